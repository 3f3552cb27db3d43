#include "experiments/scene/rebound.h"
#include "experiments/scene/arena.h"

#include <math.h>

enum { STEPS_MAX = 200000 };

typedef struct partner {
    double radius, mass;
} partner;

static partner choose_partner(const scene *s) {
    partner p = {0, INFINITY};
    for (int i = 0; i < clast_world_shape_count(s->world); i++) {
        clast_shape_def shape = clast_world_shape(s->world, i);
        p.mass = shape.mass < p.mass ? shape.mass : p.mass;
        for (int k = 0; k < shape.spheres; k++)
            p.radius = shape.radius[k] > p.radius ? shape.radius[k] : p.radius;
    }
    return p;
}

static clast_world *make_world(const scene *s, const scene_pair *pair, partner p, double speed) {
    clast_world_def def = *clast_world_definition(s->world);
    double reach = 100 * p.radius;
    def.gravity = (clast_vec3){0};
    def.global_damping = 0; /* it slows bodies in flight too */
    def.motion = CLAST_MOTION_3D;
    def.time_step = clast_world_time_step(s->world);
    def.impact_speed = speed;
    def.domain_min = (clast_vec3){-reach, -reach, -reach};
    def.domain_max = (clast_vec3){reach, reach, reach};
    def.guards = CLAST_GUARD_REPORT;
    def.threads = 1;
    def.skin = 0;
    clast_world *w = clast_world_new(&def);
    if (!w) return NULL;
    if (s->library && clast_world_use_law(w, s->library, s->function)) {
        clast_world_free(w);
        return NULL;
    }
    const int of[2] = {pair->a, pair->b};
    double inertia = 0.4 * p.mass * p.radius * p.radius;
    bool good = true;
    for (int i = 0; i < 2; i++) {
        const clast_vec3 centre = {0};
        good = clast_material_add(w, &s->materials[of[i]]) == i && good;
        good =
            clast_shape_add(w, &(clast_shape_def){.name = i ? "right" : "left",
                                                  .material = i,
                                                  .spheres = 1,
                                                  .centre = &centre,
                                                  .radius = &p.radius,
                                                  .mass = p.mass,
                                                  .inertia = {inertia, inertia, inertia}}) == i &&
            good;
    }
    for (int i = 0; i < 3 && good; i++) /* like with like never meets, but every pair must be set */
        good = clast_pair_set(w, i == 2, i > 0, &pair->def) == CLAST_OK;
    for (int i = 0; i < 2 && good; i++) {
        double side = i ? 1 : -1;
        good = clast_body_add(w, &(clast_body_def){.shape = i,
                                                   .position = {side * 1.0001 * p.radius, 0, 0},
                                                   .velocity = {-side * speed / 2, 0, 0}}) == i;
    }
    if (good) return w;
    clast_world_free(w);
    return NULL;
}

/* Speed at which the two part (approach is negative), and their distance. */
static double parting(clast_world *w, double *distance) {
    clast_bodies b = clast_world_bodies(w);
    if (b.count != 2) return -INFINITY;
    int left = b.id[0] == 0 ? 0 : 1, right = 1 - left;
    *distance = b.x[right] - b.x[left];
    return b.vx[right] - b.vx[left];
}

double scene_rebound(const scene *s, const scene_pair *pair) {
    SCENE_ASSERT(s && s->world && pair);
    double speed = clast_world_plan(s->world).impact_speed, result = -1;
    partner p = choose_partner(s);
    clast_world *w = make_world(s, pair, p, speed);
    bool touched = false;
    for (int step = 0; w && step < STEPS_MAX; step++) {
        double distance = 0, v = 0;
        if (clast_world_step(w)) break;
        v = parting(w, &distance);
        touched = touched || distance < 2 * p.radius;
        if (!(touched && distance > 2 * p.radius && v > 0)) continue;
        result = v / speed;
        break;
    }
    clast_world_free(w);
    return result;
}
