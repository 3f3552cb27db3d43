/* bed.h: a dense bed of spheres for tests and benchmarks: a close packing with jitter, as loose as
 * a poured bed, deterministic, in plain arrays. Positions depend on a frame number, so that a
 * sequence moves a little. */
#ifndef TESTS_RENDER_BED_H
#define TESTS_RENDER_BED_H

#include "render/render.h"

typedef struct bed {
    size_t count;
    double *x, *y, *z, *radius, *speed;
    int32_t *body;
    render_rgb *colour;
} bed;

/* nx * ny * nz spheres of about 10 mm across; `per_body` neighbours along x share a body. Stops the
 * program if there is no memory. */
bed bed_new(int nx, int ny, int nz, int per_body);

/* Moves the spheres to where they are in that frame, and sets their speeds, m/s. */
void bed_move(bed *b, int frame);

/* The columns as a scene of spheres. */
render_scene bed_scene(const bed *b);
void bed_free(bed *b);

#endif
