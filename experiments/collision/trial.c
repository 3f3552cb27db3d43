/* trial.c - one collision in the running engine. Guards are wide: a few steps per contact are too
 * few on purpose. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "experiments/collision/collision.h"

static const double PI = 3.14159265358979323846;

/* A touch that falls on a step would have an overlap of either sign by rounding: it comes this much
 * of a step late. */
static const double AFTER = 1e-9;

static uint64_t all_hashes;

double trial_mass(void) {
    return BALL_DENSITY * 4.0 / 3 * PI * BALL_RADIUS * BALL_RADIUS * BALL_RADIUS;
}

double trial_modulus(double young) {
    return young / (2 * (1 - BALL_POISSON * BALL_POISSON));
}

uint64_t trials_hash(void) {
    return all_hashes;
}

static void stop(const char *what) {
    fprintf(stderr, "collision: %s\n", what);
    exit(4);
}

static clast_world *world_of(const trial *t) {
    clast_world_def def = clast_world_def_default();
    def.gravity = (clast_vec3){0, 0, 0};
    def.law = t->law;
    def.scheme = t->scheme;
    def.newton_tolerance = 1e-13;
    def.time_step = t->step;
    def.impact_speed = t->speed;
    def.guards = CLAST_GUARD_REPORT;
    def.max_overlap = def.max_displacement = def.max_residual = 1e9;
    def.threads = 1;
    clast_world *w = clast_world_new(&def);
    if (!w) stop(clast_world_new_error());
    return w;
}

/* Floor and shape of the balls; returns the shape. */
static int add_scene(clast_world *w, const trial *t) {
    int matter =
        clast_material_add(w, &(clast_material_def){"ball", BALL_DENSITY, t->young, BALL_POISSON});
    clast_pair_def pair = {
        .restitution = t->restitution, .stiffness = t->stiffness, .dissipation = t->dissipation};
    if (clast_pair_set(w, matter, matter, &pair)) stop(clast_world_error(w));
    int floor = clast_part_add(w, &(clast_part_def){.name = "floor"});
    clast_wall_def plane = {.name = "floor", .material = matter, .normal = {0, 0, 1}};
    clast_wall_add(w, floor, &plane);
    return clast_shape_add_sphere(w, "ball", BALL_RADIUS, matter);
}

/* At a height from which it touches the wall in the asked-for place of a step. */
static void add_ball(clast_world *w, int shape, const trial *t, double x, double late) {
    double above = (t->lead + late + AFTER) * t->step * t->speed;
    clast_body_def body = {
        .shape = shape, .position = {x, 0, BALL_RADIUS + above}, .velocity = {0, 0, -t->speed}};
    if (clast_body_add(w, &body) < 0) stop(clast_world_error(w));
}

static clast_world *prepared(clast_world *w) {
    if (clast_world_prepare(w)) stop(clast_world_error(w));
    return w;
}

static trial_point point_of(clast_world *w, const trial *t, int step) {
    clast_contact contact = {.normal_force = 0};
    clast_world_contacts(w, &contact, 1);
    clast_bodies b = clast_world_bodies(w);
    return (trial_point){.time = (step - t->lead - t->late) * t->step,
                         .overlap = BALL_RADIUS - b.z[0],
                         .rate = -b.vz[0],
                         .force = contact.normal_force};
}

/* ---- one ball -------------------------------------------------------------------------------- */

void trial_run(const trial *t, trial_point *points) {
    clast_world *w = world_of(t);
    add_ball(w, add_scene(w, t), t, 0, t->late);
    prepared(w);
    points[0] = point_of(w, t, 0);
    for (int i = 1; i <= t->steps; i++) {
        if (clast_world_step(w)) stop(clast_world_error(w));
        points[i] = point_of(w, t, i);
    }
    all_hashes = (all_hashes * 31) ^ clast_world_hash(w);
    clast_world_free(w);
}

/* ---- a row of balls -------------------------------------------------------------------------- */

static double late_of(int place, int count) {
    return (place + 0.5) / count;
}

clast_world *trial_row_new(const trial *t, int count) {
    clast_world *w = world_of(t);
    int shape = add_scene(w, t);
    for (int i = 0; i < count; i++) add_ball(w, shape, t, 4 * BALL_RADIUS * i, late_of(i, count));
    return prepared(w);
}

static void take_row(clast_world *w, const trial *t, int step, int count, trial_point *points) {
    clast_bodies b = clast_world_bodies(w);
    for (size_t i = 0; i < b.count; i++) {
        int place = (int)b.id[i];
        points[place * (t->steps + 1) + step] =
            (trial_point){.time = (step - t->lead - late_of(place, count)) * t->step,
                          .overlap = BALL_RADIUS - b.z[i],
                          .rate = -b.vz[i],
                          .force = NAN};
    }
}

void trial_row_run(const trial *t, int count, trial_point *points) {
    clast_world *w = trial_row_new(t, count);
    take_row(w, t, 0, count, points);
    for (int i = 1; i <= t->steps; i++) {
        if (clast_world_step(w)) stop(clast_world_error(w));
        take_row(w, t, i, count, points);
    }
    all_hashes = (all_hashes * 31) ^ clast_world_hash(w);
    clast_world_free(w);
}
