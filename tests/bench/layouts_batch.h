/* layouts_batch.h - a batch of contacts in the layout experiment: rows to columns, law, columns to
 * bodies. */
#ifndef CLAST_BENCH_LAYOUTS_BATCH_H
#define CLAST_BENCH_LAYOUTS_BATCH_H

#include "tests/bench/layouts_bed.h"

/* ---- a batch of contacts --------------------------------------------------------------------- */

typedef struct batch {
    LINE double dx[BATCH], dy[BATCH], dz[BATCH], reach[BATCH], vx[BATCH], vy[BATCH], vz[BATCH],
        none[BATCH], ux[BATCH], uy[BATCH], uz[BATCH], none2[BATCH];
    LINE double work[2][BATCH];   /* elastic, dashpot */
    LINE double out[8][BATCH];    /* force x y z, 0, moment x y z, 0 */
    LINE int64_t whole[8][BATCH]; /* the same in quanta */
} batch;

/* What the layouts differ in, and the variants of their stages. */
typedef enum { HALF_GATHER, FULL, HALF_EXACT } layout;
typedef enum { COPY, SHUFFLE, GATHER } loading;
typedef enum { SCALAR, ROWS, BOTH } scattering;
typedef enum { CAST, MAGIC, MAGIC51 } rounding;

typedef struct choice {
    layout layout;
    loading load;
    scattering scatter;
    rounding round;
    int batch, threads;
    bool prefetch, lean, trail, turn, timed;
} choice;

typedef int64_t quanta[8];

/* Time of one stage; batches in which the thread was taken off its processor are left out. */
typedef struct lap {
    double ticks;
    long counted, all;
} lap;

typedef struct run {
    choice how;
    bodies body;
    contacts list;
    double scale; /* quanta per N */
    size_t cut[THREADS + 1], end[THREADS];
    quanta *sum[THREADS]; /* c: of the slots cut[t] .. end[t] */
    double *force;        /* a: per contact, b: per body; 8 doubles */
    incidence meet;       /* a */
    lap laps[THREADS][4];
    double busy[THREADS]; /* s, on a processor in the passes */
    LINE int64_t work[THREADS][8];
} run;

/* Stage 1, loads. */
static void load_copy(const double *row, const int32_t *ia, const int32_t *ib, int n, batch *t) {
    for (int i = 0; i < n; i++) {
        const double *a = row + (size_t)ia[i] * ROW, *b = row + (size_t)ib[i] * ROW;
        t->dx[i] = a[0] - b[0], t->dy[i] = a[1] - b[1], t->dz[i] = a[2] - b[2],
        t->reach[i] = a[3] + b[3];
        t->vx[i] = a[4] - b[4], t->vy[i] = a[5] - b[5], t->vz[i] = a[6] - b[6];
        t->ux[i] = a[8] + b[8], t->uy[i] = a[9] + b[9], t->uz[i] = a[10] + b[10];
    }
}

static void load_gather(const double *row, const int32_t *ia, const int32_t *ib, int n, batch *t) {
#pragma omp simd
    for (int i = 0; i < n; i++) {
        int32_t a = ia[i] * ROW, b = ib[i] * ROW;
        t->dx[i] = row[a] - row[b], t->dy[i] = row[a + 1] - row[b + 1],
        t->dz[i] = row[a + 2] - row[b + 2];
        t->reach[i] = row[a + 3] + row[b + 3];
        t->vx[i] = row[a + 4] - row[b + 4], t->vy[i] = row[a + 5] - row[b + 5],
        t->vz[i] = row[a + 6] - row[b + 6];
        t->ux[i] = row[a + 8] + row[b + 8], t->uy[i] = row[a + 9] + row[b + 9],
        t->uz[i] = row[a + 10] + row[b + 10];
    }
}

typedef double v4 __attribute__((vector_size(32), aligned(8)));
typedef int64_t k4 __attribute__((vector_size(32), aligned(8)));

#define TRANSPOSE4(type, r, c)                                                                     \
    do {                                                                                           \
        type lo01 = __builtin_shufflevector(r[0], r[1], 0, 4, 2, 6),                               \
             hi01 = __builtin_shufflevector(r[0], r[1], 1, 5, 3, 7),                               \
             lo23 = __builtin_shufflevector(r[2], r[3], 0, 4, 2, 6),                               \
             hi23 = __builtin_shufflevector(r[2], r[3], 1, 5, 3, 7);                               \
        c[0] = __builtin_shufflevector(lo01, lo23, 0, 1, 4, 5);                                    \
        c[1] = __builtin_shufflevector(hi01, hi23, 0, 1, 4, 5);                                    \
        c[2] = __builtin_shufflevector(lo01, lo23, 2, 3, 6, 7);                                    \
        c[3] = __builtin_shufflevector(hi01, hi23, 2, 3, 6, 7);                                    \
    } while (0)

static inline __attribute__((always_inline)) void put4(double *column, const v4 *c) {
    for (int k = 0; k < 4; k++) *(v4 *)(column + k * BATCH) = c[k];
}

/* Rows are subtracted whole and turned into columns four by four; u is added by subtracting -u. */
static void load_shuffle(const double *row, const int32_t *ia, const int32_t *ib, int n, batch *t) {
    int i = 0;
    for (; i + 4 <= n; i += 4) {
        v4 x[4], v[4], u[4], c[4];
        for (int k = 0; k < 4; k++) {
            const double *a = row + (size_t)ia[i + k] * ROW, *b = row + (size_t)ib[i + k] * ROW;
            v4 pa = *(const v4 *)a, pb = *(const v4 *)b;
            const k4 flip = {0, 0, 0, INT64_MIN};
            x[k] = pa - (v4)((k4)pb ^ flip);
            v[k] = *(const v4 *)(a + 4) - *(const v4 *)(b + 4);
            u[k] = *(const v4 *)(a + 8) + *(const v4 *)(b + 8);
        }
        TRANSPOSE4(v4, x, c);
        put4(t->dx + i, c);
        TRANSPOSE4(v4, v, c);
        put4(t->vx + i, c);
        TRANSPOSE4(v4, u, c);
        put4(t->ux + i, c);
    }
    for (; i < n; i++) {
        const double *a = row + (size_t)ia[i] * ROW, *b = row + (size_t)ib[i] * ROW;
        t->dx[i] = a[0] - b[0], t->dy[i] = a[1] - b[1], t->dz[i] = a[2] - b[2],
        t->reach[i] = a[3] + b[3];
        t->vx[i] = a[4] - b[4], t->vy[i] = a[5] - b[5], t->vz[i] = a[6] - b[6];
        t->ux[i] = a[8] + b[8], t->uy[i] = a[9] + b[9], t->uz[i] = a[10] + b[10];
    }
}

/* Stage 2, geometry and law: Hertz-Mindlin of engine/contact_law.h. */

typedef struct touch {
    double nx, ny, nz, arm, overlap; /* arm: of each body, in its radius */
    double v_n, tx, ty, tz;          /* m/s, at the contact */
} touch;

INLINE touch touch_at(const batch *t, int i) {
    double dx = t->dx[i], dy = t->dy[i], dz = t->dz[i], reach = t->reach[i];
    double d = sqrt(dx * dx + dy * dy + dz * dz), inverse = 1 / (d * reach),
           per_d = inverse * reach;
    touch c = {.nx = dx * per_d, .ny = dy * per_d, .nz = dz * per_d, .arm = d * d * inverse};
    c.overlap = reach - d > 0 ? reach - d : 0.0;
    /* v - (r_a w_a + r_b w_b) x n: the contact point divides the distance as the radii do */
    double ux = c.arm * t->ux[i], uy = c.arm * t->uy[i], uz = c.arm * t->uz[i];
    double vx = t->vx[i] - (uy * c.nz - uz * c.ny), vy = t->vy[i] - (uz * c.nx - ux * c.nz),
           vz = t->vz[i] - (ux * c.ny - uy * c.nx);
    c.v_n = vx * c.nx + vy * c.ny + vz * c.nz;
    c.tx = vx - c.v_n * c.nx, c.ty = vy - c.v_n * c.ny, c.tz = vz - c.v_n * c.nz;
    return c;
}

/* a = sqrt(R overlap) now and a step ago; dashpots per speed. */
typedef struct elastic {
    double a, old_a, old_overlap, force, old_force, damp_n, damp_t;
} elastic;

static const double E_STAR = 5e6 / (2 * (1 - 0.3 * 0.3)), G_STAR = 5e6 / (4 * 1.3 * 1.7),
                    R_STAR = 0.0025;

INLINE elastic elastic_at(const touch *c, double history, double mass, bool lean) {
    elastic e = {.a = sqrt(R_STAR * c->overlap)};
    e.old_a = lean ? history : sqrt(R_STAR * history);
    e.old_overlap = lean ? history * history * (1 / R_STAR) : history;
    e.force = 4.0 / 3 * E_STAR * e.a * c->overlap,
    e.old_force = 4.0 / 3 * E_STAR * e.old_a * e.old_overlap;
    double root = sqrt(e.a), per_root = sqrt(mass);
    e.damp_n = lean ? 2 * BETA * sqrt(2 * E_STAR) * per_root * root
                    : 2 * BETA * sqrt(2 * E_STAR * e.a * mass);
    e.damp_t = lean ? 2 * BETA * sqrt(8 * G_STAR) * per_root * root
                    : 2 * BETA * sqrt(8 * G_STAR * e.a * mass);
    return e;
}

/* Turns the spring into the tangent plane at its length and shrinks it with its stiffness: the
 * factor. `lean` takes one root and one division for both. */
INLINE double spring_kept(const elastic *e, double length2, double flat2, bool lean) {
    if (lean) {
        double smaller = e->a < e->old_a ? e->a : e->old_a, below = flat2 * (e->old_a * e->old_a);
        return below > 0 ? sqrt(length2 * (smaller * smaller) / below) : 0.0;
    }
    double ratio = e->old_a > 0 ? e->a / e->old_a : 0.0,
           keep = flat2 > 0 ? sqrt(length2 / flat2) : 0.0;
    return keep * (ratio < 1 ? ratio : 1.0);
}

INLINE double limited(double square, double limit) {
    return square > limit * limit ? limit / sqrt(square) : 1.0;
}

INLINE void book_work(batch *t, int i, const touch *c, const elastic *e, double f_n,
                      double old_f_n) {
    double shorter = c->overlap < e->old_overlap ? c->overlap : e->old_overlap;
    double way = shorter > 0 ? c->overlap - e->old_overlap : -DT * c->v_n;
    t->work[0][i] = -0.5 * (e->old_force + e->force) * way;
    t->work[1][i] = -0.5 * ((old_f_n - e->old_force) + (f_n - e->force)) * way;
}

/* The law of engine/contact_law.h. `lean`: with fewer roots and divisions; the history then holds a
 * in place of the overlap. */
INLINE void contact_law(batch *t, const contacts *l, size_t at, int i, double mass, bool lean) {
    touch c = touch_at(t, i);
    elastic e = elastic_at(&c, l->overlap[at], mass, lean);
    double f_n = e.force - e.damp_n * c.v_n;
    f_n = f_n > 0 ? f_n : 0.0;

    double sx = l->sx[at], sy = l->sy[at], sz = l->sz[at];
    double length2 = sx * sx + sy * sy + sz * sz, along = sx * c.nx + sy * c.ny + sz * c.nz;
    sx -= along * c.nx, sy -= along * c.ny, sz -= along * c.nz;
    double keep = spring_kept(&e, length2, sx * sx + sy * sy + sz * sz, lean),
           k_dt = 8 * G_STAR * e.a * DT;
    sx = keep * sx - k_dt * c.tx, sy = keep * sy - k_dt * c.ty, sz = keep * sz - k_dt * c.tz;
    double limit = c.overlap > 0 ? FRICTION * f_n : 0.0,
           clip = limited(sx * sx + sy * sy + sz * sz, limit);
    sx *= clip, sy *= clip, sz *= clip;
    double fx = sx - e.damp_t * c.tx, fy = sy - e.damp_t * c.ty, fz = sz - e.damp_t * c.tz;
    clip = limited(fx * fx + fy * fy + fz * fz, limit);
    fx = clip * fx + f_n * c.nx, fy = clip * fy + f_n * c.ny, fz = clip * fz + f_n * c.nz;

    book_work(t, i, &c, &e, f_n, l->normal[at]);
    l->overlap[at] = lean ? e.a : c.overlap, l->normal[at] = f_n;
    l->sx[at] = sx, l->sy[at] = sy, l->sz[at] = sz;
    t->out[0][i] = fx, t->out[1][i] = fy, t->out[2][i] = fz;
    t->out[4][i] = c.arm * (c.ny * fz - c.nz * fy);
    t->out[5][i] = c.arm * (c.nz * fx - c.nx * fz);
    t->out[6][i] = c.arm * (c.nx * fy - c.ny * fx);
}

INLINE void law_lanes(batch *t, const contacts *list, size_t first, int n, bool lean) {
    const contacts l = *list;
    const double mass = 0.5 * sphere_mass();
#pragma omp simd
    for (int i = 0; i < n; i++) contact_law(t, &l, first + (size_t)i, i, mass, lean);
}

static void law(batch *t, const contacts *list, size_t first, int n, bool lean) {
    if (lean)
        law_lanes(t, list, first, n, true);
    else
        law_lanes(t, list, first, n, false);
}

/* Stage 3, to bodies. */
static inline int64_t bits_of(double x) {
    int64_t i;
    memcpy(&i, &x, sizeof i);
    return i;
}
static inline double double_of(int64_t i) {
    double x;
    memcpy(&x, &i, sizeof x);
    return x;
}

/* Nearest integer of |x| < 2^62 in two parts: adding 1.5 * 2^84 leaves x / 2^32 in the low bits. */
static inline int64_t nearest(double x) {
    double high = x + 0x1.8p84, rest = x - (high - 0x1.8p84);
    return (int64_t)((uint64_t)bits_of(high) << 32) +
           (bits_of(rest + 0x1.8p52) - bits_of(0x1.8p52));
}

/* (double)i, rounded once, without an instruction for it. */
static inline double double_from(int64_t i) {
    double high = double_of((int64_t)((uint64_t)i >> 32) ^ bits_of(0x1p84 + 0x1p63));
    double low = double_of((i & 0xffffffff) | bits_of(0x1p52));
    return (high - (0x1p84 + 0x1p63 + 0x1p52)) + low;
}

/* The ledger: work of the normal forces, summed exactly. */
static void book(const batch *t, int n, double scale, int64_t *sum) {
    int64_t stored = 0, lost = 0;
#pragma omp simd reduction(+ : stored, lost)
    for (int i = 0; i < n; i++) {
        stored += nearest(t->work[0][i] * scale);
        lost += nearest(t->work[1][i] * scale);
    }
    sum[0] += stored, sum[1] += lost;
}

static void round_batch(batch *t, int n, double scale, rounding how) {
    for (int k = 0; k < 7; k++) {
        const double *out = t->out[k];
        int64_t *whole = t->whole[k];
        if (k == 3) continue;
        if (how == CAST) {
#pragma omp simd
            for (int i = 0; i < n; i++) whole[i] = (int64_t)(out[i] * scale);
        } else if (how == MAGIC) {
#pragma omp simd
            for (int i = 0; i < n; i++) whole[i] = nearest(out[i] * scale);
        } else {
            double magic = 0x1.8p52 / (scale * 0x1p-11);
            int64_t zero = bits_of(magic);
#pragma omp simd
            for (int i = 0; i < n; i++) whole[i] = (bits_of(out[i] + magic) - zero) * 2048;
        }
    }
}

static void scatter_scalar(const batch *t, const int32_t *ia, const int32_t *ib, int n,
                           quanta *sum) {
    for (int i = 0; i < n; i++) {
        int64_t *a = sum[ia[i]], *b = sum[ib[i]];
        for (int k = 0; k < 3; k++) a[k] += t->whole[k][i], b[k] -= t->whole[k][i];
        for (int k = 4; k < 7; k++) a[k] += t->whole[k][i], b[k] += t->whole[k][i];
    }
}

/* The sum of the owner a stays in registers while a is the same. */
static void scatter_rows(const batch *t, const int32_t *ia, const int32_t *ib, int n, quanta *sum) {
    k4 force = {0}, moment = {0};
    int32_t owner = ia[0];
    for (int i = 0; i < n; i += 4) {
        k4 in[4], f[4], m[4];
        for (int k = 0; k < 4; k++) in[k] = *(const k4 *)&t->whole[k][i];
        TRANSPOSE4(k4, in, f);
        for (int k = 0; k < 4; k++) in[k] = *(const k4 *)&t->whole[k + 4][i];
        TRANSPOSE4(k4, in, m);
        int end = n - i < 4 ? n - i : 4;
        for (int k = 0; k < end; k++) {
            if (ia[i + k] != owner) {
                k4 *a = (k4 *)sum[owner];
                a[0] += force, a[1] += moment;
                force = moment = (k4){0};
                owner = ia[i + k];
            }
            k4 *b = (k4 *)sum[ib[i + k]];
            b[0] -= f[k], b[1] += m[k];
            force += f[k], moment += m[k];
        }
    }
    k4 *a = (k4 *)sum[owner];
    a[0] += force, a[1] += moment;
}

/* No branch on the owner: its line is added to every time. */
static void scatter_both(const batch *t, const int32_t *ia, const int32_t *ib, int n, quanta *sum) {
    for (int i = 0; i < n; i += 4) {
        k4 in[4], f[4], m[4];
        for (int k = 0; k < 4; k++) in[k] = *(const k4 *)&t->whole[k][i];
        TRANSPOSE4(k4, in, f);
        for (int k = 0; k < 4; k++) in[k] = *(const k4 *)&t->whole[k + 4][i];
        TRANSPOSE4(k4, in, m);
        int end = n - i < 4 ? n - i : 4;
        for (int k = 0; k < end; k++) {
            k4 *a = (k4 *)sum[ia[i + k]], *b = (k4 *)sum[ib[i + k]];
            a[0] += f[k], a[1] += m[k];
            b[0] -= f[k], b[1] += m[k];
        }
    }
}

static void write_contacts(const batch *t, int n, double *force) {
    for (int i = 0; i < n; i++)
        for (int k = 0; k < 8; k++) force[8 * i + k] = t->out[k][i];
}
static void write_contacts_rows(const batch *t, int n, double *force) {
    for (int i = 0; i < n; i += 4) {
        v4 in[4], f[4], m[4];
        for (int k = 0; k < 4; k++) in[k] = *(const v4 *)&t->out[k][i];
        TRANSPOSE4(v4, in, f);
        for (int k = 0; k < 4; k++) in[k] = *(const v4 *)&t->out[k + 4][i];
        TRANSPOSE4(v4, in, m);
        int end = n - i < 4 ? n - i : 4;
        for (int k = 0; k < end; k++)
            *(v4 *)(force + 8 * (i + k)) = f[k], *(v4 *)(force + 8 * (i + k) + 4) = m[k];
    }
}

/* b: adds to the owners; the first and last owner of a batch may go on in another one. */
static void sum_owners(const batch *t, const int32_t *ia, int n, double *force) {
    for (int i = 0; i < n;) {
        int32_t owner = ia[i];
        double *f = force + 8 * (size_t)owner, s[7];
        for (int k = 0; k < 7; k++) s[k] = f[k];
        for (; i < n && ia[i] == owner; i++)
            for (int k = 0; k < 7; k++) s[k] += t->out[k][i];
        for (int k = 0; k < 7; k++) f[k] = s[k];
    }
}
static void sum_owners_rows(const batch *t, const int32_t *ia, int n, double *force) {
    int32_t owner = ia[0];
    v4 *at = (v4 *)(force + 8 * (size_t)owner), sf = at[0], sm = at[1];
    for (int i = 0; i < n; i += 4) {
        v4 in[4], f[4], m[4];
        for (int k = 0; k < 4; k++) in[k] = *(const v4 *)&t->out[k][i];
        TRANSPOSE4(v4, in, f);
        for (int k = 0; k < 4; k++) in[k] = *(const v4 *)&t->out[k + 4][i];
        TRANSPOSE4(v4, in, m);
        int end = n - i < 4 ? n - i : 4;
        for (int k = 0; k < end; k++) {
            if (ia[i + k] != owner) {
                at[0] = sf, at[1] = sm;
                owner = ia[i + k];
                at = (v4 *)(force + 8 * (size_t)owner);
                sf = at[0], sm = at[1];
            }
            sf += f[k], sm += m[k];
        }
    }
    at[0] = sf, at[1] = sm;
}

#endif
