/* Draws two hundred spheres from plain arrays, coloured by height, with a colour bar. Usage:
 * example FILE.png. Needs nothing but render/render.h. */
#include "render/render.h"

#include <math.h>
#include <stdio.h>

enum { COUNT = 200 };

int main(int argc, char **argv) {
    static double x[COUNT], y[COUNT], z[COUNT], radius[COUNT];
    static render_rgb colour[COUNT];
    for (int i = 0; i < COUNT; i++) { /* a spiral up a cone */
        double angle = 0.37 * i, reach = 0.05 * (1 - i / (COUNT + 40.0));
        x[i] = reach * cos(angle);
        y[i] = reach * sin(angle);
        z[i] = 0.0005 * i;
        radius[i] = 0.006 - 0.00002 * i;
    }
    render_colour_map(RENDER_VIRIDIS, z, COUNT, 0, 0.1, colour);
    render_scene scene = {
        .spheres = {.count = COUNT, .x = x, .y = y, .z = z, .radius = radius, .colour = colour}};
    render_overlay overlay = {.title = "A cone of spheres",
                              .bar_shown = true,
                              .bar_high = 0.1,
                              .bar_title = "height",
                              .bar_unit = "m"};
    render_canvas_def def = render_canvas_default(RENDER_FINAL);
    render_view view = render_view_default();
    view.projection = RENDER_PERSPECTIVE;
    view.direction[2] = -0.5; /* a little from above */

    render_canvas *canvas = NULL;
    render_font *font = NULL;
    render_camera camera;
    render_image image = {0};
    bool ok =
        render_font_open(NULL, &font) == RENDER_OK &&
        render_overlay_margins(font, &overlay, def.width, def.height, &view.margins) == RENDER_OK &&
        render_camera_fit_scene(&camera, &view, &scene, def.width, def.height) == RENDER_OK &&
        render_canvas_new(&def, &canvas) == RENDER_OK &&
        render_canvas_draw(canvas, &scene, &camera, &image) == RENDER_OK &&
        render_overlay_draw(font, &overlay, &image) == RENDER_OK &&
        render_png_write(argc > 1 ? argv[1] : "cone.png", &image, NULL, 0) == RENDER_OK;
    if (!ok) fprintf(stderr, "%s: %s\n", argv[0], render_error_text());
    render_image_free(&image);
    render_canvas_free(canvas);
    render_font_close(font);
    return ok ? 0 : 1;
}
