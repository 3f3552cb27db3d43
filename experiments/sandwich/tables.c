/* tables.c - the data folder: plain CSV that the figures are drawn from (README.md has the
 * columns). */
#include <math.h>
#include <stdlib.h>

#include "experiments/sandwich/sandwich.h"
#include "experiments/study/output.h"

static const char *name_of(int scheme) {
    return clast_scheme_info_of((clast_scheme)scheme)->name;
}

/* ---- S12 3.9.1 ------------------------------------------------------------------------------- */

static void write_positions(FILE *f, const oscillation *o) {
    for (int n = 0; n < o->count; n++)
        fprintf(f, "%g,%s,%.8g,%.8g\n", o->step, name_of(o->scheme), n * o->step,
                o->x[n] / (OSCILLATION_START * BALL_RADIUS));
}

static int write_sandwich(const char *folder) {
    static const double STEP[3] = {STEP_SMALL, STEP_LARGE, STEP_TOO_LARGE};
    FILE *f = output_table(folder, "positions.csv", "step_s,scheme,time_s,position");
    if (!f) return 4;
    for (int n = 0; n <= 9000; n++) {
        double t = n * OSCILLATION_TIME / 9000;
        fprintf(f, "0,exact,%.8g,%.8g\n", t,
                oscillation_exact(t) / (OSCILLATION_START * BALL_RADIUS));
    }
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < CLAST_SCHEMES; k++) {
            oscillation o = oscillation_run((clast_scheme)k, STEP[i]);
            write_positions(f, &o);
            oscillation_free(&o);
        }
    return output_close(f);
}

static void write_scan(FILE *f, clast_scheme scheme, double step) {
    double h = ball_frequency() * step;
    oscillation o = oscillation_run(scheme, step);
    scheme_motion theory = scheme_motion_of(scheme, h, 0);
    fprintf(f, "%s,%.6g,%.6g,%.6g,%.6g,%d,%.6g,%.6g,%.8g,%.8g\n", name_of((int)scheme), step,
            ball_contact() / step, o.error, o.window_error, o.thrown,
            lead_per_period(step, theory.angle), lead_per_period(step, o.angle), theory.decay,
            o.decay);
    oscillation_free(&o);
}

/* Twenty steps per decade through those that the source names; those of Fig. 3.8 are not printed.
 */
static int write_steps(const char *folder) {
    FILE *f = output_table(folder, "steps.csv",
                           "scheme,step_s,resolution,error,window_error,thrown,lead_theory,lead,"
                           "decay_theory,decay");
    if (!f) return 4;
    for (int k = 0; k < CLAST_SCHEMES; k++) {
        for (int i = -6; i <= 30; i++)
            write_scan(f, (clast_scheme)k, STEP_SMALL * pow(10, i / 20.0));
        write_scan(f, (clast_scheme)k, STEP_TOO_LARGE);
    }
    return output_close(f);
}

/* ---- S12 3.9.2 ------------------------------------------------------------------------------- */

static int write_approach(const sandwich_size *size, const char *folder) {
    FILE *f = output_table(folder, "approach.csv", "scheme,resolution,fraction,overlap");
    if (!f) return 4;
    for (int k = 0; k < CLAST_SCHEMES; k++) {
        for (int i = 0; i < size->fractions; i++) {
            double fraction = i / (size->fractions - 1.0);
            fprintf(f, "%s,%g,%.6g,%.8g\n", name_of(k), APPROACH_RESOLUTION, fraction,
                    approach_overlap((clast_scheme)k, APPROACH_RESOLUTION, fraction));
        }
        for (double r = 1.25; r < 50; r *= 1.04)
            fprintf(f, "%s,%.6g,0,%.8g\n", name_of(k), r, approach_overlap((clast_scheme)k, r, 0));
    }
    return output_close(f);
}

/* ---- limits ---------------------------------------------------------------------------------- */

static int write_theory(const sandwich_size *size, const char *folder) {
    FILE *f = output_table(folder, "theory.csv", "scheme,restitution,upper,step,resolution");
    if (!f) return 4;
    for (int k = 0; k < CLAST_SCHEMES; k++)
        for (int i = 0; i < size->curve; i++) {
            scheme_range ranges[SCHEME_RANGES_MAX];
            double e = 1 - 0.95 * i / (size->curve - 1.0), z = linear_damping_ratio(e, true),
                   phase = contact_phase(e);
            int count = scheme_ranges((clast_scheme)k, z, ranges);
            for (int r = 0; r < count; r++) {
                const double edge[2] = {ranges[r].from, ranges[r].to};
                for (int u = 0; u < 2; u++)
                    if (edge[u] > 0 && isfinite(edge[u]))
                        fprintf(f, "%s,%g,%d,%.8g,%.8g\n", name_of(k), e, u, edge[u],
                                phase / edge[u]);
            }
        }
    return output_close(f);
}

static int write_limits(const sandwich_size *size, const char *folder) {
    FILE *f = output_table(folder, "limits.csv",
                           "scheme,restitution,upper,step_theory,step,resolution_theory,"
                           "resolution,steps_predicted,steps");
    if (!f) return 4;
    sandwich_map map = map_measure(size);
    for (int i = 0; i < map.count; i++) {
        const step_limit *l = &map.limits[i];
        fprintf(f, "%s,%g,%d,%.8g,%.6g,%.8g,%.6g,%.6g,%d\n", name_of((int)l->scheme),
                l->restitution, l->upper, l->theory, l->measured, l->resolution_theory,
                l->resolution_measured, l->predicted, l->steps);
    }
    free(map.limits);
    return output_close(f);
}

static int write_quiet(const sandwich_size *size, const char *folder) {
    FILE *f = output_table(folder, "quiet.csv", "scheme,step,steps,alarm,residual,lost_theory");
    if (!f) return 4;
    for (int k = 0; k < CLAST_SCHEMES; k++) {
        double limit = scheme_limit((clast_scheme)k, 0);
        if (!(limit > 0 && isfinite(limit))) continue;
        quiet_run q = quiet_at_a_tenth((clast_scheme)k, size->quiet);
        fprintf(f, "%s,%.6g,%d,%d,%.3g,%.3g\n", name_of(k), q.step, q.steps, q.alarm, q.residual,
                q.lost);
    }
    return output_close(f);
}

/* ---- orders ---------------------------------------------------------------------------------- */

static void write_convergence(FILE *points, FILE *slopes, const convergence *c) {
    const char *kind = c->onset ? "onset" : "smooth", *scheme = name_of((int)c->scheme);
    for (int i = 0; i < c->count; i++)
        fprintf(points, "%s,%s,%g,%.6g,%.6g,%.6g\n", kind, scheme, c->restitution, c->resolution[i],
                c->x[i], c->v[i]);
    const clast_scheme_info *info = clast_scheme_info_of(c->scheme);
    fprintf(slopes, "%s,%s,%g,%d,%.3f,%.3f\n", kind, scheme, c->restitution,
            c->restitution < 1 ? info->order_damped : info->order, c->order_x, c->order_v);
}

static int write_orders(const sandwich_size *size, const char *folder) {
    FILE *points = output_table(folder, "orders.csv", "kind,scheme,restitution,resolution,x,v");
    if (!points) return 4;
    FILE *slopes = output_table(folder, "slopes.csv", "kind,scheme,restitution,order,x,v");
    if (!slopes) return 4 | output_close(points);
    for (int k = 0; k < CLAST_SCHEMES; k++)
        for (int damped = 0; damped < 2; damped++) {
            double e = damped ? ORDER_RESTITUTION : 1;
            convergence a = converge_smooth((clast_scheme)k, e, size->finest);
            convergence b = converge_onset((clast_scheme)k, e, size->finest);
            write_convergence(points, slopes, &a);
            write_convergence(points, slopes, &b);
        }
    return output_close(points) | output_close(slopes);
}

/* ---- all ------------------------------------------------------------------------------------- */

static int write_about(const sandwich_size *size, const char *name, const char *folder) {
    FILE *f = output_table(folder, "about.txt", "study=sandwich");
    if (!f) return 4;
    fprintf(f, "size=%s\nreplicates=one run each\nhash=0x%016llx\nengine=%s\n", name,
            (unsigned long long)ball_hashes(), CLAST_VERSION);
    fprintf(f, "budget=%d\nquiet=%d\n", size->budget, size->quiet);
    return output_close(f);
}

int sandwich_write_tables(const sandwich_size *size, const char *name, const char *folder) {
    int bad = write_sandwich(folder) | write_steps(folder) | write_approach(size, folder);
    bad |= write_theory(size, folder) | write_limits(size, folder) | write_quiet(size, folder);
    bad |= write_orders(size, folder) | write_about(size, name, folder);
    return bad ? 4 : 0;
}
