/* cull.h: from the caller's spheres to the list that is worth drawing, nearest first. */
#ifndef RENDER_CULL_H
#define RENDER_CULL_H

#include "render/lens.h"

/* One sphere as the shader reads it (std430, 32 bytes). */
typedef struct render_ball {
    float place[4]; /* view coordinates and radius, m */
    uint32_t rgba;  /* colour, and in the top byte how dark its outline is */
    uint32_t body;  /* body + 1; 0 is the background */
    uint32_t unused[2];
} render_ball;

/* Arrays that live from frame to frame. {0} is a valid start. */
typedef struct render_cull {
    render_ball *ball, *sorted; /* what is drawn is sorted[0..drawn) */
    uint32_t *key, *order, *spare;
    float *cell; /* coarse z-buffer */
    size_t room, cell_room, drawn;
} render_cull;

typedef struct render_cull_def {
    bool occlusion;         /* false: only what lies outside the picture is dropped */
    int cell_px;            /* drawn pixels per cell of the z-buffer; changes time only */
    double outline;         /* 0 to 1 */
    double outline_fade_px; /* drawn pixels (picture pixels times samples) */
} render_cull_def;

render_status render_cull_spheres(render_cull *cull, const render_spheres *spheres,
                                  const render_lens *lens, const render_cull_def *def);
void render_cull_free(render_cull *cull);

#endif
