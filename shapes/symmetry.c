#include "shapes/symmetry.h"

#include <string.h>

#include "shapes/check.h"
#include "shapes/numbers.h"

bool shape_has_axis(const shape_target *t, int *axis) {
    *axis = 0;
    if (t->source == SHAPE_FROM_PROFILE) return true;
    if (t->source == SHAPE_FROM_MESH) return false;
    const double *size = t->solid.size;
    switch (t->solid.kind) {
    case SHAPE_TORUS:
        *axis = 2;
        return true;
    case SHAPE_ELLIPSOID:
        *axis = size[1] == size[2] ? 0 : size[0] == size[2] ? 1 : 2;
        return size[1] == size[2] || size[0] == size[2] || size[0] == size[1];
    case SHAPE_CYLINDER:
    case SHAPE_CONE:
    case SHAPE_DOUBLE_CONE:
    case SHAPE_HYPERBOLOID:
    case SHAPE_BARREL:
    case SHAPE_DISC:
        return true;
    default:
        return false;
    }
}

static void add(shape_symmetry *s, double m[3][3]) {
    SHAPE_ASSERT(s->count < SYMMETRY_ROOM);
    memcpy(s->matrix[s->count++], m, 9 * sizeof(double));
}

/* Turns by equal parts of a circle, each with its mirror image along the axis if there is one. */
static void add_turns(shape_symmetry *s, int axis, int parts, bool mirror) {
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int k = 0; k < parts; k++)
        for (int side = 1; side >= (mirror ? -1 : 1); side -= 2) {
            double m[3][3] = {{0}}, sine, cosine;
            shape_sincos(2 * SHAPE_PI * k / parts, &sine, &cosine);
            m[axis][axis] = side;
            m[u][u] = m[v][v] = cosine;
            m[u][v] = -sine, m[v][u] = sine;
            add(s, m);
        }
}

/* Exchanges of axes (all six, or none but the identity) with reflections; `even`: those with an
 * even number of them, the group of a tetrahedron in a cube. */
static void add_exchanges(shape_symmetry *s, bool exchange, bool even) {
    static const int ORDERS[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                     {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (int o = 0; o < (exchange ? 6 : 1); o++)
        for (int signs = 0; signs < 8; signs++) {
            int minus = (signs & 1) + (signs >> 1 & 1) + (signs >> 2 & 1);
            if (even && minus % 2 == 1) continue;
            double m[3][3] = {{0}};
            for (int k = 0; k < 3; k++) m[k][ORDERS[o][k]] = signs >> k & 1 ? -1 : 1;
            add(s, m);
        }
}

static bool has_mirror(const shape_target *t) {
    return t->source == SHAPE_FROM_SOLID && t->solid.kind != SHAPE_CONE;
}

bool shape_symmetry_of(const shape_target *t, int ring, shape_symmetry *s) {
    static const int RINGS[SYMMETRY_RINGS] = {4, 6, 8, 16, 32};
    SHAPE_ASSERT(t && s && ring >= 0);
    int axis;
    s->count = 0;
    if (shape_has_axis(t, &axis)) {
        if (ring >= SYMMETRY_RINGS) return false;
        s->ring = RINGS[ring];
        add_turns(s, axis, s->ring, has_mirror(t));
        return true;
    }
    if (ring > 0) return false;
    if (t->source == SHAPE_FROM_MESH) {
        double same[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        add(s, same);
        return true;
    }
    shape_kind kind = t->solid.kind;
    add_exchanges(s, kind == SHAPE_SPHERE || kind == SHAPE_CUBE || kind == SHAPE_TETRAHEDRON,
                  kind == SHAPE_TETRAHEDRON);
    return true;
}

void shape_common_symmetry(const shape_target *t, shape_symmetry *s) {
    int axis;
    s->count = 0;
    if (shape_has_axis(t, &axis))
        add_turns(s, axis, 2, has_mirror(t));
    else
        shape_symmetry_of(t, 0, s);
}

bool shape_in_first_part(shape_symmetry *s, shape_vec p) {
    const shape_vec way = {0.9137, 0.3541, 0.1973}; /* no image of it is the same */
    double own = sv_dot(p, way);
    for (int k = 1; k < s->count; k++)
        if (sv_dot(shape_image(s->matrix[k], p), way) > own) return false;
    return true;
}

shape_vec shape_image(double m[3][3], shape_vec p) {
    return sv(m[0][0] * p.x + m[0][1] * p.y + m[0][2] * p.z,
              m[1][0] * p.x + m[1][1] * p.y + m[1][2] * p.z,
              m[2][0] * p.x + m[2][1] * p.y + m[2][2] * p.z);
}
