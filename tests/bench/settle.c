/* settle.c - settled states: a loose start falls, then comes to rest under global damping. */
#include "tests/bench/recipe.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

/* At rest: mean energy of motion per body below this part of its weight times one radius. */
static const double REST = 1e-5;

double bench_damping(bench_stage stage) {
    return stage == BENCH_FALLING ? 1 : stage == BENCH_RESTING ? 20 : 0;
}

/* Energy of motion over that of rest. */
static double unrest(clast_world *w) {
    clast_bodies b = clast_world_bodies(w);
    clast_shape_def s = clast_world_shape(w, 0);
    clast_energy e = clast_world_energy(w);
    return (e.kinetic + e.rotational) / (REST * (double)b.count * s.mass * 9.81 * s.radius[0]);
}

static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static clast_world *world_of(const bench_scene *scene, bench_stage stage) {
    bench_wish wish = {.threads = scene->recipe->threads, .isa = CLAST_ISA_AUTO};
    return scene->recipe->world(scene, &wish, stage);
}

static void save(clast_world *w, const char *path) {
    if (clast_checkpoint_save(w, path, NULL)) bench_fail(w, "settled state");
    clast_world_free(w);
}

void bench_settle(const bench_scene *scene, const char *path, const char *states) {
    const bench_recipe *r = scene->recipe;
    double start = seconds(), fall = r->fall(scene);
    fprintf(stderr, "bench: settling %s ...", scene->name);
    clast_world *w = world_of(scene, BENCH_FALLING);
    r->fill(w, scene, states);
    if (clast_world_run(w, fall)) bench_fail(w, "falling");
    save(w, path);
    w = world_of(scene, BENCH_RESTING);
    if (clast_checkpoint_inherit(w, path)) bench_fail(w, "inherit");
    do bench_steps(w, 200);
    while (unrest(w) > 1 && clast_world_time(w) < r->limit);
    fprintf(stderr, " %.2f s of simulation in %.0f s, energy of motion %.1e of the limit of rest\n",
            fall + clast_world_time(w), seconds() - start, unrest(w));
    if (unrest(w) > 1) {
        fprintf(stderr, "bench: %s does not come to rest\n", scene->name);
        exit(1);
    }
    save(w, path);
}
