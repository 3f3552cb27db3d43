/* Written by hand: assimp's exporter wants a scene of C++ objects built in C, and would add nothing
 * to 50 bytes per triangle. */
#include "meshes/status.h"
#include "meshes/work.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void put_word(unsigned char *to, uint32_t word) {
    for (int i = 0; i < 4; i++) to[i] = (unsigned char)(word >> 8 * i);
}

static void put_point(unsigned char *to, const double p[3]) {
    for (int k = 0; k < 3; k++) {
        float single = (float)p[k];
        uint32_t word;
        memcpy(&word, &single, sizeof word);
        put_word(to + 4 * k, word);
    }
}

static void put_facet(unsigned char *to, const mesh_work *w, size_t t) {
    double n[3];
    mesh_normal(w, t, n);
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3 && length > 0; k++) n[k] /= length;
    put_point(to, n);
    for (int k = 0; k < 3; k++)
        put_point(to + 12 + 12 * k, w->vertex + 3 * (size_t)w->corner[3 * t + (size_t)k]);
}

static bool write_all(const mesh_surface *s, FILE *file) {
    mesh_work w = {.vertex = s->vertex, .corner = s->triangle};
    unsigned char head[84] = "Clast mesh, metres";
    put_word(head + 80, (uint32_t)s->triangle_count);
    bool good = fwrite(head, sizeof head, 1, file) == 1;
    for (size_t t = 0; t < s->triangle_count && good; t++) {
        unsigned char facet[50] = {0};
        put_facet(facet, &w, t);
        good = fwrite(facet, sizeof facet, 1, file) == 1;
    }
    return good;
}

mesh_status mesh_write_stl(const mesh_surface *surface, const char *path) {
    MESH_ASSERT(surface && path && surface->triangle_count <= UINT32_MAX);
    size_t room = strlen(path) + sizeof ".part";
    char *aside = mesh_array(room, 1);
    if (!aside) return MESH_ERR_MEMORY;
    snprintf(aside, room, "%s.part", path);
    FILE *file = fopen(aside, "wb");
    bool good = file && write_all(surface, file);
    if (file && fclose(file) != 0) good = false;
    if (good) good = rename(aside, path) == 0;
    int why = errno;
    if (!good && file) remove(aside);
    free(aside);
    return good ? MESH_OK
                : mesh_fail(MESH_ERR_WRITE, "%s: cannot be written: %s", path, strerror(why));
}
