/* shape_level.h - one level of detail of a clump: its spheres, masses, quality and what they took;
 * and the three ways to show a list of them. */
#ifndef CLAST_COMMAND_SHAPE_LEVEL_H
#define CLAST_COMMAND_SHAPE_LEVEL_H

#include <stdbool.h>

#include "shapes/clump.h"
#include "shapes/quality.h"

typedef struct shape_level {
    shape_stops stops;
    shape_filling filling;
    shape_sphere *placed; /* in the frame of the target */
    shape_clump clump;
    shape_quality quality;
    double fill_s, mass_s; /* s, of processor time */
} shape_level;

/* What all levels share. */
typedef struct shape_sheet {
    const shape_target *target;
    const char *title;    /* "cylinder: radius 5 mm, length 20 mm" */
    const char *command;  /* as typed, for the head of the file */
    const char *name;     /* of the template */
    const char *material; /* the name that the template gives it */
    double density;       /* kg/m3, of that material */
    shape_mass_from from;
    int count;
    shape_level *levels;
} shape_sheet;

void shape_print(const shape_sheet *sheet);

/* malloc'ed texts. */
char *shape_yaml(const shape_sheet *sheet);
char *shape_csv(const shape_sheet *sheet);

/* The target, then each level over its translucent target, side by side. `bare`: without titles,
 * for figures. False with a message on standard error. */
bool shape_draw(const shape_sheet *sheet, const char *path, int height, bool bare);

#endif
