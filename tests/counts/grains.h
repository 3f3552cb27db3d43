/* grains.h - small beds that say what a step costs, built through the public interface. A bed is
 * brought to rest once and kept as a checkpoint: the engine gives the same bits on every machine,
 * so whoever starts from it does the same work. */
#ifndef CLAST_TESTS_GRAINS_H
#define CLAST_TESTS_GRAINS_H

#include "engine/clast.h"

typedef enum grains_kind {
    GRAINS_BOX,   /* equal spheres at rest in an open box of five planes */
    GRAINS_LAYER, /* the same in one vertical layer */
    GRAINS_RODS,  /* rigid rods of two overlapping spheres at rest in the box */
    GRAINS_WALLS, /* single spheres in the grooves of a corrugated floor of plates that moves */
    GRAINS_FLOW,  /* the box with a fast belt as floor: lists are made anew all the time */
    GRAINS_BOUNCE /* the loose start of the box: neither friction nor damping, so it never rests */
} grains_kind;

typedef struct grains {
    const char *name;
    grains_kind kind;
    int bodies;
    uint64_t settle; /* steps that bring it to rest */
} grains;

typedef struct grains_wish {
    int threads; /* 0 reads as 1 */
    clast_isa isa;
    clast_precision precision;
} grains_wish;

enum { GRAINS_COUNT = 5 };
extern const grains grains_small[GRAINS_COUNT]; /* some hundred bodies each */

extern const double GRAINS_RADIUS; /* m */
extern const double GRAINS_STEP;   /* s, of every bed */

/* Brings the bed to rest and saves it; stops the program when that fails. */
void grains_settle(const grains *g, const char *path);

/* The bed as it was saved, without damping, ready to step; stops the program when that fails. */
clast_world *grains_open(const grains *g, const grains_wish *wish, const char *path);

/* Steps; stops the program with the world's error. */
void grains_steps(clast_world *w, uint64_t count);

#endif
