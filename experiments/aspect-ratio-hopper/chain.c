/* chain.c - rows of equal spheres with the volume of a sphere of EQUAL_RADIUS: radius, side view
 * and moment in closed form. */
#include <math.h>

#include "engine/check.h"
#include "experiments/aspect-ratio-hopper/aspect.h"

static const double PI = 3.14159265358979323846;

/* Aspect ratio is 1 + (spheres - 1) / density. The main shapes touch; of the others, those of
 * density 4 are as smooth as one another, and the last has the roughness of the main ones. */
static const struct {
    const char *name;
    int spheres;
    double density;
} CHAINS[SHAPES] = {
    {"1", 1, 1},        {"2", 2, 1},           {"3", 3, 1},
    {"4", 4, 1},        {"1.25 smooth", 2, 4}, {"1.5 smooth", 3, 4},
    {"2 smooth", 5, 4}, {"5 smooth", 17, 4},   {"5", 5, 1},
};

/* Of a slice of one sphere between distances a and b from its centre, which lies at `at`: volume,
 * and moment about the axis across through the origin. Radius 1. */
static void add_slice(double at, double a, double b, double *volume, double *moment) {
    double d1 = b - a, d2 = b * b - a * a, d3 = b * b * b - a * a * a;
    double d4 = b * b * b * b - a * a * a * a, d5 = pow(b, 5) - pow(a, 5);
    *volume += PI * (d1 - d3 / 3);
    double spread = 0.25 * (d1 - 2 * d3 / 3 + d5 / 5);
    double apart = at * at * (d1 - d3 / 3) + 2 * at * (d2 / 2 - d4 / 4) + d3 / 3 - d5 / 5;
    *moment += PI * (spread + apart);
}

chain chain_of(int shape) {
    CLAST_ASSERT(shape >= 0 && shape < SHAPES);
    int n = CHAINS[shape].spheres;
    double step = 2 / CHAINS[shape].density, half = 0.5 * step, volume = 0, moment = 0;
    for (int i = 0; i < n; i++) /* every sphere between the planes half way to its neighbours */
        add_slice(0.5 * (2 * i - n + 1) * step, i == 0 ? -1 : -half, i == n - 1 ? 1 : half, &volume,
                  &moment);
    double r = EQUAL_RADIUS * cbrt(4 * PI / 3 / volume);
    double strip = 2 * half * sqrt(1 - half * half) + 2 * asin(half); /* between those planes */
    return (chain){.name = CHAINS[shape].name,
                   .aspect = 1 + (n - 1) / CHAINS[shape].density,
                   .spheres = n,
                   .density = CHAINS[shape].density,
                   .radius = r,
                   .spacing = step * r,
                   .area = (PI + (n - 1) * strip) * r * r,
                   .across = moment / volume * r * r};
}

double chain_length(const chain *c) {
    return 2 * c->radius + (c->spheres - 1) * c->spacing;
}
