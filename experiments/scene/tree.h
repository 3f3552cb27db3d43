/* tree.h - a YAML document as a tree that knows where everything stood. */
#ifndef CLAST_SCENE_TREE_H
#define CLAST_SCENE_TREE_H

#include "experiments/scene/fault.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum tree_kind { TREE_SCALAR, TREE_LIST, TREE_MAP } tree_kind;

typedef struct tree_node {
    tree_kind kind;
    int line;          /* of the value of a scalar, of the key of a list or map */
    const char *text;  /* scalar */
    bool quoted;       /* scalar in quotes: never empty, never a word such as true */
    size_t begin, end; /* scalar: bytes of the source that it takes */
    const char *key;   /* as an entry of a map, else NULL */
    int index;         /* place among its siblings */
    int children;
    const struct tree_node *parent, *first, *next;
} tree_node;

/* NULL with faults when the text is no YAML; an empty text is an empty map. */
const tree_node *scene_tree_load(scene_arena *arena, scene_faults *faults, const char *text,
                                 size_t length);

const tree_node *tree_get(const tree_node *map, const char *key); /* NULL when absent */
bool tree_is_empty(const tree_node *node); /* nothing after the colon, or ~ or null */

/* "materials.glass.young", "bodies[2].grid"; of `key` inside `node` when key is not NULL. */
const char *tree_path(scene_arena *arena, const tree_node *node, const char *key);

#endif
