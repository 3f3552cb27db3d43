/* scenes.c - the table of scenes, and how one is opened at its settled state. */
#include "tests/bench/recipe.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

const bench_scene bench_scenes[] = {
    {"A20k", "20 000 spheres d 10 mm at rest in an open box", 20000, 1, 5e-5, 1500, 300,
     .recipe = &bench_box},
    {"A100k", "100 000 spheres d 10 mm at rest in an open box", 100000, 1, 5e-5, 300, 100,
     .recipe = &bench_box},
    {"B", "5000 spheres d 20 mm in one layer, hopper 1 m wide, discharging through 0.7 m", 5000, 1,
     1e-5, 6000, 1000, .recipe = &bench_hopper},
    {"C2", "as B, rigid chains of 2 spheres", 5000, 2, 1e-5, 3000, 1000, .recipe = &bench_hopper},
    {"C4", "as B, rigid chains of 4 spheres", 5000, 4, 1e-5, 1500, 500, .recipe = &bench_hopper},
#ifdef CLAST_BENCH_SILO
    {"D", "20 000 spheres d 10 mm at rest in a silo of 2000 triangles", 20000, 1, 5e-5, 1500, 300,
     .recipe = &bench_silo, .meshes = true},
#endif
    {"G100", "100 spheres d 15 mm on 11 slowly moving bars", 100, 1, 5e-5, 120000, 2000,
     .recipe = &bench_grate},
    {"G300", "300 spheres d 15 mm on 11 slowly moving bars", 300, 1, 5e-5, 80000, 2000,
     .recipe = &bench_grate},
    {"P100", "as G100, at rest on a plane", 100, 1, 5e-5, 120000, 2000, .recipe = &bench_channel,
     .use = BENCH_USE_PEERS},
    {"P300", "as G300, at rest on a plane", 300, 1, 5e-5, 80000, 2000, .recipe = &bench_channel,
     .use = BENCH_USE_PEERS},
    {"S1k", "as A, 1000 spheres", 1000, 1, 5e-5, 20000, 2000, .recipe = &bench_box,
     .use = BENCH_USE_SCALING},
    {"S3k", "as A, 3000 spheres", 3000, 1, 5e-5, 7000, 1000, .recipe = &bench_box,
     .use = BENCH_USE_SCALING},
    {"S10k", "as A, 10 000 spheres", 10000, 1, 5e-5, 2000, 500, .recipe = &bench_box,
     .use = BENCH_USE_SCALING},
    {"S40k", "2 x A20k side by side", 40000, 1, 5e-5, 500, 200, .recipe = &bench_tiles,
     .use = BENCH_USE_SCALING},
    {"S300k", "5 x 3 x A20k side by side", 300000, 1, 5e-5, 100, 50, .recipe = &bench_tiles,
     .use = BENCH_USE_SCALING},
    {"S1M", "10 x 5 x A20k side by side", 1000000, 1, 5e-5, 40, 20, .recipe = &bench_tiles,
     .use = BENCH_USE_SCALING},
};
const int bench_scene_count = sizeof bench_scenes / sizeof *bench_scenes;

/* Counts up whenever a settled state of an older recipe must not be used any more. */
enum { STATE_VERSION = 4 };

const bench_scene *bench_scene_find(const char *name) {
    for (int i = 0; i < bench_scene_count; i++)
        if (strcmp(bench_scenes[i].name, name) == 0) return &bench_scenes[i];
    return NULL;
}

/* ---- what recipes share ---------------------------------------------------------------------- */

void bench_fail(clast_world *w, const char *doing) {
    fprintf(stderr, "bench: %s: %s\n", doing, w ? clast_world_error(w) : clast_world_new_error());
    exit(1);
}

clast_world_def bench_def(const bench_scene *scene, const bench_wish *wish) {
    clast_world_def d = clast_world_def_default();
    d.gravity = (clast_vec3){0, 0, -9.81};
    d.law = CLAST_LAW_HERTZ_MINDLIN;
    d.time_step = scene->dt;
    d.threads = wish->threads;
    if (wish->exactly) d.spheres_per_thread = 1;
    d.isa = wish->isa;
    d.seed = 8;
    return d;
}

clast_world *bench_world(const clast_world_def *def) {
    clast_world *w = clast_world_new(def);
    if (!w) bench_fail(NULL, "new world");
    return w;
}

void bench_materials(clast_world *w, const bench_law *l) {
    int grain =
        clast_material_add(w, &(clast_material_def){"grain", l->density, l->young, l->poisson});
    int wall = clast_material_add(
        w, &(clast_material_def){"wall", l->density, l->wall_young, l->wall_poisson});
    clast_pair_def own = {.restitution = l->restitution, .friction = l->friction};
    clast_pair_def other = {.restitution = l->wall_restitution, .friction = l->wall_friction};
    if (grain != BENCH_GRAIN || wall != BENCH_WALL || clast_pair_set(w, grain, grain, &own) ||
        clast_pair_set(w, grain, wall, &other))
        bench_fail(w, "materials");
}

void bench_plane(clast_world *w, int part, const char *name, int material, clast_vec3 point,
                 clast_vec3 normal) {
    if (clast_wall_add(w, part,
                       &(clast_wall_def){name, CLAST_WALL_PLANE, material, .point = point,
                                         .normal = normal}) < 0)
        bench_fail(w, name);
}

void bench_box_walls(clast_world *w, int part, double half_x, double half_y, double belt) {
    clast_wall_def floor = {"floor", CLAST_WALL_PLANE, BENCH_WALL, .normal = {0, 0, 1},
                            .belt_velocity = {belt, 0, 0}};
    if (clast_wall_add(w, part, &floor) < 0) bench_fail(w, "floor");
    bench_plane(w, part, "left", BENCH_WALL, (clast_vec3){-half_x, 0, 0}, (clast_vec3){1, 0, 0});
    bench_plane(w, part, "right", BENCH_WALL, (clast_vec3){half_x, 0, 0}, (clast_vec3){-1, 0, 0});
    bench_plane(w, part, "front", BENCH_WALL, (clast_vec3){0, -half_y, 0}, (clast_vec3){0, 1, 0});
    bench_plane(w, part, "back", BENCH_WALL, (clast_vec3){0, half_y, 0}, (clast_vec3){0, -1, 0});
}

void bench_body(clast_world *w, clast_vec3 position, double angle, clast_vec3 velocity) {
    clast_quat turn = clast_quat_axis_angle((clast_vec3){0, 1, 0}, angle);
    clast_body_def body = {.position = position, .orientation = turn, .velocity = velocity};
    if (clast_body_add(w, &body) < 0) bench_fail(w, "body");
}

double bench_uniform(uint64_t stream, uint64_t counter, double low, double high) {
    return low + (high - low) * clast_random(8, stream, counter);
}

void bench_steps(clast_world *w, uint64_t count) {
    for (uint64_t i = 0; i < count; i++)
        if (clast_world_step(w)) bench_fail(w, "step");
}

/* ---- opening --------------------------------------------------------------------------------- */

/* Body states by id, so that a world built from them numbers them alike. */
static int by_id(const void *a, const void *b) {
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return x < y ? -1 : x > y;
}

typedef struct numbered_body {
    uint32_t id;
    clast_body_def def;
} numbered_body;

static numbered_body *bodies_of(clast_world *w, size_t *count) {
    clast_bodies b = clast_world_bodies(w);
    numbered_body *all = calloc(b.count + 1, sizeof *all);
    if (!all) abort();
    for (size_t i = 0; i < b.count; i++)
        all[i] = (numbered_body){b.id[i],
                                 {.shape = b.shape[i],
                                  .position = {b.x[i], b.y[i], b.z[i]},
                                  .orientation = {b.qw[i], b.qx[i], b.qy[i], b.qz[i]},
                                  .velocity = {b.vx[i], b.vy[i], b.vz[i]},
                                  .spin = {b.wx[i], b.wy[i], b.wz[i]}}};
    qsort(all, b.count, sizeof *all, by_id);
    *count = b.count;
    return all;
}

/* The same bodies in a new world, without what their contacts remember. */
static clast_world *without_histories(clast_world *w, const bench_scene *scene,
                                      const bench_wish *wish) {
    if (clast_world_prepare(w)) bench_fail(w, "prepare");
    size_t count;
    numbered_body *all = bodies_of(w, &count);
    clast_world_free(w);
    w = scene->recipe->world(scene, wish, BENCH_RUNNING);
    for (size_t i = 0; i < count; i++)
        if (clast_body_add(w, &all[i].def) < 0) bench_fail(w, "body");
    free(all);
    return w;
}

static clast_world *try_open(const bench_scene *scene, const bench_wish *wish, const char *path) {
    clast_world *w = scene->recipe->world(scene, wish, BENCH_RUNNING);
    if (clast_checkpoint_inherit(w, path) == CLAST_OK) return w;
    fprintf(stderr, "bench: %s\n", clast_world_error(w));
    clast_world_free(w);
    return NULL;
}

clast_world *bench_scene_load(const bench_scene *scene, const bench_wish *wish,
                              const char *states) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s-%d.h5", states, scene->name, STATE_VERSION);
    struct stat there;
    clast_world *w = stat(path, &there) == 0 ? try_open(scene, wish, path) : NULL;
    if (!w) {
        mkdir(states, 0777); /* when it is there already, or cannot be made, saving will tell */
        bench_settle(scene, path, states);
        w = try_open(scene, wish, path);
    }
    if (!w) exit(1);
    return wish->fresh ? without_histories(w, scene, wish) : w;
}

clast_world *bench_scene_open(const bench_scene *scene, const bench_wish *wish,
                              const char *states) {
    clast_world *w = bench_scene_load(scene, wish, states);
    if (clast_world_prepare(w)) bench_fail(w, "prepare");
    return w;
}
