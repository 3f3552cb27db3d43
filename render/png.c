/* The only file that knows libpng. */

#include "render/status.h"

#include <errno.h>
#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h> /* Z_RLE; comes with libpng */

/* What libpng's error handler leaves for us before it jumps. */
typedef struct trouble {
    jmp_buf out;
    int number; /* errno at that moment */
    char text[160];
} trouble;

static void on_error(png_structp png, png_const_charp message) {
    trouble *t = png_get_error_ptr(png);
    t->number = errno;
    snprintf(t->text, sizeof t->text, "%s", message);
    longjmp(t->out, 1);
}

static void on_warning(png_structp png, png_const_charp message) {
    (void)png;
    (void)message; /* libpng warns about odd metadata; the picture is unharmed */
}

static render_status check_tags(const render_tag *tags, size_t count) {
    for (size_t i = 0; i < count; i++) {
        size_t length = tags[i].key ? strlen(tags[i].key) : 0;
        if (length < 1 || length > 79 || !tags[i].text)
            return render_fail(RENDER_ERR_ARGUMENT,
                               "PNG metadata %zu: a key of 1 to 79 characters and a text expected",
                               i);
    }
    return RENDER_OK;
}

/* iTXt is UTF-8 and needs no compression at this length. */
static void set_tags(png_structp png, png_infop info, const render_tag *tags, size_t count) {
    for (size_t i = 0; i < count; i++) {
        char key[80], lang[1] = "";
        snprintf(key, sizeof key, "%s", tags[i].key);
        png_text text = {.compression = PNG_ITXT_COMPRESSION_NONE,
                         .key = key,
                         .text = (char *)(uintptr_t)tags[i].text, /* libpng copies it */
                         .lang = lang,
                         .lang_key = lang};
        png_set_text(png, info, &text, 1);
    }
}

/* Everything between here and the end may jump to trouble.out. Level 1 with Z_RLE and the UP
 * filter: level 9 costs ten times the time for 15 % of the size. */
static void encode(png_structp png, png_infop info, FILE *file, const render_image *image,
                   const render_tag *tags, size_t tag_count) {
    png_init_io(png, file);
    png_set_compression_level(png, 1);
    png_set_compression_strategy(png, Z_RLE);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
    png_set_compression_buffer_size(png, 1 << 16);
    png_set_IHDR(png, info, (png_uint_32)image->width, (png_uint_32)image->height, 8,
                 PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    set_tags(png, info, tags, tag_count);
    png_write_info(png, info);
    size_t stride = 3 * (size_t)image->width;
    for (int y = 0; y < image->height; y++) png_write_row(png, image->rgb + (size_t)y * stride);
    png_write_end(png, info);
}

/* Keeps the jump away from every other local variable. */
static bool encode_safely(png_structp png, png_infop info, trouble *t, FILE *file,
                          const render_image *image, const render_tag *tags, size_t tag_count) {
    if (setjmp(t->out)) return false;
    encode(png, info, file, image, tags, tag_count);
    return true;
}

static render_status write_stream(const char *path, FILE *file, const render_image *image,
                                  const render_tag *tags, size_t tag_count) {
    trouble t = {.number = 0, .text = ""};
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &t, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    render_status status = RENDER_OK;
    if (!info)
        status = render_fail(RENDER_ERR_MEMORY, "%s: no memory for libpng", path);
    else if (!encode_safely(png, info, &t, file, image, tags, tag_count))
        status = render_fail(RENDER_ERR_FILE, "%s: %s (%s)", path, strerror(t.number), t.text);
    png_destroy_write_struct(&png, &info);
    return status;
}

static render_status write_part(const char *path, const char *part, const render_image *image,
                                const render_tag *tags, size_t tag_count) {
    FILE *file = fopen(part, "wb");
    if (!file) return render_fail(RENDER_ERR_FILE, "%s: cannot open: %s", path, strerror(errno));
    render_status status = write_stream(path, file, image, tags, tag_count);
    /* A full disk may show only when the last buffer leaves. */
    if (status == RENDER_OK && fflush(file) != 0)
        status = render_fail(RENDER_ERR_FILE, "%s: %s", path, strerror(errno));
    if (fclose(file) != 0 && status == RENDER_OK)
        status = render_fail(RENDER_ERR_FILE, "%s: %s", path, strerror(errno));
    return status;
}

render_status render_png_write(const char *path, const render_image *image, const render_tag *tags,
                               size_t tag_count) {
    RENDER_ASSERT(path && image && (tag_count == 0 || tags));
    if (!image->rgb || image->width < 1 || image->height < 1)
        return render_fail(RENDER_ERR_ARGUMENT, "%s: the image is empty", path);
    render_status status = check_tags(tags, tag_count);
    if (status != RENDER_OK) return status;
    size_t length = strlen(path) + sizeof ".part";
    char *part = malloc(length);
    if (!part) return render_fail(RENDER_ERR_MEMORY, "%s: no memory for a path", path);
    snprintf(part, length, "%s.part", path);
    status = write_part(path, part, image, tags, tag_count);
    if (status == RENDER_OK && rename(part, path) != 0)
        status = render_fail(RENDER_ERR_FILE, "%s: cannot rename: %s", path, strerror(errno));
    if (status != RENDER_OK) remove(part);
    free(part);
    return status;
}
