/* arrows.h - the forces at the contacts of a frame as arrows. */
#ifndef CLAST_COMMAND_ARROWS_H
#define CLAST_COMMAND_ARROWS_H

#include "experiments/run/results.h"
#include "render/render.h"

typedef struct arrows {
    render_lines lines;
    double *ends; /* what lines point to: from, to, widths */
    render_rgb *colour;
} arrows;

/* Lengths and colours go with the root of the force, since few contacts carry most of the load; the
 * longest is five mean radii. Nothing where the frame has no contacts. */
void arrows_make(arrows *a, const frame *f, const render_camera *camera, render_map map);
void arrows_free(arrows *a);

#endif
