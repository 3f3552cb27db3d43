/* files.h - small mesh files as text, and putting them on disk. */
#ifndef CLAST_TESTS_MESHES_FILES_H
#define CLAST_TESTS_MESHES_FILES_H

#include "meshes/shapes.h"
#include "tests/support/check.h"

static inline void put(const char *path, const void *bytes, size_t count) {
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, count, file), count);
    assert_int_equal(fclose(file), 0);
}

static inline void put_text(const char *path, const char *text) {
    put(path, text, strlen(text));
}

/* `text` with the first `old` replaced, as a file. */
static inline void put_changed(const char *path, const char *text, const char *old,
                               const char *new) {
    char out[4096];
    const char *at = strstr(text, old);
    assert_non_null(at);
    snprintf(out, sizeof out, "%.*s%s%s", (int)(at - text), text, new, at + strlen(old));
    put_text(path, out);
}

static inline mesh_report good(const char *path) {
    mesh_options options = mesh_options_default();
    mesh_surface surface;
    mesh_report report;
    if (mesh_load(path, &options, &surface, &report) != MESH_OK) fail_msg("%s", mesh_error_text());
    assert_int_equal(surface.triangle_count, report.triangles_read);
    mesh_free(&surface);
    return report;
}

#define STL_TEXT                                                                                   \
    "solid two\n"                                                                                  \
    "facet normal 0 0 1\nouter loop\n"                                                             \
    "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"                                \
    "facet normal 0 0 1\nouter loop\n"                                                             \
    "vertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\n"                                \
    "endsolid two\n"
#define OBJ_TEXT "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"
#define PLY_TEXT                                                                                   \
    "ply\nformat ascii 1.0\nelement vertex 4\n"                                                    \
    "property float x\nproperty float y\nproperty float z\nelement face 2\n"                       \
    "property list uchar int vertex_indices\nend_header\n"                                         \
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"
#define OFF_TEXT "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"

#endif
