/* Pictures against geometry: silhouettes, depth order, outlines, the cull, walls and lines; and
 * scenes that are refused. */
#include "tests/render/check.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

static bool is_white(const uint8_t *pixel) {
    return pixel[0] == 255 && pixel[1] == 255 && pixel[2] == 255;
}

static int count_drawn(const render_image *image) {
    int count = 0;
    for (int y = 0; y < image->height; y++)
        for (int x = 0; x < image->width; x++) count += !is_white(check_pixel(image, x, y));
    return count;
}

static render_scene one_sphere(double *place) {
    return (render_scene){.spheres = {1, place, place + 1, place + 2, place + 3, NULL, NULL}};
}

static void orthographic_silhouette_is_a_circle(void **state) {
    (void)state;
    double place[4] = {0.0317, -0.0211, 0.3, 0.0873}; /* awkward on purpose */
    render_scene scene = one_sphere(place);
    render_camera camera = check_front_camera(0.3);
    render_image image = {0};
    check_draw(RENDER_DRAFT, 0, true, &scene, &camera, 401, 301, &image);
    double scale = 301 / 0.3, radius = place[3] * scale;
    double cx = 200.5 + place[0] * scale, cy = 150.5 + place[1] * scale;
    for (int y = 0; y < image.height; y++)
        for (int x = 0; x < image.width; x++) {
            double away = hypot(x + 0.5 - cx, y + 0.5 - cy);
            if (away < radius - 0.01) assert_false(is_white(check_pixel(&image, x, y)));
            if (away > radius + 0.01) assert_true(is_white(check_pixel(&image, x, y)));
        }
    double area = PI * radius * radius;
    assert_true(fabs(count_drawn(&image) - area) < 0.003 * area);
    render_image_free(&image);
}

/* Off the axis a sphere is seen as an ellipse; its area has a closed form. */
static void perspective_silhouette_is_an_ellipse(void **state) {
    (void)state;
    double place[4] = {0.31, -0.17, 1.2, 0.21};
    render_scene scene = one_sphere(place);
    render_camera camera = {
        .projection = RENDER_PERSPECTIVE, .target = {0, 0, 1}, .up = {0, -1, 0}, .angle_deg = 50};
    render_image image = {0};
    check_draw(RENDER_DRAFT, 0, true, &scene, &camera, 640, 480, &image);
    double focal = 240 / tan(25 * PI / 180), r = place[3];
    double across = place[0] * place[0] + place[1] * place[1], z = place[2];
    double under = z * z - r * r;
    double area = PI * focal * focal * r * r * sqrt(across + under) / (under * sqrt(under));
    assert_true(fabs(count_drawn(&image) - area) < 0.003 * area);
    int wrong = 0; /* each pixel's ray meets the sphere or not */
    for (int y = 0; y < image.height; y++)
        for (int x = 0; x < image.width; x++) {
            double ray[3] = {(x + 0.5 - 320) / focal, (y + 0.5 - 240) / focal, 1};
            double rr = ray[0] * ray[0] + ray[1] * ray[1] + 1;
            double rc = ray[0] * place[0] + ray[1] * place[1] + z;
            double away = sqrt(across + z * z - rc * rc / rr); /* of the centre from the ray */
            if (fabs(away - r) < 1e-4) continue;
            wrong += (away < r) == is_white(check_pixel(&image, x, y));
        }
    assert_int_equal(wrong, 0);
    render_image_free(&image);
}

/* Depth of the sphere's surface under x, y for a camera looking along +z, or infinity. */
static double surface(const double *c, double x, double y) {
    double square = c[3] * c[3] - (x - c[0]) * (x - c[0]) - (y - c[1]) * (y - c[1]);
    return square < 0 ? HUGE_VAL : c[2] - sqrt(square);
}

static void nearer_surface_wins_where_spheres_cross(void **state) {
    (void)state;
    double red[4] = {-0.021, 0.013, 0.4, 0.07}, blue[4] = {0.033, -0.008, 0.38, 0.061};
    double x[] = {red[0], blue[0]}, y[] = {red[1], blue[1]}, z[] = {red[2], blue[2]};
    double radius[] = {red[3], blue[3]};
    render_rgb colour[] = {{255, 0, 0}, {0, 0, 255}};
    render_scene scene = {.spheres = {2, x, y, z, radius, NULL, colour}};
    render_camera camera = check_front_camera(0.3);
    render_image image = {0};
    check_draw(RENDER_DRAFT, 0, true, &scene, &camera, 300, 300, &image);
    int both = 0;
    for (int j = 0; j < 300; j++)
        for (int i = 0; i < 300; i++) {
            double wx = (i + 0.5 - 150) / 1000, wy = (j + 0.5 - 150) / 1000;
            double a = surface(red, wx, wy), b = surface(blue, wx, wy);
            if (isinf(a) || isinf(b) || fabs(a - b) < 1e-5) continue;
            const uint8_t *pixel = check_pixel(&image, i, j);
            assert_true((a < b) == (pixel[0] > pixel[2]));
            both++;
        }
    assert_true(both > 3000);
    render_image_free(&image);
}

/* H8: two ways, one answer. */
static void cull_leaves_the_bytes_identical(void **state) {
    (void)state;
    render_image culled = {0}, plain = {0};
    size_t dropped = 0;
    for (uint64_t seed = 1; seed <= 16; seed++) {
        render_scene scene = check_random_scene(seed);
        render_view view = render_view_default();
        view.projection = seed % 2 ? RENDER_PERSPECTIVE : RENDER_ORTHOGRAPHIC;
        view.direction[0] = 0.1 * (double)seed;
        render_camera camera;
        check_ok(render_camera_fit_scene(&camera, &view, &scene, 320, 240));
        if (seed % 4 == 1)
            camera.eye[1] += 0.6; /* into the heap: some behind, some around the eye */
        render_canvas *with =
            check_canvas(seed % 3 ? RENDER_DRAFT : RENDER_FINAL, 320, 240, "auto", 0.8, true);
        check_ok(render_canvas_draw(with, &scene, &camera, &culled));
        size_t drawn = render_canvas_timing(with).spheres_drawn;
        dropped += scene.spheres.count - drawn;
        render_canvas_free(with);
        check_draw(seed % 3 ? RENDER_DRAFT : RENDER_FINAL, 0.8, false, &scene, &camera, 320, 240,
                   &plain);
        if (!check_same_bytes(&culled, &plain)) fail_msg("seed %d differs", (int)seed);
    }
    assert_true(dropped > 16 * 100); /* it did do something */
    render_image_free(&culled);
    render_image_free(&plain);
}

/* How many pixels an outline darkens, for two crossing spheres. */
static int darkened(const int32_t body[2], render_preset preset, double radius_px) {
    double size = radius_px / 100; /* m; the picture has 100 px per m */
    double x[] = {-0.6 * size, 0.6 * size}, zero[] = {0, 0}, radius[] = {size, size};
    render_scene scene = {.spheres = {2, x, zero, zero, radius, body, NULL}};
    render_camera camera = check_front_camera(1);
    render_image with = {0}, without = {0};
    check_draw(preset, 1, true, &scene, &camera, 200, 100, &with);
    check_draw(preset, 0, true, &scene, &camera, 200, 100, &without);
    int count = 0; /* in the middle columns, away from the silhouette */
    for (int j = 50 - (int)(0.6 * radius_px); j < 50 + (int)(0.6 * radius_px); j++)
        for (int i = 98; i < 102; i++)
            count += check_pixel(&with, i, j)[0] < check_pixel(&without, i, j)[0];
    render_image_free(&with);
    render_image_free(&without);
    return count;
}

static void outline_parts_bodies_and_not_a_clump(void **state) {
    (void)state;
    static const int32_t CLUMP[2] = {7, 7}, APART[2] = {7, 8};
    for (int preset = RENDER_DRAFT; preset <= RENDER_FINAL; preset++) {
        assert_int_equal(darkened(CLUMP, (render_preset)preset, 40), 0);
        assert_true(darkened(APART, (render_preset)preset, 40) >= 40); /* a line 48 px long */
        assert_true(darkened(APART, (render_preset)preset, 3) > 0);
    }
    assert_int_equal(darkened(APART, RENDER_DRAFT, 0.9), 0); /* faded away */
}

static void wall_tints_and_opaque_wall_hides(void **state) {
    (void)state;
    double place[4] = {0, 0, 0, 0.05};
    double vertex[] = {-1, -1, -0.2, 1, -1, -0.2, 1, 1, -0.2, -1, 1, -0.2};
    uint32_t index[] = {0, 1, 2, 3};
    render_walls wall = {4, vertex, 1, 4, index, {0, 0, 200}, 0.25, 0, {0, 0, 0}};
    render_scene scene = one_sphere(place);
    render_camera camera = check_front_camera(0.2);
    render_image bare = {0}, tinted = {0}, hidden = {0};
    check_draw(RENDER_DRAFT, 0, true, &scene, &camera, 64, 64, &bare);
    scene.walls = &wall;
    scene.walls_count = 1;
    check_draw(RENDER_DRAFT, 0, true, &scene, &camera, 64, 64, &tinted);
    wall.opacity = 1;
    check_draw(RENDER_FINAL, 1, true, &scene, &camera, 64, 64, &hidden);
    const uint8_t *a = check_pixel(&bare, 32, 32), *b = check_pixel(&tinted, 32, 32);
    assert_true(fabs(b[0] - 0.75 * a[0]) < 2 && fabs(b[2] - 0.75 * a[2] - 50) < 2);
    for (int j = 0; j < 64; j++)
        for (int i = 0; i < 64; i++) {
            const uint8_t *p = check_pixel(&hidden, i, j);
            assert_true(p[0] == 0 && p[1] == 0 && p[2] == 200);
        }
    render_image_free(&bare);
    render_image_free(&tinted);
    render_image_free(&hidden);
}

static void line_has_its_width_and_its_place(void **state) {
    (void)state;
    double from[] = {-0.3, 0.1, 0}, to[] = {0.3, 0.1, 0}, width[] = {0.08};
    render_lines line = {.count = 1, .from = from, .to = to, .width = width, .unit = RENDER_METRES};
    render_scene scene = {.lines_count = 1, .lines = &line};
    render_camera camera = check_front_camera(1);
    render_image image = {0};
    check_draw(RENDER_FINAL, 0, true, &scene, &camera, 100, 100, &image);
    double area = 60 * 8 + PI * 16, sum = 0; /* a stadium, in pixels */
    for (int j = 0; j < 100; j++)
        for (int i = 0; i < 100; i++) {
            sum += (255 - check_pixel(&image, i, j)[0]) / (255.0 - 40);
            if (j < 55 || j > 64) assert_true(is_white(check_pixel(&image, i, j)));
        }
    assert_true(fabs(sum - area) < 0.01 * area);
    render_image_free(&image);
}

static void empty_scene_is_the_background(void **state) {
    (void)state;
    render_scene scene = {0};
    render_camera camera = check_front_camera(1);
    render_image image = {0};
    check_draw(RENDER_FINAL, 1, true, &scene, &camera, 33, 17, &image);
    assert_int_equal(count_drawn(&image), 0);
    render_image_free(&image);
}

static void bad_scenes_are_refused(void **state) {
    (void)state;
    double x[3] = {0, 1, 2}, y[3] = {0, 0, 0}, z[3] = {0, 0, 0}, r[3] = {1, 1, 1};
    int32_t body[3] = {0, 1, -1};
    uint32_t index[3] = {0, 1, 3};
    double vertex[9] = {0};
    render_walls wall = {3, vertex, 1, 3, index, {0, 0, 0}, 0.5, 0, {0, 0, 0}};
    render_scene scene = {.spheres = {3, x, y, z, r, NULL, NULL}};
    render_camera camera = check_front_camera(4);
    render_image image = {0};
    render_canvas *canvas = check_canvas(RENDER_DRAFT, 32, 32, "auto", 0, true);
    y[1] = NAN;
    check_refused(render_canvas_draw(canvas, &scene, &camera, &image), RENDER_ERR_ARGUMENT,
                  "y of sphere 1");
    y[1] = 0;
    r[2] = 0;
    check_refused(render_canvas_draw(canvas, &scene, &camera, &image), RENDER_ERR_ARGUMENT,
                  "radius of sphere 2");
    r[2] = 1;
    scene.spheres.body = body;
    check_refused(render_canvas_draw(canvas, &scene, &camera, &image), RENDER_ERR_ARGUMENT,
                  "body of sphere 2");
    scene = (render_scene){.walls_count = 1, .walls = &wall};
    check_refused(render_canvas_draw(canvas, &scene, &camera, &image), RENDER_ERR_ARGUMENT,
                  "names vertex 3");
    scene = (render_scene){0};
    camera.height_m = 0;
    check_refused(render_canvas_draw(canvas, &scene, &camera, &image), RENDER_ERR_ARGUMENT,
                  "height");
    render_canvas_free(canvas);
    render_image_free(&image);
    render_canvas_def def = render_canvas_default(RENDER_DRAFT);
    def.height = 0;
    check_refused(render_canvas_new(&def, &canvas), RENDER_ERR_ARGUMENT, "1280 x 0");
    check_refused(render_image_resize(&image, 10, -1), RENDER_ERR_ARGUMENT, "10 x -1");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(orthographic_silhouette_is_a_circle),
        cmocka_unit_test(perspective_silhouette_is_an_ellipse),
        cmocka_unit_test(nearer_surface_wins_where_spheres_cross),
        cmocka_unit_test(cull_leaves_the_bytes_identical),
        cmocka_unit_test(outline_parts_bodies_and_not_a_clump),
        cmocka_unit_test(wall_tints_and_opaque_wall_hides),
        cmocka_unit_test(line_has_its_width_and_its_place),
        cmocka_unit_test(empty_scene_is_the_background),
        cmocka_unit_test(bad_scenes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
