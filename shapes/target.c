#include "shapes/target.h"

#include <stdlib.h>

#include "shapes/check.h"
#include "shapes/numbers.h"

static shape_target *new_target(shape_source source) {
    shape_target *t = calloc(1, sizeof *t);
    SHAPE_ASSERT(t);
    t->source = source;
    return t;
}

static void measure(shape_target *t) {
    shape_vec low = t->surface.vertex[0], high = low;
    for (size_t i = 1; i < t->surface.vertex_count; i++) {
        shape_vec v = t->surface.vertex[i];
        low = sv(fmin(low.x, v.x), fmin(low.y, v.y), fmin(low.z, v.z));
        high = sv(fmax(high.x, v.x), fmax(high.y, v.y), fmax(high.z, v.z));
    }
    t->size = sv_distance(low, high);
}

shape_target *shape_target_of_solid(const shape_solid *solid) {
    SHAPE_ASSERT(solid && !shape_solid_fault(solid));
    shape_target *t = new_target(SHAPE_FROM_SOLID);
    t->solid = *solid;
    t->surface = shape_solid_mesh(solid, 1);
    t->mass = shape_solid_mass(solid);
    measure(t);
    return t;
}

shape_target *shape_target_of_profile(double (*at)[2], int count) {
    shape_target *t = new_target(SHAPE_FROM_PROFILE);
    t->profile = shape_profile_new(at, count);
    t->surface = shape_profile_mesh(&t->profile);
    t->mass = shape_profile_mass(&t->profile);
    measure(t);
    t->slack = 1e-3 * t->size;
    return t;
}

shape_target *shape_target_of_mesh(shape_mesh *mesh, const char **fault) {
    SHAPE_ASSERT(mesh && fault);
    double volume = mesh->triangle_count > 0 ? shape_mesh_volume(mesh) : 0;
    if (!(fabs(volume) > 0)) {
        *fault = "no volume";
        shape_mesh_free(mesh);
        return NULL;
    }
    if (volume < 0) shape_mesh_turn(mesh);
    shape_target *t = new_target(SHAPE_FROM_MESH);
    t->surface = *mesh;
    *mesh = (shape_mesh){0};
    t->tree = shape_tree_new(&t->surface);
    t->mass = shape_mesh_mass(&t->surface);
    measure(t);
    t->slack = 2e-3 * t->size;
    return t;
}

void shape_target_free(shape_target *t) {
    if (!t) return;
    shape_tree_free(t->tree);
    shape_profile_free(&t->profile);
    shape_mesh_free(&t->surface);
    free(t);
}

static shape_vec face_normal(const shape_mesh *mesh, size_t triangle) {
    shape_vec c[3];
    shape_mesh_corners(mesh, triangle, c);
    shape_vec n = sv_cross(sv_sub(c[1], c[0]), sv_sub(c[2], c[0]));
    double length = sv_norm(n);
    return length > 0 ? sv_scale(1 / length, n) : sv(0, 0, 1);
}

double shape_target_distance(const shape_target *t, shape_vec p, shape_vec *nearest,
                             shape_vec *normal) {
    SHAPE_ASSERT(t);
    if (t->source == SHAPE_FROM_SOLID) return shape_solid_distance(&t->solid, p, nearest, normal);
    if (t->source == SHAPE_FROM_PROFILE)
        return shape_profile_distance(&t->profile, p, nearest, normal);
    size_t triangle;
    double d = shape_tree_nearest(t->tree, p, nearest, &triangle);
    if (normal) *normal = face_normal(&t->surface, triangle);
    return shape_tree_winding(t->tree, p) > 0.5 ? -d : d;
}

static double triangle_area(const shape_mesh *mesh, size_t triangle) {
    shape_vec c[3];
    shape_mesh_corners(mesh, triangle, c);
    return 0.5 * sv_norm(sv_cross(sv_sub(c[1], c[0]), sv_sub(c[2], c[0])));
}

/* A point of the triangle; the square is folded over its diagonal. */
static shape_vec point_in(const shape_mesh *mesh, size_t triangle, double u, double v) {
    shape_vec c[3];
    shape_mesh_corners(mesh, triangle, c);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    shape_vec p = sv_along(c[0], u, sv_sub(c[1], c[0]));
    return sv_along(p, v, sv_sub(c[2], c[0]));
}

void shape_target_samples(const shape_target *t, int count, shape_vec *point, shape_vec *normal) {
    SHAPE_ASSERT(t && count >= 1 && point && normal);
    const shape_mesh *mesh = &t->surface;
    double total = 0, passed = 0;
    for (size_t i = 0; i < mesh->triangle_count; i++) total += triangle_area(mesh, i);
    size_t at = 0;
    double own = triangle_area(mesh, 0);
    for (int i = 0; i < count; i++) {
        double wanted = total * (i + 0.5) / count;
        while (passed + own < wanted && at + 1 < mesh->triangle_count) {
            passed += own;
            own = triangle_area(mesh, ++at);
        }
        uint64_t place = (uint64_t)i;
        point[i] = point_in(mesh, at, shape_even(2, 0, place), shape_even(2, 1, place));
        normal[i] = face_normal(mesh, at);
        if (t->source != SHAPE_FROM_MESH) shape_target_distance(t, point[i], &point[i], &normal[i]);
    }
}
