/* reference.c - the tables of schema.c in words: for messages and for `clast check --keys`. */
#include "experiments/scene/schema.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void append_range(scene_buffer *out, key_range range) {
    bool low = isfinite(range.low), high = isfinite(range.high);
    if (low) scene_append(out, ", %s %.15g", range.low_open ? ">" : ">=", range.low);
    if (high)
        scene_append(out, "%s %s %.15g", low ? " and" : ",",
                     range.high_open ? "<" : "<=", range.high);
}

static bool starts_with_vowel(const char *word) {
    return strchr("aeiou", word[0]) != NULL;
}

static void append_quantity(scene_buffer *out, const scene_key *key) {
    const char *noun = unit_kind_name(key->unit), *si = unit_kind_si(key->unit);
    scene_append(out, "%s %s%s%s", starts_with_vowel(noun) ? "an" : "a", noun, si[0] ? " in " : "",
                 si);
    append_range(out, key->range);
}

static void append_words(scene_buffer *out, const char *const *words) {
    for (int i = 0; words[i]; i++) scene_append(out, "%s%s", i ? ", " : "one of: ", words[i]);
}

static void append_list(scene_buffer *out, const scene_key *key, const char *form) {
    scene_append(out, "%s, each ", form);
    append_quantity(out, key);
}

static void append_kind(scene_buffer *out, const scene_key *key) {
    static const char *const LENGTHS[] = {"", "[a]", "[a, b]", "[a, b, c]", "[a, b, c, d]"};
    switch (key->kind) {
    case KEY_NUMBER:
        append_quantity(out, key);
        break;
    case KEY_COUNT:
    case KEY_SEED:
        scene_append(out, "a whole number");
        append_range(out, key->range);
        break;
    case KEY_SWITCH:
        scene_append(out, "true or false");
        break;
    case KEY_CHOICE:
    case KEY_AXES:
        append_words(out, key->choices);
        if (key->kind == KEY_AXES) scene_append(out, ", or a list of these");
        break;
    case KEY_TEXT:
        if (key->choices)
            append_words(out, key->choices);
        else
            scene_append(out, "a text");
        break;
    case KEY_FILE:
        scene_append(out, "a file (from the folder of the scene, or the working folder)");
        break;
    case KEY_NAME:
        scene_append(out, "a name from %s", key->refers);
        break;
    case KEY_NAMES:
        scene_append(out, "[a, b], both names from %s", key->refers);
        break;
    case KEY_NAME_LIST:
        scene_append(out, "[a, b, ...], names from %s", key->refers);
        break;
    case KEY_VECTOR:
        append_list(out, key, "[x, y, z]");
        break;
    case KEY_SPACING:
        append_quantity(out, key);
        scene_append(out, ", or [x, y, z] of them");
        break;
    case KEY_NUMBERS:
        append_list(out, key, LENGTHS[key->length]);
        break;
    case KEY_VALUES:
        scene_append(out, "a list of at most %d numbers, in SI or each with its unit", key->length);
        break;
    case KEY_POINTS:
        append_list(out, key, "[[x, z], [x, z], [x, z], ...]");
        break;
    case KEY_INTERVAL:
        scene_append(out, "a time in s or a rate in /s, with its unit");
        append_range(out, key->range);
        break;
    case KEY_SECTION:
    case KEY_PART:
        scene_append(out, "a map of keys");
        break;
    case KEY_LIST:
        scene_append(out, "a list");
        break;
    case KEY_NAMED:
    case KEY_PARAMETERS:
        scene_append(out, "a map of names");
        break;
    }
}

const char *schema_expectation(scene_arena *arena, const scene_key *key) {
    SCENE_ASSERT(arena && key);
    scene_buffer out = {0};
    append_kind(&out, key);
    if (key->word) scene_append(&out, ", or %s", key->word);
    const char *text = scene_copy(arena, out.text, out.length);
    free(out.text);
    return text;
}

/* ---- the reference --------------------------------------------------------------------------- */

enum { SECTIONS_MAX = 64 };

typedef struct printer {
    scene_arena arena;
    scene_buffer out;
    const key_section *done[SECTIONS_MAX]; /* some sections are used in several places */
    int count;
} printer;

static const char *state_of(const scene_key *key) {
    if (key->one_of) return "one of these";
    if (key->required) return "required";
    return key->fallback ? key->fallback : "";
}

static void print_key(printer *p, const scene_key *key) {
    scene_append(&p->out, "| `%s` | %s | %s | %s |\n", key->name,
                 schema_expectation(&p->arena, key), state_of(key), key->meaning);
}

static bool is_done(const printer *p, const key_section *section) {
    for (int i = 0; i < p->count; i++)
        if (p->done[i] == section) return true;
    return false;
}

static void print_section(printer *p, const key_section *section) {
    if (is_done(p, section) || section->count == 0) return;
    SCENE_ASSERT(p->count < SECTIONS_MAX);
    p->done[p->count++] = section;
    scene_append(&p->out, "%s### %s\n\n| key | value | default | meaning |\n|---|---|---|---|\n",
                 p->count > 1 ? "\n" : "", section->title);
    for (int i = 0; i < section->count; i++) print_key(p, &section->keys[i]);
    for (int i = 0; i < section->count; i++)
        if (section->keys[i].section) print_section(p, section->keys[i].section);
}

static void print_units(printer *p) {
    bool prefix;
    const char *symbol;
    scene_append(&p->out, "\n### units\n\nWith a prefix (p n u m c d h k M G T) or without:");
    for (int i = 0; (symbol = unit_listed(i, &prefix)) != NULL; i++)
        if (prefix) scene_append(&p->out, " `%s`", symbol);
    scene_append(&p->out, ".\nWithout prefix only:");
    for (int i = 0; (symbol = unit_listed(i, &prefix)) != NULL; i++)
        if (!prefix) scene_append(&p->out, " `%s`", symbol);
    scene_append(&p->out, ".\n");
}

char *schema_reference(void) {
    printer p = {0};
    print_section(&p, &SCHEMA_SCENE);
    print_units(&p);
    scene_arena_free(&p.arena);
    return p.out.text;
}
