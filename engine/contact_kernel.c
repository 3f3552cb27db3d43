/* contact_kernel.c - one pass over the contacts of a share, batch by batch so that everything
 * between stays in the first-level cache: rows into columns, geometry and law in vector lanes,
 * forces into loads. Compiled once per instruction set and precision (CLAST_KERNEL names the copy);
 * the bits are the same for all instruction sets. */
#include "engine/contact_law.h"
#include "engine/geometry.h"

#ifndef CLAST_KERNEL
#error "compile with -DCLAST_KERNEL=contact_kernel_<isa>"
#endif
contact_kernel CLAST_KERNEL;

enum { LOADS = 9 };

/* One pass over one list. */
typedef struct pass {
    const clast_world *w;
    share *s;
    const contact_list *list;
    contact_report *report;
    contact_mode mode;
    bool with_walls;
    law_need need;
    law_choice choice;
    contact_tally tally;
    batch b;
    _Alignas(64) double scaled[LOADS][LANES]; /* force on a, torques on a and b, in quanta */
    int64_t quanta[LOADS][LANES];
} pass;

/* ---- columns that are the same for all contacts ---------------------------------------------- */

static void fill_coefficients(batch *b, int i, const pair_coef *c) {
    b->k_normal[i] = (real)c->k_normal, b->k_tangent[i] = (real)c->k_tangent;
    b->c_normal[i] = (real)c->c_normal, b->c_tangent[i] = (real)c->c_tangent;
    b->friction[i] = (real)c->friction, b->cohesion[i] = (real)c->cohesion;
}

static void fill_constants(pass *p) {
    const clast_world *w = p->w;
    const shape *first = &w->shapes[0];
    double r = first->radius[0];
    const pair_coef *c = &w->coefs[first->material * (w->material_count + 1)];
    for (int i = 0; i < LANES; i++) {
        p->b.ra[i] = p->b.rb[i] = r;
        p->b.radius[i] = (real)(0.5 * r), p->b.mass[i] = (real)(0.5 * first->mass);
        p->b.per_small[i] = 1 / r;
        fill_coefficients(&p->b, i, c);
        for (int k = 0; k < 3; k++)
            p->b.wb[k][i] = p->b.ob[k][i] = p->b.oa[k][i] = p->b.n[k][i] = p->b.v[k][i] = 0;
    }
}

/* ---- rows into columns ----------------------------------------------------------------------- */

LANE_INLINE void load_motion(batch *b, int i, const motion_row *ma, const motion_row *mb,
                             law_need need) {
    b->v[0][i] = (real)(ma->v[0] - mb->v[0]), b->v[1][i] = (real)(ma->v[1] - mb->v[1]);
    if (!need.flat) {
        b->v[2][i] = (real)(ma->v[2] - mb->v[2]);
        b->wa[0][i] = (real)ma->w[0], b->wa[1][i] = (real)ma->w[1];
        b->wb[0][i] = (real)mb->w[0], b->wb[1][i] = (real)mb->w[1];
    }
    b->wa[2][i] = (real)ma->w[2], b->wb[2][i] = (real)mb->w[2];
}

LANE_INLINE void load_arm(real (*to)[LANES], int i, const vec3 *arm, law_need need) {
    to[0][i] = (real)arm->x, to[1][i] = (real)arm->y;
    if (!need.flat) to[2][i] = (real)arm->z;
}

/* Spheres that are not like all others. */
static void load_kinds(pass *p, int i, const centre_row *ca, const centre_row *cb,
                       const motion_row *ma, const motion_row *mb) {
    batch *b = &p->b;
    b->ra[i] = ca->radius, b->rb[i] = cb->radius;
    b->ma[i] = (real)ma->mass, b->mb[i] = (real)mb->mass;
    if (p->w->special.one_material) return;
    fill_coefficients(b, i, &p->w->coefs[ma->material * p->w->material_count + mb->material]);
}

LANE_INLINE void load_spheres(pass *p, size_t begin, int count, law_need need) {
    const row_store *r = &p->w->rows;
    batch *b = &p->b;
    bool one_kind = p->w->special.one_kind;
    for (int i = 0; i < count; i++) {
        size_t sa = (size_t)p->list->a[begin + (size_t)i],
               sb = (size_t)p->list->b[begin + (size_t)i];
        const centre_row *ca = &r->centre[sa], *cb = &r->centre[sb];
        const motion_row *ma = &r->motion[need.clumps ? (size_t)r->body[sa] : sa];
        const motion_row *mb = &r->motion[need.clumps ? (size_t)r->body[sb] : sb];
        b->d[0][i] = ca->x - cb->x, b->d[1][i] = ca->y - cb->y;
        if (!need.flat) b->d[2][i] = ca->z - cb->z;
        load_motion(b, i, ma, mb, need);
        if (need.clumps)
            load_arm(b->oa, i, &r->arm[sa], need), load_arm(b->ob, i, &r->arm[sb], need);
        if (!one_kind) load_kinds(p, i, ca, cb, ma, mb);
    }
}

static void load_wall_contact(pass *p, int i, size_t sphere, const wall *l) {
    const clast_world *w = p->w;
    const row_store *r = &w->rows;
    const centre_row *ca = &r->centre[sphere];
    size_t slot = body_of_sphere(w, sphere);
    const motion_row *m = &r->motion[slot];
    batch *b = &p->b;
    wall_touch t = touch_of_wall(w, l, from_kernel(w, v3(ca->x, ca->y, ca->z)), ca->radius);
    vec3 n = to_kernel(w, t.normal), v = to_kernel(w, l->surface_velocity);
    b->n[0][i] = n.x, b->n[1][i] = n.y, b->n[2][i] = n.z;
    b->overlap[i] = t.overlap;
    b->depth[i] = (real)(t.overlap > 0 ? t.overlap : 0);
    b->la[i] = ca->radius - 0.5 * t.overlap, b->lb[i] = 0;
    b->v[0][i] = (real)(m->v[0] - v.x), b->v[1][i] = (real)(m->v[1] - v.y);
    b->v[2][i] = (real)(m->v[2] - v.z);
    for (int k = 0; k < 3; k++) b->wa[k][i] = (real)m->w[k];
    b->radius[i] = (real)ca->radius, b->mass[i] = (real)m->mass;
    b->per_small[i] = 1 / ca->radius;
    fill_coefficients(b, i, &w->coefs[m->material * w->material_count + l->def.material]);
    if (!w->special.clumps) return;
    const vec3 *arm = &r->arm[sphere];
    b->oa[0][i] = (real)arm->x, b->oa[1][i] = (real)arm->y, b->oa[2][i] = (real)arm->z;
}

static void load_walls(pass *p, size_t begin, int count) {
    for (int i = 0; i < count; i++)
        load_wall_contact(p, i, (size_t)p->list->a[begin + (size_t)i],
                          &p->w->walls[p->list->b[begin + (size_t)i]]);
}

/* Lanes behind the last contact: far apart and at rest. */
static void pad(pass *p, int count, int padded) {
    batch *b = &p->b;
    for (int i = count; i < padded; i++) {
        b->d[0][i] = 1e30, b->d[1][i] = b->d[2][i] = 0;
        b->overlap[i] = -1, b->depth[i] = 0;
        for (int k = 0; k < 3; k++) b->v[k][i] = b->wa[k][i] = b->wb[k][i] = 0;
        b->n[0][i] = 1, b->n[1][i] = b->n[2][i] = 0;
        b->la[i] = b->lb[i] = 0;
        b->ma[i] = b->mb[i] = 1;
    }
}

/* ---- lanes ----------------------------------------------------------------------------------- */

static history_lanes history_at(const contact_list *l, size_t begin) {
    real *const *c = (real *const *)l->column;
    return (history_lanes){c[0] + begin, c[1] + begin, c[2] + begin, c[3] + begin, c[4] + begin};
}

LANE_INLINE void run_lanes(pass *p, size_t begin, int padded, law_need need) {
    batch *b = &p->b;
    law_choice choice = p->choice;
    history_lanes h = history_at(p->list, begin);
    if (!p->with_walls) {
#pragma omp simd
        for (int i = 0; i < padded; i++) touch_lane(b, i, need);
        if (!p->w->special.one_kind) {
#pragma omp simd
            for (int i = 0; i < padded; i++) effective_lane(b, i);
        }
    }
#pragma omp simd
    for (int i = 0; i < padded; i++) contact_law(b, h, i, choice, need);
}

/* Exact sums have no order, so they may be taken lane by lane. */
static void tally_lanes(pass *p, int padded) {
    const batch *b = &p->b;
    sum_scale q = p->w->ledger.scale;
    double ec = 0, ef = 0, dc = 0, df = 0, most = p->tally.overlap_max;
    int touching = 0, bad = 0;
    double limit = p->w->load_scale.limit;
#pragma omp simd reduction(+ : ec, ef, dc, df, touching) reduction(max : most) reduction(| : bad)
    for (int i = 0; i < padded; i++) {
        double e = (double)b->elastic[i], coarse = (e + q.coarse) - q.coarse;
        ec += coarse, ef += ((e - coarse) + q.fine) - q.fine;
        double d = (double)b->dashpot[i];
        coarse = (d + q.coarse) - q.coarse;
        dc += coarse, df += ((d - coarse) + q.fine) - q.fine;
        double overlap = b->overlap[i] * b->per_small[i];
        most = overlap > most ? overlap : most;
        touching += b->overlap[i] > 0;
        double size = fabs(p->scaled[0][i]) + fabs(p->scaled[1][i]) + fabs(p->scaled[2][i]);
        bad |= !(size < limit);
    }
    p->tally.overlap_max = bad ? INFINITY : most;
    p->tally.contacts += (size_t)touching;
    if (p->mode != CONTACTS_ADVANCE) return;
    p->tally.elastic.coarse += ec, p->tally.elastic.fine += ef;
    p->tally.dashpot.coarse += dc, p->tally.dashpot.fine += df;
}

/* ---- forces into loads ----------------------------------------------------------------------- */

LANE_INLINE void scale_column(double *restrict to, const real *restrict from, double scale,
                              int padded) {
#pragma omp simd
    for (int i = 0; i < padded; i++) to[i] = (double)from[i] * scale;
}

/* Towards zero; what is too large, or not a number, is held at the limit and found by the tally. */
LANE_INLINE void round_column(int64_t *restrict to, double *restrict from, double limit,
                              int padded) {
#pragma omp simd
    for (int i = 0; i < padded; i++) {
        double x = from[i] < limit ? from[i] : limit;
        from[i] = x > -limit ? x : -limit;
    }
#pragma omp simd
    for (int i = 0; i < padded; i++) to[i] = (int64_t)from[i];
}

LANE_INLINE void scale_loads(pass *p, int padded, law_need need) {
    const load_scale *q = &p->w->load_scale;
    for (int k = 0; k < 3; k++) {
        scale_column(p->scaled[k], p->b.f[k], q->force, padded);
        if (!need.flat || k == 2) {
            scale_column(p->scaled[3 + k], p->b.ta[k], q->torque, padded);
            scale_column(p->scaled[6 + k], p->b.tb[k], q->torque, padded);
        }
    }
}

LANE_INLINE void round_loads(pass *p, int padded, law_need need) {
    double limit = p->w->load_scale.limit;
    for (int k = 0; k < LOADS; k++) {
        bool third = k % 3 == 2, force = k < 3;
        if (need.flat && third == force) continue;
        if (!need.tangent && !need.clumps && !force) continue;
        round_column(p->quanta[k], p->scaled[k], limit, padded);
    }
}

LANE_INLINE void add_to(int64_t *sum, int64_t term) {
    *sum = (int64_t)((uint64_t)*sum + (uint64_t)term);
}

LANE_INLINE void add_load(load_row *row, const pass *p, int i, bool of_a, law_need need) {
    for (int k = 0; k < (need.flat ? 2 : 3); k++)
        add_to(&row->force[k], of_a ? p->quanta[k][i] : -p->quanta[k][i]);
    if (!need.tangent && !need.clumps) return;
    for (int k = need.flat ? 2 : 0; k < 3; k++)
        add_to(&row->torque[k], p->quanta[(of_a ? 3 : 6) + k][i]);
}

LANE_INLINE void scatter(pass *p, size_t begin, int count, law_need need) {
    const row_store *r = &p->w->rows;
    load_row *own = r->loads;
    size_t end = p->s->body_end;
    for (int i = 0; i < count; i++) {
        size_t sa = (size_t)p->list->a[begin + (size_t)i],
               sb = (size_t)p->list->b[begin + (size_t)i];
        size_t a = need.clumps ? (size_t)r->body[sa] : sa;
        add_load(own + a, p, i, true, need);
        if (p->with_walls) continue;
        size_t b = need.clumps ? (size_t)r->body[sb] : sb;
        add_load(b < end ? own + b : p->s->overhang + (b - end), p, i, false, need);
    }
}

/* ---- walls and readers ----------------------------------------------------------------------- */

static void tally_power(pass *p, size_t begin, int count) {
    for (int i = 0; i < count; i++) {
        const wall *l = &p->w->walls[p->list->b[begin + (size_t)i]];
        vec3 v = to_kernel(p->w, l->surface_velocity);
        if (v.x == 0 && v.y == 0 && v.z == 0) continue;
        double power =
            (double)p->b.f[0][i] * v.x + (double)p->b.f[1][i] * v.y + (double)p->b.f[2][i] * v.z;
        sum_add(&p->s->part_power[l->part], &p->w->ledger.scale, power * p->w->dt);
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

LANE_INLINE void run_list(pass *p, law_need need) {
    enum { GROUP = 16 }; /* lanes of the widest vector */
    for (size_t begin = 0; begin < p->list->count; begin += LANES) {
        size_t left = p->list->count - begin;
        int count = left < LANES ? (int)left : LANES, padded = (count + GROUP - 1) / GROUP * GROUP;
        if (p->with_walls)
            load_walls(p, begin, count);
        else
            load_spheres(p, begin, count, need);
        if (padded > count) pad(p, count, padded);
        run_lanes(p, begin, padded, need);
        scale_loads(p, padded, need);
        tally_lanes(p, padded);
        if (p->report) report(p, begin, count);
        if (p->mode == CONTACTS_REPORT) continue;
        round_loads(p, padded, need);
        scatter(p, begin, count, need);
        if (p->with_walls) tally_power(p, begin, count);
    }
}

/* Every call below has constants for what the scene needs, so each is compiled for its case. */
LANE_INLINE void run_flat(pass *p, bool linear, bool tangent, bool clumps) {
    if (p->need.flat)
        run_list(p, (law_need){linear, tangent, true, clumps});
    else
        run_list(p, (law_need){linear, tangent, false, clumps});
}

LANE_INLINE void run_clumps(pass *p, bool linear, bool tangent) {
    if (p->need.clumps)
        run_flat(p, linear, tangent, true);
    else
        run_flat(p, linear, tangent, false);
}

LANE_INLINE void run_tangent(pass *p, bool linear) {
    if (p->need.tangent)
        run_clumps(p, linear, true);
    else
        run_clumps(p, linear, false);
}

static void run(pass *p) {
    if (p->list->count == 0) return;
    fill_constants(p);
    if (p->need.linear)
        run_tangent(p, true);
    else
        run_tangent(p, false);
}

static law_choice choice_of(const clast_world *w, contact_mode mode) {
    bool as_printed = w->def.unloading == CLAST_UNLOAD_AS_PRINTED && w->def.law != CLAST_LAW_LINEAR;
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
    p.need = (law_need){w->def.law == CLAST_LAW_LINEAR, k->tangent, k->flat, k->clumps};
    p.choice = choice_of(w, mode);
    p.tally = (contact_tally){.contacts = 0};
    p.list = &s->contacts, p.with_walls = false;
    p.report = mode == CONTACTS_REPORT ? s->report : NULL;
    run(&p);
    p.list = &s->walls, p.with_walls = true;
    p.report = mode == CONTACTS_REPORT ? s->wall_report : NULL;
    run(&p);
    s->contact_tally = p.tally;
}
