#include "render/text.h"

#include "render/status.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct render_font {
    FT_Library library;
    FT_Face face[2]; /* regular, bold (NULL if there is none) */
};

/* Debian, Fedora, Arch and Homebrew keep it here. */
static const char *const PLACES[] = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf",
    "/opt/homebrew/share/fonts/DejaVuSans.ttf",
};
enum { PLACES_COUNT = sizeof PLACES / sizeof *PLACES };

/* ---- Opening ---- */

static void open_bold(render_font *font, const char *path) {
    char bold[1024];
    size_t length = strlen(path);
    if (length < 4 || length + 6 > sizeof bold) return;
    snprintf(bold, sizeof bold, "%.*s-Bold%s", (int)(length - 4), path, path + length - 4);
    if (FT_New_Face(font->library, bold, 0, &font->face[1])) font->face[1] = NULL;
}

static bool open_faces(render_font *font, const char *path) {
    if (FT_New_Face(font->library, path, 0, &font->face[0])) {
        font->face[0] = NULL;
        return false;
    }
    open_bold(font, path);
    return true;
}

static render_status open_somewhere(render_font *font, const char *path) {
    const char *wish = path ? path : getenv("CLAST_FONT");
    if (wish && *wish) {
        if (open_faces(font, wish)) return RENDER_OK;
        return render_fail(RENDER_ERR_UNAVAILABLE, "font %s cannot be read%s", wish,
                           path ? "" : " (from CLAST_FONT)");
    }
    for (int i = 0; i < PLACES_COUNT; i++)
        if (open_faces(font, PLACES[i])) return RENDER_OK;
    return render_fail(RENDER_ERR_UNAVAILABLE,
                       "no font: DejaVu Sans is not in the usual places (install "
                       "fonts-dejavu-core, or set CLAST_FONT to a .ttf file)");
}

render_status render_font_open(const char *path, render_font **font) {
    RENDER_ASSERT(font);
    *font = NULL;
    render_font *made = calloc(1, sizeof *made);
    if (!made || FT_Init_FreeType(&made->library)) {
        free(made);
        return render_fail(RENDER_ERR_MEMORY, "no memory for FreeType");
    }
    render_status status = open_somewhere(made, path);
    if (status == RENDER_OK)
        *font = made;
    else
        render_font_close(made);
    return status;
}

void render_font_close(render_font *font) {
    if (!font) return;
    FT_Done_FreeType(font->library); /* takes its faces along */
    free(font);
}

/* ---- Laying out a line ---- */

/* The next character; bytes that are not UTF-8 become the replacement sign. Stops at the end. */
static uint32_t next_character(const char **text) {
    const unsigned char *s = (const unsigned char *)*text;
    int extra = s[0] < 0x80 ? 0 : s[0] >= 0xf0 ? 3 : s[0] >= 0xe0 ? 2 : s[0] >= 0xc0 ? 1 : -1;
    uint32_t c = extra <= 0 ? s[0] : s[0] & (0x3fu >> extra);
    for (int i = 1; i <= extra; i++) {
        if ((s[i] & 0xc0) != 0x80)
            extra = -1;
        else
            c = c << 6 | (s[i] & 0x3fu);
    }
    *text += extra < 0 ? 1 : extra + 1;
    return extra < 0 ? 0xfffd : c;
}

static FT_Face sized_face(render_font *font, render_style style) {
    FT_Face face = style.bold && font->face[1] ? font->face[1] : font->face[0];
    return FT_Set_Pixel_Sizes(face, 0, (FT_UInt)style.px) ? NULL : face;
}

/* Coverage of a line, in a box that may be clipped anywhere. */
typedef struct stencil {
    uint8_t *cover;
    int width, height, origin_x, origin_y; /* of the baseline's left end */
} stencil;

static void stamp(stencil *s, const FT_GlyphSlot glyph, int pen) {
    int left = s->origin_x + pen + glyph->bitmap_left, top = s->origin_y - glyph->bitmap_top;
    for (int row = 0; row < (int)glyph->bitmap.rows; row++)
        for (int i = 0; i < (int)glyph->bitmap.width; i++) {
            int x = left + i, y = top + row;
            if (x < 0 || y < 0 || x >= s->width || y >= s->height) continue;
            uint8_t value = glyph->bitmap.buffer[row * glyph->bitmap.pitch + i];
            uint8_t *at = &s->cover[(size_t)y * (size_t)s->width + (size_t)x];
            if (value > *at) *at = value;
        }
}

/* Walks along the line with whole-pixel steps, which keeps stems crisp; stamps if asked to. */
static render_status walk(render_font *font, render_style style, const char *text, stencil *s,
                          int *width) {
    FT_Face face = sized_face(font, style);
    if (!face) return render_fail(RENDER_ERR_UNAVAILABLE, "font: no size of %d pixels", style.px);
    int pen = 0;
    FT_UInt before = 0;
    while (*text) {
        FT_UInt glyph = FT_Get_Char_Index(face, next_character(&text));
        FT_Vector kern = {0, 0};
        if (before && glyph) FT_Get_Kerning(face, before, glyph, FT_KERNING_DEFAULT, &kern);
        pen += (int)(kern.x / 64);
        FT_Int32 how = FT_LOAD_TARGET_LIGHT | (s ? FT_LOAD_RENDER : 0);
        if (FT_Load_Glyph(face, glyph, how))
            return render_fail(RENDER_ERR_UNAVAILABLE, "font: glyph %u cannot be drawn", glyph);
        if (s) stamp(s, face->glyph, pen);
        pen += (int)((face->glyph->advance.x + 32) / 64);
        before = glyph;
    }
    *width = pen;
    return RENDER_OK;
}

render_status render_text_measure(render_font *font, render_style style, const char *text,
                                  int *width) {
    RENDER_ASSERT(font && text && width && style.px > 0);
    return walk(font, style, text, NULL, width);
}

/* ---- Drawing ---- */

static uint8_t blend(uint8_t under, uint8_t over, int cover) {
    return (uint8_t)((under * (255 - cover) + over * cover + 127) / 255);
}

static void blend_pixel(render_image *image, int x, int y, render_rgb colour, int cover) {
    if (cover == 0 || x < 0 || y < 0 || x >= image->width || y >= image->height) return;
    uint8_t *p = image->rgb + 3 * ((size_t)y * (size_t)image->width + (size_t)x);
    p[0] = blend(p[0], colour.r, cover);
    p[1] = blend(p[1], colour.g, cover);
    p[2] = blend(p[2], colour.b, cover);
}

/* The strongest coverage within two pixels, a little transparent. */
static int halo_at(const stencil *s, int x, int y) {
    int best = 0;
    for (int dy = -2; dy <= 2; dy++)
        for (int dx = -2; dx <= 2; dx++) {
            int i = x + dx, j = y + dy, away = dx * dx + dy * dy;
            if (away > 5 || i < 0 || j < 0 || i >= s->width || j >= s->height) continue;
            int value = s->cover[(size_t)j * (size_t)s->width + (size_t)i] * (9 - away) / 9;
            if (value > best) best = value;
        }
    return best * 9 / 10;
}

static void paint(const stencil *s, int x, int y, render_ink ink, render_image *image) {
    int left = x - s->origin_x, top = y - s->origin_y;
    for (int j = 0; j < s->height; j++)
        for (int i = 0; i < s->width; i++)
            blend_pixel(image, left + i, top + j, ink.halo, halo_at(s, i, j));
    for (int j = 0; j < s->height; j++)
        for (int i = 0; i < s->width; i++)
            blend_pixel(image, left + i, top + j, ink.ink,
                        s->cover[(size_t)j * (size_t)s->width + (size_t)i]);
}

render_status render_text_draw(render_font *font, render_style style, const char *text, int x,
                               int y, render_ink ink, render_image *image) {
    RENDER_ASSERT(font && text && image && image->rgb && style.px > 0);
    int width = 0, margin = 3 + style.px / 4;
    render_status status = render_text_measure(font, style, text, &width);
    if (status != RENDER_OK || width == 0) return status;
    stencil s = {.width = width + 2 * margin,
                 .height = 2 * style.px + 2 * margin,
                 .origin_x = margin,
                 .origin_y = margin + style.px + style.px / 2};
    s.cover = calloc((size_t)s.width * (size_t)s.height, 1);
    if (!s.cover) return render_fail(RENDER_ERR_MEMORY, "no memory for a line of text");
    status = walk(font, style, text, &s, &width);
    if (status == RENDER_OK) paint(&s, x, y, ink, image);
    free(s.cover);
    return status;
}
