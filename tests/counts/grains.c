#include "tests/counts/grains.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

const grains grains_small[GRAINS_COUNT] = {
    {"box", GRAINS_BOX, 500, 12000},   {"layer", GRAINS_LAYER, 500, 12000},
    {"rods", GRAINS_RODS, 250, 20000}, {"walls", GRAINS_WALLS, 240, 3000},
    {"flow", GRAINS_FLOW, 500, 8000},
};

const double GRAINS_RADIUS = 0.005;
const double GRAINS_STEP = 5e-5;

static const double PITCH = 0.0108; /* m, of the loose start */
static const double BELT = 0.5;     /* m/s */
static const double TILT = 0.7;     /* rad, of the sides of a groove */
static const uint64_t SEED = 5;

static void demand(bool fine, const clast_world *w, const char *doing) {
    if (fine) return;
    fprintf(stderr, "grains: %s: %s\n", doing, w ? clast_world_error(w) : clast_world_new_error());
    exit(2);
}

static double uniform(uint64_t stream, int counter, double low, double high) {
    return low + (high - low) * clast_random(SEED, stream, (uint64_t)counter);
}

/* Bodies side by side in the loose start; the bed comes out about as high as wide. */
static int columns_of(const grains *g) {
    double spheres = g->bodies * (g->kind == GRAINS_RODS ? 1.6 : 1.0);
    if (g->kind == GRAINS_LAYER) return (int)ceil(sqrt(spheres));
    return g->kind == GRAINS_WALLS ? 16 : (int)ceil(cbrt(spheres));
}

static double half_width(const grains *g) {
    double pitch = g->kind == GRAINS_RODS ? 1.6 * PITCH : PITCH;
    return 0.5 * pitch * columns_of(g) + 0.1 * GRAINS_RADIUS;
}

static void add_plane(clast_world *w, int part, clast_vec3 point, clast_vec3 normal, double belt) {
    clast_wall_def plane = {"plane",        CLAST_WALL_PLANE, 0,
                            .point = point, .normal = normal, .belt_velocity = {belt, 0, 0}};
    demand(clast_wall_add(w, part, &plane) >= 0, w, "plane");
}

/* Grooves along y, one per column of spheres; the floor creeps along them. */
static void add_grooves(clast_world *w, const grains *g) {
    int part = clast_part_add(w, &(clast_part_def){.name = "floor", .velocity = {0, 0.01, 0}});
    int columns = columns_of(g);
    double slope = 0.25 * PITCH * tan(TILT), half = 0.25 * PITCH / cos(TILT);
    for (int i = 0; i < 2 * columns; i++) {
        double side = i % 2 ? 1 : -1;
        clast_wall_def plate = {"groove",
                                CLAST_WALL_PLATE,
                                0,
                                .point = {PITCH * (0.5 * i + 0.25 - 0.5 * columns), 0, slope},
                                .normal = {-side * sin(TILT), 0, cos(TILT)},
                                .side = {cos(TILT), 0, side * sin(TILT)},
                                .half_side = {half, 0.2}};
        demand(clast_wall_add(w, part, &plate) >= 0, w, "groove");
    }
}

static void add_walls(clast_world *w, const grains *g) {
    double half = half_width(g);
    int box = clast_part_add(w, &(clast_part_def){.name = "box"});
    add_plane(w, box, (clast_vec3){-half, 0, 0}, (clast_vec3){1, 0, 0}, 0);
    add_plane(w, box, (clast_vec3){half, 0, 0}, (clast_vec3){-1, 0, 0}, 0);
    if (g->kind == GRAINS_WALLS) add_grooves(w, g);
    if (g->kind == GRAINS_WALLS) return;
    add_plane(w, box, (clast_vec3){0, 0, 0}, (clast_vec3){0, 0, 1},
              g->kind == GRAINS_FLOW ? BELT : 0);
    if (g->kind == GRAINS_LAYER) return;
    add_plane(w, box, (clast_vec3){0, -half, 0}, (clast_vec3){0, 1, 0}, 0);
    add_plane(w, box, (clast_vec3){0, half, 0}, (clast_vec3){0, -1, 0}, 0);
}

static void add_shape(clast_world *w, const grains *g) {
    double r = GRAINS_RADIUS, mass = 4.0 / 3.0 * 3.14159265358979 * r * r * r * 2500;
    if (g->kind != GRAINS_RODS) {
        demand(clast_shape_add_sphere(w, "sphere", r, 0) >= 0, w, "sphere");
        return;
    }
    clast_vec3 centre[2] = {{-0.6 * r, 0, 0}, {0.6 * r, 0, 0}};
    double radius[2] = {r, r}, about = 0.4 * mass * r * r;
    clast_shape_def rod = {.name = "rod",
                           .material = 0,
                           .spheres = 2,
                           .centre = centre,
                           .radius = radius,
                           .mass = 1.7 * mass,
                           .inertia = {1.7 * about, 3.2 * about, 3.2 * about}};
    demand(clast_shape_add(w, &rod) >= 0, w, "rod");
}

static clast_world *new_world(const grains *g, const grains_wish *wish, double damping) {
    clast_world_def d = clast_world_def_default();
    d.time_step = GRAINS_STEP;
    d.threads = wish->threads > 0 ? wish->threads : 1, d.spheres_per_thread = 1;
    d.isa = wish->isa;
    d.precision = wish->precision;
    d.skin = 0.15 * GRAINS_RADIUS; /* stated: the engine may choose by the clock */
    d.global_damping = damping;
    d.max_overlap = 0.4;
    d.impact_speed = 0.5;
    d.domain_min = (clast_vec3){-1, -1, -0.01}, d.domain_max = (clast_vec3){1, 1, 3};
    if (g->kind == GRAINS_LAYER) d.motion = CLAST_MOTION_IN_PLANE, d.plane_axis = 1;
    clast_world *w = clast_world_new(&d);
    demand(w, NULL, g->name);
    demand(clast_material_add(w, &(clast_material_def){"grain", 2500, 5e6, 0.3}) == 0, w, "grain");
    clast_pair_def pair = {.restitution = 0.5, .friction = 0.5};
    if (g->kind == GRAINS_BOUNCE) pair = (clast_pair_def){.restitution = 1};
    demand(clast_pair_set(w, 0, 0, &pair) == CLAST_OK, w, "pair");
    add_shape(w, g);
    add_walls(w, g);
    return w;
}

/* A grid with play, bottom up. */
static void fill(clast_world *w, const grains *g) {
    int columns = columns_of(g), rows = g->kind == GRAINS_LAYER ? 1 : columns;
    double pitch = g->kind == GRAINS_RODS ? 1.6 * PITCH : PITCH;
    double play = 0.45 * (PITCH - 2 * GRAINS_RADIUS), speed = 0.2;
    double lift = g->kind == GRAINS_WALLS ? 1.2 * GRAINS_RADIUS : 0;
    for (int i = 0; i < g->bodies; i++) {
        int x = i % columns, y = i / columns % rows, z = i / columns / rows;
        clast_body_def b = {.position = {pitch * (x - 0.5 * (columns - 1)), 0,
                                         pitch * (z + 0.6) + lift + uniform(3, i, 0, play)}};
        b.position.x += uniform(1, i, -play, play);
        b.velocity.x = uniform(4, i, -speed, speed);
        if (rows > 1) {
            b.position.y = pitch * (y - 0.5 * (rows - 1)) + uniform(2, i, -play, play);
            b.velocity.y = uniform(5, i, -speed, speed);
        }
        double turn = g->kind == GRAINS_RODS ? uniform(6, i, -3, 3) : 0;
        b.orientation = clast_quat_axis_angle((clast_vec3){0.48, 0.6, 0.64}, turn);
        if (g->kind == GRAINS_WALLS) b.velocity.x = 0;
        demand(clast_body_add(w, &b) >= 0, w, "body");
    }
}

void grains_settle(const grains *g, const char *path) {
    const double much = 20; /* 1/s */
    clast_world *w = new_world(g, &(grains_wish){.threads = 1}, much);
    fill(w, g);
    demand(clast_world_prepare(w) == CLAST_OK, w, g->name);
    grains_steps(w, g->settle);
    demand(clast_checkpoint_save(w, path, NULL) == CLAST_OK, w, path);
    clast_world_free(w);
}

clast_world *grains_open(const grains *g, const grains_wish *wish, const char *path) {
    clast_world *w = new_world(g, wish, 0);
    demand(clast_checkpoint_inherit(w, path) == CLAST_OK, w, path);
    demand(clast_world_prepare(w) == CLAST_OK, w, g->name);
    return w;
}

void grains_steps(clast_world *w, uint64_t count) {
    for (uint64_t i = 0; i < count; i++) demand(clast_world_step(w) == CLAST_OK, w, "step");
}
