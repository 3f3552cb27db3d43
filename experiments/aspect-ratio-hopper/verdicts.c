/* verdicts.c - every number and sentence of A00 chapter 5, ours beside it. */
#include <math.h>
#include <string.h>

#include "experiments/aspect-ratio-hopper/aspect.h"
#include "experiments/study/published.h"
#include "experiments/study/verdict.h"

typedef struct court {
    published_table *published;
    verdict_table *table;
    bool same_hopper, replicated; /* as the source's; so that there is a spread to test by */
} court;

/* Judged only where something else than the claim does not decide it. */
static void say_where(const court *c, const char *quantity, interval ours, bool decided) {
    const published *p = published_need(c->published, quantity);
    bool tested = p->quantity[0] == 'P';
    verdict_published(c->table, p, ours, decided && c->same_hopper && (c->replicated || !tested));
}

static void say(const court *c, const char *quantity, interval ours) {
    say_where(c, quantity, ours, true);
}

/* "what aspect 1" and so on, as far as the source has it. */
static void say_each(const court *c, const aspect_study *s, const char *what, const char *name) {
    for (int shape = 0; shape < MAIN_SHAPES; shape++) {
        char quantity[100];
        snprintf(quantity, sizeof quantity, "%s aspect %d", what, shape + 1);
        if (published_find(c->published, quantity))
            say(c, quantity, over(s, shape, fact_named(name)));
    }
}

/* ---- the bed --------------------------------------------------------------------------------- */

/* Share of the fall from a to c that comes between b and c. */
static interval share_of_fall(interval a, interval b, interval c) {
    double whole = a.mean - c.mean, share = (b.mean - c.mean) / whole;
    double slope[] = {-share / whole, 1 / whole, (share - 1) / whole};
    return estimate_interval(estimate_of(share, (interval[]){a, b, c}, slope, 3));
}

static interval slowest(const aspect_study *s) {
    interval most = over(s, 0, fact_named("stable after"));
    for (int shape = 1; shape < MAIN_SHAPES; shape++) {
        interval now = over(s, shape, fact_named("stable after"));
        if (now.mean > most.mean) most = now;
    }
    return most;
}

static void judge_bed(const court *c, const aspect_study *s) {
    fact *phi = fact_named("solid fraction"), *z = fact_named("co-ordination number");
    interval one = over(s, 0, phi), two = over(s, 1, phi), four = over(s, 3, phi);
    say(c, "time until the slowest bed is stable", slowest(s));
    say(c, "solid fraction: fall from aspect 1 to 4", fall_percent(one, four));
    say(c, "solid fraction: share of the fall between aspect 2 and 4",
        share_of_fall(one, two, four));
    say_each(c, s, "skewness of the solid fraction", "skewness");
    say_each(c, s, "kurtosis of the solid fraction", "kurtosis");
    say_each(c, s, "particles in a full cell", "particles in a full cell");
    say(c, "co-ordination: fall from aspect 1 to 2", fall_percent(over(s, 0, z), over(s, 1, z)));
    say(c, "co-ordination: fall from aspect 2 to 4", fall_percent(over(s, 1, z), over(s, 3, z)));
    say_each(c, s, "force on the bottom: difference from the weight",
             "bottom force off the weight");
}

/* ---- the flow -------------------------------------------------------------------------------- */

static bool is_full(const aspect_study *s, int shape, const char *level) {
    return over(s, shape, fact_named(level)).mean >= CHAMBER_FULL;
}

/* The same in a deeper chamber; n = 0 without such a run. */
static interval in_deep_chamber(const aspect_study *s, int shape, const char *name) {
    for (int v = 1; v < VARIANT_COUNT; v++)
        if (VARIANTS[v].shape == shape && !strcmp(VARIANTS[v].assumption, "depth of the chamber"))
            return over_variant(s, v, fact_named(name));
    return (interval){NAN, NAN, NAN, 0};
}

/* A full chamber ends the discharge within its linear part: the tail is not there to be seen. Then
 * the run with the deeper one counts. */
static void say_linear_parts(const court *c, const aspect_study *s) {
    const char *level = "level of the heap at the end";
    for (int shape = 0; shape < MAIN_SHAPES; shape++) {
        char quantity[100];
        snprintf(quantity, sizeof quantity, "linear part of the discharge aspect %d", shape + 1);
        interval ours = over(s, shape, fact_named("linear part"));
        bool room = !is_full(s, shape, level);
        interval deep = in_deep_chamber(s, shape, "linear part");
        if (!room && deep.n > 0) {
            ours = deep;
            room = in_deep_chamber(s, shape, level).mean < CHAMBER_FULL;
        }
        say_where(c, quantity, ours, room);
    }
}

static void judge_flow(const court *c, const aspect_study *s) {
    say_each(c, s, "start-up delay", "start-up delay");
    say_linear_parts(c, s);
    say_each(c, s, "fastest particle at 1.4 s", "fastest particle at 1.4 s");
    say_each(c, s, "log10 of the energy ratio", "energy ratio");
    say_each(c, s, "log10 of the energy ratio of a particle", "energy ratio by particles");
    say_each(c, s, "angle of the shear band", "shear angle");
    interval five = over(s, SHAPES - 1, fact_named("rate"));
    interval change = fall_percent(over(s, 0, fact_named("rate")), five);
    change.mean = -change.mean;
    if (five.n > 0) say(c, "rate: change from aspect 1 to 5", change);
}

/* ---- trends ---------------------------------------------------------------------------------- */

static void judge_trend(const court *c, const aspect_study *s, const char *quantity,
                        const char *name, int sign, int shapes) {
    say(c, quantity, interval_of_none(trend_p(s, fact_named(name), sign, shapes)));
}

static void judge_spheres(const court *c, const aspect_study *s, const char *quantity,
                          const char *name) {
    say(c, quantity, interval_of_none(spheres_above_p(s, fact_named(name))));
}

/* -fact, for what is smaller in spheres. */
static double no_pulse(const aspect_case *c) {
    return -c->flow.pulse;
}

static void judge_trends(const court *c, const aspect_study *s) {
    judge_trend(c, s, "P: the bed is higher the longer the particles", "bed height", 1, 4);
    judge_trend(c, s, "P: the solid fraction falls with the aspect ratio", "solid fraction", -1, 4);
    judge_trend(c, s, "P: the co-ordination number falls with the aspect ratio",
                "co-ordination number", -1, 4);
    judge_trend(c, s, "P: the rate falls with the aspect ratio", "rate", -1, 4);
    judge_trend(c, s, "P: the rate takes longer to become constant with the aspect ratio",
                "time to the linear part", 1, 4);
    judge_trend(c, s, "P: the rate fluctuates more with the aspect ratio",
                "fluctuation of the rate", 1, 4);
    judge_trend(c, s, "P: temporary arches are more frequent with the aspect ratio", "arches", 1,
                4);
    judge_spheres(c, s, "P: spheres have the larger energy ratio left", "energy ratio left");
    judge_spheres(c, s, "P: spheres have the larger energy ratio centre", "energy ratio centre");
    judge_spheres(c, s, "P: spheres have the larger energy ratio right", "energy ratio right");
    say(c, "P: the energy ratio is smallest in the centre",
        interval_of_none(positive_p(s, fact_named("energy ratio sides over centre"))));
    judge_spheres(c, s, "P: spheres have the larger energy ratio of a particle left",
                  "energy ratio left by particles");
    judge_spheres(c, s, "P: spheres have the larger energy ratio of a particle centre",
                  "energy ratio centre by particles");
    judge_spheres(c, s, "P: spheres have the larger energy ratio of a particle right",
                  "energy ratio right by particles");
    say(c, "P: the energy ratio of a particle is smallest in the centre",
        interval_of_none(positive_p(s, fact_named("energy ratio sides over centre by particles"))));
    judge_spheres(c, s, "P: the shear band of spheres is steeper", "steepness of the shear band");
    say(c, "P: side walls feel a stronger pulse of longer particles",
        interval_of_none(spheres_above_p(s, no_pulse)));
    judge_trend(c, s, "P: the wall pressure grows with the aspect ratio", "wall load", 1, 3);
    const char *level = "level of the heap at 1.4 s"; /* what fills the chamber is level */
    say_where(c, "P: the heap of aspect 2 is steeper than that of aspect 1",
              interval_of_none(above_p(s, fact_named("heap slope at 1.4 s"), 1, 0)),
              !is_full(s, 0, level) && !is_full(s, 1, level));
    judge_spheres(c, s, "P: tracked spheres turn more than longer particles",
                  "turned by tracked particles");
}

static void judge_settings(const court *c, const aspect_study *s) {
    for (int i = 0; i < SETTING_FACT_COUNT; i++) {
        interval apart = setting_difference(s, &SETTING_FACTS[i]);
        if (apart.n == MAIN_SHAPES) say(c, SETTING_FACTS[i].row, apart);
    }
}

/* What does not hang on one number alone, said all the same. */
static void print_readings(const aspect_study *s) {
    static const char *const ALSO[] = {"solid fraction by area",
                                       "bottom force off the weight at the end",
                                       "bottom force off the weight at rest",
                                       "first particle out",
                                       "delay by the linear part",
                                       "rate",
                                       "rate with R2 0.99",
                                       "rate with R2 0.9995",
                                       "energy ratio centre by particles",
                                       "steepness of the shear band",
                                       "shear angle at 0.1 s",
                                       "shear angle at 0.4 s",
                                       "shear angle at 70 %",
                                       "level of the heap at 1.4 s",
                                       "level of the heap at the end"};
    for (size_t i = 0; i < sizeof ALSO / sizeof *ALSO; i++) {
        printf("%s, aspect 1 to 4:", ALSO[i]);
        for (int shape = 0; shape < MAIN_SHAPES; shape++) {
            char text[60];
            interval ours = over(s, shape, fact_named(ALSO[i]));
            interval_text(&ours, text, sizeof text);
            printf("  %s", text);
        }
        printf("\n");
    }
}

int aspect_verdicts(const aspect_study *s) {
    char why[PUBLISHED_ERROR_MAX];
    court c = {published_read(SCENES "/published.csv", why), verdict_new("aspect-ratio-hopper"),
               s->size->count == 5000, s->size->replicates[CHEAP] > 1};
    if (!c.published) {
        fprintf(stderr, "%s\n", why);
        return 4;
    }
    judge_bed(&c, s);
    judge_flow(&c, s);
    judge_trends(&c, s);
    judge_settings(&c, s);
    print_readings(s);
    int code = verdict_finish(c.table, s->to.verdicts, stdout);
    verdict_free(c.table);
    published_free(c.published);
    return code;
}
