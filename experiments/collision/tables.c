/* tables.c - the data folder: plain CSV that the figures are drawn from (README.md has the
 * columns). SI units; the figures normalise, as the source's captions say. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "experiments/collision/collision.h"
#include "experiments/study/output.h"

/* ---- curves of the impact models ------------------------------------------------------------- */

static void curve(FILE *f, const char *figure, const char *label, trial t) {
    char series[80];
    snprintf(series, sizeof series, "%s,%s", figure, label);
    impact_case c = {.trial = t};
    if (t.young == 0) c.trial.young = BALL_YOUNG;
    if (t.stiffness == 0) c.trial.stiffness = LINEAR_STIFF;
    if (t.speed == 0) c.trial.speed = IMPACT_SPEED;
    impact_case_run(&c, f, series);
}

static int write_curves(const collision_study *s) {
    FILE *f =
        output_table(s->data, "curves.csv", "figure,series,kind,time_s,overlap_m,rate_m_s,force_n");
    if (!f) return 4;
    for (int i = 1; i <= 4; i++) {
        char label[16];
        snprintf(label, sizeof label, "%g", i / 4.0);
        curve(f, "speed", label,
              (trial){.law = CLAST_LAW_LINEAR, .restitution = 1, .speed = i / 4.0 * IMPACT_SPEED});
    }
    for (int i = 1; i <= 5; i++) {
        char label[16];
        snprintf(label, sizeof label, "%g", i / 5.0);
        curve(f, "restitution", label, (trial){.law = CLAST_LAW_LINEAR, .restitution = i / 5.0});
    }
    curve(f, "phases", "0.5", (trial){.law = CLAST_LAW_LINEAR, .restitution = 0.5});
    curve(f, "hysteresis", "linear", (trial){.law = CLAST_LAW_LINEAR, .restitution = 0.5});
    curve(f, "hysteresis", "walton-braun",
          (trial){.law = CLAST_LAW_WALTON_BRAUN, .restitution = 0.5});
    return output_close(f);
}

/* ---- what speed and modulus do --------------------------------------------------------------- */

static void scan_one(FILE *f, const char *scan, clast_law law, double young, double speed) {
    impact_case c = {.trial = {.law = law,
                               .restitution = 1,
                               .young = young,
                               .speed = speed,
                               .stiffness = LINEAR_STIFF}};
    impact_case_run(&c, NULL, NULL);
    fprintf(f, "%s,%s,%.6g,%.6g,%.8g,%.8g,%.8g,%.8g\n", scan, clast_law_info_of(law)->name, young,
            speed, c.theory.overlap_max, c.measured.overlap_max, c.theory.duration,
            c.measured.duration);
}

/* Figs 2.17 to 2.20: the sources' ranges are not printed; one decade each. */
static int write_scans(const collision_study *s) {
    enum { SCANNED = 19 };
    static const clast_law LAW[2] = {CLAST_LAW_HOOKE, CLAST_LAW_HERTZ_MINDLIN};
    FILE *f = output_table(s->data, "scan.csv",
                           "scan,law,young_pa,speed_m_s,overlap_theory_m,overlap_m,"
                           "duration_theory_s,duration_s");
    if (!f) return 4;
    for (int l = 0; l < 2; l++)
        for (int i = 0; i < SCANNED; i++) {
            double part = 0.1 + 0.05 * i;
            scan_one(f, "speed", LAW[l], BALL_YOUNG, part);
            scan_one(f, "modulus", LAW[l], part * BALL_YOUNG, IMPACT_SPEED);
        }
    return output_close(f);
}

/* Restitution against speed: constant but for Brilliantov's law. */
static int write_restitution(const collision_study *s) {
    static const double SPEED[9] = {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5};
    static const clast_law LAW[4] = {CLAST_LAW_LINEAR, CLAST_LAW_HERTZ_MINDLIN,
                                     CLAST_LAW_HERTZ_BRILLIANTOV, CLAST_LAW_WALTON_BRAUN};
    FILE *f = output_table(s->data, "restitution.csv", "law,speed_m_s,theory,engine");
    if (!f) return 4;
    double dissipation =
        clast_dissipation(0.7, IMPACT_SPEED, trial_mass(), BALL_RADIUS, trial_modulus(BALL_YOUNG));
    for (int l = 0; l < 4; l++)
        for (int i = 0; i < 9; i++) {
            impact_case c = {.trial = {.law = LAW[l],
                                       .restitution = 0.7,
                                       .young = BALL_YOUNG,
                                       .stiffness = LINEAR_STIFF,
                                       .dissipation = dissipation,
                                       .speed = SPEED[i]}};
            impact_case_run(&c, NULL, NULL);
            fprintf(f, "%s,%g,%.8g,%.8g\n", clast_law_info_of(LAW[l])->name, SPEED[i],
                    c.theory.rebound / SPEED[i], c.measured.rebound / SPEED[i]);
        }
    return output_close(f);
}

/* ---- schemes --------------------------------------------------------------------------------- */

static void write_scheme(FILE *f, const scheme_run *r) {
    const char *name = clast_scheme_info_of(r->scheme)->name;
    for (int n = 0; n < r->count; n++)
        fprintf(f, "%g,%g,%s,%.8g,%.8g,%.8g\n", r->resolution, r->restitution, name,
                r->time[n] / (r->step * r->resolution), r->overlap[n] / r->overlap_unit,
                r->rate[n] / r->speed);
}

/* A smooth line: the exact solution of one run. */
static void write_exact(FILE *f, double resolution, double restitution) {
    double z = linear_damping_ratio(restitution, false), k = LINEAR_STIFF, m = trial_mass();
    linear_contact c = {m, k, 2 * z * sqrt(k * m), true};
    double duration = 3.14159265358979323846 * sqrt(m / k / (1 - z * z));
    double unit = IMPACT_SPEED * sqrt(m / k);
    for (int i = 0; i <= 150; i++) {
        double t = 0.01 * i * duration;
        impact_state at = linear_impact_at(&c, IMPACT_SPEED, t);
        fprintf(f, "%g,%g,exact,%.8g,%.8g,%.8g\n", resolution, restitution, t / duration,
                at.overlap / unit, at.rate / IMPACT_SPEED);
    }
}

static int write_schemes(const collision_study *s, const scheme_set *set) {
    FILE *f =
        output_table(s->data, "schemes.csv", "resolution,restitution,scheme,time,overlap,velocity");
    if (!f) return 4;
    for (int r = 0; r < 2; r++)
        for (int e = 0; e < 2; e++) {
            write_exact(f, SCHEME_RESOLUTION[r], SCHEME_RESTITUTION[e]);
            for (int k = 0; k < CLAST_SCHEMES; k++) write_scheme(f, &set->run[r][e][k]);
        }
    return output_close(f);
}

static void write_error(FILE *f, const char *setup, const scheme_run *r) {
    fprintf(f, "%s,%g,%g,%s,%.6g,%.6g,%.6g,%.6g,%.3g\n", setup, r->resolution, r->restitution,
            clast_scheme_info_of(r->scheme)->name, r->overlap_error, r->rate_error,
            r->overlap_max / r->overlap_max_exact - 1, r->rebound / r->rebound_exact - 1,
            r->map_difference);
}

static int write_errors(const collision_study *s, const scheme_set *sets) {
    FILE *f = output_table(s->data, "errors.csv",
                           "setup,resolution,restitution,scheme,overlap_error,velocity_error,"
                           "largest_overlap,rebound,map_difference");
    if (!f) return 4;
    for (int i = 0; i < SCHEME_SETUP_COUNT; i++)
        for (int r = 0; r < 2; r++)
            for (int e = 0; e < 2; e++)
                for (int k = 0; k < CLAST_SCHEMES; k++)
                    write_error(f, SCHEME_SETUPS[i].name, &sets[i].run[r][e][k]);
    return output_close(f);
}

/* What S12 says, under every set-up. */
static int write_statements(const collision_study *s, const scheme_set *sets) {
    FILE *f = output_table(s->data, "statements.csv", "statement,setup,value");
    if (!f) return 4;
    for (int i = 0; i < STATEMENT_COUNT; i++)
        for (int k = 0; k < SCHEME_SETUP_COUNT; k++)
            fprintf(f, "\"%s\",%s,%.6g\n", STATEMENTS[i].quantity, SCHEME_SETUPS[k].name,
                    STATEMENTS[i].value(&sets[k]));
    return output_close(f);
}

/* What the place of the touch within a step costs. */
static int write_onset(const collision_study *s) {
    FILE *f =
        output_table(s->data, "onset.csv", "scheme,restitution,resolution,places,mean,rms,worst");
    if (!f) return 4;
    for (int k = 0; k < CLAST_SCHEMES; k++)
        for (int e = 0; e < 2; e++)
            for (int r = 4; r <= 128; r *= 2) {
                onset_error o =
                    scheme_onset_error((clast_scheme)k, r, SCHEME_RESTITUTION[e], s->places);
                fprintf(f, "%s,%g,%d,%d,%.6g,%.6g,%.6g\n",
                        clast_scheme_info_of((clast_scheme)k)->name, SCHEME_RESTITUTION[e], r,
                        s->places, o.mean, o.rms, o.worst);
            }
    return output_close(f);
}

static int write_about(const collision_study *s) {
    FILE *f = output_table(s->data, "about.txt", "study=collision");
    if (!f) return 4;
    fprintf(f, "size=%s\nreplicates=one run each, %d places of onset\nhash=0x%016llx\nengine=%s\n",
            s->size, s->places, (unsigned long long)trials_hash(), CLAST_VERSION);
    fprintf(f, "resolution=%d\n", IMPACT_RESOLUTION);
    return output_close(f);
}

int collision_write_tables(const collision_study *s) {
    int bad = write_curves(s) | write_scans(s) | write_restitution(s);
    scheme_set *sets = scheme_sets_run();
    bad |= write_schemes(s, &sets[0]) | write_errors(s, sets) | write_statements(s, sets);
    free(sets);
    bad |= write_onset(s) | write_about(s);
    return bad ? 4 : 0;
}
