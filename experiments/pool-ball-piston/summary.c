/* summary.c - replicates into numbers that stand beside those of the source. */
#include <math.h>
#include <stdlib.h>

#include "experiments/pool-ball-piston/piston.h"

enum { SEED = 20 }; /* of shuffles and Monte Carlo */

static track mean_of(const group *g, int n) {
    track t;
    track_mean(g->list, n, &t);
    return t;
}

static int smaller(int a, int b) {
    return a < b ? a : b;
}

/* ---- friction -------------------------------------------------------------------------------- */

/* RMS of the replicates, without those that the reference is the mean of. */
static interval laid_to(const group *g, const group *reference_of, const track *reference) {
    double rms[REPLICATES_MAX];
    int n = 0;
    for (int k = g == reference_of ? ENSEMBLE : 0; k < g->replicates; k++)
        rms[n++] = track_distance(&g->tracks[k], reference);
    return mean_interval(rms, n);
}

static friction_row friction_of(const group *g, const group *base, const group *laid_rig,
                                int trials) {
    if (!g) return (friction_row){.found = false};
    track to_base = mean_of(base, ENSEMBLE), to_rig = mean_of(laid_rig, ENSEMBLE);
    int n = smaller(g->replicates, ENSEMBLE);
    return (friction_row){
        .found = true,
        .model_to_base = track_distance(&g->model_track, &to_base),
        .model_to_rig = track_distance(&g->model_track, &to_rig),
        .laid_to_base = laid_to(g, base, &to_base),
        .laid_to_rig = laid_to(g, laid_rig, &to_rig),
        .score_base = score_against(base->list, ENSEMBLE, &g->model_track).mean,
        .score_rig = score_against(laid_rig->list, ENSEMBLE, &g->model_track).mean,
        .p_base = g == base ? NAN : permutation_p(g->list, n, base->list, n, trials, SEED)};
}

/* Had one replicate of each friction been run: how often would 0.1 have been best, how often the
 * order that of the source (0.1, 0.35, 0.2, 0)? */
static void rank_draws(const group *const *frictions, const track *reference, double *best,
                       double *order) {
    double rms[FRICTIONS][ENSEMBLE];
    int first = 0, all = 0, draws = 0;
    for (int f = 0; f < FRICTIONS; f++)
        for (int k = 0; k < ENSEMBLE; k++)
            rms[f][k] = track_distance(&frictions[f]->tracks[k], reference);
    for (int i = 0; i < ENSEMBLE; i++)
        for (int j = 0; j < ENSEMBLE; j++)
            for (int k = 0; k < ENSEMBLE; k++)
                for (int l = 0; l < ENSEMBLE; l++) {
                    double a = rms[0][i], b = rms[1][j], c = rms[2][k], d = rms[3][l];
                    first += b < a && b < c && b < d;
                    all += b < d && d < c && c < a;
                    draws++;
                }
    *best = (double)first / draws;
    *order = (double)all / draws;
}

static void summarise_friction(const piston_study *s, const group *base, const group *laid_rig,
                               piston_summary *m) {
    const group *frictions[FRICTIONS];
    bool all = true;
    for (int f = 0; f < FRICTIONS; f++) {
        frictions[f] = piston_friction(s, f);
        m->friction[f] = friction_of(frictions[f], base, laid_rig, s->size->trials);
        all &= frictions[f] && frictions[f]->replicates >= ENSEMBLE;
    }
    if (!all) return;
    track reference = mean_of(laid_rig, ENSEMBLE);
    rank_draws(frictions, &reference, &m->best, &m->order);
}

/* ---- groups ---------------------------------------------------------------------------------- */

static group_row row_of(const group *g, const group *base, int trials) {
    int n = smaller(g->replicates, base->replicates);
    track own = mean_of(g, n), its = mean_of(base, n);
    return (group_row){
        .distance = track_distance(&own, &its),
        .p = g == base ? NAN : permutation_p(g->list, n, base->list, n, trials, SEED),
        .score = score_against(base->list, ENSEMBLE, &g->model_track).mean,
        .own = score_against(g->list, smaller(g->replicates, ENSEMBLE), &g->model_track).mean,
        .model = track_distance(&g->model_track, &base->model_track),
        .end = track_spread(g->list, g->replicates, TRACK_POINTS - 1)};
}

/* ---- null distributions ---------------------------------------------------------------------- */

static double *numbers(int n) {
    double *p = calloc((size_t)n, sizeof *p);
    if (!p) abort();
    return p;
}

static void summarise_null(const piston_study *s, const group *base, null_row *r) {
    r->trials = s->size->trials;
    for (int k = 0; k < NULL_KINDS; k++) {
        r->probability[k] = null_probability(k, ENSEMBLE);
        r->drawn[k] = null_probability_drawn(k, ENSEMBLE, 100 * r->trials, SEED + k);
        r->independent[k] = numbers(r->trials);
        r->whole[k] = numbers(r->trials);
        null_scores(k, false, r->independent[k], r->trials, SEED + k);
        null_scores(k, true, r->whole[k], r->trials, SEED + k);
        if (!base || base->replicates < ENSEMBLE + 2) continue;
        r->tracks[k] = numbers(r->trials);
        null_scores_of(k, base->list, base->replicates, r->tracks[k], r->trials, SEED + k);
    }
}

void piston_summarise(const piston_study *s, piston_summary *m) {
    const group *base = piston_group(s, SECTION_BASE, 0);
    const group *laid_rig = piston_group(s, SECTION_RIG, 0);
    *m = (piston_summary){.best = NAN, .order = NAN, .step = {.p = NAN, .distance = NAN}};
    summarise_null(s, base, &m->null);
    if (!base || !laid_rig) return;
    m->base = score_against(base->list, ENSEMBLE, &base->model_track);
    m->rig = score_against(laid_rig->list, ENSEMBLE, &base->model_track);
    summarise_friction(s, base, laid_rig, m);
    for (int i = 0; i < s->count; i++)
        if (s->groups[i].complete) m->rows[i] = row_of(&s->groups[i], base, s->size->trials);
    const group *step = piston_group(s, SECTION_STEP, 0);
    if (step) m->step = m->rows[step - s->groups];
}

void piston_summary_free(piston_summary *m) {
    for (int k = 0; k < NULL_KINDS; k++) {
        free(m->null.independent[k]);
        free(m->null.whole[k]);
        free(m->null.tracks[k]);
    }
}
