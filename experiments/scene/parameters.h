/* parameters.h - the names of a scene file: defined once, used as $name, overridden by --set. */
#ifndef CLAST_SCENE_PARAMETERS_H
#define CLAST_SCENE_PARAMETERS_H

#include "experiments/scene/tree.h"
#include "experiments/scene/unit.h"

typedef struct parameter {
    const tree_node *node;
    unit_value value;
    enum { PARAMETER_UNREAD, PARAMETER_READING, PARAMETER_GOOD, PARAMETER_BAD } state;
    bool used;
} parameter;

typedef struct scene_parameters {
    scene_arena *arena;
    scene_faults *faults;
    parameter *items;
    int count;
    int depth; /* of parameters that use parameters */
} scene_parameters;

/* Takes the section `parameters` of a scene; values are worked out when first asked for. */
scene_parameters scene_parameters_read(scene_arena *arena, scene_faults *faults,
                                       const tree_node *root);
unit_scope scene_parameters_scope(scene_parameters *parameters);

/* The text with every $name and ${name} replaced by that of the parameter; NULL after a fault. */
const char *scene_parameters_replace(scene_parameters *parameters, const tree_node *node);

/* If the text is one $name alone, the text of that parameter, else the text itself. */
const char *scene_parameters_word(scene_parameters *parameters, const char *text);

void scene_parameters_warn_unused(const scene_parameters *parameters);

/* The source with every "name=value" of --set put in, as if the file had been edited. Names that
 * the file does not define and values of another dimension are faults. */
const char *scene_parameters_set(scene_arena *arena, scene_faults *faults, const tree_node *root,
                                 const char *source, const char *const *set, int set_count);

#endif
