#include "experiments/scene/parameters.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DEPTH_MAX = 20 }; /* parameters that use parameters; more is a circle */

static bool is_name_start(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static size_t name_length(const char *text) {
    if (!is_name_start(*text)) return 0;
    size_t length = 1;
    while (is_name_start(text[length]) || (text[length] >= '0' && text[length] <= '9')) length++;
    return length;
}

static parameter *find(scene_parameters *parameters, const char *name) {
    for (int i = 0; i < parameters->count; i++)
        if (!strcmp(parameters->items[i].node->key, name)) return &parameters->items[i];
    return NULL;
}

static const char *suggest(const scene_parameters *parameters, const char *name) {
    const char **names = calloc((size_t)parameters->count + 1, sizeof *names);
    if (!names) return NULL;
    for (int i = 0; i < parameters->count; i++) names[i] = parameters->items[i].node->key;
    const char *best = scene_suggest(name, names, parameters->count);
    free(names);
    return best;
}

static void explain_unknown(const scene_parameters *parameters, const char *name,
                            char why[UNIT_TEXT]) {
    const char *near = suggest(parameters, name);
    snprintf(why, UNIT_TEXT, "unknown parameter '%.40s'%s%.40s%s", name,
             near ? ", did you mean '" : "", near ? near : "", near ? "'?" : "");
}

static void work_out(scene_parameters *parameters, parameter *p) {
    char why[UNIT_TEXT];
    const char *path = tree_path(parameters->arena, p->node, NULL);
    unit_scope scope = scene_parameters_scope(parameters);
    p->state = PARAMETER_READING;
    parameters->depth++;
    bool good = parameters->depth <= DEPTH_MAX && unit_parse(p->node->text, &scope, &p->value, why);
    if (parameters->depth > DEPTH_MAX) snprintf(why, sizeof why, "parameters nested too deeply");
    parameters->depth--;
    p->state = good ? PARAMETER_GOOD : PARAMETER_BAD;
    if (!good && why[0])
        scene_report(parameters->faults, p->node->line, path,
                     "found '%s': %s, expected a number with its unit", p->node->text, why);
}

static bool find_value(void *context, const char *name, unit_value *value, char why[UNIT_TEXT]) {
    scene_parameters *parameters = context;
    parameter *p = find(parameters, name);
    if (!p) {
        explain_unknown(parameters, name, why);
        return false;
    }
    p->used = true;
    if (p->state == PARAMETER_READING) {
        snprintf(why, UNIT_TEXT, "$%.40s depends on itself", name);
        return false;
    }
    if (p->state == PARAMETER_UNREAD) work_out(parameters, p);
    *value = p->value;
    why[0] = '\0'; /* a bad parameter has been reported where it is defined */
    return p->state == PARAMETER_GOOD;
}

static bool knows(void *context, const char *name) {
    return find(context, name) != NULL;
}

unit_scope scene_parameters_scope(scene_parameters *parameters) {
    return (unit_scope){.find = find_value, .knows = knows, .context = parameters};
}

scene_parameters scene_parameters_read(scene_arena *arena, scene_faults *faults,
                                       const tree_node *root) {
    SCENE_ASSERT(arena && faults);
    scene_parameters parameters = {.arena = arena, .faults = faults};
    const tree_node *map = tree_get(root, "parameters");
    if (tree_is_empty(map)) return parameters;
    if (map->kind != TREE_MAP) {
        scene_report(faults, map->line, "parameters",
                     "found no map, expected 'name: value' entries");
        return parameters;
    }
    parameters.items = scene_alloc(arena, (size_t)map->children * sizeof *parameters.items);
    for (const tree_node *node = map->first; node; node = node->next) {
        const char *path = tree_path(arena, node, NULL);
        size_t length = name_length(node->key);
        if (node->key[length] || length == 0 || length > 40)
            scene_report(faults, node->line, path,
                         "found a name with other characters than letters, digits and _ "
                         "(or more than 40), expected a name such as orifice");
        else if (node->kind != TREE_SCALAR || (!node->quoted && !node->text[0]))
            scene_report(faults, node->line, path, "found no single value, expected one");
        else
            parameters.items[parameters.count++].node = node;
    }
    return parameters;
}

/* The parameter whose name starts at text, *end behind it; *end == text when there is no name. */
static parameter *parameter_at(scene_parameters *parameters, const char *text, const char **end,
                               const char **name) {
    bool braces = *text == '{';
    size_t length = name_length(text + braces);
    *end = text;
    if (length == 0 || (braces && text[1 + length] != '}')) return NULL;
    *end = text + length + 2 * (size_t)braces;
    *name = scene_copy(parameters->arena, text + braces, length);
    return find(parameters, *name);
}

const char *scene_parameters_replace(scene_parameters *parameters, const tree_node *node) {
    SCENE_ASSERT(parameters && node && node->kind == TREE_SCALAR);
    scene_buffer out = {0};
    bool good = true;
    scene_append(&out, "%s", "");
    for (const char *at = node->text; *at;) {
        const char *end = at, *name = "";
        parameter *p = *at == '$' ? parameter_at(parameters, at + 1, &end, &name) : NULL;
        if (p) {
            p->used = true;
            scene_append(&out, "%s", p->node->text);
            at = end;
        } else if (*at == '$' && end > at + 1) {
            char why[UNIT_TEXT];
            explain_unknown(parameters, name, why);
            scene_report(parameters->faults, node->line, tree_path(parameters->arena, node, NULL),
                         "found '%s': %s", node->text, why);
            good = false;
            at = end;
        } else {
            scene_append(&out, "%c", *at++);
        }
    }
    const char *text = good ? scene_copy(parameters->arena, out.text, out.length) : NULL;
    free(out.text);
    return text;
}

const char *scene_parameters_word(scene_parameters *parameters, const char *text) {
    SCENE_ASSERT(parameters && text);
    const char *end, *name;
    parameter *p = *text == '$' ? parameter_at(parameters, text + 1, &end, &name) : NULL;
    if (!p || *end) return text;
    p->used = true;
    return p->node->text;
}

void scene_parameters_warn_unused(const scene_parameters *parameters) {
    for (int i = 0; i < parameters->count; i++) {
        const parameter *p = &parameters->items[i];
        if (!p->used)
            scene_warn(parameters->faults, p->node->line,
                       tree_path(parameters->arena, p->node, NULL), "never used as $%s",
                       p->node->key);
    }
}

/* ---- --set ----------------------------------------------------------------------------------- */

typedef struct edit {
    const parameter *parameter;
    const char *value;
} edit;

/* A motion, and not three days: the one word of a scene that is a number with a unit as well. */
static bool is_word(const char *text) {
    return strcmp(text, "3d") == 0;
}

/* A value with a unit in the file and none on the command line is off by a thousand sooner or
 * later. */
static bool same_dimension(scene_parameters *parameters, parameter *p, const char *value) {
    char why[UNIT_TEXT];
    unit_value before, now;
    unit_scope scope = scene_parameters_scope(parameters);
    if (is_word(p->node->text) || !unit_parse(p->node->text, &scope, &before, why))
        return true; /* a text, say a path */
    if (before.bare) return true;
    bool good = unit_parse(value, &scope, &now, why);
    if (good && unit_same(before.dimension, now.dimension) && !now.bare) return true;
    char dimension[UNIT_TEXT];
    unit_describe(before.dimension, dimension);
    scene_report(parameters->faults, 0, scene_print(parameters->arena, "--set %s", p->node->key),
                 "found '%s'%s%s, expected a %s with its unit, as in '%s' of line %d", value,
                 good || !why[0] ? "" : ": ", good ? "" : why, dimension, p->node->text,
                 p->node->line);
    return false;
}

static bool read_edit(scene_parameters *parameters, const char *text, edit *e) {
    const char *equals = strchr(text, '=');
    if (!equals || equals == text || !equals[1] || strpbrk(text, "\r\n")) {
        scene_report(parameters->faults, 0, "--set", "found '%s', expected name=value", text);
        return false;
    }
    const char *name = scene_copy(parameters->arena, text, (size_t)(equals - text));
    parameter *p = find(parameters, name);
    if (!p) {
        char why[UNIT_TEXT];
        explain_unknown(parameters, name, why);
        scene_report(parameters->faults, 0, "--set", "found '%s': %s; the scene defines %d", text,
                     why, parameters->count);
        return false;
    }
    *e = (edit){.parameter = p, .value = equals + 1};
    return same_dimension(parameters, p, e->value);
}

static bool is_plain(const char *value) {
    static const char SAFE[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                               "._+-/()$^ ";
    return strspn(value, SAFE) == strlen(value) && value[0] != '-' && value[0] != ' ';
}

static void append_quoted(scene_buffer *out, const char *value) {
    scene_append(out, "'");
    for (; *value; value++) scene_append(out, *value == '\'' ? "''" : "%c", *value);
    scene_append(out, "'");
}

static int by_place(const void *left, const void *right) {
    const edit *a = left, *b = right;
    size_t x = a->parameter->node->begin, y = b->parameter->node->begin;
    return (x > y) - (x < y);
}

const char *scene_parameters_set(scene_arena *arena, scene_faults *faults, const tree_node *root,
                                 const char *source, const char *const *set, int set_count) {
    SCENE_ASSERT(source && set && set_count > 0);
    scene_parameters parameters = scene_parameters_read(arena, faults, root);
    edit *edits = scene_alloc(arena, (size_t)set_count * sizeof *edits);
    int count = 0;
    for (int i = 0; i < set_count; i++) {
        edit e;
        if (!read_edit(&parameters, set[i], &e)) continue;
        int same = 0;
        while (same < count && edits[same].parameter != e.parameter) same++;
        edits[same] = e; /* the last of two wins, as on any command line */
        if (same == count) count++;
    }
    if (count) qsort(edits, (size_t)count, sizeof *edits, by_place);
    scene_buffer out = {0};
    size_t at = 0;
    for (int i = 0; i < count; i++) {
        const tree_node *node = edits[i].parameter->node;
        if (node->begin < at) continue; /* an alias: the same place again */
        scene_append(&out, "%.*s", (int)(node->begin - at), source + at);
        if (is_plain(edits[i].value))
            scene_append(&out, "%s", edits[i].value);
        else
            append_quoted(&out, edits[i].value);
        at = node->end;
    }
    scene_append(&out, "%s", source + at);
    const char *text = scene_copy(arena, out.text, out.length);
    free(out.text);
    return text;
}
