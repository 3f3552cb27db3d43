/* verdicts.c - every number that the source prints, ours beside it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "experiments/pool-ball-piston/piston.h"
#include "experiments/study/published.h"
#include "experiments/study/verdict.h"

typedef struct court {
    published_table *numbers;
    verdict_table *table;
} court;

static void say(const court *c, const char *quantity, double ours) {
    verdict_named(c->table, c->numbers, quantity, ours);
}

static void say_of(const court *c, const char *what, int p, double ours, bool have) {
    char name[80];
    snprintf(name, sizeof name, "%s of particle %d", what, p + 1);
    verdict_published(c->table, published_need(c->numbers, name), interval_exact(ours), have);
}

/* ---- what needs no run ----------------------------------------------------------------------- */

/* A00 Table 4.2 from its own counts: the only data of the experiment that are printed. */
static void judge_table(const court *c) {
    int all[DEGREES] = {0};
    double mean = 0;
    for (int p = 0; p < PARTICLES; p++) {
        double percent = score_percent(THESIS_DEGREE[p]);
        say_of(c, "Table 4.2: score", p, percent, true);
        mean += percent / PARTICLES;
        for (int k = 0; k < DEGREES; k++) all[k] += THESIS_DEGREE[p][k];
    }
    say(c, "Table 4.2: mean of the scores", mean);
    for (int k = 0; k < DEGREES; k++) {
        char name[80];
        snprintf(name, sizeof name, "Table 4.2: frames of degree %d", k);
        say(c, name, 100.0 * all[k] / (PARTICLES * VIDEO_FRAMES));
    }
}

/* A00 1.20. */
static double damping_ratio(double restitution) {
    double l = log(restitution);
    return -l / hypot(l, 3.14159265358979323846);
}

/* us: a tenth of A00 1.28. */
static double tenth_of_critical(void) {
    double young = 6.89e9, poisson = 0.35, density = 1800, radius = 0.01 * RIG_INPUT.radius;
    double speed = sqrt(young / (2 * (1 + poisson) * density));
    return 1e5 * 3.14159265358979323846 * radius / ((0.1631 * poisson + 0.8766) * speed);
}

static void judge_input(const court *c) {
    double r = RIG_INPUT.radius, h = RIG_INPUT.half;
    say(c, "diameter of a sphere", 20 * r);
    say(c, "overlap of the spheres", 100 * (r - h) / r);
    say(c, "mass of a particle by DENS 1.8", 1.8 * pair_volume(r, h));
    say(c, "damping ratio of DAMP", damping_ratio(0.85));
    say(c, "tenth of the critical step", tenth_of_critical());
}

/* ---- what our runs say ----------------------------------------------------------------------- */

static void judge_scores(const court *c, const piston_summary *m, bool have) {
    for (int p = 0; p < PARTICLES; p++)
        say_of(c, "score", p, have ? m->base.percent[p] : (double)NAN, have);
    verdict_published(c->table, published_need(c->numbers, "mean score"),
                      interval_exact(have ? m->base.mean : (double)NAN), have);
}

static void judge_friction(const court *c, const piston_summary *m) {
    for (int i = 0; i < FRICTIONS; i++) {
        char name[80];
        snprintf(name, sizeof name, "RMS at friction %g", FRICTION[i]);
        const friction_row *r = &m->friction[i];
        interval ours = {1000 * r->laid_to_rig.mean, 1000 * r->laid_to_rig.sd,
                         1000 * r->laid_to_rig.half, r->laid_to_rig.n};
        verdict_published(c->table, published_need(c->numbers, name),
                          r->found ? ours : interval_exact(NAN), r->found);
    }
}

static void judge_step(const court *c, const piston_summary *m) {
    bool have = isfinite(m->step.p);
    verdict_published(c->table, published_need(c->numbers, "P that the step makes no difference"),
                      interval_of_none(m->step.p), have);
}

/* ---- beside the verdicts --------------------------------------------------------------------- */

static void print_null_of(const char *what, const double *sorted, int n) {
    if (!sorted) return;
    double thesis = 0;
    for (int p = 0; p < PARTICLES; p++) thesis += score_percent(THESIS_DEGREE[p]) / PARTICLES;
    printf("    %s: 95 %% of the mean scores in %.1f ... %.1f %%, %.2g of them at least %.1f %%\n",
           what, sorted[(int)(0.025 * n)], sorted[(int)(0.975 * n)],
           part_at_least(sorted, n, thesis), thesis);
}

static void print_null(const null_row *r) {
    static const char *const WHAT[NULL_KINDS] = {"a perfect new draw", "the exact mean"};
    for (int k = 0; k < NULL_KINDS; k++) {
        printf("score of %s against an ensemble of %d: %.2f %% (closed form), %.2f +- %.2f %% "
               "(Monte Carlo)\n",
               WHAT[k], ENSEMBLE, 100 * r->probability[k], 100 * r->drawn[k].mean,
               100 * r->drawn[k].half);
        print_null_of("frames independent", r->independent[k], r->trials);
        print_null_of("one draw for all frames", r->whole[k], r->trials);
        print_null_of("from our own replicates", r->tracks[k], r->trials);
    }
}

static void print_friction(const piston_summary *m) {
    for (int i = 0; i < FRICTIONS; i++) {
        const friction_row *r = &m->friction[i];
        if (!r->found) continue;
        printf("friction %-4g  RMS of the model %.1f mm to ours at 0.1, %.1f mm to ours at static "
               "friction; replicates %.1f and %.1f mm; scores %.1f and %.1f %%; P %.3f\n",
               FRICTION[i], 1000 * r->model_to_base, 1000 * r->model_to_rig,
               1000 * r->laid_to_base.mean, 1000 * r->laid_to_rig.mean, r->score_base, r->score_rig,
               r->p_base);
    }
    if (isfinite(m->best))
        printf("one replicate of each friction: 0.1 comes out best in %.1f %%, the order of the "
               "source in %.1f %% of the draws\n",
               100 * m->best, 100 * m->order);
}

static void print_groups(const piston_study *s, const piston_summary *m) {
    for (int i = 0; i < s->count; i++) {
        const group *g = &s->groups[i];
        const group_row *r = &m->rows[i];
        if (!g->complete) continue;
        printf("%-26s %-36s means %5.1f mm apart, P %.3f; model %5.1f mm, scores %.1f, own %.1f "
               "%%; spread %.1f mm at the end\n",
               g->def->assumption, g->def->variant, 1000 * r->distance, r->p, 1000 * r->model,
               r->score, r->own, 1000 * r->end);
    }
}

static void print_arches(const piston_study *s) {
    for (int i = 0; i < SLOPES * FRICTIONS; i++) {
        const arch_row *r = &s->arches[i / FRICTIONS][i % FRICTIONS];
        if (r->runs > 0)
            printf("slopes of %s, friction %-4g: %d of %d arrangements end in an arch\n",
                   SLOPE_NAME[i / FRICTIONS], FRICTION[i % FRICTIONS], r->held, r->runs);
    }
}

int piston_verdicts(const piston_study *s, const piston_summary *m, const char *csv) {
    char why[PUBLISHED_ERROR_MAX];
    court c = {published_read(SCENES "/published.csv", why), verdict_new("pool-ball-piston")};
    if (!c.numbers) {
        fprintf(stderr, "%s\n", why);
        return 4;
    }
    judge_table(&c);
    judge_input(&c);
    judge_scores(&c, m, piston_group(s, SECTION_BASE, 0) != NULL);
    judge_friction(&c, m);
    judge_step(&c, m);
    print_null(&m->null);
    print_friction(m);
    print_groups(s, m);
    print_arches(s);
    int code = verdict_finish(c.table, csv, stdout);
    verdict_free(c.table);
    published_free(c.numbers);
    return code;
}
