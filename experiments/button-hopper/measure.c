/* measure.c - reads one discharge as the experimenter read his video (A00 4.3.1). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "experiments/button-hopper/hopper.h"
#include "experiments/run/results.h"

const double RATE_R2[3] = {LINEAR_R2, 0.98, 0.995};

static const double *column(const results *r, const char *name) {
    const double *c = results_series(r, name);
    if (!c) {
        fprintf(stderr, "a run has no column %s: was it made by another version?\n", name);
        exit(4);
    }
    return c;
}

/* ---- rates and arches ------------------------------------------------------------------------ */

/* The linear part begins with the start-up and ends with a broken surface; what is called steady
 * here is the middle half of it, by mass. */
static void find_middle(hopper_run *h, const double *t, const double *grams,
                        const linear_window *w) {
    h->steady = *w;
    int last = w->first + w->count - 1, i = w->first;
    double low = grams[w->first], part = grams[last] - low;
    while (i < last && grams[i] < low + 0.25 * part) i++;
    h->middle_first = i;
    while (i < last && grams[i] < low + 0.75 * part) i++;
    h->middle_last = i;
    h->middle_from = t[h->middle_first], h->middle_to = t[h->middle_last];
}

static void measure_rates(hopper_run *h, const results *r) {
    int n = (int)results_rows(r);
    const double *t = column(r, "time_s"), *kg = column(r, "out_kg");
    double *grams = calloc((size_t)n + 1, sizeof *grams);
    if (!grams) abort();
    for (int i = 0; i < n; i++) grams[i] = 1000 * kg[i];
    for (int k = 0; k < 3; k++) {
        linear_window w = linear_part(t, grams, n, RATE_R2[k]);
        double part = w.count > 0 ? grams[w.first + w.count - 1] - grams[w.first] : 0;
        /* an arch that holds from the start leaves no linear part worth the name */
        bool found = part >= 0.2 * BUTTONS * BUTTON_MASS_G;
        h->rate[k] = found ? w.slope : NAN;
        if (k == 0 && found) find_middle(h, t, grams, &w);
    }
    free(grams);
}

static void measure_arches(hopper_run *h, const results *r) {
    int n = (int)results_rows(r), flowing = 0;
    const double *out = column(r, "out_count");
    while (flowing < n && out[flowing] < ARCH_PART * out[n - 1]) flowing++;
    arch events[200];
    arches pauses = arch_events(column(r, "time_s"), out, flowing, PAUSE_MIN_S, events, 200);
    for (int i = 0; i < pauses.n && i < 200; i++) {
        h->arch_count +=
            events[i].length > ARCH_MIN_S - 0.001; /* sampled, at multiples of a step */
        if (events[i].length > h->pause.length) h->pause = events[i];
    }
    h->left = (int)column(r, "left_count")[n - 1];
    h->blocked = h->left > BLOCKED_LEFT;
}

/* ---- densities ------------------------------------------------------------------------------- */

static void measure_densities(hopper_run *h, const results *r) {
    int n = (int)results_rows(r);
    const double *phi = column(r, "bed_fraction"), *rho = column(r, "bed_bulk_kg_per_m2");
    h->phi_rest = phi[0];
    h->phi_rest_top = column(r, "bed_fraction_top")[0];
    h->phi_flow = h->rho_flow = 0;
    int count = 0;
    bool flows = h->steady.count > 0;
    for (int i = h->middle_first; flows && i <= h->middle_last && i < n; i++) {
        if (!isfinite(phi[i])) continue;
        h->phi_flow += phi[i];
        h->rho_flow += 0.1 * rho[i]; /* kg/m2 to g/cm2 */
        count++;
    }
    h->phi_flow = count ? h->phi_flow / count : NAN;
    h->rho_flow = count ? h->rho_flow / count : NAN;
    h->c = beverloo_c(h->rate[0], h->rho_flow, ORIFICE_CM[h->orifice], KD_EXPERIMENT_CM,
                      BUTTON_DIAMETER);
}

static void measure_residual(hopper_run *h, const results *r) {
    int n = (int)results_rows(r);
    const double *residual = column(r, "residual_J"), *input = column(r, "input_J");
    h->residual = 0;
    for (int i = 0; i < n; i++) h->residual = fmax(h->residual, fabs(residual[i]) / input[n - 1]);
}

/* ---- velocities in the band ------------------------------------------------------------------ */

static int place_of(const frame *f, uint32_t id) {
    size_t low = 0, high = f->bodies;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (f->id[middle] < id)
            low = middle + 1;
        else
            high = middle;
    }
    return low < f->bodies && f->id[low] == id ? (int)low : -1;
}

/* A00 4.3.1 (iii): buttons whose centre lies in the band in one frame; velocity from where they are
 * in the next frame; x halfway between. */
static void sample_band(hopper_run *h, const frame *now, const frame *next) {
    double low = 0.01 * (BAND_HEIGHT_CM - 0.5 * BUTTON_DIAMETER);
    double high = 0.01 * (BAND_HEIGHT_CM + 0.5 * BUTTON_DIAMETER);
    for (size_t i = 0; i < now->bodies; i++) {
        double z = now->position[3 * i + 2];
        int j = place_of(next, now->id[i]);
        if (z < low || z > high || j < 0) continue;
        double x = 0.5 * (now->position[3 * i] + next->position[3 * j]);
        h->velocity_x[h->velocity_count] = 100 * x;
        h->velocity[h->velocity_count++] =
            (next->position[3 * j + 2] - z) / (next->time - now->time);
    }
}

/* Frames of the video that fall into the steady part; an animated run has more frames than the
 * video. */
static void measure_velocities(hopper_run *h, results *r) {
    size_t frames = results_frames(r), room = (frames + 1) * BUTTONS;
    h->velocity_x = calloc(room, sizeof *h->velocity_x);
    h->velocity = calloc(room, sizeof *h->velocity);
    if (!h->velocity_x || !h->velocity) abort();
    if (h->steady.count == 0) return;
    for (double t = 0; t + VIDEO_FRAME_S <= h->middle_to + 0.5 * VIDEO_FRAME_S;
         t += VIDEO_FRAME_S) {
        size_t a = results_frame_at(r, t), b = results_frame_at(r, t + VIDEO_FRAME_S);
        if (t < h->middle_from - 0.5 * VIDEO_FRAME_S || a == b || b >= frames) continue;
        frame *now = results_frame(r, a), *next = results_frame(r, b);
        if (!now || !next) {
            fprintf(stderr, "%s: %s\n", h->folder, results_error(r));
            exit(4);
        }
        sample_band(h, now, next);
        frame_free(now);
        frame_free(next);
    }
}

void hopper_measure(hopper_run *h) {
    char why[RESULTS_ERROR_MAX];
    results *r = results_open(h->folder, why);
    if (!r) {
        fprintf(stderr, "%s: %s\n", h->folder, why);
        exit(4);
    }
    measure_rates(h, r);
    measure_arches(h, r);
    measure_densities(h, r);
    measure_residual(h, r);
    measure_velocities(h, r);
    results_free(r);
}
