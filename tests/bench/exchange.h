/* exchange.h - settled states for the peers, and dumps that compare the physics. */
#ifndef CLAST_BENCH_EXCHANGE_H
#define CLAST_BENCH_EXCHANGE_H

#include "tests/bench/scenes.h"

/* OUT/SCENE.data, as LAMMPS and LIGGGHTS read it (one element sphere per atom; chains with a
 * section Molecules), and OUT/SCENE.vars, the numbers their input files need, as `variable`
 * commands. Returns an exit code. */
int bench_export(const bench_scene *scene, const char *states, const char *out);

/* Runs the scene from where the peers start and writes OUT/SCENE-clast-STEP.dump at the given
 * steps, in the peers' text form. */
int bench_physics(const bench_scene *scene, const char *const *steps, int count, const char *states,
                  const char *out);

/* The scenes, one a line: name bodies spheres-per-body step-s steps warm-steps radius-m kind. */
int bench_list(void);

/* Prints what a dump of any code holds: contacts per sphere, energies of motion, heights, spheres
 * below z = 0. */
int bench_judge(const bench_scene *scene, const char *dump);

#endif
