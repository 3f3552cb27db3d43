/* mesh.c - triangles into walls: pieces that lie in one plane become one patch with one plane
 * equation, and patches that share a vertex know each other, so that an edge is felt only where no
 * face is. */
#include <stdio.h>
#include <stdlib.h>

#include "engine/world.h"

/* Two triangles that meet at less than this angle (rad) lie in one plane. Corners in single
 * precision, as STL has them, are off by less. */
#define ONE_PLANE 1e-5

typedef struct edge {
    int32_t low, high; /* vertices */
    int triangle;
} edge;

typedef struct mesh {
    const clast_mesh_def *def;
    vec3 *normal; /* per triangle, unit */
    int *group;   /* per triangle: another triangle of its patch, or itself */
    edge *edges;
    int *patch_of; /* per triangle: its patch */
    int patches;
} mesh;

/* ---- checks ---------------------------------------------------------------------------------- */

static const int32_t *corners(const clast_mesh_def *d, int triangle) {
    return d->triangle + 3 * (size_t)triangle;
}

static vec3 area_of(const clast_mesh_def *d, int triangle) {
    const int32_t *c = corners(d, triangle);
    vec3 a = d->vertex[c[0]];
    return v3_scale(0.5, v3_cross(v3_sub(d->vertex[c[1]], a), v3_sub(d->vertex[c[2]], a)));
}

static const char *fault_of_triangle(const clast_mesh_def *d, int triangle) {
    const int32_t *c = corners(d, triangle);
    for (int k = 0; k < 3; k++) {
        if (c[k] < 0 || c[k] >= d->vertices) return "names a vertex that does not exist";
        vec3 p = d->vertex[c[k]];
        if (!isfinite(p.x + p.y + p.z)) return "has a vertex that is not finite";
    }
    if (!(v3_norm(area_of(d, triangle)) > 0)) return "has no area";
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
    for (int t = 0; t < d->triangles; t++) {
        const char *fault = fault_of_triangle(d, t);
        if (fault)
            return world_fail(w, CLAST_ERR_ARGUMENT, "mesh %s: triangle %d %s", name, t, fault);
    }
    return CLAST_OK;
}

/* ---- which triangles lie in one plane -------------------------------------------------------- */

static int by_vertices(const void *left, const void *right) {
    const edge *a = left, *b = right;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    return (a->high > b->high) - (a->high < b->high);
}

static void collect_edges(mesh *m) {
    for (int t = 0; t < m->def->triangles; t++)
        for (int k = 0; k < 3; k++) {
            int32_t a = corners(m->def, t)[k], b = corners(m->def, t)[(k + 1) % 3];
            m->edges[3 * t + k] = (edge){a < b ? a : b, a < b ? b : a, t};
        }
    qsort(m->edges, 3 * (size_t)m->def->triangles, sizeof *m->edges, by_vertices);
}

static int root_of(const mesh *m, int triangle) {
    while (m->group[triangle] != triangle) triangle = m->group[triangle];
    return triangle;
}

static bool in_one_plane(const mesh *m, int a, int b) {
    return v3_norm(v3_cross(m->normal[a], m->normal[b])) < ONE_PLANE;
}

static void group_triangles(mesh *m) {
    int count = 3 * m->def->triangles;
    for (int t = 0; t < m->def->triangles; t++) m->group[t] = t;
    for (int e = 0; e + 1 < count; e++)
        for (int f = e + 1; f < count && by_vertices(&m->edges[e], &m->edges[f]) == 0; f++) {
            int a = root_of(m, m->edges[e].triangle), b = root_of(m, m->edges[f].triangle);
            if (in_one_plane(m, a, b)) m->group[a > b ? a : b] = a > b ? b : a;
        }
    m->patches = 0;
    for (int t = 0; t < m->def->triangles; t++) {
        int root = root_of(m, t);
        m->patch_of[t] = root == t ? m->patches++ : m->patch_of[root];
    }
}

/* ---- patches into walls ---------------------------------------------------------------------- */

/* How a patch lies along one of the edges of its first triangle. */
typedef struct layout {
    vec3 u, v;
    double low[2], high[2]; /* m, along u and v, from the first corner */
    double area;            /* m2, of the triangles */
} layout;

static vec3 edge_of(const clast_mesh_def *d, int triangle, int k) {
    const int32_t *c = corners(d, triangle);
    return v3_sub(d->vertex[c[(k + 1) % 3]], d->vertex[c[k]]);
}

static void stretch(layout *f, vec3 d) {
    double at[2] = {v3_dot(d, f->u), v3_dot(d, f->v)};
    for (int k = 0; k < 2; k++) {
        f->low[k] = fmin(f->low[k], at[k]);
        f->high[k] = fmax(f->high[k], at[k]);
    }
}

static layout layout_along(const mesh *m, int first, const int *next, vec3 along) {
    layout f = {.u = v3_scale(1 / v3_norm(along), along)};
    f.v = v3_cross(m->normal[first], f.u);
    vec3 origin = m->def->vertex[corners(m->def, first)[0]];
    for (int t = first; t >= 0; t = next[t]) {
        f.area += v3_norm(area_of(m->def, t));
        for (int k = 0; k < 3; k++)
            stretch(&f, v3_sub(m->def->vertex[corners(m->def, t)[k]], origin));
    }
    return f;
}

static bool fills_its_box(const layout *f) {
    double box = (f->high[0] - f->low[0]) * (f->high[1] - f->low[1]);
    return fabs(box - f->area) <= 1e-6 * box;
}

/* Sides and point of the wall: those of the rectangle that the patch fills, if it does. */
static void set_frame(wall *l, const mesh *m, int first, const int *next) {
    layout f = {.area = 0};
    for (int k = 0; k < 3 && !l->is_rectangle; k++) {
        f = layout_along(m, first, next, edge_of(m->def, first, k));
        l->is_rectangle = fills_its_box(&f);
    }
    l->u = f.u, l->v = f.v;
    if (l->is_rectangle) {
        vec3 middle = v3_add(v3_scale(0.5 * (f.low[0] + f.high[0]), f.u),
                             v3_scale(0.5 * (f.low[1] + f.high[1]), f.v));
        l->point = l->def.point = v3_add(l->def.point, middle);
        for (int k = 0; k < 2; k++) l->def.half_side[k] = 0.5 * (f.high[k] - f.low[k]);
    }
    l->def.normal = l->n;
    l->def.side = l->u;
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
    bool turned = v3_dot(m->normal[triangle], l->n) < 0; /* corners go counter-clockwise */
    double *to = l->patch.corner + 6 * (size_t)l->patch.triangles++;
    for (int k = 0; k < 3; k++)
        add_corner(l, to + 2 * (size_t)(turned ? 2 - k : k), m->def->vertex[c[k]]);
}

static void add_patch(clast_world *w, int part_index, const mesh *m, int first, const int *next) {
    char name[256];
    int index = m->patch_of[first];
    snprintf(name, sizeof name, "%s/%d", m->def->name ? m->def->name : "?", index);
    clast_wall_def def = {.name = name,
                          .kind = CLAST_WALL_PATCH,
                          .material = m->def->material,
                          .point = m->def->vertex[corners(m->def, first)[0]],
                          .normal = m->normal[first],
                          .belt_velocity = m->def->belt_velocity};
    wall *l = wall_new(w, part_index, &def);
    set_frame(l, m, first, next);
    size_t size = 0;
    for (int t = first; t >= 0; t = next[t]) size++;
    l->patch.corner = memory_grow(w, NULL, 0, 6 * size, sizeof *l->patch.corner);
    for (int t = first; t >= 0; t = next[t]) add_triangle(l, m, t);
}

/* Triangles of each patch as chains in rising order. */
static void add_patches(clast_world *w, int part_index, const mesh *m) {
    int *next = malloc((size_t)m->def->triangles * sizeof *next);
    int *head = malloc((size_t)m->patches * sizeof *head);
    CLAST_ASSERT(next && head);
    for (int p = 0; p < m->patches; p++) head[p] = -1;
    for (int t = m->def->triangles - 1; t >= 0; t--)
        next[t] = head[m->patch_of[t]], head[m->patch_of[t]] = t;
    for (int p = 0; p < m->patches; p++) add_patch(w, part_index, m, head[p], next);
    free(next), free(head);
}

/* Patches that share a vertex. */
static void join_patches(clast_world *w, const mesh *m, int first_wall) {
    int *last = malloc((size_t)m->def->vertices * sizeof *last); /* chains through corners */
    int *before = malloc(3 * (size_t)m->def->triangles * sizeof *before);
    CLAST_ASSERT(last && before);
    for (int v = 0; v < m->def->vertices; v++) last[v] = -1;
    for (int c = 0; c < 3 * m->def->triangles; c++) {
        int vertex = m->def->triangle[c], own = m->patch_of[c / 3];
        for (int other = last[vertex]; other >= 0; other = before[other]) {
            int theirs = m->patch_of[other / 3];
            if (theirs == own) continue;
            wall_join(w, first_wall + own, first_wall + theirs);
            wall_join(w, first_wall + theirs, first_wall + own);
        }
        before[c] = last[vertex];
        last[vertex] = c;
    }
    free(last), free(before);
}

int clast_mesh_add(clast_world *w, int part_index, const clast_mesh_def *def) {
    CLAST_ASSERT(w && def && def->vertex && def->triangle && !w->prepared);
    if (check(w, part_index, def)) return -1;
    size_t n = (size_t)def->triangles;
    mesh m = {.def = def,
              .normal = malloc(n * sizeof(vec3)),
              .group = malloc(n * sizeof(int)),
              .edges = malloc(3 * n * sizeof(edge)),
              .patch_of = malloc(n * sizeof(int))};
    CLAST_ASSERT(m.normal && m.group && m.edges && m.patch_of);
    for (int t = 0; t < def->triangles; t++) {
        vec3 area = area_of(def, t);
        m.normal[t] = v3_scale(1 / v3_norm(area), area);
    }
    collect_edges(&m);
    group_triangles(&m);
    int first_wall = w->wall_count;
    add_patches(w, part_index, &m);
    join_patches(w, &m, first_wall);
    free(m.normal), free(m.group), free(m.edges), free(m.patch_of);
    return m.patches;
}
