/* edit.h - puts other values into the text of a scene and leaves the rest of it, comments too, as
 * it stands. */
#ifndef CLAST_TUNE_EDIT_H
#define CLAST_TUNE_EDIT_H

#include "experiments/scene/parameters.h"

typedef struct text_edit {
    size_t begin, end; /* bytes of the text that are replaced; equal: something is put in */
    const char *text;
} text_edit;

enum { EDITS_MAX = 256 };

/* A text being edited. Everything but `source` lives in the arena. */
typedef struct scene_edit {
    scene_arena *arena;
    scene_faults faults;
    const char *source;
    const tree_node *root; /* NULL when the text is no YAML */
    text_edit edits[EDITS_MAX];
    int count;
    bool full; /* more than EDITS_MAX places */
} scene_edit;

scene_edit scene_edit_start(scene_arena *arena, const char *source);

/* Multiplies a scalar: "$step" becomes "$step * 4", "3.5 GPa" becomes "(3.5 GPa) / 10". The same
 * place twice (an alias) is edited once. `operation` is such as "* 4". */
void scene_edit_scale(scene_edit *e, const tree_node *node, const char *operation);

/* Replaces a scalar by a plain text. */
void scene_edit_replace(scene_edit *e, const tree_node *node, const char *text);

/* Gives `key` of the section `section` (NULL: of the scene itself) a value, whether it is there or
 * not. False when the place for it cannot be found. */
bool scene_edit_put(scene_edit *e, const char *section, const char *key, const char *value);

/* The edited text; malloc'ed. NULL when there were too many places. */
char *scene_edit_finish(scene_edit *e);

#endif
