#include "shapes/mesh.h"

#include <stdlib.h>
#include <string.h>

#include "shapes/check.h"
#include "shapes/numbers.h"

shape_mesh shape_mesh_new(size_t vertices, size_t triangles) {
    shape_mesh mesh = {vertices, calloc(vertices + 1, sizeof *mesh.vertex), triangles,
                       calloc(triangles + 1, 3 * sizeof *mesh.triangle)};
    SHAPE_ASSERT(mesh.vertex && mesh.triangle);
    return mesh;
}

shape_mesh shape_mesh_copy(const double *vertex, size_t vertices, const int32_t *triangle,
                           size_t triangles) {
    SHAPE_ASSERT(vertex && triangle);
    shape_mesh mesh = shape_mesh_new(vertices, triangles);
    for (size_t i = 0; i < vertices; i++)
        mesh.vertex[i] = sv(vertex[3 * i], vertex[3 * i + 1], vertex[3 * i + 2]);
    for (size_t i = 0; i < 3 * triangles; i++) {
        SHAPE_ASSERT(triangle[i] >= 0 && (size_t)triangle[i] < vertices);
        mesh.triangle[i] = triangle[i];
    }
    return mesh;
}

void shape_mesh_free(shape_mesh *mesh) {
    free(mesh->vertex), free(mesh->triangle);
    *mesh = (shape_mesh){0};
}

void shape_mesh_turn(shape_mesh *mesh) {
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        int32_t *t = mesh->triangle + 3 * i, swap = t[1];
        t[1] = t[2], t[2] = swap;
    }
}

void shape_mesh_corners(const shape_mesh *mesh, size_t triangle, shape_vec corner[3]) {
    for (int k = 0; k < 3; k++) corner[k] = mesh->vertex[mesh->triangle[3 * triangle + (size_t)k]];
}

/* ---- mass --------------------------------------------------------------------------------------
 */

/* Tetrahedra from a corner of the mesh to every triangle; with the determinant D of its edges, one
 * has volume D / 6 and int x x = D / 120 ((a + b + c)(a + b + c) + a a + b b + c c). */
static shape_moments moments_of(const shape_mesh *mesh, double *absolute) {
    shape_moments m = {.about = mesh->vertex[0]};
    *absolute = 0;
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        shape_vec v[3];
        shape_mesh_corners(mesh, i, v);
        for (int k = 0; k < 3; k++) v[k] = sv_sub(v[k], m.about);
        double d = sv_dot(v[0], sv_cross(v[1], v[2]));
        shape_vec sum = sv_add(v[0], sv_add(v[1], v[2]));
        m.volume += d / 6;
        *absolute += fabs(d) / 6;
        m.first = sv_along(m.first, d / 24, sum);
        shape_second_add(m.second, d / 120, sum, sum);
        for (int k = 0; k < 3; k++) shape_second_add(m.second, d / 120, v[k], v[k]);
    }
    return m;
}

double shape_mesh_volume(const shape_mesh *mesh) {
    SHAPE_ASSERT(mesh && mesh->vertex_count > 0);
    double absolute;
    return moments_of(mesh, &absolute).volume;
}

shape_mass shape_mesh_mass(const shape_mesh *mesh) {
    SHAPE_ASSERT(mesh && mesh->vertex_count > 0);
    double absolute, reach = 0;
    shape_moments m = moments_of(mesh, &absolute);
    for (size_t i = 0; i < mesh->vertex_count; i++)
        reach = fmax(reach, sv_distance(mesh->vertex[i], m.about));
    return shape_mass_of(&m, 64 * 0x1p-52 * absolute, reach);
}

/* ---- triangles
 * ----------------------------------------------------------------------------------- */

static shape_vec on_edge(shape_vec a, shape_vec b, shape_vec p) {
    shape_vec edge = sv_sub(b, a);
    double square = sv_dot(edge, edge);
    double t = square > 0 ? sv_dot(sv_sub(p, a), edge) / square : 0;
    return sv_along(a, t < 0 ? 0 : t > 1 ? 1 : t, edge);
}

shape_vec shape_triangle_nearest(const shape_vec c[3], shape_vec p) {
    shape_vec normal = sv_cross(sv_sub(c[1], c[0]), sv_sub(c[2], c[0]));
    double square = sv_dot(normal, normal);
    bool within = square > 0;
    for (int k = 0; k < 3 && within; k++) {
        shape_vec edge = sv_sub(c[(k + 1) % 3], c[k]);
        within = sv_dot(sv_cross(edge, sv_sub(p, c[k])), normal) >= 0;
    }
    if (within) return sv_along(p, -sv_dot(sv_sub(p, c[0]), normal) / square, normal);
    shape_vec best = c[0];
    double closest = HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        shape_vec q = on_edge(c[k], c[(k + 1) % 3], p), d = sv_sub(q, p);
        if (sv_dot(d, d) < closest) closest = sv_dot(d, d), best = q;
    }
    return best;
}

/* Solid angle of a triangle seen from p (van Oosterom and Strackee, 1983). */
static double solid_angle(const shape_vec corner[3], shape_vec p) {
    shape_vec v[3];
    double l[3];
    for (int k = 0; k < 3; k++) v[k] = sv_sub(corner[k], p), l[k] = sv_norm(v[k]);
    double volume = sv_dot(v[0], sv_cross(v[1], v[2]));
    double below = l[0] * l[1] * l[2] + sv_dot(v[0], v[1]) * l[2] + sv_dot(v[1], v[2]) * l[0] +
                   sv_dot(v[2], v[0]) * l[1];
    return 2 * shape_atan2(volume, below);
}

/* ---- tree
 * ---------------------------------------------------------------------------------------- */

enum { LEAF = 8, DEPTH = 64 };

typedef struct node {
    double low[3], high[3];
    shape_vec area, middle; /* m2, sum of the triangles' areas as vectors; their middle */
    double radius;          /* m, about the middle, of all corners */
    int first, count;       /* triangles in `order`; children when count is 0: first, first + 1 */
} node;

struct shape_tree {
    const shape_mesh *mesh;
    node *nodes;
    int node_count;
    int *order;
    double *key; /* of the split at work, by triangle */
};

static double coordinate(shape_vec v, int k) {
    return k == 0 ? v.x : k == 1 ? v.y : v.z;
}

static shape_vec area_of(const shape_vec c[3]) {
    return sv_scale(0.5, sv_cross(sv_sub(c[1], c[0]), sv_sub(c[2], c[0])));
}

static void measure(const shape_tree *t, node *n, int first, int count) {
    *n = (node){.first = first, .count = count};
    double weight = 0;
    shape_vec c[3];
    for (int k = 0; k < 3; k++) n->low[k] = HUGE_VAL, n->high[k] = -HUGE_VAL;
    for (int i = 0; i < count; i++) {
        shape_mesh_corners(t->mesh, (size_t)t->order[first + i], c);
        shape_vec area = area_of(c);
        double w = sv_norm(area) + 1e-300;
        n->area = sv_add(n->area, area);
        n->middle = sv_along(n->middle, w / 3, sv_add(c[0], sv_add(c[1], c[2])));
        weight += w;
        for (int v = 0; v < 3; v++)
            for (int k = 0; k < 3; k++) {
                n->low[k] = fmin(n->low[k], coordinate(c[v], k));
                n->high[k] = fmax(n->high[k], coordinate(c[v], k));
            }
    }
    n->middle = sv_scale(1 / weight, n->middle);
    for (int i = 0; i < count; i++) {
        shape_mesh_corners(t->mesh, (size_t)t->order[first + i], c);
        for (int v = 0; v < 3; v++) n->radius = fmax(n->radius, sv_distance(c[v], n->middle));
    }
}

/* Sorts order[from..to) by key, then by number: Shell's method, the same on every machine. */
static void sort_by_key(const shape_tree *t, int from, int to) {
    int count = to - from, *a = t->order + from;
    for (int gap = count / 2; gap > 0; gap = gap == 2 ? 1 : gap * 5 / 11)
        for (int i = gap; i < count; i++) {
            int moving = a[i], j = i;
            for (; j >= gap; j -= gap) {
                double d = t->key[a[j - gap]] - t->key[moving];
                if (d < 0 || (d == 0 && a[j - gap] < moving)) break;
                a[j] = a[j - gap];
            }
            a[j] = moving;
        }
}

static void split(shape_tree *t, int at) {
    node n = t->nodes[at];
    if (n.count <= LEAF) return;
    int axis = 0;
    for (int k = 1; k < 3; k++)
        if (n.high[k] - n.low[k] > n.high[axis] - n.low[axis]) axis = k;
    for (int i = 0; i < n.count; i++) {
        shape_vec c[3];
        int triangle = t->order[n.first + i];
        shape_mesh_corners(t->mesh, (size_t)triangle, c);
        t->key[triangle] = coordinate(c[0], axis) + coordinate(c[1], axis) + coordinate(c[2], axis);
    }
    sort_by_key(t, n.first, n.first + n.count);
    int half = n.count / 2, child = t->node_count;
    t->node_count += 2;
    measure(t, &t->nodes[child], n.first, half);
    measure(t, &t->nodes[child + 1], n.first + half, n.count - half);
    t->nodes[at].first = child;
    t->nodes[at].count = 0;
    split(t, child);
    split(t, child + 1);
}

shape_tree *shape_tree_new(const shape_mesh *mesh) {
    SHAPE_ASSERT(mesh && mesh->triangle_count > 0 && mesh->triangle_count < 100000000);
    shape_tree *t = calloc(1, sizeof *t);
    SHAPE_ASSERT(t);
    int count = (int)mesh->triangle_count;
    t->mesh = mesh;
    t->nodes = malloc(2 * (size_t)count * sizeof *t->nodes);
    t->order = malloc((size_t)count * sizeof *t->order);
    t->key = malloc((size_t)count * sizeof *t->key);
    SHAPE_ASSERT(t->nodes && t->order && t->key);
    for (int i = 0; i < count; i++) t->order[i] = i;
    t->node_count = 1;
    measure(t, &t->nodes[0], 0, count);
    split(t, 0);
    return t;
}

void shape_tree_free(shape_tree *t) {
    if (!t) return;
    free(t->nodes), free(t->order), free(t->key), free(t);
}

static double box_distance2(const node *n, shape_vec p) {
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        double x = coordinate(p, k), d = x < n->low[k] ? n->low[k] - x : x - n->high[k];
        if (d > 0) sum += d * d;
    }
    return sum;
}

double shape_tree_nearest(const shape_tree *t, shape_vec p, shape_vec *nearest, size_t *triangle) {
    SHAPE_ASSERT(t);
    int stack[DEPTH], top = 0;
    double best = HUGE_VAL;
    stack[top++] = 0;
    while (top > 0) {
        const node *n = &t->nodes[stack[--top]];
        if (box_distance2(n, p) >= best) continue;
        for (int i = 0; i < n->count; i++) {
            shape_vec c[3];
            size_t at = (size_t)t->order[n->first + i];
            shape_mesh_corners(t->mesh, at, c);
            shape_vec q = shape_triangle_nearest(c, p), d = sv_sub(q, p);
            if (sv_dot(d, d) >= best) continue;
            best = sv_dot(d, d);
            if (nearest) *nearest = q;
            if (triangle) *triangle = at;
        }
        if (n->count > 0) continue;
        double a = box_distance2(&t->nodes[n->first], p);
        double b = box_distance2(&t->nodes[n->first + 1], p);
        SHAPE_ASSERT(top + 2 <= DEPTH);
        stack[top++] = a < b ? n->first + 1 : n->first; /* the nearer one is looked at first */
        stack[top++] = a < b ? n->first : n->first + 1;
    }
    return sqrt(best);
}

double shape_tree_winding(const shape_tree *t, shape_vec p) {
    SHAPE_ASSERT(t);
    int stack[DEPTH], top = 0;
    double sum = 0;
    stack[top++] = 0;
    while (top > 0) {
        const node *n = &t->nodes[stack[--top]];
        shape_vec arm = sv_sub(n->middle, p);
        double distance = sv_norm(arm);
        if (distance > 3 * n->radius) {
            sum += sv_dot(n->area, arm) / (distance * distance * distance);
            continue;
        }
        for (int i = 0; i < n->count; i++) {
            shape_vec c[3];
            shape_mesh_corners(t->mesh, (size_t)t->order[n->first + i], c);
            sum += solid_angle(c, p);
        }
        if (n->count > 0) continue;
        SHAPE_ASSERT(top + 2 <= DEPTH);
        stack[top++] = n->first;
        stack[top++] = n->first + 1;
    }
    return sum / (4 * SHAPE_PI);
}
