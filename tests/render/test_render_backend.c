/* The same bytes from both backends, on every run and for any number of threads. Called with the
 * argument "hash" it prints a hash of one picture, for the test that runs it with other settings.
 */
#include "tests/render/check.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *self; /* the path of this program */

static void draw_heap(const char *backend, uint64_t seed, render_image *image) {
    render_scene scene = check_random_scene(seed);
    render_view view = render_view_default();
    view.projection = seed % 2 ? RENDER_PERSPECTIVE : RENDER_ORTHOGRAPHIC;
    view.direction[2] = -0.5;
    render_camera camera;
    check_ok(render_camera_fit_scene(&camera, &view, &scene, 480, 360));
    render_preset preset = seed % 4 < 2 ? RENDER_DRAFT : RENDER_FINAL;
    render_canvas *canvas = check_canvas(preset, 480, 360, backend, 0.8, true);
    assert_true(strcmp(backend, "auto") == 0 ||
                strcmp(render_canvas_backend(canvas), backend) == 0);
    check_ok(render_canvas_draw(canvas, &scene, &camera, image));
    render_canvas_free(canvas);
}

static void osmesa_and_egl_agree(void **state) {
    (void)state;
    render_image a = {0}, b = {0};
    for (uint64_t seed = 1; seed <= 4; seed++) {
        draw_heap("osmesa", seed, &a);
        draw_heap("egl", seed, &b);
        if (!check_same_bytes(&a, &b)) fail_msg("seed %d differs", (int)seed);
    }
    render_image_free(&a);
    render_image_free(&b);
}

/* Two canvases of different kinds, drawn in turns, must not disturb each other. */
static void both_backends_live_side_by_side(void **state) {
    (void)state;
    render_scene scene = check_random_scene(9);
    render_view view = render_view_default();
    render_camera camera;
    check_ok(render_camera_fit_scene(&camera, &view, &scene, 160, 120));
    render_canvas *a = check_canvas(RENDER_DRAFT, 160, 120, "osmesa", 0.5, true);
    render_canvas *b = check_canvas(RENDER_DRAFT, 160, 120, "egl", 0.5, true);
    render_image first = {0}, image = {0};
    check_ok(render_canvas_draw(a, &scene, &camera, &first));
    for (int turn = 0; turn < 4; turn++) {
        check_ok(render_canvas_draw(turn % 2 ? a : b, &scene, &camera, &image));
        assert_true(check_same_bytes(&first, &image));
    }
    render_canvas_free(a);
    check_ok(render_canvas_draw(b, &scene, &camera, &image));
    assert_true(check_same_bytes(&first, &image));
    render_canvas_free(b);
    render_image_free(&first);
    render_image_free(&image);
}

static uint64_t hash_of(const render_image *image) {
    uint64_t hash = 0xcbf29ce484222325u; /* FNV-1a */
    for (size_t i = 0; i < 3 * (size_t)image->width * (size_t)image->height; i++)
        hash = (hash ^ image->rgb[i]) * 0x100000001b3u;
    return hash;
}

static uint64_t hash_elsewhere(const char *threads) {
    char command[4200];
    char line[64] = "";
    assert_int_equal(setenv("LP_NUM_THREADS", threads, 1), 0);
    snprintf(command, sizeof command, "'%s' hash", self);
    FILE *child = popen(command, "r");
    assert_non_null(child);
    assert_non_null(fgets(line, sizeof line, child));
    assert_int_equal(pclose(child), 0);
    unsetenv("LP_NUM_THREADS");
    return strtoull(line, NULL, 16);
}

static void bytes_do_not_depend_on_threads_or_runs(void **state) {
    (void)state;
    render_canvas_free(check_canvas(RENDER_DRAFT, 8, 8, "auto", 0, true)); /* or skip */
    uint64_t one = hash_elsewhere("1");
    assert_true(one != 0);
    assert_true(one == hash_elsewhere("2"));
    assert_true(one == hash_elsewhere("3"));
    assert_true(one == hash_elsewhere("1"));
}

static int print_hash(void) {
    render_image image = {0};
    draw_heap("auto", 3, &image);
    printf("%016" PRIx64 "\n", hash_of(&image));
    render_image_free(&image);
    return 0;
}

static void unknown_backend_is_named(void **state) {
    (void)state;
    render_canvas_def def = render_canvas_default(RENDER_DRAFT);
    def.backend = "vulkan";
    render_canvas *canvas = NULL;
    check_refused(render_canvas_new(&def, &canvas), RENDER_ERR_ARGUMENT, "vulkan");
    assert_null(canvas);
}

int main(int argc, char **argv) {
    self = argv[0];
    if (argc > 1 && strcmp(argv[1], "hash") == 0) return print_hash();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(osmesa_and_egl_agree),
        cmocka_unit_test(both_backends_live_side_by_side),
        cmocka_unit_test(bytes_do_not_depend_on_threads_or_runs),
        cmocka_unit_test(unknown_backend_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
