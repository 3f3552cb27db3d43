/* stage.h - what stands around the bodies of a run: walls and how they move, the domain, and the
 * view that the scene asks for. Kept in run.h5 from the first moment on, so that pictures need no
 * scene file. */
#ifndef CLAST_RUN_STAGE_H
#define CLAST_RUN_STAGE_H

#include "engine/hdf5_io.h"
#include "experiments/run/stage_mesh.h"
#include "experiments/scene/scene.h"

enum { STAGE_NAME_MAX = 64 };

typedef struct stage_wall {
    char name[STAGE_NAME_MAX];
    clast_wall_kind kind;
    clast_vec3 point, normal, side; /* at t = 0 */
    double half_side[2];
    int part_index;      /* in frames; -1 in runs of earlier versions */
    clast_part_def part; /* its motion, of a part of constant velocity; without a name */
} stage_wall;

typedef struct stage {
    char *title, *preset, *map;
    view view; /* preset and map point to the above */
    clast_vec3 domain_min, domain_max;
    size_t wall_count;
    stage_wall *walls; /* a flat piece of a mesh is one of these, too */
    size_t mesh_count;
    stage_mesh *meshes;
} stage;

void stage_write(h5_file *f, const scene *s);

/* Failures are noted in f; the stage can be freed in any case. */
stage *stage_read(h5_file *f);
void stage_free(stage *s);

/* For frames that do not say where parts are. False when the wall's part has been removed by then;
 * else how far it has moved. */
bool stage_wall_offset(const stage_wall *w, double time, clast_vec3 *offset);

#endif
