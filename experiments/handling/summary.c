/* summary.c - replicates into means with intervals. */
#include <math.h>

#include "experiments/handling/handling.h"

typedef struct sample {
    double value[REPLICATES_MAX];
    int count;
} sample;

static void add(sample *s, double value) {
    if (isfinite(value) && s->count < REPLICATES_MAX) s->value[s->count++] = value;
}

static interval over(const sample *s) {
    return mean_interval(s->value, s->count);
}

conveyed_summary conveyed_over(const handling_study *s, scene_kind kind, int of_variant) {
    sample carried = {0}, dropped = {0}, returned = {0}, first = {0}, shear = {0}, seen = {0};
    sample peak = {0}, duration = {0};
    const handling_run *run;
    for (int k = 0; k < REPLICATES_MAX; k++) {
        if (!(run = run_of(s, kind, of_variant, k))) continue;
        results *r = run_open(run);
        conveyed c = conveyed_of(r, kind);
        add(&carried, c.carried), add(&dropped, c.dropped), add(&returned, c.returned);
        drop d = drop_of(r);
        results_free(r);
        if (d.collisions == 0) continue; /* what never lands has no hardest one */
        add(&peak, d.peak), add(&duration, d.duration);
        add(&first, d.first_is_largest), add(&shear, d.shear_with_normal);
        add(&seen, d.seen / d.peak);
    }
    return (conveyed_summary){.carried = over(&carried),
                              .dropped = over(&dropped),
                              .returned = over(&returned),
                              .first_is_largest = over(&first),
                              .shear_with_normal = over(&shear),
                              .seen_part = over(&seen),
                              .peak = over(&peak),
                              .duration = over(&duration)};
}

static double mean(const double *x, int count) {
    double sum = 0;
    int known = 0;
    for (int i = 0; i < count; i++)
        if (isfinite(x[i])) sum += x[i], known++;
    return known ? sum / known : NAN;
}

singled_summary singled_over(const handling_study *s, int of_variant) {
    sample passed = {0}, alone = {0}, speed = {0}, ahead = {0}, before = {0};
    const handling_run *run;
    for (int k = 0; k < REPLICATES_MAX; k++) {
        if (!(run = run_of(s, SINGULATION, of_variant, k))) continue;
        results *r = run_open(run);
        singled one = singled_of(r);
        double alone_of[SPHEROIDS];
        for (int i = 0; i < one.count; i++) alone_of[i] = one.alone[i];
        if (one.start == 0)
            fprintf(stderr,
                    "handling: singulation, replicate %d: all spheroids start beyond %g m, "
                    "none can pass\n",
                    k + 1, SINGLED_AT);
        add(&passed, singled_share(&one));
        add(&alone, mean(alone_of, one.count));
        add(&speed, mean(one.speed, one.count));
        add(&ahead, mean(one.ahead, one.count));
        add(&before, one.before);
        results_free(r);
    }
    return (singled_summary){over(&passed), over(&alone), over(&speed), over(&ahead),
                             over(&before)};
}

disc_summary disc_over(const handling_study *s, int of_variant) {
    sample stay = {0}, frequency = {0};
    const handling_run *run;
    for (int k = 0; k < REPLICATES_MAX; k++) {
        if (!(run = run_of(s, DISC, of_variant, k))) continue;
        results *r = run_open(run);
        turned t = turned_of(r, spin_of(of_variant));
        add(&stay, (double)t.left / t.bodies), add(&frequency, t.frequency);
        results_free(r);
    }
    return (disc_summary){over(&stay), over(&frequency)};
}

bin_summary bin_over(const handling_study *s, int of_variant, int shape, int orifice) {
    sample arched = {0}, out = {0}, rate = {0}, coordination = {0};
    const handling_run *run;
    for (int k = 0; k < REPLICATES_MAX; k++) {
        if (!(run = flow_of(s, of_variant, shape, orifice, k))) continue;
        results *r = run_open(run);
        flow f = flow_measured(r, 0.01 * ORIFICE_CM[orifice]);
        add(&arched, f.arched), add(&out, f.out), add(&rate, f.rate);
        add(&coordination, f.coordination);
        results_free(r);
    }
    return (bin_summary){over(&arched), over(&out), over(&rate), over(&coordination), arched.count};
}
