/* verdicts.c - what S12 says of its grates, ours beside it. A case that a size does not run has no
 * row. */
#include <math.h>

#include "experiments/grate-rtd/grate.h"
#include "experiments/study/published.h"
#include "experiments/study/verdict.h"

typedef struct court {
    published_table *published;
    verdict_table *table;
    const grate_study *study;
} court;

static void say(const court *c, const char *quantity, interval ours) {
    verdict_measured(c->table, c->published, quantity, ours);
}

static interval scaled(interval x, double factor) {
    return (interval){x.mean * factor, x.sd * factor, x.half * factor, x.n};
}

/* ---- forward and backward -------------------------------------------------------------------- */

static void judge_one(const court *c, const char *name) {
    const grate_result *g = result_of(c->study, name);
    char quantity[160];
    if (!g) return;
    snprintf(quantity, sizeof quantity, "%s: mean residence time", name);
    say(c, quantity, scaled(g->rtd->of[RTD_MEAN], 1.0 / 60));
    snprintf(quantity, sizeof quantity, "%s: variance over squared mean", name);
    say(c, quantity, g->rtd->of[RTD_SPREAD]);
    snprintf(quantity, sizeof quantity, "%s: feed x mean residence time over hold-up", name);
    say(c, quantity, g->rtd->little);
}

static void judge_share(const court *c, const char *name) {
    const grate_result *g = result_of(c->study, name);
    char quantity[160];
    if (!g) return;
    interval stays = g->rtd->of[RTD_INSIDE], leaves = stays;
    leaves.mean = 1 - stays.mean;
    snprintf(quantity, sizeof quantity, "%s: share of the tracers that leaves", name);
    say(c, quantity, leaves);
}

static void judge_main(const court *c) {
    const grate_result *forward = result_of(c->study, "forward clay");
    const grate_result *backward = result_of(c->study, "backward clay");
    if (forward)
        say(c, "forward clay: tracers",
            interval_exact((double)(forward->rtd->tracers - forward->rtd->inside)));
    judge_one(c, "forward clay"), judge_share(c, "forward clay");
    judge_one(c, "backward clay"), judge_share(c, "backward clay");
    judge_one(c, "backward wood");
    judge_one(c, "backward ceramic");
    if (forward && backward) {
        interval wider = difference_of(backward->rtd->of[RTD_SPREAD], forward->rtd->of[RTD_SPREAD]);
        say(c,
            "variance over squared mean, backward less forward clay: lower end of the 95 % "
            "interval",
            interval_exact(wider.mean - wider.half));
    }
    if (forward)
        say(c, "forward clay: mean residence time, sampled every 3 min over every 1 min",
            interval_exact(sampled_mean(forward->rtd, 180) / sampled_mean(forward->rtd, 60)));
}

static void judge_slope(const court *c, bool hurried, const char *quantity) {
    interval slope = slope_with_feed(c->study, hurried);
    if (isfinite(slope.mean)) say(c, quantity, interval_exact(slope.mean + slope.half));
}

static void judge_feed(const court *c) {
    judge_slope(c, false,
                "clay, backward: change of ln(mean residence time) with ln(feed): upper end of the "
                "95 % interval");
    judge_slope(c, true,
                "clay, backward, 10 x: change of ln(mean residence time) with ln(feed): upper end "
                "of the 95 % interval");
}

/* ---- width ----------------------------------------------------------------------------------- */

static void judge_width(const court *c) {
    const grate_result *one = result_of(c->study, "width 1"),
                       *five = result_of(c->study, "width 5");
    if (!one || !five) return;
    say(c, "width 5 to 1 particles: relative difference of the mean residence time",
        relative_difference(five->rtd->of[RTD_MEAN], one->rtd->of[RTD_MEAN]));
    say(c, "width 5 to 1 particles: relative difference of variance over squared mean",
        relative_difference(five->rtd->of[RTD_SPREAD], one->rtd->of[RTD_SPREAD]));
}

/* ---- bars at 35 mm/s ------------------------------------------------------------------------- */

static interval second_peak(const rtd *r) {
    bool more = r->peaks.p < 0.05 && r->peaks.count > 1;
    return interval_exact(more ? r->peaks.at[r->peaks.count - 1] / r->of[RTD_MEAN].mean
                               : (double)NAN);
}

static void judge_fast(const court *c) {
    const grate_result *full = result_of(c->study, "fast 13.6 kg/h");
    const grate_result *half = result_of(c->study, "fast 6.8 kg/h");
    if (!full || !half) return;
    say(c, "wood at 35 mm/s: hold-up at 13.6 kg/h", full->bed.bodies);
    say(c, "wood at 35 mm/s: bed height at 13.6 kg/h", scaled(full->bed.height, 1e3));
    say(c, "wood at 35 mm/s: bed height, 13.6 over 6.8 kg/h",
        ratio_of(full->bed.height, half->bed.height));
    say(c, "wood at 35 mm/s: second peak over mean", second_peak(full->rtd));
    say(c, "wood at 35 mm/s: feed x mean residence time over hold-up", full->rtd->little);
}

/* ---- bulk density ---------------------------------------------------------------------------- */

/* How much nearer to the wide bed a is than b. Where both lie on one side of it its error cancels;
 * it is counted twice all the same, as it is where they lie on both. */
static interval nearer(interval a, interval b, interval wide) {
    interval r = difference_of(difference_of(b, a), scaled(wide, 2));
    r.mean = fabs(b.mean - wide.mean) - fabs(a.mean - wide.mean);
    return r;
}

static void judge_packing(const court *c) {
    static const struct {
        const char *quantity, *name;
    } ROWS[] = {{"bulk density over that of the solid, width 1", "packing 1"},
                {"bulk density over that of the solid, width 2", "packing 2"},
                {"bulk density over that of the solid, width 5", "packing 5"},
                {"bulk density over that of the solid, wide", "packing wide"}};
    interval ours[4];
    for (int i = 0; i < 4; i++) {
        ours[i] = packing_over(c->study, ROWS[i].name);
        if (ours[i].n > 0) say(c, ROWS[i].quantity, ours[i]);
    }
    if (ours[0].n == 0 || ours[1].n == 0 || ours[3].n == 0) return;
    say(c, "bulk density: how much nearer to a wide bed width 1 is than width 2",
        nearer(ours[0], ours[1], ours[3]));
}

/* ---- mass ------------------------------------------------------------------------------------ */

static void judge_mass(const court *c) {
    double worst = 0;
    int known = 0;
    for (int i = 0; i < c->study->count; i++) {
        const passages *p = c->study->results[i].passages;
        if (p && isfinite(p->balance)) worst = fmax(worst, fabs(p->balance)), known++;
    }
    say(c, "largest error of the mass balance, all runs",
        interval_exact(known > 0 ? worst : (double)NAN));
}

int grate_verdicts(const grate_study *s, const char *path) {
    char why[PUBLISHED_ERROR_MAX];
    court c = {published_read(SCENES "/published.csv", why), verdict_new("grate-rtd"), s};
    if (!c.published) {
        fprintf(stderr, "%s\n", why);
        return 4;
    }
    judge_main(&c);
    judge_feed(&c);
    judge_width(&c);
    judge_fast(&c);
    judge_packing(&c);
    judge_mass(&c);
    int code = verdict_finish(c.table, path, stdout);
    verdict_free(c.table);
    published_free(c.published);
    return code;
}
