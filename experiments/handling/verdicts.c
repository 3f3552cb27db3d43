/* verdicts.c - what the source says about its scenes, ours beside it. Most of it is sentences: a
 * share of runs or particles for which the sentence holds stands for them. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "experiments/handling/handling.h"
#include "experiments/study/published.h"
#include "experiments/study/verdict.h"

typedef struct court {
    published_table *published;
    verdict_table *table;
} court;

static void say(const court *c, const char *quantity, interval ours) {
    verdict_measured(c->table, c->published, quantity, ours);
}

static void judge_conveyors(const court *c, const handling_study *s) {
    conveyed_summary cone = conveyed_over(s, TAPERED, 0), pear = conveyed_over(s, IRREGULAR, 0);
    say(c, "tapered: share carried with the upper conveyor", cone.carried);
    say(c, "tapered: share dropped on the lower surface", cone.dropped);
    say(c, "tapered: share moved back by the lower surface", cone.returned);
    say(c, "irregular: share dropped on the lower surface", pear.dropped);
    say(c, "irregular: largest force on the lower conveyor in the first collision",
        pear.first_is_largest);
    say(c, "irregular: largest tangential force in the same collision", pear.shear_with_normal);
    say(c, "irregular: largest force seen every 50 steps over that seen every step",
        pear.seen_part);
    say(c, "irregular: largest force on the lower conveyor", pear.peak);
    say(c, "bunch: share dropped on the lower conveyor", conveyed_over(s, BUNCH, 0).dropped);
}

static void judge_singulation(const court *c, const handling_study *s) {
    singled_summary one = singled_over(s, 0);
    say(c, "singulation: share that touches another one at the start", one.before);
    say(c, "singulation: share that is drawn on the fast conveyor", one.passed);
    say(c, "singulation: share that touches no other one there", one.alone);
    say(c, "singulation: speed on the fast conveyor", one.speed);
}

/* Share of arches over some of the shapes and some of the orifices; one run is a sample of 0 or 1.
 */
static interval arches_of(const handling_study *s, int shape, int shapes, int orifice,
                          int orifices) {
    double arched[RUNS_MAX];
    int runs = 0;
    for (int i = shape; i < shape + shapes; i++)
        for (int k = orifice; k < orifice + orifices; k++) {
            bin_summary b = bin_over(s, 0, i, k);
            int here = b.runs > 0 ? (int)lround(b.arched.mean * b.runs) : 0;
            for (int n = 0; n < b.runs; n++) arched[runs++] = n < here;
        }
    return mean_interval(arched, runs);
}

/* 1 where it is shown that a is above b (two-sided P < 0.05). Without a P, for neither scatters or
 * there are too few runs, it is not shown. What a test says is no sample. */
static interval is_above(interval a, interval b) {
    if (isnan(a.mean) || isnan(b.mean)) return interval_of_none(NAN);
    double p = t_test_welch(a, b).p;
    return interval_of_none(a.mean > b.mean && p < 0.05);
}

static void judge_bin(const court *c, const handling_study *s) {
    char quantity[100];
    for (int shape = 0; shape < SHAPES; shape++) {
        snprintf(quantity, sizeof quantity, "bin: share of permanent arches at 5 cm aspect %.1f",
                 ASPECT[shape]);
        bin_summary b = bin_over(s, 0, shape, 0);
        if (b.runs > 0) say(c, quantity, b.arched);
    }
    if (s->size->orifices < ORIFICES) return;
    interval narrow = arches_of(s, 0, SHAPES, 0, 1);
    interval wide = arches_of(s, 0, SHAPES, ORIFICES - 1, 1);
    interval short_ones = arches_of(s, 0, 2, 0, ORIFICES);
    interval long_ones = arches_of(s, SHAPES - 2, 2, 0, ORIFICES);
    say(c, "bin: arches less often at 8 cm than at 5 cm", is_above(narrow, wide));
    say(c, "bin: arches more often with the aspect ratio", is_above(long_ones, short_ones));
}

static int single_sphere(void) {
    for (int v = 1; v < VARIANT_COUNT; v++)
        if (!strcmp(VARIANTS[v].assumption, "one sphere")) return v;
    abort();
}

static void judge_disc(const court *c, const handling_study *s) {
    double frequency = disc_over(s, single_sphere()).frequency.mean;
    say(c,
        "disc: rolling sphere: relative difference of its angular frequency from 2/7 of the spin",
        interval_exact(fabs(frequency / (2.0 / 7) - 1)));
    say(c, "disc: share of the spheres that stay on it", disc_over(s, 0).stay);
}

int handling_verdicts(const handling_study *s) {
    char why[PUBLISHED_ERROR_MAX];
    court c = {published_read(SCENES "/published.csv", why), verdict_new("handling")};
    if (!c.published) {
        fprintf(stderr, "%s\n", why);
        return 4;
    }
    judge_conveyors(&c, s);
    judge_singulation(&c, s);
    judge_bin(&c, s);
    judge_disc(&c, s);
    int code = verdict_finish(c.table, s->to.verdicts, stdout);
    verdict_free(c.table);
    published_free(c.published);
    return code;
}
