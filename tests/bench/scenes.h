/* scenes.h - the scenes that speed is measured on (DESIGN section 8), built through the public
 * interface of the engine. Every scene starts from a settled state that is made once, by the engine
 * itself, kept as a file below the build folder, and given to the peers too. */
#ifndef CLAST_BENCH_SCENES_H
#define CLAST_BENCH_SCENES_H

#include "engine/clast.h"

struct bench_recipe; /* how a scene is built and settled: recipe.h */

typedef enum bench_use {
    BENCH_USE_ALL,    /* ours and the peers' */
    BENCH_USE_PEERS,  /* in place of G for a peer without meshes */
    BENCH_USE_SCALING /* cost against size */
} bench_use;

typedef struct bench_scene {
    const char *name; /* "A20k", "A100k", "B", "C2", "C4", "D", "G100", "G300" */
    const char *what; /* one line */
    size_t bodies;    /* in the settled state */
    int spheres;      /* per body */
    double dt;        /* s */
    uint64_t steps;   /* of one timed run: a second or more on one core */
    uint64_t warm;    /* steps before the timed ones */
    const struct bench_recipe *recipe;
    bench_use use;
    bool meshes; /* walls from a file */
} bench_scene;

extern const bench_scene bench_scenes[];
extern const int bench_scene_count;

/* NULL when there is no such scene. */
const bench_scene *bench_scene_find(const char *name);

typedef struct bench_wish {
    int threads; /* at most; 0: the engine's choice */
    clast_isa isa;
    bool fresh; /* without the tangential histories of the settled state, as the peers start */
    bool exactly; /* so many threads, whether they pay or not */
} bench_wish;

/* The scene at its settled state, ready for clast_world_step(). `states` is the folder of settled
 * states; what is missing there is made first (seconds to minutes, said on stderr). Stops the
 * program when that fails. */
clast_world *bench_scene_open(const bench_scene *scene, const bench_wish *wish, const char *states);

/* The same before clast_world_prepare(). */
clast_world *bench_scene_load(const bench_scene *scene, const bench_wish *wish, const char *states);

/* Stops the program with the world's error. */
void bench_fail(clast_world *w, const char *doing) __attribute__((noreturn));

/* Steps; stops the program when the run fails. */
void bench_steps(clast_world *w, uint64_t count);

#endif
