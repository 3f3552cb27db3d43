/* place.c - the particles of a replicate: the settled bed, changed as a workshop and a hand would.
 */
#include <math.h>
#include <stdio.h>

#include "engine/clast.h"
#include "experiments/pool-ball-piston/piston.h"
#include "experiments/run/results.h"

static const double PI = 3.14159265358979323846, CM = 0.01;
const rig RIG_INPUT = {.radius = 2.2225, .half = 1.3915, .top = 70, .gap = 4.60};

/* Two spheres cut at the middle plane: a body of revolution. */
double pair_volume(double radius, double half) {
    double r = radius, h = half;
    return 2 * PI * (2 * r * r * r / 3 + r * r * h - h * h * h / 3);
}

/* ---- where the bed lies ---------------------------------------------------------------------- */

bool bed_read(const char *folder, const rig *r, particle bed[PARTICLES]) {
    char why[RESULTS_ERROR_MAX];
    results *run = results_open(folder, why);
    frame *f = run && results_frames(run) ? results_frame(run, results_frames(run) - 1) : NULL;
    bool good = f && f->bodies == PARTICLES;
    for (int p = 0; good && p < PARTICLES; p++) {
        const double *at = &f->position[3 * p];
        bed[p] = (particle){.radius = CM * r->radius,
                            .half = CM * r->half,
                            .x = at[0],
                            .y = at[1],
                            .z = at[2],
                            .angle = angle_of(&f->orientation[4 * p], 0)};
    }
    if (!good) fprintf(stderr, "%s: no bed of %d particles\n", folder, PARTICLES);
    frame_free(f);
    results_free(run);
    return good;
}

/* ---- clearance ------------------------------------------------------------------------------- */

typedef struct sphere {
    double x, y, z, radius;
} sphere;

static sphere sphere_of(const particle *p, int side) {
    double s = side ? p->half : -p->half;
    return (sphere){p->x + s * cos(p->angle), p->y, p->z + s * sin(p->angle), p->radius};
}

static double sphere_to_walls(const rig *r, const sphere *s) {
    double rise = CM * (r->top - RIG_THROAT), run = CM * RIG_RUN, long_side = hypot(rise, run);
    double up = s->z - CM * RIG_THROAT, out = fabs(s->x) - CM * RIG_COLUMN / 2;
    double slope = (up * run - out * rise) / long_side; /* distance from the nearer one */
    double sheet = CM * r->gap / 2 - fabs(s->y);
    return fmin(fmin(slope, up), sheet) - s->radius;
}

static double pair_to_pair(const particle *a, const particle *b) {
    double least = INFINITY;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            sphere u = sphere_of(a, i), v = sphere_of(b, j);
            double apart = hypot(hypot(u.x - v.x, u.y - v.y), u.z - v.z);
            least = fmin(least, apart - u.radius - v.radius);
        }
    return least;
}

double bed_clearance(const rig *r, const particle bed[PARTICLES]) {
    double least = INFINITY;
    for (int i = 0; i < PARTICLES; i++) {
        for (int side = 0; side < 2; side++) {
            sphere s = sphere_of(&bed[i], side);
            least = fmin(least, sphere_to_walls(r, &s));
        }
        for (int j = 0; j < i; j++) least = fmin(least, pair_to_pair(&bed[i], &bed[j]));
    }
    return least;
}

/* ---- errors ---------------------------------------------------------------------------------- */

/* In [-1, 1): the same for the same place, whatever else changes. */
static double draw(int replicate, int which, int item) {
    enum { STREAM = 0x706f6f6c };
    return 2 * clast_random((uint64_t)replicate, STREAM, (uint64_t)(8 * which + item)) - 1;
}

/* A sheet keeps what is laid behind it in the gap. */
static double between_sheets(const rig *r, const particle *p) {
    double room = fmax(CM * r->gap / 2 - p->radius - 1e-9, 0); /* m: rounding */
    return fmin(fmax(p->y, -room), room);
}

static void spoil(const rig *r, double errors, bool flat, int replicate, particle bed[PARTICLES]) {
    for (int i = 0; i < PARTICLES; i++) {
        particle *p = &bed[i];
        p->radius += errors * ERROR_RADIUS * draw(replicate, i, 0);
        p->half += errors * ERROR_HALF * draw(replicate, i, 1);
        p->x += errors * ERROR_POSITION * draw(replicate, i, 2);
        if (!flat) p->y += errors * ERROR_POSITION * draw(replicate, i, 3);
        p->z += errors * ERROR_POSITION * draw(replicate, i, 4);
        p->angle += errors * ERROR_ANGLE * draw(replicate, i, 5);
        p->y = between_sheets(r, p);
    }
}

/* Away from where the slopes would meet, every particle moves away from every other and from both
 * slopes and the piston. */
static void lift(const rig *r, double factor, const particle from[PARTICLES],
                 particle to[PARTICLES]) {
    double apex = CM * (RIG_THROAT - RIG_COLUMN / 2 * (r->top - RIG_THROAT) / RIG_RUN);
    for (int i = 0; i < PARTICLES; i++) {
        to[i] = from[i];
        to[i].x *= factor;
        to[i].z = apex + factor * (from[i].z - apex);
    }
}

void bed_lay_by_hand(const rig *r, double errors, bool flat, int replicate,
                     particle bed[PARTICLES]) {
    enum { STEPS = 100000 };
    static const double STEP = 2e-6;
    particle spoiled[PARTICLES];
    spoil(r, errors, flat, replicate, bed);
    for (int i = 0; i < PARTICLES; i++) spoiled[i] = bed[i];
    for (int i = 1; i < STEPS && bed_clearance(r, bed) < 0; i++)
        lift(r, 1 + STEP * i, spoiled, bed);
}
