/* What reaches the disk: PNG files with metadata, the background encoder, animations, and every way
 * in which writing can fail. */
#include "tests/render/check.h"

#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[64];
static char path_text[4][256];

/* A path in the folder of this test; the last four stay valid. */
static const char *in_folder(const char *name) {
    static int turn;
    char *text = path_text[turn = (turn + 1) % 4];
    snprintf(text, sizeof path_text[0], "%s/%s", folder, name);
    return text;
}

static int make_folder(void **state) {
    (void)state;
    snprintf(folder, sizeof folder, "render-files-%ld", (long)getpid()); /* below the build */
    return mkdir(folder, 0777);
}

static int remove_folder(void **state) {
    (void)state;
    char command[128];
    snprintf(command, sizeof command, "rm -r '%s'", folder); /* the name is ours */
    return system(command);
}

static bool exists(const char *path) {
    struct stat info;
    return lstat(path, &info) == 0;
}

/* Every pixel tells its place, so that a flip or a swap of channels shows. */
static void paint(render_image *image, int width, int height, int seed) {
    check_ok(render_image_resize(image, width, height));
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            uint8_t *p = image->rgb + 3 * ((size_t)y * (size_t)width + (size_t)x);
            p[0] = (uint8_t)(x + seed);
            p[1] = (uint8_t)(y * 2);
            p[2] = (uint8_t)(x * y + seed * 7);
        }
}

/* Reads with libpng; the caller frees the image. */
static render_image read_png(const char *path) {
    png_image png = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_file(&png, path)) fail_msg("%s: %s", path, png.message);
    png.format = PNG_FORMAT_RGB;
    render_image image = {0};
    check_ok(render_image_resize(&image, (int)png.width, (int)png.height));
    assert_true(png_image_finish_read(&png, NULL, image.rgb, 0, NULL));
    return image;
}

static void png_round_trip(void **state) {
    (void)state;
    render_image image = {0};
    paint(&image, 123, 77, 5);
    check_ok(render_png_write(in_folder("round.png"), &image, NULL, 0));
    render_image back = read_png(in_folder("round.png"));
    assert_true(check_same_bytes(&image, &back));
    assert_false(exists(in_folder("round.png.part")));
    render_image_free(&image);
    render_image_free(&back);
}

/* The text of a key, read the long way (the simple interface of libpng drops it). */
static void read_tag(const char *path, const char *key, char *out, size_t size) {
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_read_info(png, info);
    png_textp text = NULL;
    int count = 0;
    png_get_text(png, info, &text, &count);
    out[0] = '\0';
    for (int i = 0; i < count; i++)
        if (strcmp(text[i].key, key) == 0) snprintf(out, size, "%s", text[i].text);
    png_destroy_read_struct(&png, &info, NULL);
    fclose(file);
}

static void metadata_round_trip(void **state) {
    (void)state;
    render_image image = {0};
    char text[128];
    static const render_tag TAGS[] = {
        {"Title", "Discharge, 10 cm"}, {"Scene", "hash: 0x1234"}, {"Comment", "d = 10 \xc2\xb5m"}};
    paint(&image, 8, 8, 1);
    check_ok(render_png_write(in_folder("tags.png"), &image, TAGS, 3));
    for (int i = 0; i < 3; i++) {
        read_tag(in_folder("tags.png"), TAGS[i].key, text, sizeof text);
        assert_string_equal(text, TAGS[i].text);
    }
    static const render_tag NAMELESS[] = {{"", "x"}};
    check_refused(render_png_write(in_folder("bad.png"), &image, NAMELESS, 1), RENDER_ERR_ARGUMENT,
                  "key");
    assert_false(exists(in_folder("bad.png")));
    render_image_free(&image);
}

static void failed_write_leaves_the_old_file(void **state) {
    (void)state;
    render_image image = {0}, other = {0};
    paint(&image, 64, 64, 1);
    paint(&other, 600, 400, 2);
    check_ok(render_png_write(in_folder("keep.png"), &image, NULL, 0));
    /* The temporary file leads to a device that is always full. */
    assert_int_equal(symlink("/dev/full", in_folder("keep.png.part")), 0);
    check_refused(render_png_write(in_folder("keep.png"), &other, NULL, 0), RENDER_ERR_FILE,
                  "No space left");
    assert_false(exists(in_folder("keep.png.part")));
    render_image back = read_png(in_folder("keep.png"));
    assert_true(check_same_bytes(&image, &back));
    check_refused(render_png_write(in_folder("none/x.png"), &image, NULL, 0), RENDER_ERR_FILE,
                  "No such file");
    check_refused(render_png_write(in_folder("keep.png/x.png"), &image, NULL, 0), RENDER_ERR_FILE,
                  "Not a directory");
    render_image_free(&image);
    render_image_free(&other);
    check_refused(render_png_write(in_folder("x.png"), &image, NULL, 0), RENDER_ERR_ARGUMENT,
                  "empty");
    render_image_free(&back);
}

static void sequence_is_complete_and_in_order(void **state) {
    (void)state;
    enum { COUNT = 23, FIRST = 7 };
    render_encoder_def def = render_encoder_default();
    def.folder = folder;
    def.stem = "order";
    def.first = FIRST;
    def.queue = 2;
    render_encoder *encoder = NULL;
    render_image image = {0};
    check_ok(render_encoder_new(&def, &encoder));
    for (int i = 0; i < COUNT; i++) {
        char number[16];
        snprintf(number, sizeof number, "%d", i);
        render_tag tag = {"Number", number};
        paint(&image, 90 + i, 60, i); /* sizes differ: slots are reused */
        check_ok(render_encoder_push(encoder, &image, NULL, &tag, 1));
    }
    check_ok(render_encoder_finish(encoder));
    for (int i = 0; i < COUNT; i++) {
        char name[32], text[16], number[16];
        snprintf(name, sizeof name, "order-%06d.png", FIRST + i);
        snprintf(number, sizeof number, "%d", i);
        paint(&image, 90 + i, 60, i);
        render_image back = read_png(in_folder(name));
        assert_true(check_same_bytes(&image, &back));
        read_tag(in_folder(name), "Number", text, sizeof text);
        assert_string_equal(text, number);
        render_image_free(&back);
    }
    render_image_free(&image);
}

static void encoder_labels_like_the_caller_would(void **state) {
    (void)state;
    render_encoder_def def = render_encoder_default();
    def.folder = folder;
    def.stem = "label";
    render_encoder *encoder = NULL;
    render_font *font = NULL;
    render_image image = {0};
    render_overlay overlay = {
        .title = "Labelled", .time_shown = true, .time_s = 1.5, .time_decimals = 1};
    paint(&image, 300, 200, 3);
    check_ok(render_font_open(NULL, &font));
    check_ok(render_encoder_new(&def, &encoder));
    check_ok(render_encoder_push(encoder, &image, &overlay, NULL, 0));
    check_ok(render_overlay_draw(font, &overlay, &image));
    check_ok(render_encoder_finish(encoder));
    render_image back = read_png(in_folder("label-000000.png"));
    assert_true(check_same_bytes(&image, &back));
    render_font_close(font);
    render_image_free(&image);
    render_image_free(&back);
}

static void encoder_reports_its_failures(void **state) {
    (void)state;
    render_encoder_def def = render_encoder_default();
    render_encoder *encoder = NULL;
    render_image image = {0};
    def.folder = "/nowhere/at/all";
    check_refused(render_encoder_new(&def, &encoder), RENDER_ERR_FILE, "/nowhere/at/all");
    def.folder = folder;
    def.stem = "full";
    def.queue = 1;
    assert_int_equal(symlink("/dev/full", in_folder("full-000001.png.part")), 0);
    check_ok(render_encoder_new(&def, &encoder));
    paint(&image, 300, 200, 3);
    render_overlay overlay = {.title = "needs a font"};
    setenv("CLAST_FONT", "/nowhere/none.ttf", 1);
    check_refused(render_encoder_push(encoder, &image, &overlay, NULL, 0), RENDER_ERR_UNAVAILABLE,
                  "CLAST_FONT");
    unsetenv("CLAST_FONT");
    render_status status = RENDER_OK;
    int pushed = 0;
    while (status == RENDER_OK && pushed < 100)
        status = render_encoder_push(encoder, &image, NULL, NULL, 0), pushed++;
    check_refused(status, RENDER_ERR_FILE, "full-000001.png");
    assert_true(pushed <= 4);
    check_refused(render_encoder_finish(encoder), RENDER_ERR_FILE, "No space left");
    assert_true(exists(in_folder("full-000000.png")));
    assert_false(exists(in_folder("full-000001.png")));
    assert_false(exists(in_folder("full-000002.png")));
    render_image_free(&image);
}

static void movie_is_made_or_declined(void **state) {
    (void)state;
    render_encoder_def def = render_encoder_default();
    def.folder = folder;
    def.stem = "film 100%d'"; /* names that a shell or ffmpeg's patterns would trip over */
    render_encoder *encoder = NULL;
    render_image image = {0};
    check_ok(render_encoder_new(&def, &encoder));
    for (int i = 0; i < 5; i++) {
        paint(&image, 65, 49, i); /* odd sides */
        check_ok(render_encoder_push(encoder, &image, NULL, NULL, 0));
    }
    check_ok(render_encoder_finish(encoder));
    render_image_free(&image);
    render_movie_def movie = render_movie_default();
    movie.folder = folder;
    movie.stem = def.stem;
    movie.path = in_folder("film.mp4");
    render_status status = render_movie_make(&movie);
    if (status == RENDER_ERR_UNAVAILABLE) {
        print_message("skipped: %s\n", render_error_text());
        skip();
    }
    check_ok(status);
    assert_true(exists(movie.path));
    movie.stem = "missing";
    movie.path = in_folder("missing.mp4");
    check_refused(render_movie_make(&movie), RENDER_ERR_PROCESS, "missing");
    assert_false(exists(movie.path));
}

static void movie_without_ffmpeg_says_so(void **state) {
    (void)state;
    char *old = strdup(getenv("PATH"));
    setenv("PATH", folder, 1);
    render_movie_def movie = render_movie_default();
    movie.folder = folder;
    movie.path = in_folder("no.mp4");
    render_status status = render_movie_make(&movie);
    setenv("PATH", old, 1);
    free(old);
    check_refused(status, RENDER_ERR_UNAVAILABLE, "ffmpeg");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(png_round_trip),
        cmocka_unit_test(metadata_round_trip),
        cmocka_unit_test(failed_write_leaves_the_old_file),
        cmocka_unit_test(sequence_is_complete_and_in_order),
        cmocka_unit_test(encoder_labels_like_the_caller_would),
        cmocka_unit_test(encoder_reports_its_failures),
        cmocka_unit_test(movie_is_made_or_declined),
        cmocka_unit_test(movie_without_ffmpeg_says_so),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
