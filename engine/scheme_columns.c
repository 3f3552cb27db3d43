/* scheme_columns.c - the columns that a scheme remembers from step to step: made with the world,
 * kept in the order of the bodies, saved and hashed. */
#include <string.h>

#include "engine/scheme.h"
#include "engine/periodic.h"
#include "engine/world.h"

static bool is_level(int t, int first, int count) {
    return t >= first && t < first + count;
}

static bool is_used(const clast_scheme_info *info, int t) {
    int levels = info->past + 1;
    if (t < A_NEXT)
        return is_level(t, X_AGO, levels) || is_level(t, V_AGO, levels) ||
               is_level(t, A_AGO, levels);
    if (t == DASHPOT) return info->splits;
    if (t == KNOWN) return info->implicit;
    if (t == STAGE || t == STAGE_2) return info->past > 0;
    return true;
}

/* What the next step depends on. */
static bool is_kept(const clast_scheme_info *info, int t) {
    if (t == X_AGO || t == V_AGO) return false; /* filled at the start of a step */
    if (t < A_NEXT) return is_used(info, t);
    return t == TORQUE || (t == DASHPOT && info->splits);
}

void integrator_make(clast_world *w) {
    integrator_free(w); /* of a scene that could not be prepared before */
    integrator *s = w->integrator = memory_grow(w, NULL, 0, 1, sizeof *s);
    s->info = clast_scheme_info_of(w->def.scheme);
    s->capacity = w->bodies.count + 1;
    for (int k = 0; k < SCHEME_COLUMNS; k++)
        if (k == TURN_W || is_used(s->info, k / 3))
            s->column[k] = memory_grow(w, NULL, 0, s->capacity, sizeof(double));
}

void integrator_free(clast_world *w) {
    integrator *s = w->integrator;
    if (!s) return;
    for (int k = 0; k < SCHEME_COLUMNS; k++) memory_release(s->column[k]);
    trial_free(w);
    bonds_free(&s->newton);
    memory_release(s);
    w->integrator = NULL;
}

void integrator_permute(clast_world *w, const uint32_t *order, void *scratch) {
    integrator *s = w->integrator;
    double *to = scratch;
    size_t n = w->bodies.count;
    for (int k = 0; s && k < SCHEME_COLUMNS; k++) {
        if (!s->column[k]) continue;
        for (size_t i = 0; i < n; i++) to[i] = s->column[k][order[i]];
        memcpy(s->column[k], to, n * sizeof *to);
    }
}

void integrator_move(clast_world *w, size_t to, size_t from) {
    integrator *s = w->integrator;
    for (int k = 0; s && k < SCHEME_COLUMNS; k++)
        if (s->column[k]) s->column[k][to] = s->column[k][from];
}

/* Which columns are part of the state: the k-th, or NULL behind the last. The order never changes:
 * files and hashes go by it. */
double *integrator_kept(const clast_world *w, int k) {
    const integrator *s = w->integrator;
    for (int c = 0; s && c < SCHEME_COLUMNS; c++)
        if (is_kept(s->info, c / 3) && k-- == 0) return s->column[c];
    return NULL;
}

/* Bodies that the step before has left beyond a periodic face come back, with the places where they
 * have been. It is done here, since forces have been taken where the bodies are, to the bit. */
void columns_wrap(clast_world *w) {
    integrator *s = w->integrator;
    exact_sum unwrapped = {0, 0};
    for (size_t i = 0; i < w->bodies.count; i++) {
        vec3 way = body_wrap(w, i, &unwrapped);
        if (v3_dot(way, way) == 0) continue;
        for (int k = 1; k <= s->info->past; k++)
            triple_put(s, X_AGO + k, i, v3_sub(triple_at(s, X_AGO + k, i), way));
        if (i < s->reference.capacity)
            for (int k = 0; k < 3; k++) s->reference.x[k][i] -= v3_at(way, k);
        rows_fill(w, i, i + 1);
    }
    w->ledger.unwrapped += sum_value(&unwrapped);
}

/* The columns from `first` on by one level. */
static void shift(double **first, int levels) {
    for (int k = 0; k < 3; k++) {
        double *oldest = first[3 * (levels - 1) + k];
        for (int level = levels - 1; level > 0; level--)
            first[3 * level + k] = first[3 * (level - 1) + k];
        first[k] = oldest;
    }
}

static void swap_triples(integrator *s, int one, int other) {
    for (int k = 0; k < 3; k++) {
        double *p = s->column[3 * one + k];
        s->column[3 * one + k] = s->column[3 * other + k];
        s->column[3 * other + k] = p;
    }
}

/* What was of this step becomes that of the step before. */
void columns_grow_older(integrator *s) {
    int levels = s->info->past + 1;
    shift(&s->column[3 * X_AGO], levels);
    shift(&s->column[3 * V_AGO], levels);
    shift(&s->column[3 * A_AGO], levels);
    swap_triples(s, A_AGO, A_NEXT);
    swap_triples(s, TORQUE, TORQUE_NEXT);
}
