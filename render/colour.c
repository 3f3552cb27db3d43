#include "render/status.h"

#include <math.h>

/* Points at ninths of the maps, as their authors give them: viridis (S. van der Walt, N. Smith) and
 * cividis (J. Nunez, C. Anderton, R. Renslow, PLOS ONE 13, 2018). Straight lines between them are
 * off by at most a few steps of 255. */
enum { POINTS = 10 };
static const render_rgb MAP[][POINTS] = {
    [RENDER_VIRIDIS] = {{68, 1, 84},
                        {72, 40, 120},
                        {62, 74, 137},
                        {49, 104, 142},
                        {38, 130, 142},
                        {31, 158, 137},
                        {53, 183, 121},
                        {110, 206, 88},
                        {181, 222, 43},
                        {253, 231, 37}},
    [RENDER_CIVIDIS] = {{0, 34, 78},
                        {18, 53, 112},
                        {59, 73, 108},
                        {87, 93, 109},
                        {112, 113, 115},
                        {138, 134, 120},
                        {165, 156, 116},
                        {195, 179, 105},
                        {225, 204, 85},
                        {254, 232, 56}},
};
static const double MAP_START = 0.1; /* the darkest tenth would turn black in the shade */

const render_rgb RENDER_BAND_TINT[3] = {{196, 74, 68}, {92, 148, 208}, {150, 210, 132}};

/* Tints for bodies: of about one lightness, so that no body stands out; an outline parts them. */
static const render_rgb BODY_TINT[] = {{226, 160, 112}, {126, 176, 213}, {158, 200, 142},
                                       {236, 200, 118}, {184, 160, 210}, {222, 146, 160},
                                       {134, 198, 190}, {200, 186, 166}, {172, 186, 222},
                                       {206, 206, 128}, {216, 172, 200}};
enum { BODY_TINTS = sizeof BODY_TINT / sizeof *BODY_TINT };

static const render_rgb STRIPE_TINT[2] = {{232, 190, 116}, {88, 132, 172}};

static uint8_t mix(uint8_t a, uint8_t b, double t) {
    return (uint8_t)(a + (b - a) * t + 0.5);
}

render_rgb render_map_at(render_map map, double t) {
    RENDER_ASSERT(map == RENDER_VIRIDIS || map == RENDER_CIVIDIS);
    if (isnan(t)) return (render_rgb){128, 128, 128};
    double clamped = t < 0 ? 0 : t > 1 ? 1 : t;
    double at = (MAP_START + (1 - MAP_START) * clamped) * (POINTS - 1);
    int point = at >= POINTS - 2 ? POINTS - 2 : (int)at;
    const render_rgb *a = &MAP[map][point], *b = a + 1;
    return (render_rgb){mix(a->r, b->r, at - point), mix(a->g, b->g, at - point),
                        mix(a->b, b->b, at - point)};
}

void render_colour_map(render_map map, const double *value, size_t count, double low, double high,
                       render_rgb *rgb) {
    RENDER_ASSERT(count == 0 || (value && rgb));
    for (size_t i = 0; i < count; i++)
        rgb[i] = render_map_at(map, high > low ? (value[i] - low) / (high - low) : 0);
}

void render_colour_bands(const double *speed, size_t count, double fastest, render_rgb *rgb) {
    RENDER_ASSERT(count == 0 || (speed && rgb));
    for (size_t i = 0; i < count; i++) {
        double share = fastest > 0 ? fabs(speed[i]) / fastest : 0;
        rgb[i] = RENDER_BAND_TINT[share > 0.7 ? 2 : share >= 0.3 ? 1 : 0];
    }
}

void render_colour_bodies(const int32_t *body, size_t count, render_rgb *rgb) {
    RENDER_ASSERT(count == 0 || (body && rgb));
    for (size_t i = 0; i < count; i++) rgb[i] = BODY_TINT[(uint32_t)body[i] % BODY_TINTS];
}

void render_colour_stripes(const double *height, size_t count, double low, double high, int stripes,
                           render_rgb *rgb) {
    RENDER_ASSERT(count == 0 || (height && rgb));
    RENDER_ASSERT(stripes >= 1);
    for (size_t i = 0; i < count; i++) {
        double at = high > low ? (height[i] - low) / (high - low) * stripes : 0;
        int stripe = !(at > 0) ? 0 : at >= stripes ? stripes - 1 : (int)at;
        rgb[i] = STRIPE_TINT[stripe % 2];
    }
}

void render_colour_spread(const render_rgb *of_body, size_t bodies, const int32_t *body,
                          size_t count, render_rgb *rgb) {
    RENDER_ASSERT(count == 0 || (of_body && body && rgb));
    for (size_t i = 0; i < count; i++) {
        RENDER_ASSERT(body[i] >= 0 && (size_t)body[i] < bodies);
        rgb[i] = of_body[body[i]];
    }
}
