/* resolve.h: from drawn samples to final pixels, on the CPU: it is a few integer operations per
 * sample, which llvmpipe would spend on fetching neighbours. Exact, so it gives the same bytes
 * everywhere. */
#ifndef RENDER_RESOLVE_H
#define RENDER_RESOLVE_H

#include "render/render.h"

typedef struct render_samples {
    int width, height; /* samples; the picture's size times `per_pixel` */
    int per_pixel;     /* 1 or 2, in each direction */
    const uint32_t
        *rgba; /* rows from the bottom; red in the low byte, outline darkness in the high */
    const uint32_t *body; /* 0: background */
    uint32_t *scratch;    /* 4 * width */
} render_samples;

/* Darkens samples where the body changes and averages them into the image, which has the final
 * size. */
void render_resolve(const render_samples *samples, render_image *image);

#endif
