#include "tests/ranks/crowd.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double RADIUS = 0.005, STEP = 5e-5;
enum { SEED = 11 };

static void demand(bool fine, const clast_world *w) {
    if (fine) return;
    fprintf(stderr, "crowd: %s\n", w ? clast_world_error(w) : clast_world_new_error());
    exit(2);
}

static double uniform(uint64_t stream, int counter, double low, double high) {
    return low + (high - low) * clast_random(SEED, stream, (uint64_t)counter);
}

static clast_world *new_world(const clast_world_def *def) {
    clast_world *w = clast_world_new(def);
    demand(w != NULL, w);
    demand(clast_material_add(w, &(clast_material_def){"grain", 2500, 5e6, 0.3}) == 0, w);
    demand(clast_pair_set(w, 0, 0, &(clast_pair_def){.restitution = 0.5, .friction = 0.5}) == 0, w);
    return w;
}

static void add_plane(clast_world *w, int part, clast_vec3 point, clast_vec3 normal) {
    clast_wall_def plane = {"plane", CLAST_WALL_PLANE, 0, .point = point, .normal = normal};
    demand(clast_wall_add(w, part, &plane) >= 0, w);
}

/* Sides at +- half along x, and along y unless it is flat. */
static void add_sides(clast_world *w, double half_x, double half_y) {
    int box = clast_part_add(w, &(clast_part_def){.name = "box"});
    if (half_x > 0) {
        add_plane(w, box, (clast_vec3){-half_x, 0, 0}, (clast_vec3){1, 0, 0});
        add_plane(w, box, (clast_vec3){half_x, 0, 0}, (clast_vec3){-1, 0, 0});
    }
    if (half_y > 0) {
        add_plane(w, box, (clast_vec3){0, -half_y, 0}, (clast_vec3){0, 1, 0});
        add_plane(w, box, (clast_vec3){0, half_y, 0}, (clast_vec3){0, -1, 0});
    }
}

static void add_floor(clast_world *w) {
    int floor = clast_part_add(w, &(clast_part_def){.name = "floor"});
    add_plane(w, floor, (clast_vec3){0, 0, 0}, (clast_vec3){0, 0, 1});
}

/* A grid with play. */
static void fill(clast_world *w, int count, int columns, int rows, double pitch, bool turned) {
    double play = 0.04 * pitch;
    int shapes = clast_world_shape_count(w);
    for (int i = 0; i < count; i++) {
        int x = i % columns, y = i / columns % rows, z = i / columns / rows;
        clast_body_def b = {
            .shape = i % shapes,
            .position = {pitch * (x - 0.5 * (columns - 1)) + uniform(1, i, -play, play),
                         rows > 1 ? pitch * (y - 0.5 * (rows - 1)) + uniform(2, i, -play, play) : 0,
                         pitch * (z + 0.6) + uniform(3, i, 0, play)},
            .velocity = {uniform(4, i, -0.3, 0.3), rows > 1 ? uniform(5, i, -0.3, 0.3) : 0, 0}};
        b.orientation =
            clast_quat_axis_angle((clast_vec3){0.48, 0.6, 0.64}, turned ? uniform(6, i, -3, 3) : 0);
        demand(clast_body_add(w, &b) >= 0, w);
    }
}

static void add_sphere(clast_world *w) {
    demand(clast_shape_add_sphere(w, "sphere", RADIUS, 0) >= 0, w);
}

static clast_world *make_box(const clast_world_def *base) {
    clast_world *w = new_world(base);
    add_sphere(w);
    add_sides(w, 0.045, 0.045);
    add_floor(w);
    fill(w, 500, 8, 8, 0.0108, false);
    return w;
}

static clast_world *make_sizes(const clast_world_def *base) {
    clast_world *w = new_world(base);
    for (int i = 0; i < 4; i++)
        demand(clast_shape_add_sphere(w, "sphere", RADIUS * (0.55 + 0.15 * i), 0) >= 0, w);
    add_sides(w, 0.045, 0.045);
    add_floor(w);
    fill(w, 500, 8, 8, 0.0108, false);
    return w;
}

static clast_world *make_layer(const clast_world_def *base) {
    clast_world_def d = *base;
    d.motion = CLAST_MOTION_IN_PLANE, d.plane_axis = 1;
    clast_world *w = new_world(&d);
    add_sphere(w);
    add_sides(w, 0.12, 0);
    add_floor(w);
    fill(w, 400, 20, 1, 0.0108, false);
    return w;
}

const crowd CROWDS[] = {
    {"box", 2000, make_box},
    {"sizes", 1000, make_sizes},
    {"layer", 1500, make_layer},
};
const int CROWD_COUNT = sizeof CROWDS / sizeof *CROWDS;

clast_world *crowd_new(const crowd *c, bool alone, int threads) {
    clast_world_def d = clast_world_def_default();
    d.time_step = STEP;
    d.alone = alone, d.threads = threads;
    d.max_overlap = 0.4;
    d.impact_speed = 0.5;
    d.domain_min = (clast_vec3){-1, -1, -0.01}, d.domain_max = (clast_vec3){1, 1, 3};
    clast_world *w = c->make(&d);
    demand(clast_world_prepare(w) == CLAST_OK, w);
    return w;
}
