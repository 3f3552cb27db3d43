#include "render/resolve.h"

#include "render/status.h"

#include <string.h>

/* Weights of 0 to 64 keep two colour channels of one 32-bit word apart: 4 * 255 * 64 < 2^16. */
enum { FULL = 64 };

static const uint32_t *row_of(const uint32_t *plane, const render_samples *s, int row) {
    int inside = row < 0 ? 0 : row >= s->height ? s->height - 1 : row;
    return plane + (size_t)inside * (size_t)s->width;
}

static uint32_t weight_of(uint32_t darkness) {
    return FULL - ((darkness + 2) >> 2); /* 255 gives 0 */
}

/* 2 x 2: a sample is darkened if any of its four neighbours belongs to another body, which makes a
 * line of one final pixel between two bodies. */
static void weigh_fine(const render_samples *s, int row, uint32_t *restrict weight) {
    const uint32_t *rgba = row_of(s->rgba, s, row), *here = row_of(s->body, s, row);
    const uint32_t *under = row_of(s->body, s, row - 1), *over = row_of(s->body, s, row + 1);
    int last = s->width - 1;
    for (int i = 1; i < last; i++) {
        uint32_t differs = (here[i] ^ here[i - 1]) | (here[i] ^ here[i + 1]) |
                           (here[i] ^ under[i]) | (here[i] ^ over[i]);
        uint32_t dark = weight_of(rgba[i] >> 24);
        weight[i] = differs ? dark : FULL;
    }
    for (int side = 0; side < 2; side++) {
        int i = side ? last : 0, beside = side ? last - 1 : 1;
        uint32_t differs = (here[i] ^ here[beside]) | (here[i] ^ under[i]) | (here[i] ^ over[i]);
        weight[i] = differs ? weight_of(rgba[i] >> 24) : FULL;
    }
}

/* 1 x 1: one pixel wide as well, so it looks right and down only, and takes the darker of both
 * sides (a background pixel has no darkness of its own). */
static void weigh_plain(const render_samples *s, int row, uint32_t *restrict weight) {
    const uint32_t *rgba = row_of(s->rgba, s, row), *here = row_of(s->body, s, row);
    const uint32_t *below_rgba = row_of(s->rgba, s, row - 1), *under = row_of(s->body, s, row - 1);
    int last = s->width - 1;
    for (int i = 0; i < last; i++) {
        uint32_t own = rgba[i] >> 24, right = rgba[i + 1] >> 24, below = below_rgba[i] >> 24;
        uint32_t a = here[i] != here[i + 1] ? (own > right ? own : right) : 0;
        uint32_t b = here[i] != under[i] ? (own > below ? own : below) : 0;
        weight[i] = weight_of(a > b ? a : b);
    }
    uint32_t own = rgba[last] >> 24, below = below_rgba[last] >> 24;
    weight[last] = weight_of(here[last] != under[last] ? (own > below ? own : below) : 0);
}

/* Adds `times` times the weighted colours of a row: red and blue in one word, green in the other.
 */
static void add_row(const uint32_t *restrict rgba, const uint32_t *restrict weight, int width,
                    uint32_t times, uint32_t *restrict red_blue, uint32_t *restrict green) {
    for (int i = 0; i < width; i++) {
        uint32_t w = weight[i] * times;
        red_blue[i] += (rgba[i] & 0xff00ffu) * w;
        green[i] += (rgba[i] >> 8 & 0xffu) * w;
    }
}

static void store(uint8_t *restrict out, const uint32_t *restrict red_blue,
                  const uint32_t *restrict green, int width, int per_pixel) {
    const uint32_t half = 0x800080u;
    for (int i = 0; i < width; i++) {
        uint32_t rb, g;
        if (per_pixel == 2) {
            rb = red_blue[2 * i] + red_blue[2 * i + 1] + half;
            g = green[2 * i] + green[2 * i + 1] + 128;
        } else {
            rb = red_blue[i] + half;
            g = green[i] + 128;
        }
        out[3 * i] = (uint8_t)(rb >> 8);
        out[3 * i + 1] = (uint8_t)(g >> 8);
        out[3 * i + 2] = (uint8_t)(rb >> 24);
    }
}

void render_resolve(const render_samples *s, render_image *image) {
    RENDER_ASSERT(s && image && image->rgb && (s->per_pixel == 1 || s->per_pixel == 2));
    RENDER_ASSERT(s->width == image->width * s->per_pixel);
    RENDER_ASSERT(s->height == image->height * s->per_pixel);
    size_t width = (size_t)s->width;
    uint32_t *red_blue = s->scratch, *green = s->scratch + width, *weight = s->scratch + 2 * width;
    uint32_t times = s->per_pixel == 2 ? 1 : 4; /* samples per pixel make four quarters */
    for (int y = 0; y < image->height; y++) {
        memset(s->scratch, 0, 2 * width * sizeof *s->scratch);
        for (int sub = 0; sub < s->per_pixel; sub++) {
            int row = s->height - 1 - (y * s->per_pixel + sub);
            if (s->per_pixel == 2 && s->width > 1)
                weigh_fine(s, row, weight);
            else
                weigh_plain(s, row, weight);
            add_row(row_of(s->rgba, s, row), weight, s->width, times, red_blue, green);
        }
        store(image->rgb + 3 * (size_t)y * (size_t)image->width, red_blue, green, image->width,
              s->per_pixel);
    }
}
