/* studio.h - frames of several runs side by side on one sheet, labelled: stills and films.
 *
 *     studio *o = studio_new(&(sheet){.panels = 4, ...});
 *     int bad = studio_still(o, frames, "build/beds.png");
 *     studio_free(o);
 */
#ifndef CLAST_ASPECT_STUDIO_H
#define CLAST_ASPECT_STUDIO_H

#include "experiments/run/results.h"

enum { PANELS_MAX = 4 };

typedef enum sheet_colour {
    SHEET_AXIS,   /* direction of the chains; spheres have none */
    SHEET_SPEED,  /* viridis, from 0 to `fastest` */
    SHEET_BANDS,  /* of the fastest above the bottom, as A00 Fig. 5.18 */
    SHEET_FORCES, /* contacts as lines, as wide as their normal force; the frames must have them */
} sheet_colour;

typedef struct sheet {
    int panels;
    double low, high;  /* heights that are shown, in widths of the hopper */
    double half_width; /* m */
    int panel_px;      /* width of a panel */
    bool closed;       /* the orifice is */
    sheet_colour colour;
    double fastest; /* m/s, top of the scale of SHEET_SPEED */
    const char *titles[PANELS_MAX];
} sheet;

typedef struct studio studio;

/* NULL when nothing can be drawn on this machine (said on stderr). All below return 0, or 4. */
studio *studio_new(const sheet *s);
void studio_free(studio *o);

/* A panel without a frame (NULL) stays empty. */
int studio_still(studio *o, const frame *const *frames, const char *path);

int studio_film_begin(studio *o, const char *folder);
int studio_film_frame(studio *o, const frame *const *frames);
int studio_film_end(studio *o, const char *path); /* without ffmpeg: the pictures alone */

#endif
