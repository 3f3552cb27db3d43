/* strokes.h: walls and lines made ready for the shaders, farthest first. */
#ifndef RENDER_STROKES_H
#define RENDER_STROKES_H

#include "render/lens.h"

typedef struct render_corner {
    float place[3]; /* view coordinates, m */
    uint32_t rgba;
} render_corner;

typedef struct render_segment {
    float from[3], half_width; /* drawn pixels, drawn pixels, view depth in m; drawn pixels */
    float to[3];
    uint32_t rgba;
} render_segment;

/* What a frame has besides spheres. {0} is a valid start; memory is kept from frame to frame. */
typedef struct render_strokes {
    render_corner
        *corner; /* three per triangle: the opaque ones, then the others, farthest first */
    size_t opaque_corners, corners, corner_room;
    render_segment *segment; /* hidden by spheres first, then those on top; each farthest first */
    size_t hidden_segments, segments, segment_room;
    struct render_item *item; /* scratch for sorting */
    size_t item_room;
    struct render_edge *edge; /* scratch for edges */
    size_t edge_room;
} render_strokes;

/* `samples` turns picture pixels into drawn ones. */
render_status render_strokes_build(render_strokes *strokes, const render_scene *scene,
                                   const render_lens *lens, int samples);
void render_strokes_free(render_strokes *strokes);

#endif
