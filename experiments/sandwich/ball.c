/* ball.c - the ball of S12 Table 3.1 between walls of its own material, in the running engine. */
#include <math.h>
#include <stdlib.h>

#include "experiments/sandwich/sandwich.h"

static const double PI = 3.14159265358979323846;

static uint64_t all_hashes;

double ball_mass(void) {
    return BALL_DENSITY * 4.0 / 3 * PI * BALL_RADIUS * BALL_RADIUS * BALL_RADIUS;
}

double ball_frequency(void) {
    return sqrt(BALL_STIFFNESS / ball_mass());
}

double ball_contact(void) {
    return PI / ball_frequency();
}

uint64_t ball_hashes(void) {
    return all_hashes;
}

static void stop(const char *what) {
    fprintf(stderr, "sandwich: %s\n", what);
    exit(4);
}

static clast_world *world_of(const ball_def *def) {
    const double any = 1e9;
    clast_world_def d = clast_world_def_default();
    d.gravity = (clast_vec3){0, 0, 0};
    d.law = CLAST_LAW_LINEAR;
    d.scheme = def->scheme;
    d.newton_tolerance = 1e-13;
    d.time_step = def->step;
    d.impact_speed = APPROACH_SPEED;
    d.max_overlap = def->max_overlap;
    d.max_displacement = def->max_displacement > 0 ? def->max_displacement : any;
    d.max_residual = def->max_residual > 0 ? def->max_residual : any;
    d.threads = 1;
    clast_world *w = clast_world_new(&d);
    if (!w) stop(clast_world_new_error());
    return w;
}

clast_world *ball_new(const ball_def *def) {
    clast_world *w = world_of(def);
    int glass = clast_material_add(w, &(clast_material_def){"glass", BALL_DENSITY, 70e9, 0.22});
    clast_pair_def pair = {.restitution = def->restitution, .stiffness = BALL_STIFFNESS};
    if (clast_pair_set(w, glass, glass, &pair)) stop(clast_world_error(w));
    int ball = clast_shape_add_sphere(w, "ball", BALL_RADIUS, glass);
    int part = clast_part_add(w, &(clast_part_def){.name = "walls"});
    clast_wall_def lower = {
        .name = "lower", .material = glass, .point = {0, 0, -def->gap}, .normal = {0, 0, 1}};
    clast_wall_def upper = {
        .name = "upper", .material = glass, .point = {0, 0, def->gap}, .normal = {0, 0, -1}};
    clast_wall_add(w, part, &lower);
    if (!def->single) clast_wall_add(w, part, &upper);
    for (int i = 0; i == 0 || i < def->row; i++) {
        clast_body_def body = {.shape = ball,
                               .position = {4 * i * BALL_RADIUS, 0, def->x},
                               .velocity = {0, 0, def->v}};
        if (clast_body_add(w, &body) < 0) stop(clast_world_error(w));
    }
    if (clast_world_prepare(w)) stop(clast_world_error(w));
    return w;
}

double ball_pressed_frequency(void) {
    return sqrt(2) * ball_frequency();
}

/* Two dashpots make the damping ratio sqrt(2) times that of one contact: a pair that rebounds
 * higher makes up for it. */
ball_def ball_pressed(clast_scheme scheme, double restitution, double h, double room) {
    const double press = 0.1, z = linear_damping_ratio(restitution, true) / sqrt(2);
    const linear_contact one = {.mass = 1, .stiffness = 1, .dashpot = 2 * z, .cut_off = true};
    return (ball_def){.scheme = scheme,
                      .restitution = linear_impact(&one, 1).rebound,
                      .step = h / ball_pressed_frequency(),
                      .gap = (1 - press) * BALL_RADIUS,
                      .max_overlap = press + room};
}

void ball_free(clast_world *w) {
    all_hashes = (all_hashes * 31) ^ clast_world_hash(w);
    clast_world_free(w);
}

double ball_x(clast_world *w) {
    return clast_world_bodies(w).z[0];
}

double ball_v(clast_world *w) {
    return clast_world_bodies(w).vz[0];
}
