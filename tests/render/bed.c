#include "tests/render/bed.h"

#include <math.h>
#include <stdlib.h>

static const double PITCH = 0.010; /* m, from sphere to sphere */
static const double ROW = 0.866;   /* from row to row of a hexagonal layer, in pitches */
static const double LAYER = 0.816; /* from layer to layer */

/* The same numbers everywhere: a mixed counter, not rand(). Between -1 and 1. */
static double jitter(uint64_t counter) {
    uint64_t h = counter * 0x9e3779b97f4a7c15u;
    h = (h ^ h >> 30) * 0xbf58476d1ce4e5b9u;
    h = (h ^ h >> 27) * 0x94d049bb133111ebu;
    return (double)(h >> 11) * 0x1p-52 - 1;
}

bed bed_new(int nx, int ny, int nz, int per_body) {
    bed b = {.count = (size_t)nx * (size_t)ny * (size_t)nz};
    b.x = malloc(9 * b.count * sizeof *b.x); /* home positions behind the current ones */
    b.body = malloc(b.count * sizeof *b.body);
    b.colour = malloc(b.count * sizeof *b.colour);
    if (!b.x || !b.body || !b.colour) abort();
    b.y = b.x + b.count;
    b.z = b.y + b.count;
    b.radius = b.z + b.count;
    b.speed = b.radius + b.count;
    double *home = b.speed + b.count;
    for (size_t i = 0; i < b.count; i++) {
        size_t ix = i % (size_t)nx, iy = i / (size_t)nx % (size_t)ny, iz = i / (size_t)(nx * ny);
        /* Three kinds of layer, one behind the other, as in a close packing. */
        double shift = (double)(iy % 3) / 3;
        home[3 * i] = PITCH * ((double)ix + 0.5 * (double)(iz % 2) + shift + 0.2 * jitter(4 * i));
        home[3 * i + 1] = PITCH * (LAYER * (double)iy + 0.2 * jitter(4 * i + 1));
        home[3 * i + 2] = PITCH * (ROW * ((double)iz + shift) + 0.2 * jitter(4 * i + 2));
        b.radius[i] = PITCH * (0.49 + 0.05 * jitter(4 * i + 3));
        b.body[i] = (int32_t)(i / (size_t)per_body);
    }
    bed_move(&b, 0);
    return b;
}

/* A slow funnel: what lies high and central sinks and turns inward. */
void bed_move(bed *b, int frame) {
    const double *home = b->speed + b->count;
    double middle = home[3 * (b->count - 1)] / 2;
    for (size_t i = 0; i < b->count; i++) {
        double off = (home[3 * i] - middle) / middle;
        double flow = exp(-6 * off * off) * (0.3 + home[3 * i + 2] / 0.25);
        b->x[i] = home[3 * i] - 2e-5 * frame * off * flow;
        b->y[i] = home[3 * i + 1];
        b->z[i] = home[3 * i + 2] - 6e-5 * frame * flow;
        b->speed[i] = 0.1 * flow * (1 + 0.2 * jitter(7 * i));
    }
}

render_scene bed_scene(const bed *b) {
    return (render_scene){.spheres = {.count = b->count,
                                      .x = b->x,
                                      .y = b->y,
                                      .z = b->z,
                                      .radius = b->radius,
                                      .body = b->body,
                                      .colour = b->colour}};
}

void bed_free(bed *b) {
    free(b->x);
    free(b->body);
    free(b->colour);
    *b = (bed){0};
}
