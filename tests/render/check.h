/* check.h: what the tests of render/ share: cmocka, and drawing a scene or failing with the
 * message. */
#ifndef TESTS_RENDER_CHECK_H
#define TESTS_RENDER_CHECK_H

/* cmocka.h needs these before it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "render/render.h"

/* Fails the test with the message of the library. */
void check_ok(render_status status);

/* Fails the test unless the status is the wanted one and the message holds `part`. */
void check_refused(render_status status, render_status wanted, const char *part);

/* A canvas of that size without outline; skips the test if the backend is not on this machine. */
render_canvas *check_canvas(render_preset preset, int width, int height, const char *backend,
                            double outline, bool cull);

/* Draws with a new canvas ("auto") and frees it. */
void check_draw(render_preset preset, double outline, bool cull, const render_scene *scene,
                const render_camera *camera, int width, int height, render_image *image);

bool check_same_bytes(const render_image *a, const render_image *b);

/* Looks along +z at the xy plane: x to the right, y down; `height` m span the picture. */
render_camera check_front_camera(double height);

/* A repeatable number in [0, 1). */
double check_random(uint64_t *state);

/* A random heap of spheres, walls and lines; memory is static, so one at a time. */
render_scene check_random_scene(uint64_t seed);

const uint8_t *check_pixel(const render_image *image, int x, int y);

#endif
