/* picture.h - one frame of a run as a picture: joins what the run stored with what render/ draws.
 */
#ifndef CLAST_COMMAND_PICTURE_H
#define CLAST_COMMAND_PICTURE_H

#include "experiments/run/results.h"
#include "render/render.h"

typedef struct picture_options {
    render_preset preset;
    const char *backend;
    int width, height;
    colour_by colour;
    render_map map;
    double speed_max;       /* m/s; 0 takes the fastest of each frame */
    const uint32_t *marked; /* ids of bodies drawn in black */
    int marked_count;
    bool forces; /* an arrow for every contact, where the run kept them */
} picture_options;

typedef struct painter painter;

/* NULL after a message on standard error. */
painter *painter_new(results *r, const picture_options *o);
void painter_free(painter *p);

/* Draws frame i and hands picture and labels to the encoder; false after a message. */
bool painter_draw(painter *p, size_t i, render_encoder *encoder);

const char *painter_backend(const painter *p);

#endif
