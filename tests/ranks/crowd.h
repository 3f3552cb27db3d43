/* crowd.h - small scenes that several processes share. */
#ifndef CLAST_TESTS_CROWD_H
#define CLAST_TESTS_CROWD_H

#include "engine/clast.h"

typedef struct crowd {
    const char *name;
    uint64_t steps;
    bool divides; /* anew, after the start: the work moves about */
    clast_world *(*make)(const clast_world_def *base);
} crowd;

extern const crowd CROWDS[];
extern const int CROWD_COUNT;

/* Alone on every process, or shared by all; stops the program where it cannot be made. */
clast_world *crowd_new(const crowd *c, bool alone, int threads);

#endif
