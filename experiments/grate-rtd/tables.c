/* tables.c - the data folder: plain CSV that the figures are drawn from. Times in minutes, as the
 * source has them. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/grate-rtd/grate.h"
#include "experiments/study/output.h"
#include "experiments/study/verdict.h"

static const char *const GROUP_NAME[] = {
    [GROUP_MAIN] = "main",       [GROUP_FEED] = "feed",   [GROUP_FEED_10X] = "feed 10 x",
    [GROUP_SEED] = "seed",       [GROUP_WIDTH] = "width", [GROUP_FAST] = "fast",
    [GROUP_PACKING] = "packing", [GROUP_FILM] = "film",   [GROUP_VARIANT] = "variant"};

static void put(FILE *f, interval x, double factor) {
    fprintf(f, ",%.6g,%.4g", factor * x.mean, factor * x.half);
}

/* ---- one row per run ------------------------------------------------------------------------- */

static void write_case(FILE *f, const grate_result *g) {
    const rtd *r = g->rtd;
    fprintf(f, "%s,%s,%g,%g,%zu,%zu,%.5g,%d", g->of->name, GROUP_NAME[g->of->group], g->of->feed,
            g->of->across, r->tracers, r->inside, r->from / 60, r->steady);
    put(f, r->of[RTD_MEAN], 1.0 / 60);
    put(f, r->of[RTD_SPREAD], 1);
    put(f, r->of[RTD_SKEWNESS], 1);
    put(f, r->of[RTD_TANKS], 1);
    put(f, r->of[RTD_PECLET_OPEN], 1);
    put(f, r->of[RTD_PECLET_CLOSED], 1);
    fprintf(f, ",%.5g,%.5g", r->tanks.shape, r->dispersion.shape);
    put(f, r->of[RTD_INSIDE], 1);
    put(f, r->of[RTD_SIZE_SLOPE], 1e-3 / 60);
    put(f, r->of[RTD_SIZE_RANK], 1);
    put(f, r->drift, 1);
    put(f, r->holdup, 1);
    put(f, r->little, 1);
    put(f, g->bed.bodies, 1);
    put(f, g->bed.height, 1e3);
    put(f, g->bed.outline, 1e3);
    put(f, g->bed.packing, 1);
    fprintf(f, ",%.4g,%.4g,%.5g,%.4g,%.3g", r->peaks.p,
            r->peaks.count > 1 ? r->peaks.at[r->peaks.count - 1] / r->of[RTD_MEAN].mean
                               : (double)NAN,
            g->processor_time, g->steps, 1e6 * g->processor_time / g->steps);
    put(f, g->bed.lying, 1);
    fprintf(f, "\n");
}

static int write_cases(const grate_study *s) {
    FILE *f = output_table(
        s->data, "cases.csv",
        "case,group,feed_kg_h,across,tracers,inside,from_min,steady,mean_min,mean_half,spread,"
        "spread_half,skewness,skewness_half,tanks,tanks_half,peclet_open,peclet_open_half,"
        "peclet_closed,peclet_closed_half,tanks_fit,peclet_fit,stays,stays_half,size_min_per_mm,"
        "size_half,rank,rank_half,drift,drift_half,holdup_kg,holdup_half,little,little_half,bodies,"
        "bodies_half,"
        "height_mm,height_half,outline_mm,outline_half,packing,packing_half,p_peaks,second_peak,"
        "processor_s,steps,us_per_step,lying,lying_half");
    if (!f) return 4;
    for (int i = 0; i < s->count; i++)
        if (s->results[i].rtd) write_case(f, &s->results[i]);
    return output_close(f);
}

/* ---- curves ---------------------------------------------------------------------------------- */

static void write_curve(FILE *f, const char *name, const rtd *r) {
    double step = r->options.sampling, mean = r->of[RTD_MEAN].mean;
    for (size_t j = 0; j < r->bins; j++) {
        double from = step * (double)j, to = from + step;
        rtd_fitted tanks = rtd_fitted_bin(r, tanks_share, &r->tanks, j);
        rtd_fitted flow = rtd_fitted_bin(r, dispersion_share, &r->dispersion, j);
        fprintf(f, "%s,%g,%.6g,%.6g,%.5g,%.4g,%.5g,%.4g,%.5g,%.5g,%.5g,%.5g,%.5g\n", name,
                step / 60, from / 60, to / 60, 60 * r->density[j], 60 * r->density_half[j],
                r->share[j], r->share_half[j], 60 * tanks.density, tanks.share, 60 * flow.density,
                flow.share, (from + to) / 2 / mean);
    }
}

/* Sampled anew: same tracers, another width of the intervals. */
static void write_sampled(FILE *f, const grate_result *g, double sampling) {
    char why[RTD_ERROR_MAX];
    rtd_options o = g->rtd->options;
    o.sampling = sampling;
    rtd *r = rtd_new(g->passages, &o, why);
    if (r) write_curve(f, g->of->name, r); /* a fit that failed is nan */
    rtd_free(r);
}

/* A figure is drawn where its table has rows: one table per figure. */
static int write_curves_of(const grate_study *s, const char *table,
                           bool wanted(const grate_case *c), double sampling) {
    FILE *f = output_table(s->data, table,
                           "case,sampling_min,from_min,to_min,E_per_min,E_half,F,F_half,E_tanks,"
                           "F_tanks,E_dispersion,F_dispersion,middle_over_mean");
    if (!f) return 4;
    for (int i = 0; i < s->count; i++) {
        const grate_result *g = &s->results[i];
        if (!g->rtd || !wanted(g->of)) continue;
        write_sampled(f, g, sampling);
        if (!strcmp(g->of->name, "forward clay")) write_sampled(f, g, 60);
    }
    return output_close(f);
}

static bool is_main(const grate_case *c) {
    return c->group == GROUP_MAIN;
}
static bool is_hard(const grate_case *c) {
    return c->group == GROUP_MAIN && !strstr(c->name, "clay");
}
static bool is_wide(const grate_case *c) {
    return c->group == GROUP_WIDTH;
}
static bool is_fast(const grate_case *c) {
    return c->group == GROUP_FAST;
}

static int write_curves(const grate_study *s) {
    return write_curves_of(s, "curves.csv", is_main, SAMPLING) |
           write_curves_of(s, "hard.csv", is_hard, SAMPLING) |
           write_curves_of(s, "wide.csv", is_wide, 6) | write_curves_of(s, "fast.csv", is_fast, 6);
}

static const char *scan_of(const grate_case *c) {
    return in_scan(c, false) ? "clay" : in_scan(c, true) ? "clay10" : is_fast(c) ? "fast" : NULL;
}

/* Means against feed, where there is more than one feed. */
static int write_feeds(const grate_study *s) {
    FILE *f = output_table(s->data, "feeds.csv", "group,feed_kg_h,mean_min,mean_half");
    if (!f) return 4;
    bool scanned = false;
    for (int i = 0; i < s->count; i++)
        scanned = scanned || (s->results[i].rtd && s->results[i].of->group == GROUP_FEED);
    for (int i = 0; i < s->count && scanned; i++) {
        const grate_result *g = &s->results[i];
        if (!g->rtd || !scan_of(g->of)) continue;
        fprintf(f, "%s,%g", scan_of(g->of), g->of->feed);
        put(f, g->rtd->of[RTD_MEAN], 1.0 / 60);
        fprintf(f, "\n");
    }
    return output_close(f);
}

/* Hold-up and bed of wood at 35 mm/s against the pitch, where there is more than one. */
static int write_pitches(const grate_study *s) {
    static const char NAME[] = "fast 13.6 kg/h";
    FILE *f =
        output_table(s->data, "pitches.csv", "pitch_mm,bodies,bodies_half,height_mm,height_half");
    if (!f) return 4;
    int scanned = 0;
    for (int i = 0; i < s->count; i++)
        scanned += s->results[i].rtd && !strncmp(s->results[i].of->name, NAME, strlen(NAME));
    for (int i = 0; i < s->count && scanned > 1; i++) {
        const grate_result *g = &s->results[i];
        if (!g->rtd || strncmp(g->of->name, NAME, strlen(NAME)) != 0) continue;
        fprintf(f, "%.4g", 1e3 * case_pitch(g->of));
        put(f, g->bed.bodies, 1);
        put(f, g->bed.height, 1e3);
        fprintf(f, "\n");
    }
    return output_close(f);
}

/* ---- time and size --------------------------------------------------------------------------- */

enum { LOOKS = 400, SIZE_CLASSES = 9 };

static int write_holdup(const grate_study *s) {
    FILE *f = output_table(s->data, "holdup.csv", "case,time_min,holdup_kg,from_min");
    if (!f) return 4;
    for (int i = 0; i < s->count; i++) {
        const grate_result *g = &s->results[i];
        if (!g->rtd || g->of->assumption) continue;
        for (int k = 1; k <= LOOKS; k++) {
            double time = g->passages->end * k / LOOKS;
            fprintf(f, "%s,%.6g,%.6g,%.6g\n", g->of->name, time / 60, holdup_at(g->passages, time),
                    g->rtd->from / 60);
        }
    }
    return output_close(f);
}

/* Mean residence time by class of diameter, with its interval over tracers. */
static void write_sizes_of(FILE *f, const grate_result *g) {
    static double sample[SIZE_CLASSES][20000];
    int count[SIZE_CLASSES] = {0};
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < g->rtd->tracers; i++) {
        low = fmin(low, g->rtd->items[i].diameter);
        high = fmax(high, g->rtd->items[i].diameter);
    }
    if (!(high > low)) return;
    for (size_t i = 0; i < g->rtd->tracers; i++) {
        const tracer *t = &g->rtd->items[i];
        int k = (int)((t->diameter - low) / (high - low) * (SIZE_CLASSES - 1e-9));
        if (t->left && count[k] < 20000) sample[k][count[k]++] = t->time;
    }
    for (int k = 0; k < SIZE_CLASSES; k++) {
        interval m = mean_interval(sample[k], count[k]);
        fprintf(f, "%s,%.5g,%.6g,%.4g,%d\n", g->of->name,
                1e3 * (low + (k + 0.5) * (high - low) / SIZE_CLASSES), m.mean / 60, m.half / 60,
                m.n);
    }
}

static int write_sizes(const grate_study *s) {
    FILE *f = output_table(s->data, "sizes.csv", "case,diameter_mm,mean_min,mean_half,n");
    if (!f) return 4;
    for (int i = 0; i < s->count; i++)
        if (s->results[i].rtd && s->results[i].of->group == GROUP_MAIN)
            write_sizes_of(f, &s->results[i]);
    return output_close(f);
}

/* ---- bulk density ---------------------------------------------------------------------------- */

static int write_packing(const grate_study *s) {
    FILE *f = output_table(s->data, "packing.csv", "across,packing,packing_half,n,published");
    if (!f) return 4;
    for (int i = 0; i < CASE_COUNT; i++) {
        interval x = packing_over(s, CASES[i].name);
        if (CASES[i].group != GROUP_PACKING || x.n == 0) continue;
        fprintf(f, "%g,%.5g,%.4g,%d,%.4g\n", CASES[i].across, x.mean, x.half, x.n,
                packing_published(CASES[i].across));
    }
    return output_close(f);
}

/* ---- what assumptions do --------------------------------------------------------------------- */

static void write_variant(FILE *f, const grate_result *g, const char *assumption,
                          const char *value) {
    char mean[60], spread[60], height[60];
    interval minutes = g->rtd->of[RTD_MEAN], mm = g->bed.height;
    minutes.mean /= 60, minutes.half /= 60;
    mm.mean *= 1e3, mm.half *= 1e3;
    interval_text(&minutes, mean, sizeof mean);
    interval_text(&g->rtd->of[RTD_SPREAD], spread, sizeof spread);
    interval_text(&mm, height, sizeof height);
    fprintf(f, "%s,%s,%s,%zu,%s,%s,%s,%.0f,%.3g\n", g->of->of ? g->of->of : g->of->name, assumption,
            value, g->rtd->tracers, mean, spread, height, g->bed.bodies.mean,
            g->processor_time / (g->rtd->end / g->speed_up) * 3600);
}

static int write_variants(const grate_study *s) {
    FILE *f =
        output_table(s->data, "variants.csv",
                     "case,assumption,value,tracers,mean (min),variance over squared mean,bed "
                     "height (mm),bodies,processor time (s per h)");
    if (!f) return 4;
    for (int i = 0; i < s->count; i++) {
        const grate_result *g = &s->results[i];
        bool varied = g->of->assumption != NULL;
        if (!g->rtd) continue;
        write_variant(f, g, varied ? g->of->assumption : "(as it stands)",
                      varied ? strrchr(g->of->name, ':') + 2 : "");
    }
    return output_close(f);
}

/* ---- all ------------------------------------------------------------------------------------- */

static double worst_residual(const grate_study *s) {
    double worst = 0;
    for (int i = 0; i < s->count; i++) {
        char why[RESULTS_ERROR_MAX];
        results *r = s->results[i].rtd ? results_open(s->results[i].folder, why) : NULL;
        if (!r) continue;
        size_t last = results_rows(r) - 1;
        worst = fmax(worst, fabs(results_series(r, "residual_J")[last]) /
                                results_series(r, "input_J")[last]);
        results_free(r);
    }
    return worst;
}

static int write_about(const grate_study *s) {
    FILE *f = output_table(s->data, "about.txt", "study=grate-rtd");
    if (!f) return 4;
    uint64_t hash = 0;
    double seconds = 0;
    int runs = 0, untimed = 0;
    for (int i = 0; i < s->count; i++) {
        hash = hash * UINT64_C(0x100000001b3) ^ s->jobs[i].hash;
        runs += s->jobs[i].done;
        if (isfinite(s->results[i].processor_time))
            seconds += s->results[i].processor_time;
        else
            untimed++;
    }
    double fast = case_speed_up(&CASES[0], s->size);
    fprintf(f, "size=%s%s\nspeed_up=%g\nreplicates=%d runs\n", study_size_name(s->size),
            fast > 1 ? " (bars and feed 10 x, times x 10)" : "", fast, runs);
    fprintf(f, "hash=0x%016llx\nengine=%s\n", (unsigned long long)hash, CLAST_VERSION);
    fprintf(f, "worst_residual=%.2g\nprocessor_min=%s%.3g\n", worst_residual(s),
            untimed > 0 ? "more than " : "", seconds / 60);
    return output_close(f);
}

int grate_write_tables(const grate_study *s) {
    CLAST_ASSERT(s);
    int bad = write_cases(s) | write_curves(s) | write_holdup(s) | write_sizes(s);
    bad |= write_feeds(s) | write_pitches(s) | write_packing(s) | write_variants(s);
    return bad | write_about(s) ? 4 : 0;
}
