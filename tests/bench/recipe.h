/* recipe.h - how a scene of the benchmarks is built and brought to rest. Private to tests/bench. */
#ifndef CLAST_BENCH_RECIPE_H
#define CLAST_BENCH_RECIPE_H

#include "tests/bench/scenes.h"

#include <stdio.h>

typedef enum bench_stage {
    BENCH_FALLING, /* loose start, little global damping */
    BENCH_RESTING, /* much of it */
    BENCH_RUNNING  /* none */
} bench_stage;

/* 1/s. Resting: about critical for the sway of a bed as a whole. */
double bench_damping(bench_stage stage);

/* What touches what, and how. */
typedef struct bench_law {
    double density, young, poisson; /* kg/m3, Pa: of the grains */
    double wall_young, wall_poisson;
    double restitution, wall_restitution; /* measured rebound */
    double friction, wall_friction;
} bench_law;

typedef struct bench_recipe {
    const char *kind; /* "box", "hopper", "grate": what a peer's input file must build */
    /* Walls, materials and the one shape; no bodies. */
    clast_world *(*world)(const bench_scene *scene, const bench_wish *wish, bench_stage stage);
    /* The loose start that settles. */
    void (*fill)(clast_world *w, const bench_scene *scene, const char *states);
    bench_law (*law)(void);                                      /* while running */
    void (*half_size)(const bench_scene *scene, double half[2]); /* m: side walls, in x and y */
    int threads;                              /* of the settling run; 0: the engine's choice */
    double (*fall)(const bench_scene *scene); /* s, then it comes to rest */
    double limit;                             /* s, at most so long after that */
    /* LIGGGHTS commands for walls that its input file cannot build by itself, with files STEM-*; or
     * NULL. */
    void (*peer_walls)(FILE *include, const char *stem);
} bench_recipe;

extern const bench_recipe bench_box;     /* A: scene_box.c */
extern const bench_recipe bench_hopper;  /* B, C: scene_hopper.c */
extern const bench_recipe bench_grate;   /* G: scene_grate.c */
extern const bench_recipe bench_channel; /* P: scene_channel.c */
extern const bench_recipe bench_tiles;   /* S: scene_tiles.c */
extern const bench_recipe bench_silo;    /* D: scene_silo.c, where meshes/ is built */

/* A definition with what all scenes share: gravity, law, step, threads, guards. */
clast_world_def bench_def(const bench_scene *scene, const bench_wish *wish);
clast_world *bench_world(const clast_world_def *def);

/* Materials "grain" (index 0) and "wall" (1) with their pairs. */
enum { BENCH_GRAIN, BENCH_WALL };
void bench_materials(clast_world *w, const bench_law *law);

void bench_body(clast_world *w, clast_vec3 position, double angle, clast_vec3 velocity);

/* An endless plane through `point` that pushes along `normal`. */
void bench_plane(clast_world *w, int part, const char *name, int material, clast_vec3 point,
                 clast_vec3 normal);

/* A floor at z = 0, whose surface runs along x at `belt` m/s, and four sides, by planes. */
void bench_box_walls(clast_world *w, int part, double half_x, double half_y, double belt);

/* Uniform in [low, high): number `counter` of stream `stream`. */
double bench_uniform(uint64_t stream, uint64_t counter, double low, double high);

/* settle.c: makes states/NAME-*.h5 from the recipe. */
void bench_settle(const bench_scene *scene, const char *path, const char *states);

#endif
