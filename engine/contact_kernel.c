/* contact_kernel.c - narrow phase, law and sums per pair, block by block so that everything between
 * stays in the first-level cache. Compiled once per instruction set (CLAST_KERNEL names the copy);
 * the bits are the same in all of them. */
#include "engine/contact_law.h"
#include "engine/geometry.h"

#ifndef CLAST_KERNEL
#error "compile with -DCLAST_KERNEL=contact_kernel_<isa>"
#endif
contact_kernel CLAST_KERNEL;

/* Places of the contacts of a batch. */
typedef struct batch_places {
    uint32_t pair[LANES], candidate[LANES];
    touch touch[LANES];
} batch_places;

/* ---- narrow phase ---------------------------------------------------------------------------- */

/* gap[k] < 0 where candidate begin + k overlaps (a difference of squares for spheres). */
static void narrow_spheres(const clast_world *w, size_t begin, int count, double *gap) {
    const double *restrict x = w->spheres.x, *restrict y = w->spheres.y, *restrict z = w->spheres.z,
                 *restrict r = w->spheres.radius;
    const int32_t *restrict a = w->list.candidates.a + begin, *restrict b =
                                                                  w->list.candidates.b + begin;
#pragma omp simd
    for (int k = 0; k < count; k++) {
        double dx = x[a[k]] - x[b[k]], dy = y[a[k]] - y[b[k]], dz = z[a[k]] - z[b[k]];
        double reach = r[a[k]] + r[b[k]];
        gap[k] = dx * dx + dy * dy + dz * dz - reach * reach;
    }
}

static void narrow_walls(const clast_world *w, size_t begin, int count, double *gap) {
    const sphere_store *s = &w->spheres;
    const candidate_store *c = &w->list.candidates;
    for (int k = 0; k < count; k++) {
        int32_t e = c->a[begin + (size_t)k];
        const wall *l = &w->walls[-1 - c->b[begin + (size_t)k]];
        gap[k] = wall_approach(l, v3(s->x[e], s->y[e], s->z[e])).distance - s->radius[e];
    }
}

/* ---- filling a batch ------------------------------------------------------------------------- */

static vec3 velocity_at(const body_store *b, int32_t slot, vec3 arm) {
    vec3 spin = v3(b->wx[slot], b->wy[slot], b->wz[slot]);
    return v3_add(v3(b->vx[slot], b->vy[slot], b->vz[slot]), v3_cross(spin, arm));
}

static vec3 velocity_of_b(const clast_world *w, const pair *p, const touch *t) {
    if (p->b < 0) return w->walls[-1 - p->b].surface_velocity;
    return velocity_at(&w->bodies, p->b, t->arm_b);
}

static void load_history(batch *b, int i, const history *h) {
    b->old_overlap[i] = h->overlap;
    b->sx[i] = h->spring.x, b->sy[i] = h->spring.y, b->sz[i] = h->spring.z;
    b->old_fx[i] = h->force.x, b->old_fy[i] = h->force.y, b->old_fz[i] = h->force.z;
}

static void load_coefficients(batch *b, int i, const pair_coef *c) {
    b->e_star[i] = c->e_star, b->g_star[i] = c->g_star;
    b->stiffness[i] = c->stiffness, b->tangential[i] = c->tangential;
    b->damping[i] = c->damping, b->friction[i] = c->friction, b->cohesion[i] = c->cohesion;
}

static void load_contact(const clast_world *w, batch *b, batch_places *places, uint32_t pair_index,
                         uint32_t c) {
    const pair *p = &w->list.pairs[pair_index];
    int i = b->count++;
    places->pair[i] = pair_index;
    places->candidate[i] = c;
    touch *t = &places->touch[i];
    *t = touch_of(w, p, c);
    vec3 v = v3_sub(velocity_at(&w->bodies, p->a, t->arm_a), velocity_of_b(w, p, t));
    b->nx[i] = t->normal.x, b->ny[i] = t->normal.y, b->nz[i] = t->normal.z;
    b->vx[i] = v.x, b->vy[i] = v.y, b->vz[i] = v.z;
    b->overlap[i] = t->overlap;
    b->radius[i] = w->list.candidates.radius[c];
    b->mass[i] = p->mass;
    load_coefficients(b, i, &w->coefs[p->coef]);
    load_history(b, i, &w->list.candidates.histories[c]);
}

/* ---- the law over all lanes ------------------------------------------------------------------ */

/* The choice is a constant in every call below, so each loop is compiled for its law. */
LANE_INLINE void run_law(batch *b, law_choice choice, double dt) {
#pragma omp simd
    for (int i = 0; i < b->count; i++) contact_law(b, i, choice, dt);
}

LANE_INLINE void run_limit(batch *b, clast_law law, clast_unloading unloading,
                             clast_friction_limit limit, double dt) {
    if (limit == CLAST_LIMIT_TOTAL) run_law(b, (law_choice){law, unloading, CLAST_LIMIT_TOTAL}, dt);
    else run_law(b, (law_choice){law, unloading, CLAST_LIMIT_SPRING}, dt);
}

LANE_INLINE void run_unloading(batch *b, clast_law law, const clast_world_def *d, double dt) {
    if (d->unloading == CLAST_UNLOAD_RESCALE || law == CLAST_LAW_LINEAR)
        run_limit(b, law, CLAST_UNLOAD_RESCALE, d->limit, dt);
    else run_limit(b, law, CLAST_UNLOAD_AS_PRINTED, d->limit, dt);
}

static void evaluate_law(batch *b, const clast_world_def *d, double dt) {
    if (d->law == CLAST_LAW_LINEAR) run_unloading(b, CLAST_LAW_LINEAR, d, dt);
    else if (d->law == CLAST_LAW_HERTZ_A00) run_unloading(b, CLAST_LAW_HERTZ_A00, d, dt);
    else run_unloading(b, CLAST_LAW_HERTZ_MINDLIN, d, dt);
}

/* ---- putting the results back ---------------------------------------------------------------- */

static void tally_overlap(const clast_world *w, contact_tally *tally, const batch *b, int i,
                          uint32_t c) {
    const sphere_store *s = &w->spheres;
    const candidate_store *k = &w->list.candidates;
    double small = s->radius[k->a[c]];
    if (k->b[c] >= 0 && s->radius[k->b[c]] < small) small = s->radius[k->b[c]];
    double overlap = b->old_overlap[i] / small, sum = b->fx[i] + b->fy[i] + b->fz[i];
    if (!(sum - sum == 0)) overlap = INFINITY;
    if (overlap > tally->overlap_max) tally->overlap_max = overlap;
}

static void tally_work(const clast_world *w, contact_tally *tally, const batch *b, int i,
                       const pair *p) {
    const wall *l = &w->walls[-1 - p->b];
    vec3 v = l->surface_velocity;
    if (v.x == 0 && v.y == 0 && v.z == 0) return;
    double work = 0.5 * w->contact_dt * ((b->old_fx[i] + b->fx[i]) * v.x +
                                         (b->old_fy[i] + b->fy[i]) * v.y +
                                         (b->old_fz[i] + b->fz[i]) * v.z);
    sum_add(&tally->part_work[l->part], &w->ledger.scale, work);
}

static void store_contact(clast_world *w, const batch *b, const batch_places *places, int i,
                          contact_tally *tally) {
    uint32_t c = places->candidate[i], pair_index = places->pair[i];
    candidate_store *k = &w->list.candidates;
    vec3 force = v3(b->fx[i], b->fy[i], b->fz[i]);
    k->histories[c] = (history){b->old_overlap[i], v3(b->sx[i], b->sy[i], b->sz[i]), force};
    k->touching[c] = b->old_overlap[i] > 0;
    if (w->list.pairs[pair_index].b < 0) tally_work(w, tally, b, i, &w->list.pairs[pair_index]);
    if (!k->touching[c]) {
        k->histories[c] = (history){0};
        return;
    }
    tally->contacts++;
    tally_overlap(w, tally, b, i, c);
    pair_force_add(&w->list.forces[pair_index], &places->touch[i], force);
}

static void flush_batch(clast_world *w, batch *b, const batch_places *places,
                        contact_tally *tally) {
    if (b->count == 0) return;
    evaluate_law(b, &w->def, w->contact_dt);
    for (int i = 0; i < b->count; i++) {
        sum_add(&tally->elastic, &w->ledger.scale, b->work_elastic[i]);
        sum_add(&tally->dashpot, &w->ledger.scale, b->work_dashpot[i]);
    }
    for (int i = 0; i < b->count; i++) store_contact(w, b, places, i, tally);
    b->count = 0;
}

/* ---- one block
 * -----------------------------------------------------------------------------------------------
 */

static void run_block(clast_world *w, size_t pair_begin, size_t pair_end, contact_tally *tally) {
    enum { NARROW = 256 };
    const pair_list *l = &w->list;
    double gap[NARROW];
    batch b;
    b.count = 0;
    batch_places places;
    bool walls = pair_begin >= l->wall_pairs;
    size_t end = l->pairs[pair_end].first, p = pair_begin;
    for (size_t i = pair_begin; i < pair_end; i++) l->forces[i] = (pair_force){0};
    for (size_t begin = l->pairs[pair_begin].first; begin < end; begin += NARROW) {
        int count = end - begin < NARROW ? (int)(end - begin) : NARROW;
        if (walls) narrow_walls(w, begin, count, gap);
        else narrow_spheres(w, begin, count, gap);
        for (int k = 0; k < count; k++) {
            size_t c = begin + (size_t)k;
            if (!(gap[k] < 0) && !l->candidates.touching[c]) continue;
            while (c >= l->pairs[p + 1].first) p++;
            load_contact(w, &b, &places, (uint32_t)p, (uint32_t)c);
            if (b.count == LANES) flush_batch(w, &b, &places, tally);
        }
    }
    flush_batch(w, &b, &places, tally);
}

void CLAST_KERNEL(clast_world *w, size_t block_begin, size_t block_end, contact_tally *tally) {
    for (size_t i = block_begin; i < block_end; i++)
        run_block(w, w->list.block_first[i], w->list.block_first[i + 1], tally);
}
