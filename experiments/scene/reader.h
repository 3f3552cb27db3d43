/* reader.h - fills a draft from a tree by the tables of schema.c, reporting all faults it meets. */
#ifndef CLAST_SCENE_READER_H
#define CLAST_SCENE_READER_H

#include "experiments/scene/draft.h"
#include "experiments/scene/parameters.h"
#include "experiments/scene/schema.h"

typedef struct scene_reader {
    scene_arena *arena;
    scene_faults *faults;
    scene_parameters *parameters;
    const tree_node *root;
    const char *folder; /* of the scene file: relative paths start there */
} scene_reader;

void scene_read(scene_reader *reader, scene_draft *draft);

/* A fault at `key` inside `node`, or at `node` itself when key is NULL. */
void scene_fault_at(scene_arena *arena, scene_faults *faults, const tree_node *node,
                    const char *key, const char *format, ...) __attribute__((format(printf, 5, 6)));

#endif
