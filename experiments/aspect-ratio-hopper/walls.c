/* walls.c - forces on the side walls: A00 5.3.3.1, Figs 5.19 and 5.20. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "engine/check.h"
#include "experiments/aspect-ratio-hopper/aspect.h"

static const double SMOOTH_S = 0.02; /* a pulse lasts longer than the ringing of a contact */

static const double *partition(const results *r, const char *side, int section) {
    char name[40];
    snprintf(name, sizeof name, "%s_normal_%d_N", side, section + 1);
    return run_column(r, name);
}

/* Largest mean over SMOOTH_S up to PULSE_UNTIL. */
static double largest(const double *t, const double *force, int n) {
    int span = (int)lround(SMOOTH_S / (t[1] - t[0])) + 1;
    double most = 0;
    for (int i = 1; i + span <= n && t[i + span - 1] <= PULSE_UNTIL; i++) {
        double sum = 0;
        for (int k = 0; k < span; k++) sum += force[i + k];
        most = fmax(most, sum / span);
    }
    return most;
}

/* Both walls; partitions that carry less than a tenth of the most loaded one at rest are left
 * out: at the surface any force is many times that at rest. */
static double pulse_of(const results *r, const double *t, int n) {
    double at_rest[2][SECTIONS], most = 0, sum = 0, count = 0;
    static const char *const SIDE[2] = {"west", "east"};
    for (int side = 0; side < 2; side++)
        for (int k = 0; k < SECTIONS; k++) {
            at_rest[side][k] = partition(r, SIDE[side], k)[0];
            most = fmax(most, at_rest[side][k]);
        }
    for (int side = 0; side < 2; side++)
        for (int k = 0; k < SECTIONS; k++) {
            if (at_rest[side][k] < 0.1 * most) continue;
            sum += largest(t, partition(r, SIDE[side], k), n) / at_rest[side][k];
            count++;
        }
    return count > 0 ? sum / count : NAN;
}

static void measure_pressure(flow_facts *f, const aspect_case *c, const results *r, const double *t,
                             int n) {
    f->pressure_mean = 0;
    for (int k = 0; k < SECTIONS; k++) {
        const double *west = partition(r, "west", k), *east = partition(r, "east", k);
        double sum = 0, count = 0;
        for (int i = 0; i < n; i++)
            if (t[i] >= PRESSURE_FROM && t[i] <= PRESSURE_UNTIL)
                sum += 0.5 * (west[i] + east[i]), count++;
        f->pressure[k] = count > 0 ? sum / count / (c->bed.height / SECTIONS) : NAN;
        f->pressure_mean += f->pressure[k] / SECTIONS;
    }
}

/* ---- Janssen between two walls ---------------------------------------------------------------
 * A slice of the bed rests on the one below and rubs on both walls: with s its vertical stress
 * times the thickness of the layer, W ds/dy = rho g W - 2 mu K s. */

double janssen_load(const aspect_case *c, double k, double depth) {
    double width = 2 * c->half_width, bulk = c->bed.weight / (width * c->bed.height);
    double most = bulk * width / (2 * WALL_FRICTION);
    return depth > 0 ? most * (1 - exp(-2 * WALL_FRICTION * k * depth / width)) : 0;
}

static double misfit(const aspect_case *c, double k) {
    double sum = 0, part = c->bed.height / SECTIONS;
    for (int i = 0; i < SECTIONS; i++) {
        double off = c->flow.pressure[i] - janssen_load(c, k, (SECTIONS - i - 0.5) * part);
        sum += off * off;
    }
    return sum;
}

/* K by least squares, in steps of a thousandth: one dip, and no number needs more digits. */
static void fit_janssen(aspect_case *c) {
    flow_facts *f = &c->flow;
    f->janssen_k = 0.001;
    for (int i = 1; i <= 5000; i++)
        if (misfit(c, 0.001 * i) < misfit(c, f->janssen_k)) f->janssen_k = 0.001 * i;
    double spread = 0;
    for (int i = 0; i < SECTIONS; i++) spread += pow(f->pressure[i] - f->pressure_mean, 2);
    f->janssen_r2 = 1 - misfit(c, f->janssen_k) / spread;
}

void walls_measure(aspect_case *c, const results *r) {
    CLAST_ASSERT(c && r);
    const double *t = run_column(r, "time_s");
    int n = (int)results_rows(r);
    c->flow.pulse = pulse_of(r, t, n);
    measure_pressure(&c->flow, c, r, t, n);
    fit_janssen(c);
}
