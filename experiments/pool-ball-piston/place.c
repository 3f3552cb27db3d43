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

/* ---- nothing overlaps ------------------------------------------------------------------------ */

static const double MARGIN = 1e-9; /* m: of what is pushed apart */

static void push(particle *p, double x, double z) {
    p->x += x, p->z += z;
}

static void push_from_walls(const rig *r, particle *p) {
    double rise = CM * (r->top - RIG_THROAT), run = CM * RIG_RUN, long_side = hypot(rise, run);
    for (int side = 0; side < 2; side++) {
        sphere s = sphere_of(p, side);
        double up = s.z - CM * RIG_THROAT, out = fabs(s.x) - CM * RIG_COLUMN / 2;
        double slope = s.radius - (up * run - out * rise) / long_side + MARGIN;
        double inwards = s.x > 0 ? -rise / long_side : rise / long_side;
        if (slope > MARGIN) push(p, slope * inwards, slope * run / long_side);
        if (s.radius > up) push(p, 0, s.radius - up + MARGIN);
    }
}

static void push_apart(particle *a, particle *b) {
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            sphere u = sphere_of(a, i), v = sphere_of(b, j);
            double dx = v.x - u.x, dz = v.z - u.z, flat = hypot(dx, dz);
            double overlap = u.radius + v.radius - hypot(flat, v.y - u.y);
            if (overlap <= 0) continue;
            double half = (overlap / 2 + MARGIN) / flat;
            push(a, -half * dx, -half * dz);
            push(b, half * dx, half * dz);
        }
}

/* Each particle gives way to its neighbours, half the overlap each, and to the walls, until all
 * have room: the V is open above. */
static void make_room(const rig *r, particle bed[PARTICLES]) {
    enum { ROUNDS = 100000 };
    for (int round = 0; round < ROUNDS && bed_clearance(r, bed) < 0; round++)
        for (int i = 0; i < PARTICLES; i++) {
            for (int j = 0; j < i; j++) push_apart(&bed[i], &bed[j]);
            push_from_walls(r, &bed[i]);
        }
}

void bed_lay_by_hand(const rig *r, double errors, bool flat, int replicate,
                     particle bed[PARTICLES]) {
    spoil(r, errors, flat, replicate, bed);
    make_room(r, bed);
}
