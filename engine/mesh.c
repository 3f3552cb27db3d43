/* mesh.c - triangles into walls: pieces that lie in one plane become one flat patch (a facet) with
 * one plane equation, and facets that meet at a small angle become one smooth patch. Which of the
 * facets that a sphere touches it feels is found out in facets.c. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/geometry.h"
#include "engine/numbers.h"
#include "engine/world.h"

/* Triangles whose corners are this close to a plane (of the farthest coordinate) lie in it: twice
 * what single precision, as STL has it, may be off by. No patch is farther from its triangles.
 * Rejected: a limit on the angle between neighbours. Slivers have no angle to speak of, and many
 * small angles add up to a cylinder. */
#define ONE_PLANE 0x1p-22

/* Belt velocities are along their surface to this. */
#define ALONG 1e-5

typedef struct edge {
    int32_t low, high; /* vertices */
    int triangle;
} edge;

typedef struct plane {
    vec3 normal; /* of all its triangles by their areas */
    vec3 point;  /* m, their centre */
    double area; /* m2 */
    int first;   /* lowest of them */
    int largest, triangles;
} plane;

typedef struct mesh {
    const clast_mesh_def *def;
    double thickness; /* m, of a plane */
    vec3 *area;       /* m2, per triangle */
    edge *edges;      /* sorted by vertices */
    int *edge_at;     /* per side of a triangle: the first of its edges */
    int *patch_of;    /* per triangle */
    int *scratch;     /* per triangle */
    plane *planes;    /* per patch */
    int patches;
} mesh;

/* ---- checks ---------------------------------------------------------------------------------- */

static const int32_t *corners(const clast_mesh_def *d, int triangle) {
    return d->triangle + 3 * (size_t)triangle;
}

static vec3 side(const clast_mesh_def *d, int triangle, int k) {
    const int32_t *c = corners(d, triangle);
    return v3_sub(d->vertex[c[(k + 1) % 3]], d->vertex[c[k]]);
}

static vec3 area_of(const clast_mesh_def *d, int triangle) {
    return v3_scale(0.5, v3_cross(side(d, triangle, 0), side(d, triangle, 1)));
}

static vec3 centre_of(const clast_mesh_def *d, int triangle) {
    const int32_t *c = corners(d, triangle);
    return v3_scale(1.0 / 3, v3_add(d->vertex[c[0]], v3_add(d->vertex[c[1]], d->vertex[c[2]])));
}

static vec3 longest_side(const clast_mesh_def *d, int triangle) {
    vec3 best = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
        vec3 s = side(d, triangle, k);
        if (v3_dot(s, s) > v3_dot(best, best)) best = s;
    }
    return best;
}

static const char *fault_of_triangle(const clast_mesh_def *d, int triangle) {
    const int32_t *c = corners(d, triangle);
    for (int k = 0; k < 3; k++) {
        if (c[k] < 0 || c[k] >= d->vertices) return "names a vertex that does not exist";
        vec3 p = d->vertex[c[k]];
        if (!isfinite(v3_dot(p, p))) return "has a vertex that is not finite";
    }
    vec3 longest = longest_side(d, triangle);
    if (!(v3_norm(area_of(d, triangle)) > 1e-14 * v3_dot(longest, longest))) return "has no area";
    return NULL;
}

static int check(clast_world *w, int part_index, const clast_mesh_def *d) {
    const char *name = d->name ? d->name : "?";
    if (part_index < 0 || part_index >= w->part_count)
        return world_fail(w, CLAST_ERR_ARGUMENT, "mesh %s belongs to no part", name);
    if (d->material < 0 || d->material >= w->material_count)
        return world_fail(w, CLAST_ERR_ARGUMENT, "mesh %s has no such material", name);
    if (d->triangles < 1)
        return world_fail(w, CLAST_ERR_ARGUMENT, "mesh %s has no triangles", name);
    if (!(d->smooth_angle < NUMBER_PI / 2))
        return world_fail(w, CLAST_ERR_ARGUMENT,
                          "mesh %s: smooth_angle is %g rad, expected less than a right angle", name,
                          d->smooth_angle);
    if (!isfinite(v3_norm(d->belt_velocity)))
        return world_fail(w, CLAST_ERR_ARGUMENT, "mesh %s has a belt velocity that is not finite",
                          name);
    for (int t = 0; t < d->triangles; t++) {
        const char *fault = fault_of_triangle(d, t);
        if (fault)
            return world_fail(w, CLAST_ERR_ARGUMENT, "mesh %s: triangle %d %s", name, t, fault);
    }
    return CLAST_OK;
}

static int check_belt(clast_world *w, const mesh *m) {
    vec3 belt = m->def->belt_velocity;
    for (int p = 0; p < m->patches; p++) {
        if (fabs(v3_dot(belt, m->planes[p].normal)) <= ALONG * v3_norm(belt)) continue;
        return world_fail(w, CLAST_ERR_ARGUMENT,
                          "mesh %s: triangle %d is not along the belt velocity",
                          m->def->name ? m->def->name : "?", m->planes[p].first);
    }
    return CLAST_OK;
}

/* ---- which triangles share an edge ----------------------------------------------------------- */

static int by_vertices(const void *left, const void *right) {
    const edge *a = left, *b = right;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    return (a->high > b->high) - (a->high < b->high);
}

static edge edge_of(const clast_mesh_def *d, int triangle, int k) {
    int32_t a = corners(d, triangle)[k], b = corners(d, triangle)[(k + 1) % 3];
    return (edge){a < b ? a : b, a < b ? b : a, triangle};
}

static void collect_edges(mesh *m) {
    int count = 3 * m->def->triangles;
    for (int i = 0; i < count; i++) m->edges[i] = edge_of(m->def, i / 3, i % 3);
    qsort(m->edges, (size_t)count, sizeof *m->edges, by_vertices);
    for (int i = 0; i < count; i++) {
        edge e = edge_of(m->def, i / 3, i % 3);
        int from = 0, to = count;
        while (from < to) {
            int middle = from + (to - from) / 2;
            if (by_vertices(&m->edges[middle], &e) < 0)
                from = middle + 1;
            else
                to = middle;
        }
        m->edge_at[i] = from;
    }
}

/* ---- which of them lie in one plane ---------------------------------------------------------- */

static bool is_in_plane(const mesh *m, int triangle, vec3 point, vec3 normal) {
    const int32_t *c = corners(m->def, triangle);
    for (int k = 0; k < 3; k++) {
        double height = v3_dot(v3_sub(m->def->vertex[c[k]], point), normal);
        if (fabs(height) > m->thickness) return false;
    }
    return true;
}

static void take(mesh *m, int triangle, int patch_index, int *count) {
    m->patch_of[triangle] = patch_index;
    m->scratch[(*count)++] = triangle;
}

/* Takes every triangle that can be reached from `seed` without leaving the plane; returns how many
 * there are, by then in the scratch. */
static int reach_from(mesh *m, int seed, int patch_index, vec3 point, vec3 normal) {
    const edge *end = m->edges + 3 * (size_t)m->def->triangles;
    int count = 0;
    take(m, seed, patch_index, &count);
    for (int next = 0; next < count; next++)
        for (int k = 0; k < 3; k++) {
            const edge *own = &m->edges[m->edge_at[3 * m->scratch[next] + k]];
            for (const edge *e = own; e < end && by_vertices(e, own) == 0; e++)
                if (m->patch_of[e->triangle] < 0 && is_in_plane(m, e->triangle, point, normal))
                    take(m, e->triangle, patch_index, &count);
        }
    return count;
}

/* The plane of one small triangle is uncertain far away: that of all that were found in it is less
 * so, and may find more. */
static void grow_patch(mesh *m, int seed, int patch_index) {
    vec3 normal = v3_scale(1 / v3_norm(m->area[seed]), m->area[seed]);
    vec3 point = centre_of(m->def, seed);
    int before = 1, count = reach_from(m, seed, patch_index, point, normal);
    for (int round = 0; round < 8 && count > before; round++) {
        vec3 area = {0, 0, 0}, moment = {0, 0, 0};
        double all = 0;
        before = count;
        for (int i = 0; i < count; i++) {
            int t = m->scratch[i];
            double own = v3_norm(m->area[t]);
            area = v3_add(area, v3_scale(v3_dot(m->area[t], normal) < 0 ? -1 : 1, m->area[t]));
            moment = v3_add(moment, v3_scale(own, v3_sub(centre_of(m->def, t), point)));
            all += own;
            m->patch_of[t] = -1;
        }
        point = v3_add(point, v3_scale(1 / all, moment));
        normal = v3_scale(1 / v3_norm(area), area);
        count = reach_from(m, seed, patch_index, point, normal);
    }
}

typedef struct sized {
    double area;
    int triangle;
} sized;

static int by_area(const void *left, const void *right) {
    const sized *a = left, *b = right;
    if (a->area != b->area) return a->area > b->area ? -1 : 1;
    return (a->triangle > b->triangle) - (a->triangle < b->triangle);
}

/* Large triangles first: their planes are the best known. */
static void group_triangles(mesh *m) {
    size_t n = (size_t)m->def->triangles;
    sized *order = malloc(n * sizeof *order);
    CLAST_ASSERT(order);
    for (size_t t = 0; t < n; t++) {
        order[t] = (sized){v3_norm(m->area[t]), (int)t};
        m->patch_of[t] = -1;
    }
    qsort(order, n, sizeof *order, by_area);
    for (size_t i = 0; i < n; i++)
        if (m->patch_of[order[i].triangle] < 0) grow_patch(m, order[i].triangle, m->patches++);
    free(order);
}

/* Patches are counted in the order of their first triangles. */
static void number_patches(mesh *m) {
    int *number = m->scratch, next = 0;
    for (int p = 0; p < m->patches; p++) number[p] = -1;
    for (int t = 0; t < m->def->triangles; t++) {
        int *of_patch = &number[m->patch_of[t]];
        if (*of_patch < 0) {
            m->planes[next].first = m->planes[next].largest = t;
            *of_patch = next++;
        }
        m->patch_of[t] = *of_patch;
        plane *p = &m->planes[*of_patch];
        if (v3_norm(m->area[t]) > v3_norm(m->area[p->largest])) p->largest = t;
    }
}

/* By the areas of the triangles, whichever way round they are. */
static void fit_planes(mesh *m) {
    for (int t = 0; t < m->def->triangles; t++) {
        plane *p = &m->planes[m->patch_of[t]];
        double turned = v3_dot(m->area[t], m->area[p->largest]) < 0 ? -1 : 1;
        p->normal = v3_add(p->normal, v3_scale(turned, m->area[t]));
        p->triangles++;
    }
    for (int p = 0; p < m->patches; p++)
        m->planes[p].normal = v3_scale(1 / v3_norm(m->planes[p].normal), m->planes[p].normal);
    for (int t = 0; t < m->def->triangles; t++) {
        plane *p = &m->planes[m->patch_of[t]];
        vec3 from_first = v3_sub(centre_of(m->def, t), centre_of(m->def, p->first));
        p->area += v3_norm(m->area[t]);
        p->point = v3_add(p->point, v3_scale(v3_norm(m->area[t]), from_first));
    }
    for (int p = 0; p < m->patches; p++) {
        plane *l = &m->planes[p];
        l->point = v3_add(centre_of(m->def, l->first), v3_scale(1 / l->area, l->point));
    }
}

/* ---- triangles of a patch into a tree of boxes (geometry.h) ---------------------------------- */

enum { TRIANGLE = 6, BOX = 4 }; /* numbers of each */

static double middle_of(const double *triangle, int axis) {
    return triangle[axis] + triangle[2 + axis] + triangle[4 + axis];
}

static int by_middle(const double *a, const double *b, int axis) {
    double x = middle_of(a, axis), y = middle_of(b, axis);
    if (x != y) return x < y ? -1 : 1;
    for (int k = 0; k < TRIANGLE; k++)
        if (a[k] != b[k]) return a[k] < b[k] ? -1 : 1;
    return 0;
}

static int by_middle_along(const void *a, const void *b) {
    return by_middle(a, b, 0);
}

static int by_middle_across(const void *a, const void *b) {
    return by_middle(a, b, 1);
}

static void box_around(double *box, const double *triangle, size_t count) {
    box[0] = box[1] = INFINITY, box[2] = box[3] = -INFINITY;
    for (size_t k = 0; k < 3 * count; k++)
        for (int axis = 0; axis < 2; axis++) {
            double x = triangle[2 * k + (size_t)axis];
            box[axis] = fmin(box[axis], x), box[2 + axis] = fmax(box[2 + axis], x);
        }
}

/* Sorts the triangles under `node`, which has so many leaves from `leaf` on. */
static void make_tree(patch *p, int node, int leaf, int leaves) {
    int all = patch_leaves(p->triangles);
    size_t from = patch_first(p, leaf, all), to = patch_first(p, leaf + leaves, all);
    double *box = p->corner + TRIANGLE * (size_t)p->triangles + BOX * (size_t)node;
    box_around(box, p->corner + TRIANGLE * from, to - from);
    if (leaves == 1) return;
    bool wide = box[2] - box[0] > box[3] - box[1];
    qsort(p->corner + TRIANGLE * from, to - from, TRIANGLE * sizeof(double),
          wide ? by_middle_along : by_middle_across);
    make_tree(p, 2 * node + 1, leaf, leaves / 2);
    make_tree(p, 2 * node + 2, leaf + leaves / 2, leaves / 2);
}

/* ---- patches into walls ---------------------------------------------------------------------- */

/* How a patch lies along one of its rims. */
typedef struct layout {
    vec3 u, v;
    double low[2], high[2]; /* m, along u and v, from the wall's point */
} layout;

/* > 0 where a triangle lies to the left of one of its edges, seen against n. */
static double beyond(const mesh *m, int triangle, const edge *e, vec3 n) {
    const int32_t *c = corners(m->def, triangle);
    vec3 low = m->def->vertex[e->low], along = v3_sub(m->def->vertex[e->high], low);
    double most = 0;
    for (int k = 0; k < 3; k++) {
        double x = v3_dot(v3_cross(along, v3_sub(m->def->vertex[c[k]], low)), n);
        if (fabs(x) > fabs(most)) most = x;
    }
    return most;
}

typedef enum seam { RIM, SEAM, FOLD } seam;

/* What lies on the other side of the k-th side of a triangle: nothing of its patch, one triangle,
 * or more than can lie in a plane side by side. */
static seam seam_of(const mesh *m, int triangle, int k, vec3 n) {
    const edge *own = &m->edges[m->edge_at[3 * triangle + k]];
    const edge *end = m->edges + 3 * (size_t)m->def->triangles;
    int others = 0;
    bool fold = false;
    for (const edge *e = own; e < end && by_vertices(e, own) == 0; e++) {
        if (e->triangle == triangle || m->patch_of[e->triangle] != m->patch_of[triangle]) continue;
        fold |= beyond(m, triangle, own, n) * beyond(m, e->triangle, own, n) >= 0;
        others++;
    }
    return others == 0 ? RIM : others == 1 && !fold ? SEAM : FOLD;
}

/* The longest rim of a patch that lies flat; nothing where triangles lie on each other. */
static vec3 longest_rim(const mesh *m, const plane *p, const int *next) {
    vec3 best = {0, 0, 0};
    for (int t = p->first; t >= 0; t = next[t])
        for (int k = 0; k < 3; k++) {
            seam kind = seam_of(m, t, k, p->normal);
            if (kind == FOLD) return v3(0, 0, 0);
            vec3 s = side(m->def, t, k);
            if (kind == RIM && v3_dot(s, s) > v3_dot(best, best)) best = s;
        }
    return best;
}

static layout layout_along(const mesh *m, const plane *p, const int *next, vec3 along) {
    layout f = {.low = {INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY}};
    along = v3_sub(along, v3_scale(v3_dot(along, p->normal), p->normal));
    f.u = v3_scale(1 / v3_norm(along), along);
    f.v = v3_cross(p->normal, f.u);
    for (int t = p->first; t >= 0; t = next[t])
        for (int k = 0; k < 3; k++) {
            vec3 d = v3_sub(m->def->vertex[corners(m->def, t)[k]], p->point);
            double at[2] = {v3_dot(d, f.u), v3_dot(d, f.v)};
            for (int i = 0; i < 2; i++)
                f.low[i] = fmin(f.low[i], at[i]), f.high[i] = fmax(f.high[i], at[i]);
        }
    return f;
}

/* Sides and point of the wall: those of the rectangle around the patch, which fills it or not. */
static void set_frame(wall *l, const mesh *m, const plane *p, const int *next) {
    vec3 rim = longest_rim(m, p, next);
    bool flat = v3_dot(rim, rim) > 0;
    layout f = layout_along(m, p, next, flat ? rim : longest_side(m->def, p->largest));
    double box = (f.high[0] - f.low[0]) * (f.high[1] - f.low[1]);
    l->is_rectangle = flat && fabs(box - p->area) <= 1e-6 * box;
    l->u = f.u, l->v = f.v;
    vec3 middle = v3_add(v3_scale(0.5 * (f.low[0] + f.high[0]), f.u),
                         v3_scale(0.5 * (f.low[1] + f.high[1]), f.v));
    l->point = l->def.point = v3_add(l->def.point, middle);
    for (int k = 0; k < 2; k++) l->def.half_side[k] = 0.5 * (f.high[k] - f.low[k]);
    l->def.normal = l->n;
    l->def.side = l->u;
}

/* m, how far a place (s, t) is outside of the box of a wall; below zero inside. */
static double outside_box(const wall *l, double s, double t) {
    return fmax(fabs(s) - l->def.half_side[0], fabs(t) - l->def.half_side[1]);
}

/* The least of that along a rim: it bends where one of these is zero. */
static double least_outside(const wall *l, const double *a, const double *b) {
    double hs = l->def.half_side[0], ht = l->def.half_side[1];
    double at_a[6] = {a[0],
                      a[1],
                      a[0] - a[1] - hs + ht,
                      a[0] + a[1] - hs + ht,
                      a[0] - a[1] + hs - ht,
                      a[0] + a[1] + hs - ht};
    double at_b[6] = {b[0],
                      b[1],
                      b[0] - b[1] - hs + ht,
                      b[0] + b[1] - hs + ht,
                      b[0] - b[1] + hs - ht,
                      b[0] + b[1] + hs - ht};
    double least = fmin(outside_box(l, a[0], a[1]), outside_box(l, b[0], b[1]));
    for (int k = 0; k < 6; k++) {
        double x = at_a[k] / (at_a[k] - at_b[k]);
        if (!(x > 0 && x < 1)) continue;
        least = fmin(least, outside_box(l, a[0] + x * (b[0] - a[0]), a[1] + x * (b[1] - a[1])));
    }
    return least;
}

/* How far from the sides of its box a patch that is no rectangle has its border: no rim reaches
 * farther in. */
static void set_rim(wall *l, const mesh *m, const plane *p, const int *next) {
    l->rim = l->is_rectangle ? 0 : WALL_ENDLESS;
    flat_way middle = way_from_patch(&l->patch, 0, 0);
    if (l->is_rectangle || middle.s != 0 || middle.t != 0) return;
    double rim = 0;
    for (int t = p->first; t >= 0; t = next[t])
        for (int k = 0; k < 3; k++) {
            seam kind = seam_of(m, t, k, p->normal);
            if (kind == FOLD) return;
            if (kind == SEAM) continue;
            const int32_t *c = corners(m->def, t);
            vec3 from = v3_sub(m->def->vertex[c[k]], l->def.point),
                 to = v3_sub(m->def->vertex[c[(k + 1) % 3]], l->def.point);
            double a[2] = {v3_dot(from, l->u), v3_dot(from, l->v)};
            double b[2] = {v3_dot(to, l->u), v3_dot(to, l->v)};
            rim = fmax(rim, -least_outside(l, a, b));
        }
    l->rim = rim + 1e-9 * l->bound;
}

static void add_corner(wall *l, double *to, vec3 p) {
    vec3 d = v3_sub(p, l->def.point);
    to[0] = v3_dot(d, l->u), to[1] = v3_dot(d, l->v);
    l->bound = fmax(l->bound, v3_norm(d));
    l->half_box = v3(fmax(l->half_box.x, fabs(d.x)), fmax(l->half_box.y, fabs(d.y)),
                     fmax(l->half_box.z, fabs(d.z)));
}

static void add_triangle(wall *l, const mesh *m, int triangle) {
    const int32_t *c = corners(m->def, triangle);
    double *to = l->patch.corner + TRIANGLE * (size_t)l->patch.triangles++;
    for (int k = 0; k < 3; k++) add_corner(l, to + 2 * (size_t)k, m->def->vertex[c[k]]);
    if (left_of(to, to + 2, to[4], to[5])) return; /* corners go counter-clockwise */
    double s = to[0], t = to[1];
    to[0] = to[4], to[1] = to[5], to[4] = s, to[5] = t;
}

static void add_patch(clast_world *w, int part_index, const mesh *m, int index, const int *next) {
    char name[256];
    const plane *p = &m->planes[index];
    snprintf(name, sizeof name, "%s/%d", m->def->name ? m->def->name : "?", index);
    clast_wall_def def = {.name = name,
                          .kind = CLAST_WALL_PATCH,
                          .material = m->def->material,
                          .point = p->point,
                          .normal = p->normal,
                          .belt_velocity = m->def->belt_velocity};
    wall *l = wall_new(w, part_index, &def);
    set_frame(l, m, p, next);
    size_t boxes = 2 * (size_t)patch_leaves(p->triangles) - 1;
    size_t numbers = TRIANGLE * (size_t)p->triangles + BOX * boxes;
    l->patch.corner = memory_grow(w, NULL, 0, numbers, sizeof *l->patch.corner);
    for (int t = p->first; t >= 0; t = next[t]) add_triangle(l, m, t);
    make_tree(&l->patch, 0, 0, patch_leaves(p->triangles));
    set_rim(l, m, p, next);
}

/* Triangles of each patch as chains in rising order. */
static void add_patches(clast_world *w, int part_index, const mesh *m) {
    int *next = m->scratch;
    int *head = malloc((size_t)m->patches * sizeof *head);
    CLAST_ASSERT(head);
    for (int p = 0; p < m->patches; p++) head[p] = -1;
    for (int t = m->def->triangles - 1; t >= 0; t--)
        next[t] = head[m->patch_of[t]], head[m->patch_of[t]] = t;
    for (int p = 0; p < m->patches; p++) add_patch(w, part_index, m, p, next);
    free(head);
}

/* ---- which patches go on smoothly in each other -----------------------------------------------
 */

/* Into a triangle from one of its edges, in the plane of its patch, unit. */
static vec3 inwards(const mesh *m, const edge *e) {
    vec3 n = m->planes[m->patch_of[e->triangle]].normal;
    vec3 along = v3_sub(m->def->vertex[e->high], m->def->vertex[e->low]);
    vec3 in = v3_scale(beyond(m, e->triangle, e, n) < 0 ? -1 : 1, v3_cross(n, along));
    return v3_scale(1 / v3_norm(in), in);
}

static int root_of(int *parent, int of) {
    while (parent[of] != of) of = parent[of] = parent[parent[of]];
    return of;
}

/* The lower number becomes the root: it does not hang on the order of the edges. */
static void unite(int *parent, int a, int b) {
    int x = root_of(parent, a), y = root_of(parent, b);
    if (x < y) parent[y] = x;
    if (y < x) parent[x] = y;
}

/* A seam turns by less than the angle: the ways into its two triangles are nearly opposite. */
static void unite_over_edges(const mesh *m, int *parent, double cosine) {
    const edge *end = m->edges + 3 * (size_t)m->def->triangles;
    for (const edge *e = m->edges; e < end; e++)
        for (const edge *f = e + 1; f < end && by_vertices(e, f) == 0; f++) {
            int a = m->patch_of[e->triangle], b = m->patch_of[f->triangle];
            if (a != b && -v3_dot(inwards(m, e), inwards(m, f)) > cosine) unite(parent, a, b);
        }
}

/* Patches that one can go to and fro between over smooth seams have one number, that of the first
 * of their walls. */
static void join_patches(clast_world *w, const mesh *m, int first_wall) {
    double angle = m->def->smooth_angle == 0 ? CLAST_SMOOTH_ANGLE : m->def->smooth_angle, sine,
           cosine;
    clast_sincos(angle > 0 ? angle : 0, &sine, &cosine);
    int *parent = malloc((size_t)m->patches * sizeof *parent);
    CLAST_ASSERT(parent);
    for (int p = 0; p < m->patches; p++) parent[p] = p;
    if (angle > 0) unite_over_edges(m, parent, cosine);
    for (int p = 0; p < m->patches; p++) {
        wall *l = &w->walls[first_wall + p];
        int root = root_of(parent, p);
        l->family = first_wall;
        l->smooth_cosine = cosine;
        if (root == p) continue;
        l->smooth = w->walls[first_wall + root].smooth = first_wall + root;
    }
    free(parent);
}

/* ---- where facets end ------------------------------------------------------------------------ */

/* The facet on the other side of an edge, seen from triangle `own`: its own one where it goes on
 * there, -1 where none does or more than one. */
static int facet_beyond(const mesh *m, const edge *from, const edge *to, const edge *own) {
    int facet = m->patch_of[own->triangle];
    if (to - from != 2) return -1;
    const edge *e = own == from ? from + 1 : from;
    int other = m->patch_of[e->triangle];
    vec3 n = m->planes[facet].normal;
    bool fold = beyond(m, own->triangle, own, n) * beyond(m, e->triangle, own, n) >= 0;
    return other == facet && fold ? -1 : other;
}

static void round_seams(clast_world *w, const mesh *m, int first_wall) {
    const edge *end = m->edges + 3 * (size_t)m->def->triangles;
    border *borders = malloc(3 * (size_t)m->def->triangles * sizeof *borders);
    CLAST_ASSERT(borders);
    int count = 0;
    for (const edge *from = m->edges, *to; from < end; from = to) {
        for (to = from + 1; to < end && by_vertices(to, from) == 0;) to++;
        for (const edge *e = from; e < to; e++) {
            int facet = m->patch_of[e->triangle], other = facet_beyond(m, from, to, e);
            if (other == facet) continue;
            borders[count++] = (border){facet, other, e->low, e->high, inwards(m, e)};
        }
    }
    fillets_make(w, first_wall, m->def, borders, count);
    free(borders);
}

/* ---- the whole ------------------------------------------------------------------------------- */

static double farthest(const clast_mesh_def *d) {
    double most = 0;
    for (int c = 0; c < 3 * d->triangles; c++) {
        vec3 p = d->vertex[d->triangle[c]];
        most = fmax(most, fmax(fabs(p.x), fmax(fabs(p.y), fabs(p.z))));
    }
    return most;
}

static void mesh_make(mesh *m, const clast_mesh_def *d) {
    size_t n = (size_t)d->triangles;
    *m = (mesh){.def = d, .thickness = ONE_PLANE * farthest(d)};
    m->area = malloc(n * sizeof *m->area);
    m->edges = malloc(3 * n * sizeof *m->edges);
    m->edge_at = malloc(3 * n * sizeof *m->edge_at);
    m->patch_of = malloc(n * sizeof *m->patch_of);
    m->scratch = malloc(n * sizeof *m->scratch);
    m->planes = calloc(n, sizeof *m->planes);
    CLAST_ASSERT(m->area && m->edges && m->edge_at && m->patch_of && m->scratch && m->planes);
    for (int t = 0; t < d->triangles; t++) m->area[t] = area_of(d, t);
    collect_edges(m);
    group_triangles(m);
    number_patches(m);
    fit_planes(m);
}

static void mesh_free(mesh *m) {
    free(m->area), free(m->edges), free(m->edge_at);
    free(m->patch_of), free(m->scratch), free(m->planes);
}

int clast_mesh_add(clast_world *w, int part_index, const clast_mesh_def *def) {
    CLAST_ASSERT(w && def && def->vertex && def->triangle && !w->prepared);
    if (check(w, part_index, def)) return -1;
    mesh m;
    mesh_make(&m, def);
    int first_wall = w->wall_count, patches = check_belt(w, &m) ? -1 : m.patches;
    if (patches > 0) {
        add_patches(w, part_index, &m);
        mesh_extend(w, first_wall, def);
        join_patches(w, &m, first_wall);
        round_seams(w, &m, first_wall);
    }
    mesh_free(&m);
    return patches;
}
