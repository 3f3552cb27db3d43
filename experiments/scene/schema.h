/* schema.h - every key of a scene in tables: name, dimension, range, default, meaning, and the
 * field it fills. Reading, checking, defaults and the reference of `clast check --keys` come from
 * here alone.
 */
#ifndef CLAST_SCENE_SCHEMA_H
#define CLAST_SCENE_SCHEMA_H

#include "experiments/scene/arena.h"
#include "experiments/scene/unit.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum key_kind {                /* field in the target struct */
                        KEY_NUMBER,    /* double */
                        KEY_COUNT,     /* int */
                        KEY_SEED,      /* uint64_t */
                        KEY_SWITCH,    /* bool */
                        KEY_CHOICE,    /* int or enum: place of the word in `choices` */
                        KEY_AXES,      /* bool[3]: x, y, z, one of them or a list */
                        KEY_TEXT,      /* const char *, one of `choices` if there are any */
                        KEY_FILE,      /* const char *, an existing file or folder */
                        KEY_NAME,      /* int: index of an entry of the section `refers` */
                        KEY_NAMES,     /* int[2] */
                        KEY_NAME_LIST, /* name_list */
                        KEY_VECTOR,    /* clast_vec3 */
                        KEY_SPACING,   /* clast_vec3, one number stands for all three */
                        KEY_NUMBERS,   /* double[length] */
                        KEY_VALUES,    /* double[length], of any dimension; fewer leave zeros */
                        KEY_POINTS,    /* point_list */
                        KEY_INTERVAL,  /* double: s between two outputs, from a time or a rate */
                        KEY_SECTION,   /* fields of `section` in the same target */
                        KEY_PART,      /* fields of `section` in a struct at offset */
                        KEY_NAMED,     /* item_list: map from names to `section` */
                        KEY_LIST,      /* item_list: list of `section` */
                        KEY_PARAMETERS /* read before anything else */
} key_kind;

typedef struct key_range {
    double low, high;
    bool low_open, high_open; /* the end itself is outside */
} key_range;

struct key_section;

typedef struct scene_key {
    const char *name;
    key_kind kind;
    unit_kind unit;
    size_t offset;
    key_range range;
    const char *fallback; /* default as it would be written; NULL: stays as it was */
    bool required;
    bool one_of;                /* exactly one of the keys so marked must be there */
    const char *word;           /* a word that may stand for 0: auto, none, never */
    const char *const *choices; /* up to NULL */
    const char *refers;
    int length;
    const struct key_section *section;
    const char *meaning;
} scene_key;

typedef struct key_section {
    const char *title; /* of the table in the reference, e.g. "walls.NAME.plate" */
    size_t size;       /* of one item, for lists */
    const scene_key *keys;
    int count;
} key_section;

extern const key_section SCHEMA_SCENE;

/* "a pressure in Pa, > 0", "one of: stop, report", "a velocity (3 numbers) in m/s". */
const char *schema_expectation(scene_arena *arena, const scene_key *key);

/* The reference of all keys as Markdown tables; malloc'ed. */
char *schema_reference(void);

#endif
