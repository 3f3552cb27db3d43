/* fault.h - what is wrong with a scene, collected instead of thrown: a user who made five mistakes
 * learns of five at once.
 */
#ifndef CLAST_SCENE_FAULT_H
#define CLAST_SCENE_FAULT_H

#include "experiments/scene/arena.h"

#include <stdbool.h>

typedef struct scene_fault {
    const char *file;
    int line; /* 1, 2, ...; 0 when no line is to blame */
    bool warning;
    bool foreign;     /* in a file that the scene names: printed last */
    const char *key;  /* path such as materials.glass.young; may be "" */
    const char *text; /* what was found and what was expected */
    int order;        /* of reporting: keeps sorting stable */
} scene_fault;

typedef struct scene_faults {
    scene_arena *arena;
    const char *file; /* the scene file, which most faults are in */
    scene_fault *items;
    int count, room;
    int errors; /* those that are not warnings */
} scene_faults;

void scene_report(scene_faults *faults, int line, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
void scene_warn(scene_faults *faults, int line, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* A fault in a file that the scene names. */
void scene_report_in(scene_faults *faults, const char *file, int line, const char *key,
                     const char *format, ...) __attribute__((format(printf, 5, 6)));

/* "file:line: key: text" lines, sorted by line; malloc'ed. NULL when there is nothing to say. */
char *scene_faults_text(const scene_faults *faults);

/* The candidate most like `word`, or NULL when none is close enough to be what was meant. */
const char *scene_suggest(const char *word, const char *const *candidates, int count);

/* Typing errors between two words: insert, delete, replace, swap of neighbours; the case of a
 * letter counts too. Stops counting at `limit`. */
int scene_distance(const char *a, const char *b, int limit);

#endif
