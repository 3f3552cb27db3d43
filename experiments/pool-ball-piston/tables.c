/* tables.c - the data folder: plain CSV that the figures are drawn from (README.md has the
 * columns). */
#include <math.h>
#include <stdlib.h>

#include "engine/clast.h"
#include "experiments/pool-ball-piston/piston.h"
#include "experiments/study/output.h"
#include "experiments/study/published.h"

static const double MM = 1000, CM = 100, DEGREE = 57.295779513082321;
static const char *const KIND[NULL_KINDS] = {"new draw", "exact mean"};

/* ---- tracks ---------------------------------------------------------------------------------- */

static void write_track(FILE *f, const char *set, int replicate, const track *t) {
    for (int p = 0; p < PARTICLES; p++)
        for (int k = 0; k < TRACK_POINTS; k++) {
            const double *at = t->at[k][p];
            fprintf(f, "%s,%d,%d,%.2f,%.4f,%.4f,%.3f\n", set, replicate, p + 1, k * TRACK_S,
                    CM * at[ITEM_X], CM * at[ITEM_Z], DEGREE * at[ITEM_ANGLE]);
        }
}

static void write_group(FILE *f, const char *set, const group *g, int replicates) {
    if (!g) return;
    write_track(f, set, 0, &g->model_track);
    for (int k = 0; k < replicates && k < g->replicates; k++)
        write_track(f, set, k + 1, &g->tracks[k]);
}

static int write_tracks(const piston_study *s) {
    FILE *f =
        output_table(s->data, "tracks.csv", "set,replicate,particle,time_s,x_cm,z_cm,angle_deg");
    if (!f) return 4;
    write_group(f, "base", piston_group(s, SECTION_BASE, 0), ENSEMBLE);
    write_group(f, "static", piston_group(s, SECTION_RIG, 0), ENSEMBLE);
    write_group(f, "critical", piston_group(s, SECTION_STEP, 0), ENSEMBLE);
    for (int i = 0; i < FRICTIONS; i++) {
        char set[40];
        snprintf(set, sizeof set, "friction %g", FRICTION[i]);
        if (i != 1) write_group(f, set, piston_friction(s, i), 0);
    }
    return output_close(f);
}

/* The ensemble as the source draws it: limits over five replicates, and their mean. */
static int write_limits(const piston_study *s) {
    static const char *const ITEM[ITEMS] = {"x", "z", "angle"};
    static const double UNIT[ITEMS] = {CM, CM, DEGREE};
    const group *g = piston_group(s, SECTION_BASE, 0);
    FILE *f =
        output_table(s->data, "limits.csv", "item,particle,time_s,mean,half,least,most,model");
    if (!f) return 4;
    for (int i = 0; g && i < ITEMS; i++)
        for (int p = 0; p < PARTICLES; p++)
            for (int k = 0; k < TRACK_POINTS; k++) {
                double x[ENSEMBLE], least = INFINITY, most = -INFINITY;
                for (int t = 0; t < ENSEMBLE; t++) {
                    x[t] = UNIT[i] * g->tracks[t].at[k][p][i];
                    least = fmin(least, x[t]), most = fmax(most, x[t]);
                }
                interval v = mean_interval(x, ENSEMBLE);
                fprintf(f, "%s,%d,%.2f,%.4f,%.4f,%.4f,%.4f,%.4f\n", ITEM[i], p + 1, k * TRACK_S,
                        v.mean, 1.96 * v.sd / sqrt(ENSEMBLE), least, most,
                        UNIT[i] * g->model_track.at[k][p][i]);
            }
    return output_close(f);
}

static int write_outline(const piston_study *s) {
    FILE *f = output_table(s->data, "outline.csv", "side,x_cm,z_cm");
    if (!f) return 4;
    for (int side = -1; side <= 1; side += 2) {
        double wall = side * RIG_COLUMN / 2;
        fprintf(f, "%d,%g,%g\n%d,%g,%g\n%d,%g,0\n\n", side, wall + side * RIG_RUN, RIG_INPUT.top,
                side, wall, RIG_THROAT, side, wall);
    }
    return output_close(f);
}

/* ---- the score ------------------------------------------------------------------------------- */

static int write_scores(const piston_study *s, const piston_summary *m) {
    FILE *f = output_table(s->data, "scores.csv",
                           "particle,none,one,two,three,ours,against_static,thesis");
    if (!f) return 4;
    for (int p = 0; p < PARTICLES && piston_group(s, SECTION_BASE, 0); p++) {
        const int *d = m->base.degree[p];
        fprintf(f, "%d,%d,%d,%d,%d,%.2f,%.2f,%.2f\n", p + 1, d[0], d[1], d[2], d[3],
                m->base.percent[p], m->rig.percent[p], score_percent(THESIS_DEGREE[p]));
    }
    return output_close(f);
}

/* Bins as wide as one of thirty points, the least that a score of whole tracks can change by. */
static void write_histogram(FILE *f, const char *kind, const char *how, const double *sorted,
                            int n) {
    enum { BINS = PARTICLES * ITEMS };
    for (int i = 0; sorted && i <= BINS; i++) {
        double from = 100 * (i - 0.5) / BINS, to = 100 * (i + 0.5) / BINS;
        fprintf(f, "%s,%s,%.3f,%.6f\n", kind, how, 100.0 * i / BINS,
                part_at_least(sorted, n, from) - part_at_least(sorted, n, to));
    }
}

static void write_quantiles(FILE *f, const char *kind, const char *how, const double *sorted,
                            int n) {
    if (!sorted) return;
    double sum = 0, thesis = 0;
    for (int i = 0; i < n; i++) sum += sorted[i];
    for (int p = 0; p < PARTICLES; p++) thesis += score_percent(THESIS_DEGREE[p]) / PARTICLES;
    fprintf(f, "%s,%s,%.3f,%.3f,%.3f,%.5f\n", kind, how, sum / n, sorted[(int)(0.025 * n)],
            sorted[(int)(0.975 * n)], part_at_least(sorted, n, thesis));
}

static int write_null(const piston_study *s, const null_row *r) {
    FILE *h = output_table(s->data, "null.csv", "kind,frames,score,part");
    FILE *q =
        output_table(s->data, "null_summary.csv", "kind,frames,mean,low,high,part_at_least_thesis");
    if (!h || !q) return 4;
    for (int k = 0; k < NULL_KINDS; k++) {
        const double *const lists[] = {r->independent[k], r->whole[k], r->tracks[k]};
        static const char *const HOW[] = {"independent", "whole track", "our replicates"};
        for (int i = 0; i < 3; i++) {
            write_histogram(h, KIND[k], HOW[i], lists[i], r->trials);
            write_quantiles(q, KIND[k], HOW[i], lists[i], r->trials);
        }
    }
    return output_close(h) | output_close(q);
}

/* ---- friction, growth, assumptions ----------------------------------------------------------- */

static int write_friction(const piston_study *s, const piston_summary *m) {
    static const double THESIS[FRICTIONS] = {1052, 532, 951, 731}; /* mm: A00 4.2.2 */
    FILE *f = output_table(s->data, "friction.csv",
                           "friction,thesis_mm,model_to_base_mm,laid_to_base_mm,base_half_mm,"
                           "model_to_static_mm,laid_to_static_mm,static_half_mm,score_base,"
                           "score_static,p_base");
    if (!f) return 4;
    for (int i = 0; i < FRICTIONS; i++) {
        const friction_row *r = &m->friction[i];
        if (!r->found) continue;
        fprintf(f, "%g,%g,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%.2f,%.2f,%.4f\n", FRICTION[i], THESIS[i],
                MM * r->model_to_base, MM * r->laid_to_base.mean, MM * r->laid_to_base.half,
                MM * r->model_to_rig, MM * r->laid_to_rig.mean, MM * r->laid_to_rig.half,
                r->score_base, r->score_rig, r->p_base);
    }
    return output_close(f);
}

static int write_growth(const piston_study *s) {
    FILE *f = output_table(s->data, "spread.csv", "errors,time_s,spread_mm");
    FILE *r = output_table(s->data, "growth.csv",
                           "errors,first_mm,last_mm,rate_per_s,rate_half,from_s,to_s");
    if (!f || !r) return 4;
    for (int i = 0; i < s->count; i++) {
        const group *g = &s->groups[i];
        section of = g->def->section;
        if (!g->complete || (of != SECTION_ERRORS && of != SECTION_BASE)) continue;
        for (int k = 0; k < TRACK_POINTS; k++)
            fprintf(f, "%g,%.2f,%.6g\n", g->def->errors, k * TRACK_S,
                    MM * track_spread(g->list, g->replicates, k));
        growth w = growth_of(g);
        fprintf(r, "%g,%.4g,%.4g,%.4g,%.3g,%.2f,%.2f\n", w.errors, MM * w.first, MM * w.last,
                w.rate, w.rate_half, w.from, w.to);
    }
    return output_close(f) | output_close(r);
}

static int write_arches(const piston_study *s) {
    FILE *f = output_table(s->data, "arches.csv", "slopes,friction,runs,held,mean_above");
    if (!f) return 4;
    for (int i = 0; i < SLOPES * FRICTIONS; i++) {
        const arch_row *r = &s->arches[i / FRICTIONS][i % FRICTIONS];
        if (r->runs > 0)
            fprintf(f, "%s,%g,%d,%d,%.2f\n", SLOPE_NAME[i / FRICTIONS], FRICTION[i % FRICTIONS],
                    r->runs, r->held, (double)r->above / r->runs);
    }
    return output_close(f);
}

static int write_assumptions(const piston_study *s, const piston_summary *m) {
    FILE *f = output_table(s->data, "assumptions.csv",
                           "assumption,variant,replicates,distance_mm,p,score,own_score,model_mm,"
                           "spread_end_mm");
    if (!f) return 4;
    for (int i = 0; i < s->count; i++) {
        const group *g = &s->groups[i];
        const group_row *r = &m->rows[i];
        if (!g->complete || g->def->section == SECTION_ERRORS) continue;
        csv_put(f, g->def->assumption);
        fputc(',', f);
        csv_put(f, g->def->variant);
        fprintf(f, ",%d,%.3f,%.4f,%.2f,%.2f,%.3f,%.3f\n", g->replicates, MM * r->distance, r->p,
                r->score, r->own, MM * r->model, MM * r->end);
    }
    return output_close(f);
}

static int write_about(const piston_study *s, const piston_summary *m) {
    FILE *f = output_table(s->data, "about.txt", "study=pool-ball-piston");
    if (!f) return 4;
    uint64_t hash = 0;
    for (int i = 0; i < s->count; i++) {
        hash = (hash * 31) ^ s->groups[i].model.hash;
        for (int k = 0; k < s->groups[i].replicates; k++)
            hash = (hash * 31) ^ s->groups[i].laid[k].hash;
    }
    fprintf(f, "size=%s\nreplicates=%d, %d of each variant\nhash=0x%016llx\nengine=%s\n", s->name,
            s->size->replicates[SECTION_BASE], s->size->replicates[SECTION_RIG],
            (unsigned long long)hash, CLAST_VERSION);
    fprintf(f, "particles=%d\nspheres_per_particle=2\nstep=%s of the critical step\n", PARTICLES,
            s->size->fraction);
    fprintf(f, "mean_score=%.1f\nscore_static=%.1f\nbest_part=%.3f\norder_part=%.3f\n",
            m->base.mean, m->rig.mean, m->best, m->order);
    fprintf(f, "null_new=%.2f\nnull_mean=%.2f\n", 100 * m->null.probability[NULL_NEW_DRAW],
            100 * m->null.probability[NULL_EXACT_MEAN]);
    return output_close(f);
}

int piston_write_tables(const piston_study *s, const piston_summary *m) {
    int bad = write_tracks(s) | write_limits(s) | write_outline(s) | write_scores(s, m);
    bad |= write_null(s, &m->null) | write_friction(s, m) | write_growth(s);
    bad |= write_arches(s) | write_assumptions(s, m) | write_about(s, m);
    return bad ? 4 : 0;
}
