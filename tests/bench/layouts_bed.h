/* layouts_bed.h - bodies of the layout experiment, their cells and lists of near pairs. */
#ifndef CLAST_BENCH_LAYOUTS_BED_H
#define CLAST_BENCH_LAYOUTS_BED_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#ifndef ROW
#define ROW 12 /* doubles from one row of a body to the next */
#endif
#define INLINE __attribute__((always_inline)) static inline
enum { BATCH = 128, BLOCK = 64, THREADS = 8 };
#define LINE __attribute__((aligned(64)))

static void *must(void *p) {
    if (!p) abort();
    return p;
}
static void *take(size_t count, size_t size) {
    size_t bytes = (count * size + 64 + 127) / 64 * 64;
    return memset(must(aligned_alloc(64, bytes)), 0, bytes);
}
#define TAKE(type, count) ((type *)take((count), sizeof(type)))

/* ---- the bed --------------------------------------------------------------------------------- */

static const double RADIUS = 0.005, DENSITY = 2500, FRICTION = 0.5;
static const double BETA = 0.19672; /* sqrt(5/6) ln e / sqrt(ln2 e + pi2) at e = 0.5 */
static const double GRAVITY = 9.81, DT = 5e-5;

static double sphere_mass(void) {
    return 4.0 / 3 * 3.14159265358979 * RADIUS * RADIUS * RADIUS * DENSITY;
}

typedef struct bodies {
    size_t count;
    int32_t *id;
    double *x, *y, *z, *vx, *vy, *vz, *wx, *wy, *wz, *radius, *mass;
    double *row; /* x y z r vx vy vz - ux uy uz -, u = r w */
    double side_x, side_y;
} bodies;

typedef struct contacts {
    size_t count;
    size_t *first; /* per body */
    int32_t *a, *b;
    double *overlap, *normal, *sx, *sy, *sz; /* history */
} contacts;

static bodies bodies_new(size_t n) {
    bodies s = {.count = n, .id = TAKE(int32_t, n)};
    double **column[] = {&s.x,  &s.y,  &s.z,  &s.vx,     &s.vy,  &s.vz,
                         &s.wx, &s.wy, &s.wz, &s.radius, &s.mass};
    for (size_t i = 0; i < sizeof column / sizeof *column; i++) *column[i] = TAKE(double, n);
    s.row = TAKE(double, n *ROW);
    return s;
}

static void row_write(const bodies *s, size_t i) {
    double *r = s->row + i * ROW;
    r[0] = s->x[i], r[1] = s->y[i], r[2] = s->z[i], r[3] = s->radius[i];
    r[4] = s->vx[i], r[5] = s->vy[i], r[6] = s->vz[i];
    r[8] = s->radius[i] * s->wx[i], r[9] = s->radius[i] * s->wy[i], r[10] = s->radius[i] * s->wz[i];
}

static bodies bodies_copy(const bodies *s, const int32_t *order) {
    bodies t = bodies_new(s->count);
    t.side_x = s->side_x, t.side_y = s->side_y;
    for (size_t i = 0; i < s->count; i++) {
        size_t k = order ? (size_t)order[i] : i;
        t.id[i] = s->id[k], t.radius[i] = s->radius[k], t.mass[i] = s->mass[k];
        t.x[i] = s->x[k], t.y[i] = s->y[k], t.z[i] = s->z[k];
        t.vx[i] = s->vx[k], t.vy[i] = s->vy[k], t.vz[i] = s->vz[k];
        t.wx[i] = s->wx[k], t.wy[i] = s->wy[k], t.wz[i] = s->wz[k];
        row_write(&t, i);
    }
    return t;
}

static void bodies_free(bodies *s) {
    double *column[] = {s->x,  s->y,  s->z,  s->vx,     s->vy,   s->vz,
                        s->wx, s->wy, s->wz, s->radius, s->mass, s->row};
    for (size_t i = 0; i < sizeof column / sizeof *column; i++) free(column[i]);
    free(s->id);
}

static double uniform(uint64_t *state) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

/* A jittered lattice, loose enough to fall into a random packing. */
static bodies lattice(size_t n) {
    bodies s = bodies_new(n);
    size_t columns = (size_t)(cbrt((double)n) * 0.93 + 0.5);
    double spacing = 2.08 * RADIUS;
    s.side_x = s.side_y = (double)columns * spacing;
    uint64_t state = 1;
    for (size_t i = 0; i < n; i++) {
        s.id[i] = (int32_t)i;
        s.radius[i] = RADIUS, s.mass[i] = sphere_mass();
        s.x[i] = ((double)(i % columns) + 0.5) * spacing + 0.035 * RADIUS * (uniform(&state) - 0.5);
        s.y[i] = ((double)(i / columns % columns) + 0.5) * spacing +
                 0.035 * RADIUS * (uniform(&state) - 0.5);
        s.z[i] = ((double)(i / columns / columns) + 0.5) * spacing +
                 0.035 * RADIUS * (uniform(&state) - 0.5);
        s.vx[i] = uniform(&state) - 0.5, s.vy[i] = uniform(&state) - 0.5;
    }
    return s;
}

/* ---- cells and lists ------------------------------------------------------------------------- */

typedef struct grid {
    int nx, ny, nz;
    double size;
    size_t *start; /* per cell, of the slots sorted by cell */
} grid;

static int clampi(int i, int n) {
    return i < 0 ? 0 : i >= n ? n - 1 : i;
}

static size_t cell_at(const grid *g, int x, int y, int z) {
    return ((size_t)z * (size_t)g->ny + (size_t)y) * (size_t)g->nx + (size_t)x;
}

static size_t cell_of(const grid *g, const bodies *s, size_t i) {
    return cell_at(g, clampi((int)(s->x[i] / g->size), g->nx),
                   clampi((int)(s->y[i] / g->size), g->ny),
                   clampi((int)(s->z[i] / g->size), g->nz));
}

/* Sorts the bodies by cell; returns the grid of the sorted ones. */
static grid sort_bodies(bodies *s, double reach) {
    double top = 0;
    for (size_t i = 0; i < s->count; i++) top = fmax(top, s->z[i]);
    grid g = {.size = reach};
    g.nx = (int)(s->side_x / reach) + 1, g.ny = (int)(s->side_y / reach) + 1,
    g.nz = (int)(top / reach) + 1;
    size_t cells = (size_t)g.nx * (size_t)g.ny * (size_t)g.nz;
    g.start = TAKE(size_t, cells + 2);
    for (size_t i = 0; i < s->count; i++) g.start[cell_of(&g, s, i) + 2]++;
    for (size_t c = 2; c < cells + 2; c++) g.start[c] += g.start[c - 1];
    int32_t *order = TAKE(int32_t, s->count);
    for (size_t i = 0; i < s->count; i++) order[g.start[cell_of(&g, s, i) + 1]++] = (int32_t)i;
    bodies sorted = bodies_copy(s, order);
    bodies_free(s);
    *s = sorted;
    free(order);
    return g;
}

static const int32_t *sort_ids;
static int by_id(const void *p, const void *q) {
    int32_t a = sort_ids[*(const int32_t *)p], b = sort_ids[*(const int32_t *)q];
    return (a > b) - (a < b);
}

/* Partners of body i closer than `reach` in slots from `from` on, in the order of ids. */
static int partners(const bodies *s, const grid *g, size_t i, size_t from, double reach,
                    int32_t *found) {
    int n = 0, cx = clampi((int)(s->x[i] / g->size), g->nx),
        cy = clampi((int)(s->y[i] / g->size), g->ny), cz = clampi((int)(s->z[i] / g->size), g->nz);
    for (int k = 0; k < 27; k++) {
        int x = cx + k % 3 - 1, y = cy + k / 3 % 3 - 1, z = cz + k / 9 - 1;
        if (x < 0 || y < 0 || z < 0 || x >= g->nx || y >= g->ny || z >= g->nz) continue;
        size_t cell = cell_at(g, x, y, z);
        for (size_t j = g->start[cell]; j < g->start[cell + 1]; j++) {
            double dx = s->x[i] - s->x[j], dy = s->y[i] - s->y[j], dz = s->z[i] - s->z[j];
            if (j >= from && j != i && dx * dx + dy * dy + dz * dz < reach * reach)
                found[n++] = (int32_t)j;
        }
    }
    sort_ids = s->id;
    qsort(found, (size_t)n, sizeof *found, by_id);
    return n;
}

static contacts list_room(size_t n, size_t count) {
    contacts c = {
        .first = TAKE(size_t, n + 2), .a = TAKE(int32_t, count), .b = TAKE(int32_t, count)};
    double **column[] = {&c.overlap, &c.normal, &c.sx, &c.sy, &c.sz};
    for (int k = 0; k < 5; k++) *column[k] = TAKE(double, count);
    return c;
}

/* Half list (b > a) of pairs with a gap below `skin`. Sorts the bodies. */
static contacts list_new(bodies *s, double skin) {
    double reach = 2 * RADIUS + skin;
    grid g = sort_bodies(s, reach);
    contacts c = list_room(s->count, 8 * s->count);
    for (size_t i = 0; i < s->count; i++) {
        int32_t found[64];
        c.first[i] = c.count;
        int n = partners(s, &g, i, i + 1, reach, found);
        for (int k = 0; k < n; k++) c.a[c.count] = (int32_t)i, c.b[c.count++] = found[k];
    }
    c.first[s->count] = c.count;
    free(g.start);
    return c;
}

static void list_free(contacts *c) {
    void *column[] = {c->first, c->a, c->b, c->overlap, c->normal, c->sx, c->sy, c->sz};
    for (size_t k = 0; k < sizeof column / sizeof *column; k++) free(column[k]);
}

static contacts list_copy(const contacts *from, size_t n) {
    contacts c = list_room(n, from->count);
    c.count = from->count;
    memcpy(c.first, from->first, (n + 1) * sizeof *c.first);
    memcpy(c.a, from->a, c.count * sizeof *c.a), memcpy(c.b, from->b, c.count * sizeof *c.b);
    double *to[] = {c.overlap, c.normal, c.sx, c.sy, c.sz},
           *of[] = {from->overlap, from->normal, from->sx, from->sy, from->sz};
    for (int k = 0; k < 5; k++) memcpy(to[k], of[k], c.count * sizeof(double));
    return c;
}

/* Per body its contacts k by id of the partner: k where the body is a, ~k where it is b. */
typedef struct incidence {
    size_t *first;
    int32_t *entry;
} incidence;

static int32_t partner_id(const contacts *c, const int32_t *id, int32_t k) {
    return k < 0 ? id[c->a[~k]] : id[c->b[k]];
}

static incidence incidence_new(const contacts *c, const int32_t *id, size_t n) {
    incidence t = {TAKE(size_t, n + 2), TAKE(int32_t, 2 * c->count)};
    for (size_t k = 0; k < c->count; k++) t.first[c->a[k] + 2]++, t.first[c->b[k] + 2]++;
    for (size_t i = 2; i < n + 2; i++) t.first[i] += t.first[i - 1];
    for (size_t k = 0; k < c->count; k++) {
        t.entry[t.first[c->a[k] + 1]++] = (int32_t)k;
        t.entry[t.first[c->b[k] + 1]++] = ~(int32_t)k;
    }
    for (size_t i = 0; i < n; i++)
        for (size_t e = t.first[i] + 1; e < t.first[i + 1]; e++)
            for (size_t q = e; q > t.first[i]; q--) {
                int32_t p0 = t.entry[q - 1], p1 = t.entry[q];
                if (partner_id(c, id, p0) <= partner_id(c, id, p1)) break;
                t.entry[q - 1] = p1, t.entry[q] = p0;
            }
    return t;
}

/* The full list of a half one, with its histories: the spring is antisymmetric. */
static contacts list_full(const contacts *half, const int32_t *id, size_t n) {
    incidence t = incidence_new(half, id, n);
    contacts c = list_room(n, 2 * half->count);
    c.count = 2 * half->count;
    for (size_t i = 0; i < n; i++)
        for (size_t e = t.first[i]; e < t.first[i + 1]; e++) {
            bool turned = t.entry[e] < 0;
            size_t k = (size_t)(turned ? ~t.entry[e] : t.entry[e]);
            double sign = turned ? -1 : 1;
            c.a[e] = (int32_t)i, c.b[e] = turned ? half->a[k] : half->b[k];
            c.overlap[e] = half->overlap[k], c.normal[e] = half->normal[k];
            c.sx[e] = sign * half->sx[k], c.sy[e] = sign * half->sy[k],
            c.sz[e] = sign * half->sz[k];
        }
    memcpy(c.first, t.first, (n + 1) * sizeof *c.first);
    free(t.first), free(t.entry);
    return c;
}

#endif
