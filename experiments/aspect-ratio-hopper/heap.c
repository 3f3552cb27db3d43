/* heap.c - shape and slope of the heap in the chamber: A00 5.3.3, Fig. 5.17. */
#include <math.h>
#include <stdlib.h>

#include "engine/check.h"
#include "experiments/aspect-ratio-hopper/aspect.h"

static const double DEGREE = 57.29577951308232;

/* What falls is nearly as fast as in a free fall from the orifice; the heap is what is slower. */
static bool rests(const frame *f, const aspect_case *c, size_t i) {
    const double *p = &f->position[3 * i], *v = &f->velocity[3 * i];
    if (p[2] > 0 || p[2] < -c->chamber) return false;
    double speed = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    return speed < RESTS_BELOW * sqrt(2 * GRAVITY * -p[2]);
}

/* Strays that rest for a moment on their way are above the heap, not on it: of the highest in a bin
 * the third counts. */
enum { STRAYS = 2 };

typedef struct highest {
    double z[STRAYS + 1]; /* falling */
} highest;

static void add(highest *h, double z) {
    for (int k = 0; k <= STRAYS; k++)
        if (z > h->z[k]) {
            double spare = h->z[k];
            h->z[k] = z, z = spare;
        }
}

void heap_of(const frame *f, const aspect_case *c, double top[HEAP_BINS]) {
    CLAST_ASSERT(f && c && top);
    highest bin[HEAP_BINS];
    for (int k = 0; k < HEAP_BINS; k++) bin[k] = (highest){{0}};
    for (size_t i = 0; i < f->bodies; i++) {
        if (!rests(f, c, i)) continue;
        int k = (int)((f->position[3 * i] + c->half_width) / (2 * c->half_width) * HEAP_BINS);
        k = k < 0 ? 0 : k >= HEAP_BINS ? HEAP_BINS - 1 : k;
        add(&bin[k], f->position[3 * i + 2] + c->chamber);
    }
    for (int k = 0; k < HEAP_BINS; k++) top[k] = bin[k].z[STRAYS];
}

double heap_level(const double top[HEAP_BINS], double chamber) {
    CLAST_ASSERT(top && chamber > 0);
    double sum = 0, count = 0;
    for (int k = 0; k < HEAP_BINS; k++)
        if (fabs(2 * (k + 0.5) / HEAP_BINS - 1) < ORIFICE) sum += top[k], count++;
    return sum / count / chamber;
}

/* Of a straight line through the heights over the distance from the middle, both flanks together;
 * above 0 for a heap, below for a hollow. */
double heap_slope(const double top[HEAP_BINS], double half_width) {
    double x[HEAP_BINS], z[HEAP_BINS];
    for (int k = 0; k < HEAP_BINS; k++) {
        x[k] = fabs(2 * (k + 0.5) / HEAP_BINS - 1) * half_width;
        z[k] = top[k];
    }
    return -DEGREE * atan(line_fit(x, z, HEAP_BINS).slope);
}
