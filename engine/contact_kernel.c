/* contact_kernel.c - one pass over the contacts of a share, batch by batch so that everything
 * between stays in the first-level cache: rows into columns, geometry and law in vector lanes,
 * forces into loads. Compiled once per instruction set and precision (CLAST_KERNEL names the copy);
 * the bits are the same for all instruction sets. */
#include "engine/column_lanes.h"
#include "engine/constant_lanes.h"
#include "engine/part.h"
#include "engine/pair_lanes.h"
#include "engine/periodic_lanes.h"
#include "engine/settle_lanes.h"
#include "engine/shared_lanes.h"
#ifndef CLAST_SINGLE
#include "engine/contact_user.h"
#endif

#ifndef CLAST_KERNEL
#error "compile with -DCLAST_KERNEL=contact_kernel_<isa>"
#endif
contact_kernel CLAST_KERNEL;

enum { GROUP = 64 / sizeof(real) }; /* lanes of the widest vector */

/* One pass over one list. */
typedef struct pass {
    const clast_world *w;
    share *s;
    const contact_list *list;
    contact_report *report;
    contact_mode mode;
    bool with_walls, far; /* far: rows do not fit into the second-level cache */
    bool around;          /* something of "around the law" is needed */
    bool yields, springs, rolls, user;
    bool pushing; /* the forces of parts that move are summed up */
    bool facets;  /* walls that may hide each other: a sphere's stand in one batch */
    law_need need;
    law_choice choice;
    contact_tally tally;
    sharing sharing;
    real aside[HISTORY_COLUMNS][GROUP];
    batch b;
    wall_batch l;
    _Alignas(64) int64_t force[3][LANES], ta[3][LANES], tb[3][LANES]; /* quanta */
} pass;

/* ---- columns that are the same for all contacts ---------------------------------------------- */

/* Of spheres, or of spheres and walls, that are all alike. */
static bool is_uniform(const pass *p) {
    return p->with_walls ? p->w->special.one_wall : p->w->special.one_kind;
}

/* As many lanes as the list can fill. */
static void fill_constants(pass *p) {
    const clast_world *w = p->w;
    const shape *first = &w->shapes[0];
    double r = first->radius[0];
    int other = p->with_walls ? w->walls[0].def.material : first->material;
    const pair_coef *c = &w->coefs[first->material * w->material_count + other];
    double effective = p->with_walls ? 1 : 0.5; /* of radius and mass */
    batch *b = &p->b;
    int lanes = p->list->count < LANES - GROUP ? (int)p->list->count + GROUP : LANES;
    for (int i = 0; i < lanes; i++) {
        b->ra[i] = b->rb[i] = r;
        b->radius[i] = (real)(effective * r), b->mass[i] = (real)(effective * first->mass);
        b->per_small[i] = 1 / r;
        fill_coefficients(b, i, c);
    }
    if (p->need.flat) clear_third(b, lanes);
    if (p->with_walls && !(p->need.equal && !p->rolls)) clear_other(b, lanes);
    if (is_uniform(p)) scale_stiffness(b, w->def.law, lanes);
}

/* ---- rows into columns ----------------------------------------------------------------------- */

#ifdef LANE_ROWS
LANE_INLINE void load_pairs(pass *p, const int32_t *a, const int32_t *b, int count, int padded,
                            law_need need) {
    const row_store r = p->w->rows; /* a copy, as for targets below */
    for (int i = 0; i < padded; i += 4) {
        side sa[4], sb[4];
        for (int k = 0; k < 4; k++) {
            int at = lane_or_last(i + k, count);
            sa[k] = side_of(&r, a[at], need), sb[k] = side_of(&r, b[at], need);
        }
        load_four(&p->b, i, sa, sb, need);
    }
}
#else
LANE_INLINE void load_pairs(pass *p, const int32_t *a, const int32_t *b, int count, int padded,
                            law_need need) {
    const row_store *r = &p->w->rows;
    for (int i = 0; i < padded; i++) {
        int at = lane_or_last(i, count);
        load_pair(&p->b, i, side_of(r, a[at], need), side_of(r, b[at], need), need);
    }
}
#endif

/* Spheres that are not like all others. */
static void load_kinds(pass *p, const int32_t *a, const int32_t *b, int count, int padded) {
    const clast_world *w = p->w;
    for (int i = 0; i < padded; i++) {
        int at = lane_or_last(i, count);
        size_t sa = (size_t)a[at], sb = (size_t)b[at];
        const motion_row *ma = &w->rows.motion[body_of_sphere(w, sa)];
        const motion_row *mb = &w->rows.motion[body_of_sphere(w, sb)];
        p->b.ra[i] = w->rows.centre[sa].radius, p->b.rb[i] = w->rows.centre[sb].radius;
        p->b.ma[i] = (real)ma->mass, p->b.mb[i] = (real)mb->mass;
        if (w->special.one_material && !p->around) continue;
        fill_coefficients(&p->b, i, &w->coefs[ma->material * w->material_count + mb->material]);
    }
}

/* Rows and loads of the partners of the next batch, where they are too many for the second-level
 * cache, a piece at every stage, since a processor waits for so many lines at a time and no more: a
 * third of the pass at 100 000 spheres, nothing but instructions at 20 000. */
enum { PIECES = 7, PIECE = (LANES + PIECES - 1) / PIECES };

LANE_INLINE void prefetch_piece(const pass *p, size_t begin, int piece, law_need need) {
    if (!p->far) return;
    size_t from = begin + LANES + (size_t)piece * PIECE, to = from + PIECE;
    if (to > p->list->count) to = p->list->count;
    const row_store *r = &p->w->rows;
    for (size_t i = from; i < to; i++) {
        size_t sphere = (size_t)p->list->b[i],
               body = need.clumps ? (size_t)r->arm[sphere].body : sphere;
        __builtin_prefetch(&r->centre[sphere]);
        __builtin_prefetch(&r->motion[body]);
        __builtin_prefetch(&r->loads[body], 1);
    }
}

LANE_INLINE void load_spheres(pass *p, size_t begin, int count, int padded, law_need need) {
    const int32_t *a = p->list->a + begin, *b = p->list->b + begin;
    load_pairs(p, a, b, count, padded, need);
    if (p->w->period.any) take_nearest(&p->w->kernel_period, &p->b, padded);
    if (!p->w->special.one_kind) load_kinds(p, a, b, count, padded);
}

/* A batch of walls: rows of spheres less those of walls. */
#ifdef LANE_ROWS
LANE_INLINE void load_four_walls(pass *p, const row_store *r, const wall_row *wall_rows, int i,
                                 const int32_t *spheres, const int32_t *walls, int count,
                                 law_need need) {
    rows4 d[4], dt[4], v[4], wa[4], oa[4] = {{0}}, row[5][4];
    for (int k = 0; k < 4; k++) {
        int at = lane_or_last(i + k, count);
        size_t sphere = (size_t)spheres[at];
        const wall_row *l = &wall_rows[walls[at]];
        const motion_row *m = &r->motion[need.clumps ? (size_t)r->arm[sphere].body : sphere];
        for (int j = 0; j < 5; j++) row[j][k] = row_at(l->point + 4 * j);
        d[k] = row_at(&r->centre[sphere].x) - row[0][k];
        v[k] = row_at(m->v) - row[1][k];
        wa[k] = row_at(m->w);
        if (need.clumps) oa[k] = row_at(r->arm[sphere].arm);
    }
    TRANSPOSE4(rows4, d, dt);
    for (int k = 0; k < 3; k++) *(rows4 *)&p->b.d[k][i] = dt[k];
    *(rows4 *)&p->b.ra[i] = dt[3];
    put_vector(p->b.v, i, v, need);
    put_spin(p->b.wa, i, wa, need);
    if (need.clumps) put_vector(p->b.oa, i, oa, need);
    put_row(p->l.n, i, row[2]), put_row(p->l.u, i, row[3]), put_row(p->l.v, i, row[4]);
}
#else
LANE_INLINE void load_wall_contact(pass *p, int i, size_t sphere, size_t wall_index,
                                   law_need need) {
    const row_store *r = &p->w->rows;
    const wall_row *l = &p->w->wall_rows[wall_index];
    const motion_row *m = &r->motion[body_of_sphere(p->w, sphere)];
    const centre_row *c = &r->centre[sphere];
    const double centre[3] = {c->x, c->y, c->z};
    batch *b = &p->b;
    b->ra[i] = c->radius;
    for (int k = 0; k < 3; k++) {
        b->d[k][i] = centre[k] - l->point[k];
        b->v[k][i] = (real)(m->v[k] - l->motion[k]);
        b->wa[k][i] = (real)m->w[k];
        p->l.n[k][i] = l->n[k], p->l.u[k][i] = l->u[k], p->l.v[k][i] = l->v[k];
        if (need.clumps) b->oa[k][i] = (real)r->arm[sphere].arm[k];
    }
    p->l.n[3][i] = l->half_u, p->l.u[3][i] = l->half_v, p->l.v[3][i] = l->rim;
}
#endif

/* Where spheres or walls are not all alike. */
static void load_wall_kinds(pass *p, const int32_t *spheres, const int32_t *walls, int count,
                            int padded) {
    const clast_world *w = p->w;
    batch *b = &p->b;
    for (int i = 0; i < padded; i++) {
        int at = lane_or_last(i, count);
        const motion_row *m = &w->rows.motion[body_of_sphere(w, (size_t)spheres[at])];
        b->radius[i] = (real)b->ra[i], b->mass[i] = (real)m->mass;
        b->per_small[i] = 1 / b->ra[i];
        int other = w->walls[walls[at]].def.material;
        fill_coefficients(b, i, &w->coefs[m->material * w->material_count + other]);
    }
}

LANE_INLINE void load_walls(pass *p, size_t begin, int count, int padded, law_need need) {
    const int32_t *spheres = p->list->a + begin, *walls = p->list->b + begin;
#ifdef LANE_ROWS
    const row_store r = p->w->rows;
    const wall_row *wall_rows = p->w->wall_rows;
    for (int i = 0; i < padded; i += 4)
        load_four_walls(p, &r, wall_rows, i, spheres, walls, count, need);
#else
    for (int i = 0; i < padded; i++) {
        int at = lane_or_last(i, count);
        load_wall_contact(p, i, (size_t)spheres[at], (size_t)walls[at], need);
    }
#endif
    if (p->w->period.any) take_images(p->w, p->list, begin, &p->b, count);
    if (!p->w->special.one_wall) load_wall_kinds(p, spheres, walls, count, padded);
}

/* ---- lanes ----------------------------------------------------------------------------------- */

static history_lanes history_at(const contact_list *l, size_t begin) {
    real *const *c = (real *const *)l->column;
    real *plastic = c[HISTORY_PLASTIC] ? c[HISTORY_PLASTIC] + begin : NULL;
    return (history_lanes){c[0] + begin, c[1] + begin, c[2] + begin,
                           c[3] + begin, c[4] + begin, plastic};
}

/* What only fills up the last vector is apart. */
LANE_INLINE void hide_behind(batch *b, int count, int padded) {
#pragma omp simd
    for (int i = padded - GROUP; i < padded; i++) b->overlap[i] = i < count ? b->overlap[i] : -1;
}

LANE_INLINE void touch_walls(pass *p, size_t begin, int count, int padded) {
    const real *was = (const real *)p->list->column[0] + begin;
    const sharing *s = &p->sharing;
#pragma omp simd
    for (int i = 0; i < padded; i++) wall_lane(&p->b, &p->l, was, i);
    settling t = {p->w, p->list, p->s->touches, p->mode == CONTACTS_ADVANCE};
    if (p->facets && s->end - s->begin > LANES)
        take_touches(&t, t.touch + (begin - s->begin), &p->b, 0, count);
    else if (p->facets)
        settle_walls(&t, &p->b, &p->l, begin, count);
    hide_behind(&p->b, count, padded);
#pragma omp simd
    for (int i = 0; i < padded; i++) wall_overlap_lane(&p->b, i);
}

/* A wall that turns moves where it is touched; the sphere rolls against its spin. */
static void turn_walls(pass *p, size_t begin, int count) {
    const clast_world *w = p->w;
    batch *b = &p->b;
    for (int i = 0; i < count; i++) {
        const wall *l = &w->walls[p->list->b[begin + (size_t)i]];
        const part *of = &w->parts[l->part];
        vec3 spin = to_kernel(w, v3_scale(of->at.spin, of->axis));
        b->wb[0][i] = (real)spin.x, b->wb[1][i] = (real)spin.y, b->wb[2][i] = (real)spin.z;
        if (of->at.spin == 0) continue;
        vec3 centre = from_kernel(w, centre_at(&w->rows.centre[p->list->a[begin + (size_t)i]]));
        vec3 n = v3(b->n[0][i], b->n[1][i], b->n[2][i]);
        vec3 point = v3_sub(to_kernel(w, image_at_wall(w, l, centre)), v3_scale(b->la[i], n));
        vec3 v = v3_cross(spin, v3_sub(point, to_kernel(w, part_pivot(of))));
        b->v[0][i] -= (real)v.x, b->v[1][i] -= (real)v.y, b->v[2][i] -= (real)v.z;
    }
}

LANE_INLINE void touch_spheres(pass *p, int count, int padded, law_need need) {
    batch *b = &p->b;
#pragma omp simd
    for (int i = 0; i < padded; i++) touch_lane(b, i, need);
    hide_behind(b, count, padded);
#pragma omp simd
    for (int i = padded - GROUP; i < padded; i++)
        b->depth[i] = (real)(b->overlap[i] > 0 ? b->overlap[i] : 0);
    if (p->w->special.one_kind) return;
#pragma omp simd
    for (int i = 0; i < padded; i++) effective_lane(b, i);
}

/* ---- around the law --------------------------------------------------------------------------
 * What few worlds need, in loops of its own: the kernels of all others stay as they are, and these
 * are not copied with them. */

static const pair_coef *coef_at(const pass *p, size_t at) {
    const clast_world *w = p->w;
    int32_t a = p->list->a[at], b = p->list->b[at];
    int64_t own = w->rows.motion[body_of_sphere(w, (size_t)a)].material;
    int64_t other = p->with_walls ? w->walls[b].def.material
                                  : w->rows.motion[body_of_sphere(w, (size_t)b)].material;
    return &w->coefs[own * w->material_count + other];
}

static double turning_of(const clast_world *w, int32_t sphere) {
    return w->shapes[w->bodies.shape[body_of_sphere(w, (size_t)sphere)]].turning;
}

static void load_around(pass *p, size_t begin, int count, int padded) {
    const clast_world *w = p->w;
    batch *b = &p->b;
    for (int i = 0; i < count; i++) {
        const pair_coef *c = coef_at(p, begin + (size_t)i);
        double ta = turning_of(w, p->list->a[begin + (size_t)i]);
        double tb = p->with_walls ? 0 : turning_of(w, p->list->b[begin + (size_t)i]);
        b->yield[i] = (real)c->yield, b->rolling[i] = (real)c->rolling;
        b->hold[i] = (real)((p->with_walls ? ta : ta * tb / (ta + tb)) / w->dt);
    }
    for (int i = count; i < padded; i++) b->yield[i] = b->rolling[i] = b->hold[i] = 0;
}

static void before_law(pass *p, size_t begin, int count, int padded) {
    clast_law law = p->w->def.law;
    batch *b = &p->b;
    if (!is_uniform(p)) scale_stiffness(b, law, count);
    if (law == CLAST_LAW_HERTZ_BRILLIANTOV) {
#pragma omp simd
        for (int i = 0; i < padded; i++) viscoelastic_lane(b, i);
    }
    if (p->rolls || p->yields) load_around(p, begin, count, padded);
    if (!p->yields) return;
    history_lanes h = history_at(p->list, begin);
#pragma omp simd
    for (int i = 0; i < padded; i++) yield_before(b, h, i);
}

LANE_INLINE void roll(batch *b, history_lanes h, int padded, law_need need) {
#pragma omp simd
    for (int i = 0; i < padded; i++) rolling_lane(b, h, i, need);
}

static void after_law(pass *p, size_t begin, int padded) {
    history_lanes h = history_at(p->list, begin);
    batch *b = &p->b;
    if (p->yields) {
#pragma omp simd
        for (int i = 0; i < padded; i++) yield_after(b, h, i);
    }
    if (!p->rolls) return;
    bool equal = p->need.equal && !(p->with_walls && p->w->special.turning);
    if (p->need.flat && equal)
        roll(b, h, padded, (law_need){.flat = true, .equal = true});
    else if (p->need.flat)
        roll(b, h, padded, (law_need){.flat = true});
    else if (equal)
        roll(b, h, padded, (law_need){.equal = true});
    else
        roll(b, h, padded, (law_need){.flat = false});
}

/* ---- the law --------------------------------------------------------------------------------- */

/* The user's own in the place of the lanes; what only pads the batch is apart and at rest. */
static void run_user(pass *p, size_t begin, int count, int padded) {
    batch *b = &p->b;
    (void)begin; /* not read in mixed precision */
#ifndef CLAST_SINGLE
    history_lanes h = history_at(p->list, begin);
    for (int i = 0; i < count; i++) {
        contact_place at = {p->list, begin + (size_t)i, p->with_walls};
        user_law_lane(p->w, &at, b, h, i, p->choice, p->need);
    }
#endif
    for (int i = count; i < padded; i++) {
        b->elastic[i] = b->dashpot[i] = 0;
        for (int k = 0; k < 3; k++) b->f[k][i] = b->ta[k][i] = b->tb[k][i] = 0;
    }
}

LANE_INLINE void run_lanes(pass *p, size_t begin, int padded, law_need need) {
    batch *b = &p->b;
    law_choice choice = p->choice;
    history_lanes h = history_at(p->list, begin);
    prefetch_piece(p, begin, 1, need);
#pragma omp simd
    for (int i = 0; i < padded; i++) law_normal(b, h, i, choice, need);
    prefetch_piece(p, begin, 2, need);
    if (need.tangent && p->springs) {
#pragma omp simd
        for (int i = 0; i < padded; i++) law_spring(b, h, i, choice, need);
    }
    prefetch_piece(p, begin, 3, need);
#pragma omp simd
    for (int i = 0; i < padded; i++) law_force(b, h, i, need);
}

/* Exact sums have no order, so they may be taken lane by lane. */
static void tally_lanes(pass *p, int padded) {
    const batch *b = &p->b;
    sum_scale q = p->w->ledger.scale;
    double ec = 0, ef = 0, dc = 0, df = 0, touching = 0, bad = 0, most = p->tally.overlap_max;
    double limit = p->w->load_scale.limit * p->w->load_scale.force_quantum;
#pragma omp simd reduction(+ : ec, ef, dc, df, touching, bad) reduction(max : most)
    for (int i = 0; i < padded; i++) {
        double e = (double)b->elastic[i], coarse = (e + q.coarse) - q.coarse;
        ec += coarse, ef += ((e - coarse) + q.fine) - q.fine;
        double d = (double)b->dashpot[i];
        coarse = (d + q.coarse) - q.coarse;
        dc += coarse, df += ((d - coarse) + q.fine) - q.fine;
        double overlap = b->overlap[i] * b->per_small[i];
        most = overlap > most ? overlap : most;
        touching += b->overlap[i] > 0 ? 1 : 0;
        double size =
            fabs((double)b->f[0][i]) + fabs((double)b->f[1][i]) + fabs((double)b->f[2][i]);
        bad += size < limit ? 0 : 1;
    }
    p->tally.overlap_max = bad > 0 ? INFINITY : most;
    p->tally.contacts += (size_t)touching;
    if (p->mode != CONTACTS_ADVANCE) return;
    p->tally.elastic.coarse += ec, p->tally.elastic.fine += ef;
    p->tally.dashpot.coarse += dc, p->tally.dashpot.fine += df;
}

/* ---- forces into loads ----------------------------------------------------------------------- */

/* What is too large, or not a number, is held at the limit; the tally has found it. */
LANE_INLINE void round_column(int64_t *restrict to, const real *restrict from, double scale,
                              double limit, int padded) {
#pragma omp simd
    for (int i = 0; i < padded; i++) {
        double x = (double)from[i] * scale;
        x = x < limit ? x : limit;
        to[i] = nearest(x > -limit ? x : -limit);
    }
}

LANE_INLINE void round_loads(pass *p, int padded, law_need need) {
    const load_scale *q = &p->w->load_scale;
    for (int k = 0; k < (need.flat ? 2 : 3); k++)
        round_column(p->force[k], p->b.f[k], q->force, q->limit, padded);
    if (!need.tangent && !need.clumps) return;
    for (int k = need.flat ? 2 : 0; k < 3; k++) {
        round_column(p->ta[k], p->b.ta[k], q->torque, q->limit, padded);
        if (!need.equal) round_column(p->tb[k], p->b.tb[k], q->torque, q->limit, padded);
    }
}

#ifdef LANE_ROWS
LANE_INLINE void add4(int64_t *to, whole4 term) {
    *(whole4 *)to += term;
}

/* Both halves of a number that is not below zero any more. */
LANE_INLINE void add_push(push_row *row, whole4 force) {
    typedef uint64_t words4 __attribute__((vector_size(32), aligned(8), may_alias));
    words4 word = (words4)force + (uint64_t)PUSH_OFFSET;
    *(words4 *)row->low += word & 0xffffffff, *(words4 *)row->high += word >> 32;
}

LANE_INLINE void force_rows(whole4 *r, int64_t (*column)[LANES], int i, law_need need) {
    whole4 c[4] = {{0}};
    for (int k = 0; k < (need.flat ? 2 : 3); k++) c[k] = *(const whole4 *)&column[k][i];
    TRANSPOSE4(whole4, c, r);
}

LANE_INLINE void torque_rows(whole4 *r, int64_t (*column)[LANES], int i, law_need need) {
    whole4 c[4] = {{0}};
    for (int k = need.flat ? 2 : 0; k < 3; k++) c[k] = *(const whole4 *)&column[k][i];
    TRANSPOSE4(whole4, c, r);
}
#endif

LANE_INLINE void add_to(int64_t *to, int64_t term) {
    *to = (int64_t)((uint64_t)*to + (uint64_t)term);
}

LANE_INLINE void add_load(load_row *row, const pass *p, int i, bool of_a, law_need need) {
    for (int k = 0; k < (need.flat ? 2 : 3); k++)
        add_to(&row->force[k], of_a ? p->force[k][i] : -p->force[k][i]);
    if (!need.tangent && !need.clumps) return;
    for (int k = need.flat ? 2 : 0; k < 3; k++)
        add_to(&row->torque[k], of_a || need.equal ? p->ta[k][i] : p->tb[k][i]);
}

/* Where the loads of a batch go. A copy: what is added to a row might be any number of the pass, as
 * far as a compiler can see, so it would ask for all of this again after each. */
typedef struct targets {
    const int32_t *a, *b;
    const arm_row *arm;
    load_row *loads, *overhang; /* a share adds to bodies of later ones apart */
    size_t body_end;
    const int32_t *push_index;
    push_row *push_rows;
    bool with_walls, pushing;
} targets;

LANE_INLINE targets targets_of(const pass *p, size_t begin) {
    const row_store *r = &p->w->rows;
    return (targets){.a = p->list->a + begin,
                     .b = p->list->b + begin,
                     .arm = r->arm,
                     .loads = r->loads,
                     .overhang = p->s->overhang,
                     .body_end = p->s->body_end,
                     .push_index = p->w->push_index,
                     .push_rows = p->s->push_rows,
                     .with_walls = p->with_walls,
                     .pushing = p->pushing};
}

LANE_INLINE load_row *row_of_a(const targets *t, int i, law_need need) {
    size_t a = (size_t)t->a[i];
    return &t->loads[need.clumps ? (size_t)t->arm[a].body : a];
}

LANE_INLINE load_row *row_of_b(const targets *t, int i, law_need need) {
    size_t b = (size_t)t->b[i];
    if (need.clumps) b = (size_t)t->arm[b].body;
    return b < t->body_end ? &t->loads[b] : &t->overhang[b - t->body_end];
}

/* Walls of parts that stay push nobody's row. */
LANE_INLINE push_row *push_row_of(const targets *t, int i) {
    return &t->push_rows[t->push_index[t->b[i]]];
}

#ifdef LANE_ROWS
/* `count` of the four contacts from lane i on. */
LANE_INLINE void scatter_four(pass *p, const targets *t, int i, int count, law_need need) {
    bool turns = need.tangent || need.clumps;
    whole4 f[4], ta[4], tb[4];
    force_rows(f, p->force, i, need);
    if (turns) torque_rows(ta, p->ta, i, need);
    if (turns && !need.equal) torque_rows(tb, p->tb, i, need);
    for (int k = 0; k < 4; k++) {
        if (k >= count) break;
        load_row *row = row_of_a(t, i + k, need);
        add4(row->force, f[k]);
        if (turns) add4(row->torque, ta[k]);
        if (t->with_walls) {
            if (t->pushing) add_push(push_row_of(t, i + k), f[k]);
            continue;
        }
        row = row_of_b(t, i + k, need);
        add4(row->force, -f[k]);
        if (turns) add4(row->torque, need.equal ? ta[k] : tb[k]);
    }
}

LANE_INLINE void scatter(pass *p, size_t begin, int count, law_need need) {
    targets t = targets_of(p, begin);
    int i = 0;
    for (; i + 4 <= count; i += 4) scatter_four(p, &t, i, 4, need);
    if (i < count) scatter_four(p, &t, i, count - i, need);
}
#else
LANE_INLINE void add_push(push_row *row, const pass *p, int i, law_need need) {
    for (int k = 0; k < 4; k++) {
        bool none = k == 3 || (k == 2 && need.flat);
        uint64_t word = (uint64_t)(none ? 0 : p->force[k][i]) + (uint64_t)PUSH_OFFSET;
        row->low[k] += word & 0xffffffff, row->high[k] += word >> 32;
    }
}

LANE_INLINE void scatter(pass *p, size_t begin, int count, law_need need) {
    targets t = targets_of(p, begin);
    for (int i = 0; i < count; i++) {
        add_load(row_of_a(&t, i, need), p, i, true, need);
        if (t.pushing) add_push(push_row_of(&t, i), p, i, need);
        if (!t.with_walls) add_load(row_of_b(&t, i, need), p, i, false, need);
    }
}
#endif

/* ---- walls and readers ----------------------------------------------------------------------- */

/* What belts and parts that turn do to the bodies beside their forces. */
static void tally_drives(pass *p, size_t begin, int count) {
    const clast_world *w = p->w;
    const batch *b = &p->b;
    bool flat = p->need.flat, couples = p->need.tangent || p->need.clumps;
    for (int i = 0; i < count; i++) {
        size_t at = begin + (size_t)i;
        const wall *l = &w->walls[p->list->b[at]];
        if (!l->drives || !(b->overlap[i] > 0)) continue;
        vec3 f = v3((double)b->f[0][i], (double)b->f[1][i], flat ? 0 : (double)b->f[2][i]);
        vec3 couple = {0, 0, couples ? (double)b->ta[2][i] : 0};
        if (couples && !flat) couple.x = (double)b->ta[0][i], couple.y = (double)b->ta[1][i];
        part_add_drive(w, &p->s->pushes[l->part], l, (size_t)p->list->a[at], f, couple);
    }
}

static void report(pass *p, size_t begin, int count) {
    const batch *b = &p->b;
    for (int i = 0; i < count; i++)
        p->report[begin + (size_t)i] = (contact_report){
            .normal = v3(b->n[0][i], b->n[1][i], b->n[2][i]),
            .force = v3((double)b->f[0][i], (double)b->f[1][i], (double)b->f[2][i]),
            .lever = b->la[i]};
}

/* ---- the pass -------------------------------------------------------------------------------- */

/* Everything that the law reads. */
LANE_INLINE void prepare_batch(pass *p, size_t begin, int count, int padded, law_need need) {
    if (p->with_walls)
        load_walls(p, begin, count, padded, need), touch_walls(p, begin, count, padded);
    else
        load_spheres(p, begin, count, padded, need), touch_spheres(p, count, padded, need);
    prefetch_piece(p, begin, 0, need);
    if (p->with_walls && p->w->special.turning) turn_walls(p, begin, count);
    if (p->around) before_law(p, begin, count, padded);
}

LANE_INLINE int padded_of(int count) {
    return (count + GROUP - 1) / GROUP * GROUP;
}

/* ---- shared dashpots ------------------------------------------------------------------------- */

LANE_INLINE void weigh_batch(pass *p, size_t begin, int count, int padded, law_need need) {
    shared_batch *g = &p->sharing.batch[(begin - p->sharing.begin) / LANES];
    const row_store *r = &p->w->rows;
#pragma omp simd
    for (int i = 0; i < padded; i++) weigh_lane(&p->b, g, i, need);
    load_moments(g->ia, r, p->list->a + begin, count, need);
    clear_moments(g->ia, count, padded);
    if (!p->with_walls) load_moments(g->ib, r, p->list->b + begin, count, need);
    clear_moments(g->ib, p->with_walls ? 0 : count, padded);
}

/* All batches of a body with more contacts than one holds. Not compiled for every case: they are
 * few. */
static __attribute__((noinline)) void weigh_ahead(pass *p) {
    for (size_t begin = p->sharing.begin; begin < p->sharing.end; begin += LANES) {
        size_t left = p->sharing.end - begin;
        int count = left < LANES ? (int)left : LANES;
        prepare_batch(p, begin, count, padded_of(count), p->need);
        weigh_batch(p, begin, count, padded_of(count), p->need);
    }
    join_groups(&p->sharing);
}

/* Before a batch; groups, and the walls of a sphere, do not reach beyond the end that it sets. */
LANE_INLINE void begin_block(pass *p, size_t begin, bool shared) {
    sharing *s = &p->sharing;
    if (begin < s->end) return;
    s->begin = begin;
    s->end = shared ? block_end(p->w, p->list, begin) : sphere_block_end(p->list, begin);
    if (s->end - begin <= LANES) return;
    settling t = {p->w, p->list, p->s->touches, p->mode == CONTACTS_ADVANCE};
    if (p->facets) settle_ahead(&t, s->begin, s->end);
    if (shared) weigh_ahead(p);
}

/* Effective masses that make one dashpot of all in a group. */
LANE_INLINE void share_dashpots(pass *p, size_t begin, int count, int padded, law_need need) {
    sharing *s = &p->sharing;
    if (s->end - s->begin <= LANES) {
        weigh_batch(p, begin, count, padded, need);
        join_groups(s);
    }
    shared_batch *g = &s->batch[(begin - s->begin) / LANES];
    batch *b = &p->b;
    if (is_uniform(p)) {
        for (int i = 0; i < padded; i++) b->mass[i] = s->whole_mass;
    }
#pragma omp simd
    for (int i = 0; i < padded; i++) shared_mass_lane(b, g, i, need);
}

/* Histories behind a batch that ends before the list does: lanes that pad it write there. */
static void set_aside(pass *p, size_t from) {
    for (int k = 0; k < p->w->history_columns; k++) {
        real *column = (real *)p->list->column[k] + from;
        memcpy(p->aside[k], column, sizeof p->aside[k]);
        memset(column, 0, sizeof p->aside[k]);
    }
}

static void put_back(const pass *p, size_t from) {
    for (int k = 0; k < p->w->history_columns; k++)
        memcpy((real *)p->list->column[k] + from, p->aside[k], sizeof p->aside[k]);
}

/* ---- lists ----------------------------------------------------------------------------------- */

LANE_INLINE void run_list(pass *p, law_need need) {
    bool shared = need.clumps && p->sharing.on, blocks = shared || p->facets;
    for (size_t begin = 0, next; begin < p->list->count; begin = next) {
        if (blocks) begin_block(p, begin, shared);
        size_t end = blocks ? p->sharing.end : p->list->count, left = end - begin;
        int count = left < LANES ? (int)left : LANES, padded = padded_of(count);
        next = begin + (size_t)count;
        bool ahead = blocks && padded > count && next < p->list->count;
        prepare_batch(p, begin, count, padded, need);
        if (shared) share_dashpots(p, begin, count, padded, need);
        if (ahead) set_aside(p, next);
        if (p->user)
            run_user(p, begin, count, padded);
        else
            run_lanes(p, begin, padded, need);
        if (p->around) after_law(p, begin, padded);
        if (ahead) put_back(p, next);
        prefetch_piece(p, begin, 4, need);
        tally_lanes(p, padded);
        prefetch_piece(p, begin, 5, need);
        if (p->report) report(p, begin, count);
        if (p->mode == CONTACTS_REPORT) continue;
        round_loads(p, padded, need);
        prefetch_piece(p, begin, 6, need);
        scatter(p, begin, count, need);
        if (p->with_walls && p->w->special.driving) tally_drives(p, begin, count);
    }
}

/* Every call below has constants for what the scene needs, so each is compiled for its case. */
LANE_INLINE void run_hertz(pass *p, bool tangent, bool flat) {
    if (p->need.clumps)
        run_list(p, (law_need){false, tangent, flat, true, false});
    else if (p->need.equal)
        run_list(p, (law_need){false, tangent, flat, false, true});
    else
        run_list(p, (law_need){false, tangent, flat, false, false});
}

LANE_INLINE void run_linear(pass *p, bool flat) {
    if (p->need.clumps)
        run_list(p, (law_need){true, true, flat, true, false});
    else
        run_list(p, (law_need){true, true, flat, false, false});
}

static void run(pass *p) {
    const law_need *need = &p->need;
    if (p->list->count == 0) return;
    p->sharing = (sharing){
        .on = p->w->special.shared, .groups = &p->s->groups[p->with_walls], .batch = p->s->batches};
    fill_constants(p);
    p->sharing.whole_mass = p->b.mass[0];
    if (need->linear && need->flat)
        run_linear(p, true);
    else if (need->linear)
        run_linear(p, false);
    else if (need->tangent && need->flat)
        run_hertz(p, true, true);
    else if (need->tangent)
        run_hertz(p, true, false);
    else if (need->flat)
        run_hertz(p, false, true);
    else
        run_hertz(p, false, false);
}

static law_choice choice_of(const clast_world *w, contact_mode mode) {
    bool linear = clast_law_info_of(w->def.law)->linear;
    bool as_printed = w->def.unloading == CLAST_UNLOAD_AS_PRINTED && !linear;
    bool again = mode != CONTACTS_ADVANCE, mindlin = w->def.law == CLAST_LAW_HERTZ_MINDLIN;
    bool total = w->def.limit == CLAST_LIMIT_TOTAL;
    return (law_choice){.dt = again ? 0 : (real)w->contact_dt,
                        .again = again,
                        .advance = !again,
                        .rescale = !as_printed,
                        .keep_displacement = as_printed && mindlin,
                        .keep_force = as_printed && !mindlin,
                        .limit_total = total,
                        .limit_elastic = !total};
}

void CLAST_KERNEL(const clast_world *w, share *s, contact_mode mode) {
    const speciality *k = &w->special;
    pass p;
    p.w = w, p.s = s, p.mode = mode;
    p.far = w->bodies.count > 40000;
    const clast_law_info *law = clast_law_info_of(w->def.law);
    p.yields = law->yields, p.springs = k->spring, p.rolls = k->rolling;
    p.user = w->def.law == CLAST_LAW_USER;
    p.around = p.yields || p.rolls || w->def.law == CLAST_LAW_HERTZ_BRILLIANTOV ||
               w->def.law == CLAST_LAW_HOOKE || w->def.law == CLAST_LAW_MAW;
    bool equal = k->one_kind && !k->clumps && !k->rolling && !p.user; /* those need both spins */
    p.need = (law_need){law->linear, k->tangent, k->flat, k->clumps, equal};
    p.choice = choice_of(w, mode);
    p.tally = (contact_tally){.contacts = 0};
    p.list = &s->contacts, p.with_walls = p.facets = p.pushing = false;
    p.report = mode == CONTACTS_REPORT ? s->report : NULL;
    run(&p);
    p.need.equal = !k->clumps; /* a wall does not spin and feels no torque */
    p.list = &s->walls, p.with_walls = true, p.far = false;
    p.facets = k->facets, p.pushing = k->pushing;
    p.report = mode == CONTACTS_REPORT ? s->wall_report : NULL;
    run(&p);
    s->contact_tally = p.tally;
}
