/* stage_mesh.h - walls of triangles in run.h5, for pictures. */
#ifndef CLAST_RUN_STAGE_MESH_H
#define CLAST_RUN_STAGE_MESH_H

#include "engine/hdf5_io.h"
#include "experiments/scene/scene.h"

typedef struct stage_mesh {
    size_t wall; /* any wall of the stage that moves as it does */
    int part;    /* index in the world */
    size_t vertex_count, triangle_count;
    double *vertex; /* m, 3 each, at t = 0 */
    uint32_t *triangle;
} stage_mesh;

void stage_meshes_write(h5_file *f, const scene *s);

/* None in a file of a run without such walls; failures are noted in f. */
stage_mesh *stage_meshes_read(h5_file *f, size_t walls, size_t *count);
void stage_meshes_free(stage_mesh *meshes, size_t count);

#endif
