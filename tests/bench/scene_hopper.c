/* scene_hopper.c - B, C2, C4: A00 chapter 5. One vertical layer in a hopper 1 m wide, flat bottom
 * with an orifice of 70 % of the width. The bed is consolidated without friction on the closed
 * bottom; the orifice is open from the start of the run. Nothing reaches the floor of the chamber,
 * 2 m below, in the steps that are timed. */
#include "tests/bench/recipe.h"

#include <math.h>
#include <stdlib.h>

static const double WIDTH = 1.0, ORIFICE = 0.7, CHAMBER = 2.0; /* m */

/* A00 5.1: equal volumes. */
static double radius_of(const bench_scene *scene) {
    return 0.01 * cbrt(1.0 / scene->spheres);
}

static void add_plate(clast_world *w, const char *name, double from, double to) {
    int part = clast_part_add(w, &(clast_part_def){.name = name});
    clast_wall_def plate = {name,
                            CLAST_WALL_PLATE,
                            BENCH_WALL,
                            .point = {0.5 * (from + to), 0, 0},
                            .normal = {0, 0, 1},
                            .side = {1, 0, 0},
                            .half_side = {0.5 * (to - from), 0.1}};
    if (clast_wall_add(w, part, &plate) < 0) bench_fail(w, name);
}

static void add_walls(clast_world *w, bench_stage stage) {
    int sides = clast_part_add(w, &(clast_part_def){.name = "sides"});
    bench_plane(w, sides, "left", BENCH_WALL, (clast_vec3){-0.5 * WIDTH, 0, 0},
                (clast_vec3){1, 0, 0});
    bench_plane(w, sides, "right", BENCH_WALL, (clast_vec3){0.5 * WIDTH, 0, 0},
                (clast_vec3){-1, 0, 0});
    bench_plane(w, sides, "chamber", BENCH_WALL, (clast_vec3){0, 0, -CHAMBER},
                (clast_vec3){0, 0, 1});
    add_plate(w, "bottom left", -0.5 * WIDTH, -0.5 * ORIFICE);
    add_plate(w, "bottom right", 0.5 * ORIFICE, 0.5 * WIDTH);
    if (stage != BENCH_RUNNING) add_plate(w, "gate", -0.5 * ORIFICE, 0.5 * ORIFICE);
}

static void add_chain(clast_world *w, const bench_scene *scene) {
    clast_vec3 centre[8];
    double r = radius_of(scene), radius[8];
    for (int k = 0; k < scene->spheres; k++) {
        centre[k] = (clast_vec3){r * (2 * k - scene->spheres + 1), 0, 0};
        radius[k] = r;
    }
    clast_shape_def chain = {.name = "chain",
                             .material = BENCH_GRAIN,
                             .spheres = scene->spheres,
                             .centre = centre,
                             .radius = radius};
    if (clast_shape_add(w, &chain) < 0) bench_fail(w, "chain");
}

static void hopper_half_size(const bench_scene *scene, double half[2]) {
    (void)scene;
    half[0] = 0.5 * WIDTH, half[1] = 0;
}

/* A00 table 5.1; its damping ratio 0.5 as a rebound. */
static bench_law hopper_law(void) {
    double e = clast_restitution(CLAST_LAW_HERTZ_MINDLIN, 0.5);
    return (bench_law){.density = 2650,
                       .young = 3.5e9,
                       .poisson = 0.3,
                       .wall_young = 3.5e9,
                       .wall_poisson = 0.3,
                       .restitution = e,
                       .wall_restitution = e,
                       .friction = 0.2,
                       .wall_friction = 0.5};
}

static clast_world *hopper_world(const bench_scene *scene, const bench_wish *wish,
                                 bench_stage stage) {
    clast_world_def d = bench_def(scene, wish);
    bool settling = stage != BENCH_RUNNING;
    d.motion = CLAST_MOTION_IN_PLANE;
    d.plane_axis = 1;
    d.domain_min = (clast_vec3){-0.6, -0.1, -CHAMBER - 0.1};
    d.domain_max = (clast_vec3){0.6, 0.1, 12};
    d.global_damping = bench_damping(stage);
    clast_world *w = bench_world(&d);
    bench_law law = hopper_law();
    if (settling) law.friction = law.wall_friction = 0;
    bench_materials(w, &law);
    add_chain(w, scene);
    add_walls(w, stage);
    return w;
}

/* ---- the loose start: random sequential addition, any position and direction ------------------
 */

typedef struct sieve { /* one centre per cell: a cell's diagonal is less than a diameter */
    double cell, diameter;
    int nx, nz;
    double *x, *z; /* NAN: empty */
} sieve;

static sieve sieve_new(double diameter, double height) {
    sieve s = {diameter / 1.5, diameter, 0, 0, NULL, NULL};
    s.nx = (int)(WIDTH / s.cell) + 1, s.nz = (int)(height / s.cell) + 1;
    size_t cells = (size_t)s.nx * (size_t)s.nz;
    s.x = malloc(cells * sizeof *s.x), s.z = malloc(cells * sizeof *s.z);
    if (!s.x || !s.z) abort();
    for (size_t i = 0; i < cells; i++) s.x[i] = s.z[i] = NAN;
    return s;
}

static int column_of(const sieve *s, double x) {
    return (int)((x + 0.5 * WIDTH) / s->cell);
}
static int row_of(const sieve *s, double z) {
    return (int)(z / s->cell);
}

static bool is_free(const sieve *s, double x, double z) {
    for (int j = row_of(s, z) - 2; j <= row_of(s, z) + 2; j++)
        for (int i = column_of(s, x) - 2; i <= column_of(s, x) + 2; i++) {
            if (i < 0 || j < 0 || i >= s->nx || j >= s->nz) continue;
            double dx = x - s->x[j * s->nx + i], dz = z - s->z[j * s->nx + i];
            if (dx * dx + dz * dz < s->diameter * s->diameter) return false;
        }
    return true;
}

static void occupy(sieve *s, double x, double z) {
    int place = row_of(s, z) * s->nx + column_of(s, x);
    s->x[place] = x, s->z[place] = z;
}

typedef struct chain_pose {
    double x, z, dx, dz; /* m, middle and step from sphere to sphere */
} chain_pose;

static bool fits(const sieve *s, const chain_pose *p, int spheres, double height) {
    double r = 0.5 * s->diameter, side = 0.5 * WIDTH - r;
    for (int k = 0; k < spheres; k++) {
        double at = k - 0.5 * (spheres - 1), x = p->x + at * p->dx, z = p->z + at * p->dz;
        if (fabs(x) > side || z < r || z > height - r || !is_free(s, x, z)) return false;
    }
    return true;
}

/* Area fraction of the loose start: below what random addition reaches, higher settles sooner. */
static double loose_fraction(int spheres) {
    return spheres == 1 ? 0.5 : spheres == 2 ? 0.45 : 0.42;
}

static double loose_height(const bench_scene *scene) {
    double r = radius_of(scene), disc = 3.14159265358979 * r * r;
    int n = scene->spheres;
    return (double)scene->bodies * n * disc / (WIDTH * loose_fraction(n));
}

static void hopper_fill(clast_world *w, const bench_scene *scene, const char *states) {
    (void)states;
    int n = scene->spheres;
    double r = radius_of(scene), height = loose_height(scene);
    sieve s = sieve_new(2.002 * r, height); /* a little air: nothing touches at the start */
    uint64_t draw = 0;
    for (size_t placed = 0; placed < scene->bodies; draw++) {
        double angle = bench_uniform(2, 3 * draw, 0, 3.14159265358979), sine, cosine;
        clast_sincos(angle, &sine, &cosine);
        chain_pose p = {bench_uniform(2, 3 * draw + 1, -0.5 * WIDTH, 0.5 * WIDTH),
                        bench_uniform(2, 3 * draw + 2, 0, height), 2 * r * cosine, -2 * r * sine};
        if (!fits(&s, &p, n, height)) continue;
        for (int k = 0; k < n; k++) {
            double at = k - 0.5 * (n - 1);
            occupy(&s, p.x + at * p.dx, p.z + at * p.dz);
        }
        bench_body(w, (clast_vec3){p.x, 0, p.z}, angle, (clast_vec3){0, 0, 0});
        placed++;
    }
    free(s.x), free(s.z);
}

/* s: the top sinks by less than a half. */
static double hopper_fall(const bench_scene *scene) {
    return 1.1 * sqrt(2 * 0.45 * loose_height(scene) / 9.81);
}

const bench_recipe bench_hopper = {"hopper",     hopper_world,     hopper_fill,
                                   hopper_law,   hopper_half_size, .fall = hopper_fall,
                                   .threads = 0, .limit = 1.5};
