#include "shapes/lathe.h"

#include <stdlib.h>

#include "shapes/check.h"
#include "shapes/numbers.h"

static int32_t vertex_of(double (*at)[2], const int32_t *first, int point, int place, int around) {
    return first[point] + (at[point][1] > 0 ? place % around : 0);
}

static void add_triangle(shape_mesh *mesh, int32_t a, int32_t b, int32_t c) {
    if (a == b || b == c || c == a) return;
    int32_t *to = mesh->triangle + 3 * mesh->triangle_count++;
    to[0] = a, to[1] = b, to[2] = c;
}

static size_t place_vertices(shape_mesh *mesh, double (*at)[2], int count, int around,
                             int32_t *first) {
    size_t used = 0;
    bool closed = at[0][0] == at[count - 1][0] && at[0][1] == at[count - 1][1];
    for (int i = 0; i < count; i++) {
        first[i] = (int32_t)used;
        if (closed && i == count - 1) {
            first[i] = first[0];
            break;
        }
        for (int k = 0; k < (at[i][1] > 0 ? around : 1); k++) {
            double s, c;
            shape_sincos(2 * SHAPE_PI * k / around, &s, &c);
            mesh->vertex[used++] = sv(at[i][0], at[i][1] * c, at[i][1] * s);
        }
    }
    return used;
}

shape_mesh shape_lathe(double (*at)[2], int count, int around) {
    SHAPE_ASSERT(at && count >= 3 && around >= 3);
    shape_mesh mesh =
        shape_mesh_new((size_t)count * (size_t)around, 2 * (size_t)(count - 1) * (size_t)around);
    mesh.triangle_count = 0;
    int32_t *first = malloc((size_t)count * sizeof *first);
    SHAPE_ASSERT(first);
    mesh.vertex_count = place_vertices(&mesh, at, count, around, first);
    for (int i = 0; i + 1 < count; i++)
        for (int k = 0; k < around; k++) {
            int32_t a = vertex_of(at, first, i, k, around);
            int32_t b = vertex_of(at, first, i + 1, k, around);
            int32_t c = vertex_of(at, first, i + 1, k + 1, around);
            int32_t d = vertex_of(at, first, i, k + 1, around);
            add_triangle(&mesh, a, d, c);
            add_triangle(&mesh, a, c, b);
        }
    free(first);
    return mesh;
}
