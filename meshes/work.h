/* work.h: the stages between the triangles of a file and a clean surface. */
#ifndef CLAST_MESHES_WORK_H
#define CLAST_MESHES_WORK_H

#include "meshes/mesh.h"

typedef struct mesh_work {
    const char *name; /* of the file, for messages */
    size_t vertex_count;
    double *vertex; /* m, 3 each */
    size_t count;
    int32_t *corner; /* 3 per triangle */
    int32_t *source; /* triangle of the file, from 0 */
    mesh_report *report;
} mesh_work;

/* import.c: everything in the file as triangles in the file's units and axes. Fills in the first
 * block of the report. */
MESH_MUST_CHECK mesh_status mesh_import(const char *path, mesh_surface *raw, mesh_report *report);

/* probe.c: what assimp would not notice or would not say clearly. */
MESH_MUST_CHECK mesh_status mesh_probe(const char *path);
/* probe_ply.c: whether the file can hold the elements that its header announces. */
MESH_MUST_CHECK mesh_status mesh_probe_ply(const char *path, FILE *file, long long size);

/* build.c: takes the arrays of `raw` over, and leaves it empty. */
MESH_MUST_CHECK mesh_status mesh_clean(const char *name, mesh_surface *raw,
                                       const mesh_options *options, mesh_surface *surface,
                                       mesh_report *report);

/* weld.c: vertices within report->weld_distance become the first of them. */
MESH_MUST_CHECK mesh_status mesh_weld(mesh_work *w);

/* remove.c: triangles without an area or that are there already; then vertices in no triangle. */
MESH_MUST_CHECK mesh_status mesh_remove(mesh_work *w);
MESH_MUST_CHECK mesh_status mesh_drop_unused(mesh_work *w);

/* edges.c: open and branching edges, pieces, winding; turns triangles when `mend` is set. */
MESH_MUST_CHECK mesh_status mesh_check_edges(mesh_work *w, bool mend);

/* crossings.c: pairs of triangles that pass through each other; needs the box of the report. */
MESH_MUST_CHECK mesh_status mesh_find_crossings(mesh_work *w);

/* measure.c: (b - a) x (c - a), twice the area along the normal; six times the volume between the
 * triangle and `origin`. */
void mesh_normal(const mesh_work *w, size_t triangle, double normal[3]);
double mesh_six_volumes(const mesh_work *w, size_t triangle, const double origin[3]);
void mesh_measure_box(mesh_work *w);
void mesh_measure(mesh_work *w);

/* The other side out. */
static inline void mesh_turn(int32_t corner[3]) {
    int32_t held = corner[1];
    corner[1] = corner[2];
    corner[2] = held;
}

/* One more of a kind, seen at triangle `source` of the file, from 0. */
void mesh_note(mesh_finding *finding, int32_t source);

#endif
