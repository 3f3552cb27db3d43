/* flow.c - what is read off a discharge: A00 5.3.2 and 5.3.3. */
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>

#include "engine/check.h"
#include "experiments/aspect-ratio-hopper/aspect.h"

const double SHEAR_AT[SHEAR_TIMES] = {0.1, 0.15, SHEAR_TIME, 0.3, 0.4};

/* ---- the discharge curve --------------------------------------------------------------------- */

/* First row at which a rising column has reached a value; n when it never has. */
static int reached(const double *x, int n, double value) {
    int i = 0;
    while (i < n && x[i] < value) i++;
    return i;
}

/* Rows that BIN_S spans. */
static int bin_of(const double *t, int n) {
    int rows = n > 1 ? (int)lround(BIN_S / ((t[n - 1] - t[0]) / (n - 1))) : 1;
    return rows < 1 ? 1 : rows;
}

/* Fluctuation and arches of the rate over bins of BIN_S within the linear part, without a tenth at
 * either end: it begins with the start-up and ends when the chamber is full or the hopper empty. */
void roughness_measure(flow_facts *f, const double *t, const double *out) {
    CLAST_ASSERT(f && t && out);
    enum { BINS = 4096 };
    double rates[BINS] = {0}, lowest = INFINITY;
    int bin = bin_of(t + f->linear.first, f->linear.count), tenth = f->linear.count / 10;
    int below = 0, bins = 0, first = f->linear.first + tenth;
    int last = f->linear.first + f->linear.count - 1 - tenth;
    f->fluctuation = f->lowest = f->lowest_at = f->arches = NAN;
    if (last - first < 2 * bin) return;
    f->arches = 0;
    for (int i = first; i + bin <= last && bins < BINS; i += bin)
        rates[bins++] = (out[i + bin] - out[i]) / (t[i + bin] - t[i]);
    f->fluctuation = gsl_stats_sd(rates, 1, (size_t)bins) / f->rate;
    for (int i = first; i + bin <= last; i++) {
        double rate = (out[i + bin] - out[i]) / (t[i + bin] - t[i]);
        below = rate < ARCH_RATE * f->rate ? below + 1 : 0;
        f->arches += below == 1;
        if (rate < lowest) lowest = rate, f->lowest_at = 0.5 * (t[i] + t[i + bin]);
    }
    f->lowest = lowest / f->rate;
}

static double *percent_of(const aspect_case *c, const double *count, int n) {
    double *p = calloc((size_t)n + 1, sizeof *p);
    CLAST_ASSERT(p);
    for (int i = 0; i < n; i++) p[i] = 100 * count[i] / c->count;
    return p;
}

void discharge_measure(aspect_case *c, const results *r) {
    flow_facts *f = &c->flow;
    int n = (int)results_rows(r);
    const double *t = run_column(r, "time_s"), *number = run_column(r, "out_count");
    double *out = percent_of(c, number, n);
    int begun = reached(out, n, 100 * DELAY_SHARE), first = reached(number, n, 1);
    f->delay = begun < n ? t[begun] : NAN;
    f->first = first < n ? t[first] : NAN;
    f->linear = linear_part(t, out, n, LINEAR_R2);
    fitted_line line = line_fit(t + f->linear.first, out + f->linear.first, f->linear.count);
    f->meets = -line.intercept / line.slope;
    double part =
        f->linear.count ? out[f->linear.first + f->linear.count - 1] - out[f->linear.first] : 0;
    f->linear_share = part / out[n - 1];
    f->rate = f->linear.slope;
    f->rate_kg = f->rate / 100 * c->bed.weight / GRAVITY;
    f->rate_r2[0] = linear_part(t, out, n, 0.99).slope;
    f->rate_r2[1] = linear_part(t, out, n, 0.9995).slope;
    f->start_up = f->linear.from - f->first;
    f->left = 1 - out[n - 1] / 100;
    roughness_measure(f, t, out);
    free(out);
    const double *residual = run_column(r, "residual_J"), *input = run_column(r, "input_J");
    for (int i = 0; i < n; i++) f->residual = fmax(f->residual, fabs(residual[i]) / input[n - 1]);
}

/* ---- energy ratio (A00 5.2 to 5.4) ----------------------------------------------------------- */

typedef struct ratio_sum {
    double turning, moving, ratios, count;
} ratio_sum;

static void add_body(ratio_sum *s, double turning, double moving) {
    s->turning += turning, s->moving += moving;
    if (moving > 0) s->ratios += turning / moving, s->count += 1;
}

/* Twice the energy of rotation over the mass: in space chains also turn about their own axis, with
 * the moment of their spheres (which touch, there). */
static double turning_of(const frame *f, const aspect_case *c, size_t i) {
    const double *w = &f->spin[3 * i];
    double all = w[0] * w[0] + w[1] * w[1] + w[2] * w[2], along = 0;
    if (c->in_space && c->chain.spheres > 1) {
        const double *q = &f->orientation[4 * i];
        along = w[0] * (1 - 2 * (q[2] * q[2] + q[3] * q[3])) +
                w[1] * 2 * (q[1] * q[2] + q[0] * q[3]) + w[2] * 2 * (q[1] * q[3] - q[0] * q[2]);
    }
    double own = 0.4 * c->chain.radius * c->chain.radius;
    return c->chain.across * (all - along * along) + own * along * along;
}

ratio_at ratios_of(const frame *f, const aspect_case *c) {
    ratio_sum sum[REGIONS + 1] = {0};
    for (size_t i = 0; i < f->bodies; i++) {
        const double *p = &f->position[3 * i], *v = &f->velocity[3 * i];
        if (p[2] < 0) continue;
        double turning = 0.5 * turning_of(f, c, i);
        double moving = 0.5 * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        int region = (int)((p[0] + c->half_width) / (2 * c->half_width) * REGIONS);
        region = region < 0 ? 0 : region >= REGIONS ? REGIONS - 1 : region;
        add_body(&sum[region], turning, moving);
        add_body(&sum[REGIONS], turning, moving);
    }
    ratio_at all;
    for (int k = 0; k <= REGIONS; k++) {
        all.summed[k] = sum[k].moving > 0 ? sum[k].turning / sum[k].moving : NAN;
        all.mean[k] = sum[k].count > 0 ? sum[k].ratios / sum[k].count : NAN;
    }
    return all;
}

/* Mean over the frames of the linear part, in which the bed flows everywhere. */
void ratios_measure(aspect_case *c, results *r) {
    flow_facts *f = &c->flow;
    double sum[REGIONS + 1] = {0}, mean[REGIONS + 1] = {0}, frames = 0;
    for (size_t i = 0; i < results_frames(r); i++) {
        frame *now = results_frame(r, i);
        CLAST_ASSERT(now);
        if (now->time >= f->linear.from && now->time <= f->linear.to) {
            ratio_at at = ratios_of(now, c);
            for (int k = 0; k <= REGIONS; k++) sum[k] += log10(at.summed[k]);
            for (int k = 0; k <= REGIONS; k++) mean[k] += log10(at.mean[k]);
            frames++;
        }
        frame_free(now);
    }
    for (int k = 0; k < REGIONS; k++) f->ratio[k] = sum[k] / frames;
    for (int k = 0; k < REGIONS; k++) f->ratio_mean[k] = mean[k] / frames;
    f->ratio_all = sum[REGIONS] / frames;
    f->ratio_mean_all = mean[REGIONS] / frames;
}

/* ---- frames ---------------------------------------------------------------------------------- */

static double fastest_of(const frame *f) {
    double most = 0;
    for (size_t i = 0; i < f->bodies; i++) {
        const double *v = &f->velocity[3 * i];
        most = fmax(most, v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
    return sqrt(most);
}

static void measure_frames(aspect_case *c, results *r) {
    flow_facts *f = &c->flow;
    for (int k = 0; k < SHEAR_TIMES; k++) {
        frame *now = run_frame(r, SHEAR_AT[k]);
        f->angle[k] = shear_angle(now, c, SHEAR_BAND);
        if (SHEAR_AT[k] == SHEAR_TIME) f->angle_70 = shear_angle(now, c, 0.7);
        frame_free(now);
    }
    frame *now = run_frame(r, SNAPSHOT), *end = run_frame(r, 1e9);
    double last[HEAP_BINS];
    f->fastest = fastest_of(now);
    heap_of(now, c, f->heap);
    heap_of(end, c, last);
    f->heap_slope = heap_slope(f->heap, c->half_width);
    f->heap_end = heap_slope(last, c->half_width);
    f->level = heap_level(f->heap, c->chamber);
    f->level_end = heap_level(last, c->chamber);
    frame_free(now), frame_free(end);
}

static void measure_tracks(aspect_case *c, results *r) {
    static track all[TRACKED];
    tracks_of(r, c, all);
    double sum = 0;
    for (int k = 0; k < TRACKED; k++) sum += turned_by(&all[k]) / TRACKED;
    c->flow.turned = sum;
}

void flow_measure(aspect_case *c) {
    CLAST_ASSERT(c && c->ran);
    results *r = run_open(c->flow_folder);
    discharge_measure(c, r);
    ratios_measure(c, r);
    if (!c->in_space) {
        walls_measure(c, r);
        measure_frames(c, r);
        measure_tracks(c, r);
    }
    results_free(r);
}
