/* text.h: lines of text on an image. text.c is the only file that knows FreeType. */
#ifndef RENDER_TEXT_H
#define RENDER_TEXT_H

#include "render/render.h"

typedef struct render_ink {
    render_rgb ink, halo; /* the halo keeps text legible over particles */
} render_ink;

typedef struct render_style {
    int px;    /* font size */
    bool bold; /* ordinary if the font has no bold face */
} render_style;

/* Width of the line in pixels; RENDER_ERR_UNAVAILABLE if FreeType cannot draw it. */
render_status render_text_measure(render_font *font, render_style style, const char *text,
                                  int *width);

/* Left end of the baseline at x, y; clipped at the borders of the image. */
render_status render_text_draw(render_font *font, render_style style, const char *text, int x,
                               int y, render_ink ink, render_image *image);

#endif
