#include "tests/render/check.h"

#include <string.h>

void check_ok(render_status status) {
    if (status != RENDER_OK) fail_msg("%s: %s", render_status_name(status), render_error_text());
}

void check_refused(render_status status, render_status wanted, const char *part) {
    if (status != wanted)
        fail_msg("%s instead of %s", render_status_name(status), render_status_name(wanted));
    if (!strstr(render_error_text(), part))
        fail_msg("the message lacks \"%s\": %s", part, render_error_text());
}

render_canvas *check_canvas(render_preset preset, int width, int height, const char *backend,
                            double outline, bool cull) {
    render_canvas_def def = render_canvas_default(preset);
    def.width = width;
    def.height = height;
    def.outline = outline;
    def.cull = cull;
    def.backend = backend;
    render_canvas *canvas = NULL;
    render_status status = render_canvas_new(&def, &canvas);
    if (status == RENDER_ERR_UNAVAILABLE) {
        print_message("skipped: %s\n", render_error_text());
        skip();
    }
    check_ok(status);
    return canvas;
}

void check_draw(render_preset preset, double outline, bool cull, const render_scene *scene,
                const render_camera *camera, int width, int height, render_image *image) {
    render_canvas *canvas = check_canvas(preset, width, height, "auto", outline, cull);
    check_ok(render_canvas_draw(canvas, scene, camera, image));
    render_canvas_free(canvas);
}

bool check_same_bytes(const render_image *a, const render_image *b) {
    return a->width == b->width && a->height == b->height &&
           memcmp(a->rgb, b->rgb, 3 * (size_t)a->width * (size_t)a->height) == 0;
}

render_camera check_front_camera(double height) {
    return (render_camera){.projection = RENDER_ORTHOGRAPHIC,
                           .eye = {0, 0, -1},
                           .target = {0, 0, 0},
                           .up = {0, -1, 0},
                           .height_m = height};
}

double check_random(uint64_t *state) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

enum { HEAP = 500, STROKES = 20 };

render_scene check_random_scene(uint64_t seed) {
    static double x[HEAP], y[HEAP], z[HEAP], radius[HEAP], vertex[9], from[3 * STROKES],
        to[3 * STROKES];
    static int32_t body[HEAP];
    static render_rgb colour[HEAP];
    static const uint32_t index[3] = {0, 1, 2};
    static render_walls walls;
    static render_lines lines;
    uint64_t s = seed;
    for (int i = 0; i < HEAP; i++) {
        x[i] = check_random(&s) - 0.5;
        y[i] = check_random(&s) - 0.5;
        z[i] = check_random(&s) - 0.5;
        radius[i] = 0.01 + 0.12 * check_random(&s) * check_random(&s);
        body[i] = i / 3;
        for (int k = 0; k < 3; k++) (&colour[i].r)[k] = (uint8_t)(255 * check_random(&s));
    }
    for (int i = 0; i < 9; i++) vertex[i] = check_random(&s) - 0.5;
    for (int i = 0; i < 3 * STROKES; i++) {
        from[i] = check_random(&s) - 0.5;
        to[i] = check_random(&s) - 0.5;
    }
    walls = (render_walls){3, vertex, 1, 3, index, {90, 120, 150}, 0.3, 1.5, {20, 20, 20}};
    lines = (render_lines){.count = STROKES, .from = from, .to = to, .on_top = seed % 2 == 0};
    return (render_scene){.spheres = {HEAP, x, y, z, radius, body, colour},
                          .walls_count = 1,
                          .walls = &walls,
                          .lines_count = 1,
                          .lines = &lines};
}

const uint8_t *check_pixel(const render_image *image, int x, int y) {
    assert_in_range(x, 0, image->width - 1);
    assert_in_range(y, 0, image->height - 1);
    return image->rgb + 3 * ((size_t)y * (size_t)image->width + (size_t)x);
}
