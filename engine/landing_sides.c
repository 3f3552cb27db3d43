/* landing_sides.c - the planes that a clump can come to lie on: along its principal axes, and where
 * three of its spheres (in a plane of motion two) touch a plane that all others are above of.
 *
 * The latter are found from directions at random: a plane comes up to the clump, is tilted about
 * the sphere that it meets until it meets a second, and then about both until it meets a third.
 * Every such side has its share of directions that lead to it; a side that is missed is a small
 * one. All of them would be the hull of the spheres, whose sides grow with their number. */
#include "engine/landing.h"

enum { TRIES = 48 };

static bool leaves_plane(const clast_world *w, int axis) {
    return w->def.motion == CLAST_MOTION_IN_PLANE && axis == w->def.plane_axis;
}

/* A unit vector, in the plane of motion where there is one. */
static vec3 any_direction(const clast_world *w, uint64_t stream, uint64_t *count) {
    for (;;) {
        double c[3];
        for (int i = 0; i < 3; i++) c[i] = 2 * clast_random(1, stream, (*count)++) - 1;
        for (int i = 0; i < 3; i++)
            if (leaves_plane(w, i)) c[i] = 0;
        vec3 v = v3(c[0], c[1], c[2]);
        double n2 = v3_dot(v, v);
        if (n2 > 0.01 && n2 < 1) return v3_scale(1 / sqrt(n2), v);
    }
}

static double depth_of(const shape *s, int i, vec3 n) {
    return s->radius[i] - v3_dot(s->centre[i], n);
}

static int deepest_of(const shape *s, vec3 n) {
    int most = 0;
    for (int i = 1; i < s->spheres; i++)
        if (depth_of(s, i, n) > depth_of(s, most, n)) most = i;
    return most;
}

/* A turn of a normal: n' = along + cos out + sin side, cos and sin of an angle from 0 on. */
typedef struct turning_normal {
    vec3 along, out, side;
} turning_normal;

static vec3 turned(const turning_normal *t, double tangent) {
    double c = (1 - tangent * tangent) / (1 + tangent * tangent);
    double s = 2 * tangent / (1 + tangent * tangent);
    return v3_add(t->along, v3_add(v3_scale(c, t->out), v3_scale(s, t->side)));
}

/* Tangent of half the angle at which sphere i is as deep as sphere a: the smaller root above 0 of
 * a quadratic equation; INFINITY without one. */
static double as_deep(const shape *s, int i, int a, const turning_normal *t) {
    vec3 d = v3_sub(s->centre[i], s->centre[a]);
    double rest = s->radius[i] - s->radius[a] - v3_dot(d, t->along);
    double c = v3_dot(d, t->out), b = v3_dot(d, t->side);
    double root2 = c * c + b * b - rest * rest;
    if (root2 < 0) return INFINITY;
    /* (rest + c) x^2 - 2 b x + rest - c = 0 */
    double q = b + (b < 0 ? -1 : 1) * sqrt(root2);
    double one = q / (rest + c), other = (rest - c) / q, least = INFINITY;
    if (one > 1e-9) least = one;
    if (other > 1e-9 && other < least) least = other;
    return least;
}

/* Turns until one more sphere than a and b is as deep; false when none ever is. */
static bool turn_to_next(const shape *s, int a, int b, const turning_normal *t, int *next,
                         vec3 *n) {
    double least = INFINITY;
    for (int i = 0; i < s->spheres; i++) {
        double tangent = i == a || i == b ? INFINITY : as_deep(s, i, a, t);
        if (tangent < least) least = tangent, *next = i;
    }
    if (least == INFINITY) return false;
    *n = turned(t, least);
    return true;
}

/* Down on sphere a, on a and b, and on a third where there is one (a row has none); false where
 * nothing but a is ever met. */
static bool find_side(const clast_world *w, const shape *s, vec3 *n, vec3 way) {
    int a = deepest_of(s, *n), b = a, c = a;
    vec3 out = v3_sub(way, v3_scale(v3_dot(way, *n), *n));
    double length = v3_norm(out);
    if (length < 1e-3) return false;
    turning_normal first = {{0, 0, 0}, *n, v3_scale(1 / length, out)};
    if (!turn_to_next(s, a, a, &first, &b, n)) return false;
    if (w->def.motion == CLAST_MOTION_IN_PLANE) return true;
    vec3 d = v3_sub(s->centre[b], s->centre[a]), axis = v3_scale(1 / v3_norm(d), d);
    turning_normal second = {.along = v3_scale(v3_dot(*n, axis), axis)};
    second.out = v3_sub(*n, second.along);
    second.side = v3_cross(axis, second.out);
    turn_to_next(s, a, b, &second, &c, n);
    return true;
}

int landing_sides(const clast_world *w, const shape *s, vec3 normals[LANDING_SIDES]) {
    int count = 0;
    uint64_t drawn = 0;
    for (int side = 0; side < 6; side++)
        if (!leaves_plane(w, side / 2)) normals[count++] = v3_axis(side / 2, side % 2 ? -1 : 1);
    for (int i = 0; i < TRIES && s->spheres > 1; i++) {
        vec3 n = any_direction(w, 0, &drawn), way = any_direction(w, 0, &drawn);
        if (find_side(w, s, &n, way)) normals[count++] = n;
    }
    CLAST_ASSERT(count <= LANDING_SIDES);
    return count;
}
