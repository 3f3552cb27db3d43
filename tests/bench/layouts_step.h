/* layouts_step.h - the step of the layout experiment: contacts, then bodies. */
#ifndef CLAST_BENCH_LAYOUTS_STEP_H
#define CLAST_BENCH_LAYOUTS_STEP_H

#include <omp.h>
#include <time.h>

#include "tests/bench/layouts_batch.h"

/* ---- the step -------------------------------------------------------------------------------- */

static inline uint64_t ticks(bool timed) {
    return timed ? __builtin_ia32_rdtsc() : 0;
}

static inline void lap_add(lap *l, uint64_t from, uint64_t to) {
    bool whole = to - from < 100000;
    l->all++, l->counted += whole, l->ticks += whole ? (double)(to - from) : 0;
}

static double clock_s(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void deliver(run *r, batch *t, size_t first, int n, int thread) {
    const int32_t *ia = r->list.a + first, *ib = r->list.b + first;
    bool rows = r->how.scatter != SCALAR;
    if (r->how.layout == HALF_GATHER) {
        (rows ? write_contacts_rows : write_contacts)(t, n, r->force + 8 * first);
    } else if (r->how.layout == FULL) {
        (rows ? sum_owners_rows : sum_owners)(t, ia, n, r->force);
    } else {
        round_batch(t, n, r->scale, r->how.round);
        (r->how.scatter == BOTH ? scatter_both
         : rows                 ? scatter_rows
                                : scatter_scalar)(t, ia, ib, n, r->sum[thread] - r->cut[thread]);
    }
}

typedef struct block {
    LINE double f[8][BLOCK];
    LINE int64_t whole[8][BLOCK];
} block;

static void collect_gather(const run *r, size_t first, int n, block *k) {
    for (int i = 0; i < n; i++) {
        v4 force = {0}, moment = {0};
        for (size_t e = r->meet.first[first + (size_t)i]; e < r->meet.first[first + (size_t)i + 1];
             e++) {
            int32_t c = r->meet.entry[e];
            const v4 *f = (const v4 *)(r->force + 8 * (size_t)(c < 0 ? ~c : c));
            force = c < 0 ? force - f[0] : force + f[0];
            moment += f[1];
        }
        for (int j = 0; j < 3; j++) k->f[j][i] = force[j], k->f[4 + j][i] = moment[j];
    }
}

static void collect_full(const run *r, size_t first, int n, block *k) {
    for (int i = 0; i < n; i++) {
        double *f = r->force + 8 * (first + (size_t)i);
        for (int j = 0; j < 7; j++) k->f[j][i] = f[j], f[j] = 0;
    }
}

/* Eight 8-byte values of each of four rows into columns `stride` apart, or back. */
INLINE void turn_rows(const void *rows, size_t row, void *columns, size_t column) {
    for (int half = 0; half < 2; half++) {
        k4 in[4], out[4];
        for (int k = 0; k < 4; k++)
            in[k] = *(const k4 *)((const int64_t *)rows + (size_t)k * row + 4 * half);
        TRANSPOSE4(k4, in, out);
        for (int k = 0; k < 4; k++)
            *(k4 *)((int64_t *)columns + (size_t)(4 * half + k) * column) = out[k];
    }
}

static void take_sums(quanta *s, int n, bool turn, block *k) {
    int i = 0;
    for (; turn && i + 4 <= n; i += 4) turn_rows(s + i, 8, &k->whole[0][i], BLOCK);
    for (; i < n; i++)
        for (int j = 0; j < 7; j++) k->whole[j][i] = s[i][j];
    memset(s, 0, (size_t)n * sizeof *s);
}

static void collect_exact(const run *r, int thread, size_t first, int n, block *k) {
    take_sums(r->sum[thread] + (first - r->cut[thread]), n, r->how.turn, k);
    for (int t = 0; t < thread; t++)
        for (size_t i = first; i < first + (size_t)n && i < r->end[t]; i++) {
            int64_t *s = r->sum[t][i - r->cut[t]];
            for (int j = 0; j < 7; j++) k->whole[j][i - first] += s[j], s[j] = 0;
        }
    double quantum = 1 / r->scale;
    for (int j = 0; j < 7; j++)
#pragma omp simd
        for (int i = 0; i < n; i++) k->f[j][i] = quantum * double_from(k->whole[j][i]);
}

/* A smooth linear spring and dashpot: the walls are not what is measured. */
static inline double wall_force(double gap, double v) {
    return gap < 0 ? -2000.0 * gap - 0.6 * v : 0.0;
}

static void kick_drift(bodies *s, size_t first, int n, const block *k) {
    double *x = s->x + first, *y = s->y + first, *z = s->z + first, *vx = s->vx + first,
           *vy = s->vy + first, *vz = s->vz + first, *wx = s->wx + first, *wy = s->wy + first,
           *wz = s->wz + first, *radius = s->radius + first, *mass = s->mass + first;
    double side_x = s->side_x, side_y = s->side_y;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        double r = radius[i], per_mass = DT / mass[i], turn = -2.5 * per_mass / r;
        double fx =
            k->f[0][i] + wall_force(x[i] - r, vx[i]) - wall_force(side_x - x[i] - r, -vx[i]);
        double fy =
            k->f[1][i] + wall_force(y[i] - r, vy[i]) - wall_force(side_y - y[i] - r, -vy[i]);
        double fz = k->f[2][i] + wall_force(z[i] - r, vz[i]);
        vx[i] += per_mass * fx, vy[i] += per_mass * fy, vz[i] += per_mass * fz - GRAVITY * DT;
        wx[i] += turn * k->f[4][i], wy[i] += turn * k->f[5][i], wz[i] += turn * k->f[6][i];
        x[i] += DT * vx[i], y[i] += DT * vy[i], z[i] += DT * vz[i];
    }
}

static void write_rows(const bodies *s, size_t first, int n, bool turn) {
    int i = 0;
    for (; turn && i + 4 <= n; i += 4) {
        size_t k = first + (size_t)i;
        const double *column[] = {s->x + k,  s->y + k,  s->z + k,  s->radius + k,
                                  s->vx + k, s->vy + k, s->vz + k, s->vz + k,
                                  s->wx + k, s->wy + k, s->wz + k, s->wz + k};
        for (int part = 0; part < 3; part++) {
            v4 in[4], out[4], r = *(const v4 *)(s->radius + k);
            for (int q = 0; q < 4; q++) in[q] = *(const v4 *)column[4 * part + q];
            if (part == 2)
                for (int q = 0; q < 4; q++) in[q] *= r;
            TRANSPOSE4(v4, in, out);
            for (int q = 0; q < 4; q++) *(v4 *)(s->row + (k + (size_t)q) * ROW + 4 * part) = out[q];
        }
    }
    for (; i < n; i++) row_write(s, first + (size_t)i);
}

static void body_range(run *r, int thread, size_t begin, size_t end) {
    block k;
    for (size_t first = begin; first < end; first += BLOCK) {
        int n = end - first < BLOCK ? (int)(end - first) : BLOCK;
        uint64_t t0 = ticks(r->how.timed);
        if (r->how.layout == HALF_GATHER)
            collect_gather(r, first, n, &k);
        else if (r->how.layout == FULL)
            collect_full(r, first, n, &k);
        else
            collect_exact(r, thread, first, n, &k);
        kick_drift(&r->body, first, n, &k);
        write_rows(&r->body, first, n, r->how.turn);
        lap_add(&r->laps[thread][3], t0, ticks(r->how.timed));
    }
}

/* Bodies of this thread below this slot are partners of another thread's contacts. */
static size_t shared_until(const run *r, int thread) {
    size_t end = r->cut[thread];
    for (int t = 0; t < thread; t++) end = r->end[t] > end ? r->end[t] : end;
    return end < r->cut[thread + 1] ? end : r->cut[thread + 1];
}

static void body_pass(run *r, int thread) {
    body_range(r, thread, r->cut[thread],
               r->how.trail ? shared_until(r, thread) : r->cut[thread + 1]);
}

/* c: a body whose contacts are all done moves on at once, while its line is still near. */
static size_t trail(run *r, int thread, size_t moved, size_t done) {
    size_t end = moved;
    while (end + BLOCK <= done) end += BLOCK;
    if (done == r->cut[thread + 1]) end = done;
    if (end > moved) body_range(r, thread, moved, end);
    return end;
}

INLINE void prefetch(const run *r, quanta *sum, size_t first, size_t end) {
    for (size_t i = first; i < end; i++) {
        const double *row = r->body.row + (size_t)r->list.b[i] * ROW;
        __builtin_prefetch(row);
        __builtin_prefetch(row + 8);
        if (sum) __builtin_prefetch(sum + r->list.b[i], 1);
    }
}

static void load(const run *r, size_t first, int n, batch *t) {
    const double *row = r->body.row;
    const int32_t *a = r->list.a + first, *b = r->list.b + first;
    if (r->how.load == COPY)
        load_copy(row, a, b, n, t);
    else if (r->how.load == SHUFFLE)
        load_shuffle(row, a, b, n, t);
    else
        load_gather(row, a, b, n, t);
}

static void contact_pass(run *r, int thread) {
    batch t;
    memset(&t, 0, sizeof t);
    size_t end = r->list.first[r->cut[thread + 1]], size = (size_t)r->how.batch,
           moved = shared_until(r, thread);
    lap *laps = r->laps[thread];
    bool timed = r->how.timed;
    quanta *sum = r->how.layout == HALF_EXACT ? r->sum[thread] - r->cut[thread] : NULL;
    for (size_t first = r->list.first[r->cut[thread]]; first < end; first += size) {
        size_t left = end - first;
        int n = (int)(left < size ? left : size);
        uint64_t t0 = ticks(timed);
        if (r->how.prefetch && left > 2 * size) prefetch(r, sum, first + size, first + 2 * size);
        load(r, first, n, &t);
        uint64_t t1 = ticks(timed);
        law(&t, &r->list, first, n, r->how.lean);
        uint64_t t2 = ticks(timed);
        book(&t, n, 0x1p40, r->work[thread]);
        deliver(r, &t, first, n, thread);
        uint64_t t3 = ticks(timed);
        lap_add(&laps[0], t0, t1), lap_add(&laps[1], t1, t2), lap_add(&laps[2], t2, t3);
        if (r->how.trail)
            moved = trail(r, thread, moved,
                          left <= size ? r->cut[thread + 1] : (size_t)r->list.a[first + size]);
    }
}

static void run_steps(run *r, int steps) {
#pragma omp parallel num_threads(r->how.threads)
    for (int i = 0; i < steps; i++) {
        int thread = omp_get_thread_num();
        double t0 = clock_s(CLOCK_THREAD_CPUTIME_ID);
        contact_pass(r, thread);
        r->busy[thread] += clock_s(CLOCK_THREAD_CPUTIME_ID) - t0;
#pragma omp barrier
        t0 = clock_s(CLOCK_THREAD_CPUTIME_ID);
        body_pass(r, thread);
        r->busy[thread] += clock_s(CLOCK_THREAD_CPUTIME_ID) - t0;
#pragma omp barrier
    }
}

/* ---- a run and its freedom from order -------------------------------------------------------- */

static void cut_ranges(run *r) {
    const contacts *c = &r->list;
    size_t body = 0, n = r->body.count;
    for (int t = 0; t <= r->how.threads; t++) {
        while (body < n && c->first[body] < c->count * (size_t)t / (size_t)r->how.threads) body++;
        r->cut[t] = t == r->how.threads ? n : body;
    }
    for (int t = 0; t < r->how.threads; t++) {
        size_t end = r->cut[t + 1];
        for (size_t k = c->first[r->cut[t]]; k < c->first[r->cut[t + 1]]; k++)
            if ((size_t)c->b[k] >= end) end = (size_t)c->b[k] + 1;
        r->end[t] = end;
        if (r->how.layout == HALF_EXACT) r->sum[t] = TAKE(quanta, end - r->cut[t]);
    }
}

/* Takes the bodies and the list over. */
static run run_new(choice how, bodies body, contacts list) {
    run r = {.how = how, .body = body, .list = list, .scale = 0x1p52};
    cut_ranges(&r);
    if (how.layout == HALF_GATHER) r.meet = incidence_new(&r.list, r.body.id, r.body.count);
    if (how.layout != HALF_EXACT)
        r.force = TAKE(double, 8 * (how.layout == FULL ? body.count : list.count));
    return r;
}

static void run_free(run *r) {
    for (int t = 0; t < r->how.threads; t++) free(r->sum[t]);
    free(r->force), free(r->meet.entry), free(r->meet.first);
    bodies_free(&r->body), list_free(&r->list);
}

#endif
