/* body_kernel.c - moves the bodies of a share: loads into forces, kick, drift, rotation, rows for
 * the next contact pass. Compiled once per instruction set (CLAST_BODY_KERNEL names the copy); the
 * bits are the same in all of them. */
#include "engine/body_lanes.h"
#include "engine/lanes.h"
#include "engine/periodic.h"
#include "engine/rows.h"

#ifndef CLAST_BODY_KERNEL
#error "compile with -DCLAST_BODY_KERNEL=body_kernel_<isa>"
#endif
body_kernel CLAST_BODY_KERNEL;

enum { BLOCK = 64 };

/* Columns of one block of bodies that do not live in the store. */
typedef struct block {
    _Alignas(64) double load[6][BLOCK]; /* quanta: force, torque */
    double w[3][BLOCK];                 /* rad/s, after the step */
    double mass[BLOCK], inverse_mass[BLOCK], bound[BLOCK];
    double inverse_inertia[3][BLOCK];
} block;

/* What a loop over lanes finds out. */
typedef struct findings {
    double work_coarse, work_fine, global_coarse, global_fine, way;
    int64_t outside, bad; /* as wide as the lanes: narrower ones would take two vectors at a time */
} findings;

static void load_shape(const clast_world *w, block *b, int i, const shape *s) {
    vec3 inverse = to_kernel(w, s->inverse_inertia);
    b->mass[i] = s->mass, b->inverse_mass[i] = s->inverse_mass, b->bound[i] = s->bound;
    b->inverse_inertia[0][i] = inverse.x, b->inverse_inertia[1][i] = inverse.y;
    b->inverse_inertia[2][i] = inverse.z;
}

/* ---- loads ----------------------------------------------------------------------------------- */

static void add_row(load_row *to, const load_row *from) {
    for (int k = 0; k < 3; k++) {
        to->force[k] = (int64_t)((uint64_t)to->force[k] + (uint64_t)from->force[k]);
        to->torque[k] = (int64_t)((uint64_t)to->torque[k] + (uint64_t)from->torque[k]);
    }
}

/* What the contacts of the shares before this one have laid on its bodies. */
static void add_overhangs(const clast_world *w, const share *s) {
    for (const share *other = w->shares; other < s; other++) {
        size_t from = s->body_begin > other->body_end ? s->body_begin : other->body_end;
        size_t to = other->body_end + other->overhang_count;
        if (to > s->body_end) to = s->body_end;
        for (size_t i = from; i < to; i++) {
            load_row *row = &other->overhang[i - other->body_end];
            add_row(&w->rows.loads[i], row);
            *row = (load_row){{0}, {0}};
        }
    }
}

#ifdef LANE_ROWS
/* Four rows into four lanes of columns; the rows are empty afterwards. */
LANE_INLINE void take_four(int64_t (*columns)[BLOCK], int i, load_row *rows) {
    for (int half = 0; half < 2; half++) {
        whole4 r[4], c[4];
        for (int k = 0; k < 4; k++) {
            whole4 *row = (whole4 *)(half ? rows[k].torque : rows[k].force);
            r[k] = *row, *row = (whole4){0, 0, 0, 0};
        }
        TRANSPOSE4(whole4, r, c);
        for (int k = 0; k < 3; k++) *(whole4 *)&columns[3 * half + k][i] = c[k];
    }
}
#endif

static void take_loads(load_row *rows, block *b, int count) {
    _Alignas(64) int64_t sums[6][BLOCK];
    int i = 0;
#ifdef LANE_ROWS
    for (; i + 4 <= count; i += 4) take_four(sums, i, &rows[i]);
#endif
    for (; i < count; i++) {
        load_row *r = &rows[i];
        for (int k = 0; k < 3; k++) sums[k][i] = r->force[k], sums[3 + k][i] = r->torque[k];
        *r = (load_row){{0}, {0}};
    }
    for (int k = 0; k < 6; k++)
#pragma omp simd
        for (int l = 0; l < count; l++) b->load[k][l] = double_from(sums[k][l]);
}

/* ---- lanes ----------------------------------------------------------------------------------- */

CLAST_INLINE static inline vec3 at(double *const column[3], size_t i) {
    return v3(column[0][i], column[1][i], column[2][i]);
}

CLAST_INLINE static inline void put(double *const column[3], size_t i, vec3 a) {
    column[0][i] = a.x, column[1][i] = a.y, column[2][i] = a.z;
}

/* oriented: else nobody sees how the bodies are turned, and their orientations stay. */
CLAST_INLINE static inline void move_block(const clast_world *w, block *b, kernel_columns c,
                                           int count, turning turn, bool oriented,
                                           findings *found) {
    body_choice choice = {w->dt, 0.5 * w->def.global_damping * w->dt, to_kernel(w, w->def.gravity)};
    double qf = w->load_scale.force_quantum, qt = w->load_scale.torque_quantum, way = found->way;
    vec3 low = to_kernel(w, w->def.domain_min), high = to_kernel(w, w->def.domain_max);
    sum_scale s = w->ledger.scale;
    double wc = 0, wf = 0, gc = 0, gf = 0;
    int64_t outside = 0, bad = 0;
#pragma omp simd reduction(+ : wc, wf, gc, gf) reduction(max : way) reduction(| : outside, bad)
    for (int i = 0; i < count; i++) {
        size_t j = (size_t)i;
        moving m = {at(c.v, j), at(c.l, j), {c.qw[j], c.q[0][j], c.q[1][j], c.q[2][j]}};
        vec3 inverse =
            v3(b->inverse_inertia[0][i], b->inverse_inertia[1][i], b->inverse_inertia[2][i]);
        vec3 force = v3(qf * b->load[0][i], qf * b->load[1][i], qf * b->load[2][i]);
        vec3 torque = v3(qt * b->load[3][i], qt * b->load[4][i], qt * b->load[5][i]);
        kick k = kicked(turn, choice, m, force, torque, b->mass[i], b->inverse_mass[i], inverse);
        vec3 x = v3_add(at(c.x, j), v3_scale(choice.dt, k.velocity));
        if (turn == TURN_IN_PLANE) x.z = c.x[2][j];
        quat q = oriented ? turned_by(turn, m.q, k.momentum, inverse, choice.dt) : m.q;
        vec3 spin = spin_of(turn, q, k.momentum, inverse);
        put(c.x, j, x), put(c.v, j, k.velocity), put(c.l, j, k.momentum);
        if (oriented) c.qw[j] = q.w, c.q[0][j] = q.x, c.q[1][j] = q.y, c.q[2][j] = q.z;
        b->w[0][i] = spin.x, b->w[1][i] = spin.y, b->w[2][i] = spin.z;
        double step = choice.dt * (v3_norm(k.velocity) + v3_norm(spin) * b->bound[i]);
        way = step > way ? step : way;
        bad |= !(step < 1e300);
        outside |= !(x.x >= low.x && x.x <= high.x && x.y >= low.y && x.y <= high.y &&
                     x.z >= low.z && x.z <= high.z);
        double coarse = (k.contact_work + s.coarse) - s.coarse;
        wc += coarse, wf += ((k.contact_work - coarse) + s.fine) - s.fine;
        coarse = (k.global_loss + s.coarse) - s.coarse;
        gc += coarse, gf += ((k.global_loss - coarse) + s.fine) - s.fine;
    }
    found->work_coarse += wc, found->work_fine += wf;
    found->global_coarse += gc, found->global_fine += gf;
    found->way = way, found->outside |= outside, found->bad |= bad;
}

/* ---- rows for the contact pass --------------------------------------------------------------- */

#ifdef LANE_ROWS
/* Four lanes of three columns into the first three numbers of four rows. */
LANE_INLINE void put_rows(double *to, size_t stride, const double *x, const double *y,
                          const double *z) {
    rows4 c[4] = {*(const rows4 *)x, *(const rows4 *)y, *(const rows4 *)z, {0, 0, 0, 0}}, r[4];
    TRANSPOSE4(rows4, c, r);
    for (size_t k = 0; k < 4; k++) {
        rows4 *row = (rows4 *)(to + k * stride);
        *row = __builtin_shufflevector(r[k], *row, 0, 1, 2, 7);
    }
}
#endif

/* Columns begin .. into the first three numbers of rows that are `stride` doubles apart. */
LANE_INLINE void store_rows(double *to, size_t stride, const double *x, const double *y,
                            const double *z, int count) {
    int i = 0;
#ifdef LANE_ROWS
    for (; i + 4 <= count; i += 4) put_rows(to + (size_t)i * stride, stride, x + i, y + i, z + i);
#endif
    for (; i < count; i++) {
        double *row = to + (size_t)i * stride;
        row[0] = x[i], row[1] = y[i], row[2] = z[i];
    }
}

static void store_motion(motion_row *rows, const block *b, kernel_columns c, int count) {
    enum { STRIDE = sizeof(motion_row) / sizeof(double) };
    store_rows(rows->v, STRIDE, c.v[0], c.v[1], c.v[2], count);
    store_rows(rows->w, STRIDE, b->w[0], b->w[1], b->w[2], count);
}

static kernel_columns columns_from(kernel_columns c, size_t begin) {
    for (int k = 0; k < 3; k++) c.x[k] += begin, c.q[k] += begin, c.v[k] += begin, c.l[k] += begin;
    c.qw += begin;
    return c;
}

static void move(clast_world *w, block *b, kernel_columns c, int count, findings *found) {
    bool plane = w->def.motion == CLAST_MOTION_IN_PLANE, oriented = w->special.oriented;
    if (plane && oriented)
        move_block(w, b, c, count, TURN_IN_PLANE, true, found);
    else if (plane)
        move_block(w, b, c, count, TURN_IN_PLANE, false, found);
    else if (w->special.round && oriented)
        move_block(w, b, c, count, TURN_ROUND, true, found);
    else if (w->special.round)
        move_block(w, b, c, count, TURN_ROUND, false, found);
    else
        move_block(w, b, c, count, TURN_ANY, true, found);
}

void CLAST_BODY_KERNEL(clast_world *w, share *s) {
    kernel_columns all = columns_of(w);
    findings found = {0};
    exact_sum unwrapped = {0, 0};
    bool lost = false;
    block b;
    bool one_shape = w->special.one_shape;
    for (int i = 0; i < BLOCK && one_shape; i++) load_shape(w, &b, i, &w->shapes[0]);
    add_overhangs(w, s);
    for (size_t begin = s->body_begin; begin < s->body_end; begin += BLOCK) {
        int count = s->body_end - begin < BLOCK ? (int)(s->body_end - begin) : BLOCK;
        for (int i = 0; i < count && !one_shape; i++)
            load_shape(w, &b, i, &w->shapes[w->bodies.shape[begin + (size_t)i]]);
        kernel_columns here = columns_from(all, begin);
        take_loads(w->rows.loads + begin, &b, count);
        move(w, &b, here, count, &found);
        if (w->period.any && found.outside) {
            lost |= bodies_wrap(w, begin, begin + (size_t)count, &unwrapped);
            found.outside = lost;
        }
        store_motion(w->rows.motion + begin, &b, here, count);
        if (w->special.clumps)
            place_spheres(w, &all, begin, begin + (size_t)count);
        else
            store_rows(&w->rows.centre[begin].x, 4, here.x[0], here.x[1], here.x[2], count);
    }
    s->body_tally = (body_tally){.global = {found.global_coarse, found.global_fine},
                                 .contact = {found.work_coarse, found.work_fine},
                                 .unwrapped = unwrapped,
                                 .way = found.bad ? INFINITY : found.way,
                                 .outside = found.outside};
}
