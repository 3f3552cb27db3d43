/* layouts.c - which layout of contacts is fastest with the same bits (DESIGN section 8).
 *
 *   a  half list: force and moment written once per contact, gathered per body in the order of ids
 *   b  full list: every owner computes its own side, antisymmetric to the bit; history held twice
 *   c  half list: force and moment rounded to 64-bit integers and added to both bodies; integer
 *      sums have no order
 *
 * The program settles its bed itself (equal spheres in a box without friction at the walls) and
 * keeps it in the current folder. `layouts 20000` compares the layouts, `layouts 20000 v` variants
 * of the stages of c. By hand, from the root of the repository, with -mavx2 -mtune=haswell,
 * -mavx512f -mavx512dq -mavx512vl -mavx512bw -mprefer-vector-width=512, or neither:
 *
 *   gcc -std=gnu17 -D_POSIX_C_SOURCE=200809L -O3 -ffp-contract=off -fno-math-errno -fopenmp \
 *       -fno-trapping-math -fno-tree-slp-vectorize -I. tests/bench/layouts.c -o layouts -lm
 */
#include <stdio.h>

#include "tests/bench/layouts_step.h"

/* ---- settling -------------------------------------------------------------------------------- */

static const choice SETTLE = {HALF_EXACT, COPY, SCALAR, MAGIC, 64, 1, .timed = false};

static double fastest(const bodies *s) {
    double v2 = 0;
    for (size_t i = 0; i < s->count; i++)
        v2 = fmax(v2, s->vx[i] * s->vx[i] + s->vy[i] * s->vy[i] + s->vz[i] * s->vz[i]);
    return sqrt(v2);
}

/* Histories move from the old list to the new one by the ids of both bodies. */
static void list_carry(contacts *to, const bodies *now, const contacts *from, const bodies *then) {
    int32_t *slot = TAKE(int32_t, now->count);
    for (size_t i = 0; i < then->count; i++) slot[then->id[i]] = (int32_t)i;
    for (size_t k = 0; k < to->count; k++) {
        int32_t p = slot[now->id[to->a[k]]], q = slot[now->id[to->b[k]]], low = p < q ? p : q,
                high = p < q ? q : p;
        double sign = p < q ? 1 : -1;
        for (size_t j = from->first[low]; j < from->first[low + 1]; j++) {
            if (from->b[j] != high) continue;
            to->overlap[k] = from->overlap[j], to->normal[k] = from->normal[j];
            to->sx[k] = sign * from->sx[j], to->sy[k] = sign * from->sy[j],
            to->sz[k] = sign * from->sz[j];
        }
    }
    free(slot);
}

/* Lets the bed fall until nothing moves faster than `calm` (m/s); returns its wide list. */
static contacts settle(bodies *s, double calm) {
    const double skin = 0.2 * RADIUS;
    contacts list = list_new(s, skin);
    for (double t = 0; t < 0.3 || (fastest(s) > calm && t < 1.2);) {
        run r = run_new(SETTLE, *s, list);
        for (double way = 0; way < 0.35 * skin && (t < 0.3 || fastest(&r.body) > calm);
             t += 5 * DT) {
            run_steps(&r, 5);
            way += 5 * DT * fastest(&r.body) * 1.05;
        }
        *s = bodies_copy(&r.body, NULL);
        fprintf(stderr, "\rsettling: %.3f s, fastest %.4f m/s ", t, fastest(s));
        list = list_new(s, skin);
        list_carry(&list, s, &r.list, &r.body);
        run_free(&r);
    }
    return list;
}

typedef struct bed {
    bodies body;
    contacts half, full;
    double touching; /* contacts per sphere, each counted for both */
} bed;

/* Columns of a bed in its file. */
static bool bed_file(const char *name, const char *mode, bodies *s, contacts *c) {
    FILE *f = fopen(name, mode);
    if (!f) return false;
    bool write = *mode == 'w', good = true;
    double *columns[] = {s->x, s->y, s->z, s->vx, s->vy, s->vz, s->wx, s->wy, s->wz};
    for (int k = 0; k < 9; k++)
        good &= (write ? fwrite(columns[k], 8, s->count, f) : fread(columns[k], 8, s->count, f)) ==
                s->count;
    good &= (write ? fwrite(s->id, 4, s->count, f) : fread(s->id, 4, s->count, f)) == s->count;
    good &= (write ? fwrite(&c->count, 8, 1, f) : fread(&c->count, 8, 1, f)) == 1;
    void *lists[] = {c->a, c->b, c->overlap, c->normal, c->sx, c->sy, c->sz};
    for (int k = 0; k < 7; k++) {
        size_t size = k < 2 ? 4 : 8;
        good &= (write ? fwrite(lists[k], size, c->count, f)
                       : fread(lists[k], size, c->count, f)) == c->count;
    }
    return fclose(f) == 0 && good;
}

static bed bed_open(size_t n, double skin) {
    char name[64];
    snprintf(name, sizeof name, "bed-%zu.bin", n);
    bodies s = lattice(n);
    contacts wide = list_room(n, 8 * n);
    if (bed_file(name, "rb", &s, &wide)) {
        for (size_t k = wide.count; k-- > 0;) wide.first[wide.a[k]] = k;
        for (size_t i = n, next = wide.count; i-- > 0;) {
            bool any = wide.count > 0 && wide.a[wide.first[i]] == (int32_t)i;
            next = wide.first[i] = any ? wide.first[i] : next;
        }
        wide.first[n] = wide.count;
    } else {
        wide = settle(&s, 2e-3);
        if (!bed_file(name, "wb", &s, &wide)) abort();
    }
    bodies then = bodies_copy(&s, NULL);
    contacts near = list_new(&s, skin);
    list_carry(&near, &s, &wide, &then);
    bed b = {.body = bodies_copy(&s, NULL), .half = near};
    b.full = list_full(&b.half, b.body.id, n);
    for (size_t k = 0; k < b.half.count; k++) b.touching += 2 * (b.half.overlap[k] > 0) / (double)n;
    return b;
}

/* ---- the experiment -------------------------------------------------------------------------- */

static run run_of(const bed *b, choice how) {
    const contacts *list = how.layout == FULL ? &b->full : &b->half;
    run r = run_new(how, bodies_copy(&b->body, NULL), list_copy(list, b->body.count));
    for (size_t k = 0; how.lean && k < r.list.count; k++)
        r.list.overlap[k] = sqrt(RADIUS / 2 * r.list.overlap[k]);
    return r;
}

static size_t run_bytes(const run *r) {
    size_t n = r->body.count, c = r->list.count, bytes = n * (11 * 8 + 4 + ROW * 8);
    bytes += n * 8 + c * (8 + 5 * 8);
    if (r->how.layout == HALF_GATHER) bytes += c * (64 + 2 * 4) + n * 8;
    if (r->how.layout == FULL) bytes += n * 64;
    if (r->how.layout == HALF_EXACT)
        for (int t = 0; t < r->how.threads; t++) bytes += (r->end[t] - r->cut[t]) * 64;
    return bytes;
}

static const char *ISA =
#if defined __AVX512F__
    "avx512";
#elif defined __AVX2__
    "avx2";
#else
    "baseline";
#endif

typedef struct timing {
    double wall, busy, stage[4]; /* s per step */
} timing;

/* Steps in short windows and keeps the fastest ones: a shared machine disturbs most windows. */
static timing best_windows(run *r) {
    int steps = (int)(100000 / r->body.count) + 1, windows = 40;
    timing best = {.wall = 1e9, .busy = 1e9};
    r->how.timed = false;
    for (int i = 0; i < windows; i++) {
        memset(r->busy, 0, sizeof r->busy);
        double t0 = clock_s(CLOCK_MONOTONIC), busy = 0;
        run_steps(r, steps);
        best.wall = fmin(best.wall, (clock_s(CLOCK_MONOTONIC) - t0) / steps);
        for (int t = 0; t < r->how.threads; t++) busy = fmax(busy, r->busy[t] / steps);
        best.busy = fmin(best.busy, busy);
    }
    return best;
}

/* Stages of the fastest of some windows, summed over threads. */
static void best_stages(run *r, double per_tick, double *stage) {
    r->how.timed = true;
    int steps = (int)(200000 / r->body.count) + 1;
    for (int i = 0; i < 20; i++) {
        memset(r->laps, 0, sizeof r->laps);
        run_steps(r, steps);
        for (int k = 0; k < 4; k++) {
            double sum = 0;
            for (int t = 0; t < r->how.threads; t++)
                sum += r->laps[t][k].ticks * (double)r->laps[t][k].all /
                       (double)(r->laps[t][k].counted + 1);
            if (i == 0 || sum * per_tick / steps < stage[k]) stage[k] = sum * per_tick / steps;
        }
    }
}

static double seconds_per_tick(void) {
    double t0 = clock_s(CLOCK_MONOTONIC);
    uint64_t c0 = ticks(true);
    while (clock_s(CLOCK_MONOTONIC) - t0 < 0.05) continue;
    return (clock_s(CLOCK_MONOTONIC) - t0) / (double)(ticks(true) - c0);
}

static void measure(const bed *b, choice how, const char *what) {
    double n = (double)b->body.count, unit = 1e9 / n;
    run r = run_of(b, how);
    run_steps(&r, 10);
    timing t = best_windows(&r);
    best_stages(&r, seconds_per_tick(), t.stage);
    printf("%-8s %6.0f %d %-30s %6.1f %6.1f %6.2f |%6.1f%6.1f%6.1f%6.1f |%5.0f\n", ISA, n,
           how.threads, what, t.wall * unit, t.busy * unit, t.busy * 1e9 / (double)b->half.count,
           t.stage[0] * unit, t.stage[1] * unit, t.stage[2] * unit, t.stage[3] * unit,
           (double)run_bytes(&r) / n);
    fflush(stdout);
    run_free(&r);
}

static double difference(const bodies *s, const bodies *t) {
    double most = 0;
    for (size_t i = 0; i < s->count; i++)
        most =
            fmax(most, fabs(s->x[i] - t->x[i]) + fabs(s->y[i] - t->y[i]) + fabs(s->z[i] - t->z[i]));
    return most / RADIUS;
}

static bool same_bits(const bodies *s, const bodies *t) {
    size_t size = s->count * sizeof(double);
    return !memcmp(s->x, t->x, size) && !memcmp(s->vx, t->vx, size) &&
           !memcmp(s->wy, t->wy, size) && !memcmp(s->z, t->z, size) &&
           !memcmp(s->vz, t->vz, size) && !memcmp(s->wz, t->wz, size);
}

/* Turns the order of every body's contacts around. */
static void turn_list(contacts *c, size_t n) {
    for (size_t i = 0; i < n; i++)
        for (size_t p = c->first[i], q = c->first[i + 1]; p + 1 < q; p++) {
            q--;
            int32_t j = c->b[p];
            c->b[p] = c->b[q], c->b[q] = j;
            double *column[] = {c->overlap, c->normal, c->sx, c->sy, c->sz};
            for (int k = 0; k < 5; k++) {
                double h = column[k][p];
                column[k][p] = column[k][q], column[k][q] = h;
            }
        }
}

static run after(const bed *b, choice how, int steps, bool turned) {
    run r = run_of(b, how);
    if (turned) turn_list(&r.list, b->body.count);
    run_steps(&r, steps);
    return r;
}

static void compare(const bed *b) {
    choice base = {HALF_GATHER, SHUFFLE, BOTH, MAGIC, 64, 1, .timed = false}, full = base,
           exact = base;
    full.layout = FULL, exact.layout = HALF_EXACT;
    choice two = exact, scalar = exact;
    two.threads = 2, two.trail = two.turn = true, scalar.load = COPY, scalar.scatter = SCALAR,
    scalar.batch = 32;
    run r[] = {after(b, base, 100, false), after(b, full, 100, false), after(b, exact, 100, false),
               after(b, two, 100, false), after(b, scalar, 100, true)};
    printf("# after 100 steps, of a radius: a-b %.1e, a-c %.1e; same bits: a b %d, c two threads "
           "%d, c other order %d\n",
           difference(&r[0].body, &r[1].body), difference(&r[0].body, &r[2].body),
           same_bits(&r[0].body, &r[1].body), same_bits(&r[2].body, &r[3].body),
           same_bits(&r[2].body, &r[4].body));
    uint64_t hash = 0;
    for (size_t i = 0; i < b->body.count; i++)
        hash =
            hash * 31 + (uint64_t)bits_of(r[2].body.x[i]) + 7 * (uint64_t)bits_of(r[2].body.wx[i]);
    printf("# hash of c %016llx\n", (unsigned long long)hash);
    for (int i = 0; i < 5; i++) run_free(&r[i]);
}

static void layouts(const bed *b) {
    static const char *names[] = {"a half, gather", "b full, owner computes",
                                  "c half, exact scatter"};
    for (int threads = 1; threads <= 2; threads++)
        for (int l = 0; l < 3; l++) {
            choice how = {(layout)l, COPY, SCALAR, MAGIC, 64, threads, .timed = false};
            char what[80];
            snprintf(what, sizeof what, "%s", names[l]);
            measure(b, how, what);
            how.prefetch = true;
            snprintf(what, sizeof what, "%s, prefetch", names[l]);
            measure(b, how, what);
#ifdef __AVX__
            how.load = SHUFFLE, how.scatter = l == 2 ? BOTH : ROWS, how.turn = true;
            snprintf(what, sizeof what, "%s, shuffled", names[l]);
            measure(b, how, what);
#endif
        }
}

static void variants(const bed *b) {
#ifdef __AVX__
    const choice best = {HALF_EXACT, SHUFFLE, BOTH, MAGIC, 64, 1, .turn = true, .prefetch = true};
#else
    const choice best = {HALF_EXACT, COPY, SCALAR, MAGIC, 64, 1, .prefetch = true};
#endif
    choice v = best;
    measure(b, v, "c");
    v.lean = true, measure(b, v, "c lean law"), v = best;
    v.trail = true, measure(b, v, "c trailing bodies"), v = best;
    v.prefetch = false, measure(b, v, "c no prefetch"), v = best;
    v.lean = true, v.threads = 2, measure(b, v, "c lean law"), v = best;
    v.round = CAST, measure(b, v, "c cast"), v = best;
    v.scatter = ROWS, measure(b, v, "c scatter, owner in registers"), v = best;
    v.round = MAGIC51, measure(b, v, "c 51-bit magic, own loop"), v = best;
    v.batch = 32, measure(b, v, "c batch 32"), v = best;
    v.batch = 128, measure(b, v, "c batch 128"), v = best;
    v.load = GATHER, measure(b, v, "c load by vector gathers"), v = best;
    v.load = COPY, measure(b, v, "c load by copies"), v = best;
    v.scatter = SCALAR, measure(b, v, "c scatter by scalars"), v = best;
    v.turn = false, measure(b, v, "c bodies by scalars"), v = best;
}

int main(int argc, char **argv) {
    size_t n = argc > 1 ? (size_t)atol(argv[1]) : 20000;
    bed b = bed_open(n, 0.02 * RADIUS);
    printf("# %zu spheres, listed pairs per sphere %.2f, coordination %.2f, fastest %.1e m/s\n", n,
           (double)b.half.count / (double)n, b.touching, fastest(&b.body));
    compare(&b);
    printf("# ns per sphere-step by the wall and of the busiest thread on its processor, ns per "
           "contact |\n"
           "# load, law, deliver, bodies: ns per sphere, all threads | bytes per sphere\n");
    if (argc > 2)
        variants(&b);
    else
        layouts(&b);
    return 0;
}
