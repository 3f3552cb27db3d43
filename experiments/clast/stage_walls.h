/* stage_walls.h - walls of a run as surfaces to draw. */
#ifndef CLAST_COMMAND_STAGE_WALLS_H
#define CLAST_COMMAND_STAGE_WALLS_H

#include "experiments/run/results.h"
#include "render/render.h"

enum { WALL_VERTICES = 6, WALL_FACES = 4 };

typedef struct wall_surfaces {
    size_t count;
    render_walls *walls;
    double *vertices;
    uint32_t *indices;
    double *mesh_vertices; /* of all meshes, moved */
} wall_surfaces;

/* The walls that are there in a frame, where they are then. Infinite planes are cut out by the box,
 * which must not be empty. Meshes hide what is behind them, planes and plates do not. */
void wall_surfaces_at(wall_surfaces *w, const stage *s, const frame *f, const double low[3],
                      const double high[3]);
void wall_surfaces_free(wall_surfaces *w);

#endif
