/* fixture.h - a small scene made by hand, and folders of its own for every test. */
#ifndef CLAST_TESTS_RUN_FIXTURE_H
#define CLAST_TESTS_RUN_FIXTURE_H

#include "experiments/scene/scene.h"

/* Twenty-four dumb-bells and balls in one layer fall into a box whose plug is pulled at 0.2 s:
 * contacts with history, moving and vanishing walls, bodies that rain in and that leave. About
 * 20 000 steps. */
typedef struct bed_options {
    double friction; /* 0 reads as 0.4 */
    double latest;   /* s; 0 reads as 0.3 */
    int threads;     /* 0 reads as 1 */
    double max_overlap;
    bool empty; /* no bodies: for inheriting */
} bed_options;

clast_world *bed_world(const bed_options *o);

/* The world with measures of every kind, frames, rows and checkpoints; free with bed_free(). */
scene *bed_scene(const bed_options *o);
void bed_free(scene *s);

/* A fresh folder below the working folder; malloc'ed. */
char *test_folder(const char *name);
void remove_folder(const char *path);

/* Contents of a file, malloc'ed; NULL when it is not there. */
char *slurp(const char *path, size_t *length);

#endif
