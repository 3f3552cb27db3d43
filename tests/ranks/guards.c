#include "tests/ranks/guards.h"

#include <stdio.h>
#include <string.h>

#include "engine/clast.h"

static const double RADIUS = 5e-3, STEP = 1e-4;
enum { LEAVES_AT = 20 };

typedef struct trial {
    const char *name, *says; /* says: of whom, for any number of processes */
    double max_overlap;
    void (*fill)(clast_world *w);
} trial;

static void add(clast_world *w, double x, double z, clast_vec3 velocity) {
    clast_body_add(w, &(clast_body_def){.position = {x, 0, z}, .velocity = velocity});
}

/* Four that fall alike, and soon too fast: the first is not where the first process is. */
static void fill_fast(clast_world *w) {
    static const double x[] = {0.5, -0.5, 0.2, -0.2};
    for (int i = 0; i < 4; i++) add(w, x[i], 0, (clast_vec3){0, 0, -4.99});
}

static void add_pair(clast_world *w, double x, double half_gap, double speed) {
    for (int side = -1; side <= 1; side += 2)
        add(w, x, side * (RADIUS + half_gap), (clast_vec3){0, 0, -side * speed});
}

/* Equal collisions, side by side. */
static void fill_deep(clast_world *w) {
    static const double x[] = {0.5, -0.5, 0.25};
    for (int i = 0; i < 3; i++) add_pair(w, x[i], 2e-4, 1);
}

static void fill_start(clast_world *w) {
    for (int i = 0; i < 20; i++) add_pair(w, 0.6 - 0.06 * i, -0.1 * RADIUS * (i % 3), 0);
}

/* One leaves the domain in the step in which another comes, and two touch. */
static void fill_left(clast_world *w) {
    static const int shapes[1] = {0};
    clast_feed_def feed = {.name = "rain",
                           .region_min = {-0.9, 0, 0.2},
                           .region_max = {0.9, 0, 0.2},
                           .shapes = 1,
                           .shape = shapes,
                           .number_rate = 10,
                           .from = LEAVES_AT * STEP};
    add(w, -1 + (LEAVES_AT - 0.5) * STEP, 0, (clast_vec3){-1, 0, 0});
    add_pair(w, 0.3, 0.5e-4 * LEAVES_AT, 0.6);
    add(w, 0.7, 0, (clast_vec3){0, 0, 0});
    clast_feed_add(w, &feed);
}

static const trial TRIALS[] = {{"fast", "body 0 ", 0.2, fill_fast},
                               {"deep", "body 0 ", 0.01, fill_deep},
                               {"start", "body 2 (sphere)", 0.05, fill_start},
                               {"left", "body 0 ", 0.2, fill_left}};

/* ---- what a world comes to --------------------------------------------------------------------
 */

typedef struct outcome {
    clast_status status;
    uint64_t steps, hash;
    size_t bodies;
    char error[2048];
} outcome;

static clast_world *new_world(const trial *t, bool alone) {
    clast_world_def d = clast_world_def_default();
    d.time_step = STEP, d.alone = alone, d.threads = 1;
    d.max_overlap = t->max_overlap, d.impact_speed = 1;
    d.domain_min = (clast_vec3){-1, -1, -1}, d.domain_max = (clast_vec3){1, 1, 1};
    clast_world *w = clast_world_new(&d);
    int m = clast_material_add(w, &(clast_material_def){"grain", 2500, 5e6, 0.3});
    clast_pair_set(w, m, m, &(clast_pair_def){.restitution = 0.5, .friction = 0.5});
    clast_shape_add_sphere(w, "sphere", RADIUS, m);
    t->fill(w);
    return w;
}

static outcome run(const trial *t, bool alone) {
    clast_world *w = new_world(t, alone);
    outcome o = {.status = clast_world_prepare(w)};
    bool stands = o.status == CLAST_OK;
    while (!o.status && clast_world_steps(w) < 200) o.status = clast_world_step(w);
    snprintf(o.error, sizeof o.error, "%s", clast_world_error(w));
    o.steps = clast_world_steps(w);
    if (stands) o.hash = clast_world_hash(w), o.bodies = clast_world_bodies(w).count;
    clast_world_free(w);
    return o;
}

static bool is_other(const trial *t, const outcome *a, const outcome *b) {
    return a->status == CLAST_OK || a->status != b->status || a->steps != b->steps ||
           a->hash != b->hash || a->bodies != b->bodies || strcmp(a->error, b->error) != 0 ||
           !strstr(a->error, t->says);
}

int faults_of_guards(void) {
    int faults = 0;
    for (size_t i = 0; i < sizeof TRIALS / sizeof *TRIALS; i++) {
        const trial *t = &TRIALS[i];
        outcome alone = run(t, true), shared = run(t, false);
        if (clast_ranks_most(is_other(t, &alone, &shared)) == 0) continue;
        faults++;
        if (clast_ranks_number() == 0)
            printf("guard %s: alone %zu bodies, %.200s\n  shared %zu bodies, %.200s\n", t->name,
                   alone.bodies, alone.error, shared.bodies, shared.error);
    }
    if (clast_ranks_number() == 0) printf("guards: %d fail otherwise\n", faults);
    return faults;
}
