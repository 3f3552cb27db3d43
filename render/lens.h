/* lens.h: a camera made ready: an orthonormal frame and the map from it to pixels. */
#ifndef RENDER_LENS_H
#define RENDER_LENS_H

#include "render/render.h"

/* View coordinates: x to the right, y up, z = distance in front of the eye along the line of sight.
 * Pixels: from the bottom left, as OpenGL counts them. */
typedef struct render_lens {
    bool perspective;
    int width, height;                        /* pixels drawn (picture pixels times samples) */
    double eye[3], right[3], up[3], ahead[3]; /* unit vectors */
    double scale;                             /* pixels per metre; perspective: at z = 1 */
    double centre_x, centre_y;                /* pixel that the line of sight falls on */
} render_lens;

render_status render_lens_make(render_lens *lens, const render_camera *camera, int width,
                               int height);

static inline void render_lens_view(const render_lens *lens, double x, double y, double z,
                                    double view[3]) {
    double dx = x - lens->eye[0], dy = y - lens->eye[1], dz = z - lens->eye[2];
    view[0] = dx * lens->right[0] + dy * lens->right[1] + dz * lens->right[2];
    view[1] = dx * lens->up[0] + dy * lens->up[1] + dz * lens->up[2];
    view[2] = dx * lens->ahead[0] + dy * lens->ahead[1] + dz * lens->ahead[2];
}

/* Pixels per metre at that depth; z > 0 if perspective. */
static inline double render_lens_scale(const render_lens *lens, double z) {
    return lens->perspective ? lens->scale / z : lens->scale;
}

#endif
