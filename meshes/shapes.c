#include "meshes/shapes.h"
#include "meshes/make.h"

#include <math.h>
#include <string.h>

static const double PI = 3.141592653589793;

bool mesh_allocate(mesh_surface *s, size_t vertices, size_t triangles) {
    *s = (mesh_surface){vertices, mesh_array(vertices, 3 * sizeof(double)), triangles,
                        mesh_array(triangles, 3 * sizeof(int32_t))};
    if (s->vertex && s->triangle) return true;
    mesh_free(s);
    return false;
}

int32_t *mesh_put(int32_t *to, int32_t a, int32_t b, int32_t c) {
    memcpy(to, (int32_t[3]){a, b, c}, 3 * sizeof *to);
    return to + 3;
}

void mesh_direction(double angle, double *cosine, double *sine) {
    MESH_ASSERT(fabs(angle) <= PI * (1 + 1e-12));
    double term = 1;
    *cosine = *sine = 0;
    for (int n = 0; n < 40; n++) {
        *(n % 2 == 0 ? cosine : sine) += n % 4 < 2 ? term : -term;
        term *= angle / (n + 1);
    }
}

/* Vertex 0 is the middle of the bottom; then rings of `segments` from the bottom up. */
static void cylinder_vertices(const mesh_cylinder *c, mesh_surface *s) {
    for (int i = 0; i < c->segments; i++) {
        double cosine, sine;
        mesh_direction(2 * PI * i / c->segments - PI, &cosine, &sine);
        for (int j = 0; j <= c->bands; j++) {
            double *p = s->vertex + 3 * (1 + (size_t)j * (size_t)c->segments + (size_t)i);
            p[0] = c->radius * cosine;
            p[1] = c->radius * sine;
            p[2] = c->height * j / c->bands;
        }
    }
}

static void cylinder_triangles(const mesh_cylinder *c, mesh_surface *s) {
    int32_t *to = s->triangle;
    for (int32_t i = 0; i < c->segments; i++)
        to = mesh_put(to, 0, 1 + i, 1 + (i + 1) % c->segments);
    for (int32_t j = 0; j < c->bands; j++)
        for (int32_t i = 0; i < c->segments; i++) {
            int32_t a = 1 + j * c->segments + i, b = 1 + j * c->segments + (i + 1) % c->segments;
            to = mesh_put(to, a, a + c->segments, b);
            to = mesh_put(to, b, a + c->segments, b + c->segments);
        }
}

mesh_status mesh_make_cylinder(const mesh_cylinder *c, mesh_surface *surface) {
    MESH_ASSERT(c && surface);
    *surface = (mesh_surface){0};
    if (!(c->radius > 0 && isfinite(c->radius) && c->height > 0 && isfinite(c->height)))
        return mesh_fail(MESH_ERR_ARGUMENT,
                         "cylinder of radius %g m, height %g m: both must be above 0", c->radius,
                         c->height);
    if (c->segments < 3 || c->bands < 1 || (double)c->segments * (2.0 * c->bands + 1) > 1e8)
        return mesh_fail(
            MESH_ERR_ARGUMENT,
            "cylinder of %d segments, %d bands: at least 3 and 1, 1e8 triangles at most",
            c->segments, c->bands);
    size_t segments = (size_t)c->segments, bands = (size_t)c->bands;
    if (!mesh_allocate(surface, 1 + segments * (bands + 1), segments * (2 * bands + 1)))
        return MESH_ERR_MEMORY;
    cylinder_vertices(c, surface);
    cylinder_triangles(c, surface);
    return MESH_OK;
}

/* Vertex numbers have x in bit 0, y in bit 1, z in bit 2. */
static const int32_t BOX[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                   {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                   {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};

mesh_status mesh_make_box(const double size[3], mesh_surface *surface) {
    MESH_ASSERT(size && surface);
    *surface = (mesh_surface){0};
    for (int k = 0; k < 3; k++)
        if (!(size[k] > 0 && isfinite(size[k])))
            return mesh_fail(MESH_ERR_ARGUMENT, "box of %g x %g x %g m: each must be above 0",
                             size[0], size[1], size[2]);
    if (!mesh_allocate(surface, 8, 12)) return MESH_ERR_MEMORY;
    for (int v = 0; v < 8; v++)
        for (int k = 0; k < 3; k++)
            surface->vertex[3 * v + k] = v >> k & 1 ? size[k] / 2 : -size[k] / 2;
    memcpy(surface->triangle, BOX, sizeof BOX);
    return MESH_OK;
}
