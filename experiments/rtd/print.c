/* print.c - the analysis for people and as tables. */
#include "experiments/rtd/rtd.h"

#include <inttypes.h>
#include <math.h>

#include "experiments/study/output.h"
#include "experiments/study/verdict.h"

static void line(FILE *to, const char *name, const char *unit, const interval *x) {
    char text[80];
    interval_text(x, text, sizeof text);
    fprintf(to, "  %-52s %s%s%s\n", name, text, *unit ? " " : "", unit);
}

static void print_window(const rtd *r, FILE *to) {
    fprintf(to, "tracers: fed from %g s to %g s: %zu, of which %zu still inside at %g s\n", r->from,
            r->until, r->tracers, r->inside, r->end);
    if (!r->steady)
        fprintf(to, "NOT STEADY: the minimum of MSER-5 lies in the second half of the run; nothing "
                    "was dropped\n");
    else
        fprintf(to,
                "steady from %g s (hold-up, MSER-5, or as asked for); what was fed before is "
                "dropped\n",
                r->from);
    fprintf(to,
            "intervals: 95 %%, circular block bootstrap, %d resamples, seed %" PRIu64 ", %zu "
            "blocks of %zu tracers\n",
            r->options.resamples, r->options.seed, r->blocks, r->block);
}

static void print_fit(FILE *to, const char *name, const rtd_fit *f) {
    fprintf(to, "  %-52s %.4g (mean %.5g s, misfit of F %.3g)\n", name, f->shape, f->mean,
            f->misfit);
}

static void print_peaks(const rtd *r, FILE *to) {
    fprintf(to, "peaks: more than one with P = %.3g (Silverman, critical width %.3g s);",
            r->peaks.p, r->peaks.width);
    for (int i = 0; i < r->peaks.count; i++)
        fprintf(to, "%s %.3g t_m", i ? "," : " just below it at",
                r->peaks.at[i] / r->of[RTD_MEAN].mean);
    fprintf(to, "\n");
}

void rtd_print(const rtd *r, FILE *to) {
    print_window(r, to);
    for (int k = 0; k < RTD_NUMBERS; k++)
        line(to, RTD_NUMBER[k].name, RTD_NUMBER[k].unit, &r->of[k]);
    print_fit(to, "tanks in series, least squares", &r->tanks);
    print_fit(to, "Peclet number, open vessel, least squares", &r->dispersion);
    line(to, "change of the residence time over the window", "of the mean", &r->drift);
    line(to, "hold-up", "kg", &r->holdup);
    fprintf(to, "  %-52s %.6g kg/s\n", "feed", r->feed);
    line(to, "feed x mean residence time over hold-up (S12 4.1)", "", &r->little);
    if (isfinite(r->height_held.mean)) {
        line(to, "bed height from the residence time (S12 4.1)", "m", &r->height_fed);
        line(to, "bed height from the hold-up", "m", &r->height_held);
    }
    if (isfinite(r->balance))
        fprintf(to, "  %-52s %.3g kg\n", "mass in less out less inside, whole run", r->balance);
    else
        fprintf(to, "  %-52s not known: series.csv has no inside_kg\n",
                "mass in less out less inside, whole run");
    fprintf(to, "  %-52s %zu\n", "left the domain, by no outlet", r->strays);
    print_peaks(r, to);
}

static int write_numbers(const rtd *r, const char *folder) {
    FILE *f = output_table(folder, "rtd.csv", "quantity,unit,value,half");
    if (!f) return 4;
    for (int k = 0; k < RTD_NUMBERS; k++)
        fprintf(f, "\"%s\",%s,%.9g,%.4g\n", RTD_NUMBER[k].name, RTD_NUMBER[k].unit, r->of[k].mean,
                r->of[k].half);
    fprintf(f, "\"tanks in series, least squares\",,%.9g,\n", r->tanks.shape);
    fprintf(f, "\"Peclet number, open vessel, least squares\",,%.9g,\n", r->dispersion.shape);
    fprintf(f, "change of the residence time over the window,,%.9g,%.4g\n", r->drift.mean,
            r->drift.half);
    fprintf(f, "hold-up,kg,%.9g,%.4g\nfeed,kg/s,%.9g,\n", r->holdup.mean, r->holdup.half, r->feed);
    fprintf(f, "feed x mean residence time over hold-up,,%.9g,%.4g\n", r->little.mean,
            r->little.half);
    fprintf(f, "bed height from the residence time,m,%.9g,%.4g\n", r->height_fed.mean,
            r->height_fed.half);
    fprintf(f, "bed height from the hold-up,m,%.9g,%.4g\n", r->height_held.mean,
            r->height_held.half);
    fprintf(f, "mass in less out less inside,kg,%.9g,\n", r->balance);
    fprintf(f, "\"left the domain, by no outlet\",,%zu,\n", r->strays);
    fprintf(f, "P of a single peak,,%.4g,\n", r->peaks.p);
    fprintf(f, "tracers,,%zu,\nstill inside,,%zu,\nsteady,,%d,\nfrom,s,%.9g,\nuntil,s,%.9g,\n",
            r->tracers, r->inside, r->steady, r->from, r->until);
    return output_close(f);
}

static int write_curve(const rtd *r, const char *folder) {
    FILE *f = output_table(folder, "curve.csv",
                           "from_s,to_s,E_per_s,E_half_per_s,F,F_half,E_tanks_per_s,F_tanks,"
                           "E_dispersion_per_s,F_dispersion");
    if (!f) return 4;
    double step = r->options.sampling;
    for (size_t j = 0; j < r->bins; j++) {
        double from = step * (double)j, to = from + step;
        rtd_fitted tanks = rtd_fitted_bin(r, tanks_share, &r->tanks, j);
        rtd_fitted flow = rtd_fitted_bin(r, dispersion_share, &r->dispersion, j);
        fprintf(f, "%.9g,%.9g,%.6g,%.4g,%.6g,%.4g,%.6g,%.6g,%.6g,%.6g\n", from, to, r->density[j],
                r->density_half[j], r->share[j], r->share_half[j], tanks.density, tanks.share,
                flow.density, flow.share);
    }
    return output_close(f);
}

static int write_tracers(const rtd *r, const char *folder) {
    FILE *f =
        output_table(folder, "tracers.csv", "id,entry_s,residence_s,left,mass_kg,diameter_m,share");
    if (!f) return 4;
    for (size_t i = 0; i < r->tracers; i++) {
        const tracer *t = &r->items[i];
        fprintf(f, "%" PRIu32 ",%.9g,%.9g,%d,%.9g,%.9g,%.9g\n", t->id, t->entry, t->time, t->left,
                t->mass, t->diameter, r->weight[i]);
    }
    return output_close(f);
}

int rtd_write(const rtd *r, const char *folder) {
    output_folder(folder);
    return write_numbers(r, folder) | write_curve(r, folder) | write_tracers(r, folder);
}
