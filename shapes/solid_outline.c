/* solid_outline.c - outlines of solids of revolution, and all solids as triangles. */
#include "shapes/solid_outline.h"

#include <stdlib.h>
#include <string.h>

#include "shapes/check.h"
#include "shapes/lathe.h"
#include "shapes/numbers.h"

shape_outline shape_outline_of(const shape_solid *s) {
    double a = s->size[0], b = s->size[1], c = s->size[2], h = 0.5 * c;
    switch (s->kind) {
    case SHAPE_CYLINDER:
        h = 0.5 * b;
        return (shape_outline){3, -1, {{-h, 0}, {-h, a}, {h, a}, {h, 0}}};
    case SHAPE_CONE:
        return (shape_outline){2, -1, {{-0.25 * b, 0}, {-0.25 * b, a}, {0.75 * b, 0}}};
    case SHAPE_DOUBLE_CONE:
        return (shape_outline){2, -1, {{-0.5 * b, 0}, {0, a}, {0.5 * b, 0}}};
    case SHAPE_DISC:
        if (b > 0) return (shape_outline){4, -1, {{-h, b}, {-h, a}, {h, a}, {h, b}, {-h, b}}};
        return (shape_outline){3, -1, {{-h, 0}, {-h, a}, {h, a}, {h, 0}}};
    default:
        SHAPE_ASSERT(s->kind == SHAPE_HYPERBOLOID || s->kind == SHAPE_BARREL);
        return (shape_outline){3, 1, {{-h, 0}, {-h, a}, {h, a}, {h, 0}}};
    }
}

double shape_curve_height(const shape_solid *s, double x, double *slope) {
    double end = s->size[0], middle = s->size[1], t = 2 * x / s->size[2];
    if (s->kind == SHAPE_BARREL) {
        *slope = -4 * (middle - end) * t / s->size[2];
        return middle - (middle - end) * t * t;
    }
    double more = (end - middle) * (end + middle);
    double height = sqrt(middle * middle + more * t * t);
    *slope = 2 * more * t / (s->size[2] * height);
    return height;
}

const int SHAPE_TETRAHEDRON_FACES[4][3] = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};

void shape_tetrahedron_corners(double edge, shape_vec corner[4]) {
    double a = edge / (2 * sqrt(2));
    corner[0] = sv(a, a, a);
    corner[1] = sv(a, -a, -a);
    corner[2] = sv(-a, a, -a);
    corner[3] = sv(-a, -a, a);
}

/* ---- triangles
 * ----------------------------------------------------------------------------------- */

static shape_mesh tetrahedron_mesh(double edge) {
    shape_mesh mesh = shape_mesh_new(4, 4);
    shape_tetrahedron_corners(edge, mesh.vertex);
    for (int i = 0; i < 12; i++) mesh.triangle[i] = SHAPE_TETRAHEDRON_FACES[i / 3][i % 3];
    return mesh;
}

/* Corner numbers have x in bit 0, y in bit 1, z in bit 2. */
static shape_mesh block_mesh(double x, double y, double z) {
    static const int32_t FACES[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                      2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    shape_mesh mesh = shape_mesh_new(8, 12);
    for (int v = 0; v < 8; v++)
        mesh.vertex[v] = sv(v & 1 ? x / 2 : -x / 2, v & 2 ? y / 2 : -y / 2, v & 4 ? z / 2 : -z / 2);
    memcpy(mesh.triangle, FACES, sizeof FACES);
    return mesh;
}

/* From the angle pi (left) over the top, by the half or the whole circle. */
static shape_mesh circle_mesh(double radius, double height, bool whole, int fine) {
    int pieces = (whole ? 32 : 24) * fine;
    double(*at)[2] = malloc((size_t)(pieces + 1) * sizeof *at);
    SHAPE_ASSERT(at);
    for (int i = 0; i <= pieces; i++) {
        double s, c;
        shape_sincos((whole ? 2 : 1) * SHAPE_PI * i / pieces, &s, &c);
        at[i][0] = -radius * c, at[i][1] = height + radius * s;
    }
    if (!whole) at[0][1] = at[pieces][1] = 0;
    shape_mesh mesh = shape_lathe(at, pieces + 1, 48 * fine);
    free(at);
    return mesh;
}

static shape_mesh outline_mesh(const shape_solid *s, int fine) {
    shape_outline o = shape_outline_of(s);
    int bends = 16 * fine, count = 0;
    double(*at)[2] = malloc((size_t)(OUTLINE_ROOM + bends) * sizeof *at);
    SHAPE_ASSERT(at);
    for (int i = 0; i <= o.pieces; i++) {
        memcpy(at[count++], o.at[i], sizeof *at);
        for (int k = 1; i == o.curve && k < bends; k++) {
            double slope, x = o.at[i][0] + (o.at[i + 1][0] - o.at[i][0]) * k / bends;
            at[count][0] = x;
            at[count++][1] = shape_curve_height(s, x, &slope);
        }
    }
    shape_mesh mesh = shape_lathe(at, count, 48 * fine);
    free(at);
    return mesh;
}

static shape_mesh ellipsoid_mesh(double a, double b, double c, int fine) {
    shape_mesh mesh = circle_mesh(1, 0, false, fine);
    for (size_t i = 0; i < mesh.vertex_count; i++) {
        shape_vec *v = &mesh.vertex[i];
        *v = sv(a * v->x, b * v->y, c * v->z);
    }
    return mesh;
}

static shape_mesh torus_mesh(double tube, double ring, int fine) {
    shape_mesh mesh = circle_mesh(tube, ring, true, fine);
    for (size_t i = 0; i < mesh.vertex_count; i++) {
        shape_vec v = mesh.vertex[i];
        mesh.vertex[i] = sv(v.y, v.z, v.x); /* axis along z */
    }
    return mesh;
}

shape_mesh shape_solid_mesh(const shape_solid *s, int fine) {
    SHAPE_ASSERT(s && fine >= 1);
    const double *z = s->size;
    switch (s->kind) {
    case SHAPE_SPHERE:
        return ellipsoid_mesh(z[0], z[0], z[0], fine);
    case SHAPE_ELLIPSOID:
        return ellipsoid_mesh(z[0], z[1], z[2], fine);
    case SHAPE_CUBE:
        return block_mesh(z[0], z[0], z[0]);
    case SHAPE_BLOCK:
        return block_mesh(z[0], z[1], z[2]);
    case SHAPE_PARALLELEPIPED:
        return block_mesh(z[0], z[1], z[1]);
    case SHAPE_TETRAHEDRON:
        return tetrahedron_mesh(z[0]);
    case SHAPE_TORUS:
        return torus_mesh(z[0], z[1], fine);
    default:
        return outline_mesh(s, fine);
    }
}
