/* What needs no OpenGL: colours, cameras, overlays, and refusals of bad input. */
#include "tests/render/check.h"

#include <math.h>
#include <stdlib.h>

static void check_rgb(render_rgb c, int r, int g, int b, int tolerance) {
    if (abs(c.r - r) > tolerance || abs(c.g - g) > tolerance || abs(c.b - b) > tolerance)
        fail_msg("%d %d %d instead of %d %d %d", c.r, c.g, c.b, r, g, b);
}

static void maps_start_at_a_tenth_and_get_lighter(void **state) {
    (void)state;
    check_rgb(render_map_at(RENDER_VIRIDIS, 0), 72, 36, 117, 3); /* the map's own value at 0.1 */
    check_rgb(render_map_at(RENDER_VIRIDIS, 1), 253, 231, 37, 1);
    check_rgb(render_map_at(RENDER_CIVIDIS, 1), 254, 232, 56, 1);
    check_rgb(render_map_at(RENDER_CIVIDIS, 7), 254, 232, 56, 1);
    check_rgb(render_map_at(RENDER_VIRIDIS, NAN), 128, 128, 128, 0);
    for (int map = RENDER_VIRIDIS; map <= RENDER_CIVIDIS; map++) {
        double before = 0;
        for (int i = 0; i <= 100;
             i++) { /* lightness rises all the way, so grey prints can be read */
            render_rgb c = render_map_at((render_map)map, i / 100.0);
            double luma = 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
            assert_true(luma > before - 0.5);
            before = luma;
        }
    }
}

static void bands_split_at_30_and_70_per_cent(void **state) {
    (void)state;
    double speed[] = {0, 0.299, 0.3, -0.7, 0.701, 1};
    render_rgb rgb[6];
    render_colour_bands(speed, 6, 1, rgb);
    static const int BAND[] = {0, 0, 1, 1, 2, 2};
    for (int i = 0; i < 6; i++)
        assert_memory_equal(&rgb[i], &RENDER_BAND_TINT[BAND[i]], sizeof *rgb);
    render_colour_bands(speed, 6, 0, rgb);
    assert_memory_equal(&rgb[5], &RENDER_BAND_TINT[0], sizeof *rgb);
    assert_true(RENDER_BAND_TINT[0].r > RENDER_BAND_TINT[0].b); /* slow is red, fast is green */
    assert_true(RENDER_BAND_TINT[2].g > RENDER_BAND_TINT[2].r);
}

static void stripes_and_bodies_alternate(void **state) {
    (void)state;
    double height[] = {-1, 0.1, 0.3, 0.6, 0.9, 2};
    render_rgb rgb[6], tint[40], spread[3];
    render_colour_stripes(height, 6, 0, 1, 4, rgb);
    assert_memory_equal(&rgb[0], &rgb[1], sizeof *rgb);
    assert_memory_not_equal(&rgb[1], &rgb[2], sizeof *rgb);
    assert_memory_equal(&rgb[1], &rgb[3], sizeof *rgb);
    assert_memory_equal(&rgb[4], &rgb[5], sizeof *rgb);
    int32_t id[40];
    for (int i = 0; i < 40; i++) id[i] = i;
    render_colour_bodies(id, 40, tint);
    for (int i = 1; i < 40; i++) assert_memory_not_equal(&tint[i], &tint[i - 1], sizeof *tint);
    static const int32_t BODY[] = {2, 0, 2};
    render_colour_spread(tint, 40, BODY, 3, spread);
    assert_memory_equal(&spread[0], &tint[2], sizeof *tint);
    assert_memory_equal(&spread[1], &tint[0], sizeof *tint);
}

static void scale_of_a_map_is_linear(void **state) {
    (void)state;
    double value[] = {2, 3, 4, 5};
    render_rgb rgb[4], want = render_map_at(RENDER_VIRIDIS, 0.5);
    render_colour_map(RENDER_VIRIDIS, value, 4, 2, 4, rgb);
    assert_memory_equal(&rgb[1], &want, sizeof want);
    assert_memory_equal(&rgb[2], &rgb[3], sizeof want);
}

/* Every corner of the box inside the margins, and touching them in one direction. */
static void check_fit(render_projection projection) {
    double low[] = {-0.31, 0.02, 0.1}, high[] = {0.27, 0.4, 0.9};
    render_view view = render_view_default();
    view.projection = projection;
    view.direction[0] = 0.37;
    view.direction[2] = -0.21;
    view.margins = (render_margins){31, 140, 47, 63};
    render_camera camera;
    check_ok(render_camera_fit(&camera, &view, low, high, 900, 700));
    double x0 = 1e9, x1 = -1e9, y0 = 1e9, y1 = -1e9;
    for (int corner = 0; corner < 8; corner++) {
        double point[3], pixel[2], depth;
        for (int k = 0; k < 3; k++) point[k] = corner >> k & 1 ? high[k] : low[k];
        assert_true(render_camera_project(&camera, 900, 700, point, pixel, &depth));
        assert_true(depth > 0);
        x0 = fmin(x0, pixel[0]);
        x1 = fmax(x1, pixel[0]);
        y0 = fmin(y0, pixel[1]);
        y1 = fmax(y1, pixel[1]);
    }
    assert_true(x0 > 31 - 1e-6 && x1 < 760 + 1e-6 && y0 > 47 - 1e-6 && y1 < 637 + 1e-6);
    assert_true(fabs(y1 - y0 - 590) < 1e-6 || fabs(x1 - x0 - 729) < 1e-6);
    assert_true(fabs(x0 - 31 - (760 - x1)) < 1e-6 && fabs(y0 - 47 - (637 - y1)) < 1e-6);
}

static void fitted_box_fills_the_margins(void **state) {
    (void)state;
    check_fit(RENDER_ORTHOGRAPHIC);
    check_fit(RENDER_PERSPECTIVE);
}

static void camera_scale_is_pixels_per_metre(void **state) {
    (void)state;
    render_camera camera = check_front_camera(0.4);
    assert_true(fabs(render_camera_scale(&camera, 720) - 1800) < 1e-9);
    camera.projection = RENDER_PERSPECTIVE;
    camera.angle_deg = 90;
    assert_true(fabs(render_camera_scale(&camera, 720) - 360) < 1e-9); /* 2 m high at 1 m */
}

static void bad_cameras_are_refused(void **state) {
    (void)state;
    double low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
    render_view view = render_view_default();
    render_camera camera;
    check_refused(render_camera_fit(&camera, &view, low, high, 0, 10), RENDER_ERR_ARGUMENT,
                  "0 x 10");
    check_refused(render_camera_fit(&camera, &view, low, high, 40, 40), RENDER_ERR_ARGUMENT,
                  "margins");
    view.up[2] = 0;
    view.up[1] = 2;
    check_refused(render_camera_fit(&camera, &view, low, high, 100, 100), RENDER_ERR_ARGUMENT,
                  "up");
    view = render_view_default();
    high[1] = NAN;
    check_refused(render_camera_fit(&camera, &view, low, high, 100, 100), RENDER_ERR_ARGUMENT,
                  "axis 1");
    view.projection = RENDER_PERSPECTIVE;
    view.angle_deg = 180;
    high[1] = 1;
    check_refused(render_camera_fit(&camera, &view, low, high, 100, 100), RENDER_ERR_ARGUMENT,
                  "180");
}

static void overlay_stays_in_its_margins(void **state) {
    (void)state;
    render_font *font = NULL;
    check_ok(render_font_open(NULL, &font));
    render_overlay o = {.title = "A title \xc2\xb5",
                        .time_shown = true,
                        .time_s = -0.5,
                        .time_decimals = 1,
                        .scale_px_per_m = 1000,
                        .bar_shown = true,
                        .bar_low = -2e-6,
                        .bar_high = 3e-6,
                        .bar_title = "force",
                        .bar_unit = "N"};
    render_overlay_bands(&o, 0.123);
    render_margins m;
    render_image image = {0};
    check_ok(render_overlay_margins(font, &o, 640, 480, &m));
    check_ok(render_image_resize(&image, 640, 480));
    check_ok(render_overlay_draw(font, &o, &image));
    int written = 0;
    for (int y = 0; y < 480; y++)
        for (int x = 0; x < 640; x++) {
            bool inside = x >= m.left && x < 640 - m.right && y >= m.top && y < 480 - m.bottom;
            bool white = check_pixel(&image, x, y)[0] == 255 && check_pixel(&image, x, y)[1] == 255;
            if (inside) assert_true(white);
            written += !white;
        }
    assert_true(written > 1000);
    render_image_free(&image);
    render_font_close(font);
}

static void bad_overlays_are_refused(void **state) {
    (void)state;
    render_font *font = NULL;
    render_image image = {0};
    render_overlay o = {.bar_shown = true, .bar_low = 1, .bar_high = 1};
    check_refused(render_font_open("/nowhere/none.ttf", &font), RENDER_ERR_UNAVAILABLE, "none.ttf");
    check_ok(render_font_open(NULL, &font));
    check_refused(render_overlay_draw(font, &o, &image), RENDER_ERR_ARGUMENT, "empty");
    check_ok(render_image_resize(&image, 64, 64));
    check_refused(render_overlay_draw(font, &o, &image), RENDER_ERR_ARGUMENT, "colour bar");
    o = (render_overlay){.time_shown = true, .time_s = NAN};
    check_refused(render_overlay_draw(font, &o, &image), RENDER_ERR_ARGUMENT, "nan");
    o = (render_overlay){.title =
                             "\xff\xc3 broken UTF-8 \xe2\x88"}; /* drawn somehow, never a crash */
    check_ok(render_overlay_draw(font, &o, &image));
    render_image_free(&image);
    render_font_close(font);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(maps_start_at_a_tenth_and_get_lighter),
        cmocka_unit_test(bands_split_at_30_and_70_per_cent),
        cmocka_unit_test(stripes_and_bodies_alternate),
        cmocka_unit_test(scale_of_a_map_is_linear),
        cmocka_unit_test(fitted_box_fills_the_margins),
        cmocka_unit_test(camera_scale_is_pixels_per_metre),
        cmocka_unit_test(bad_cameras_are_refused),
        cmocka_unit_test(overlay_stays_in_its_margins),
        cmocka_unit_test(bad_overlays_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
