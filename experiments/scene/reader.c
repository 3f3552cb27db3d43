#include "experiments/scene/reader.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef void read_fn(scene_reader *r, const scene_key *key, const tree_node *node, void *field);

static void read_section(scene_reader *r, const key_section *section, const tree_node *node,
                         void *target);
static void apply_defaults(scene_reader *r, const key_section *section, void *target);

void scene_fault_at(scene_arena *arena, scene_faults *faults, const tree_node *node,
                    const char *key, const char *format, ...) {
    SCENE_ASSERT(node);
    va_list arguments;
    va_start(arguments, format);
    const char *text = scene_vprint(arena, format, arguments);
    va_end(arguments);
    const tree_node *entry = key ? tree_get(node, key) : NULL;
    scene_report(faults, entry ? entry->line : node->line, tree_path(arena, node, key), "%s", text);
}

#define FAULT(node, ...) scene_fault_at(r->arena, r->faults, (node), NULL, __VA_ARGS__)

static const char *what(scene_reader *r, const tree_node *node) {
    if (tree_is_empty(node)) return "nothing";
    if (node->kind == TREE_LIST) return scene_print(r->arena, "a list of %d", node->children);
    if (node->kind == TREE_MAP) return "a map";
    return scene_print(r->arena, "'%s'", node->text);
}

static void expected(scene_reader *r, const scene_key *key, const tree_node *node) {
    FAULT(node, "found %s, expected %s", what(r, node), schema_expectation(r->arena, key));
}

/* ---- numbers --------------------------------------------------------------------------------- */

static bool in_range(key_range range, double value) {
    bool above = range.low_open ? value > range.low : value >= range.low;
    bool below = range.high_open ? value < range.high : value <= range.high;
    return above && below;
}

static bool parse(scene_reader *r, const scene_key *key, const tree_node *node, unit_value *value) {
    if (node->kind != TREE_SCALAR || tree_is_empty(node)) {
        expected(r, key, node);
        return false;
    }
    char why[UNIT_TEXT];
    unit_scope scope = scene_parameters_scope(r->parameters);
    if (unit_parse(node->text, &scope, value, why)) return true;
    if (why[0])
        FAULT(node, "found '%s': %s, expected %s", node->text, why,
              schema_expectation(r->arena, key));
    return false;
}

static void wrong_dimension(scene_reader *r, const scene_key *key, const tree_node *node,
                            const unit_value *value) {
    char dimension[UNIT_TEXT];
    unit_describe(value->dimension, dimension);
    FAULT(node, "found '%s' (%s), expected %s", node->text, dimension,
          schema_expectation(r->arena, key));
}

static bool number(scene_reader *r, const scene_key *key, const tree_node *node, double *out) {
    unit_value value;
    if (!parse(r, key, node, &value)) return false;
    if (!value.bare && !unit_same(value.dimension, unit_kind_dimension(key->unit))) {
        wrong_dimension(r, key, node, &value);
        return false;
    }
    if (!in_range(key->range, value.value)) {
        expected(r, key, node);
        return false;
    }
    *out = value.value;
    return true;
}

static bool is_word(scene_reader *r, const scene_key *key, const tree_node *node) {
    return key->word && node->kind == TREE_SCALAR &&
           !strcmp(scene_parameters_word(r->parameters, node->text), key->word);
}

static void read_number(scene_reader *r, const scene_key *key, const tree_node *node, void *field) {
    double value = 0;
    if (is_word(r, key, node) || number(r, key, node, &value)) memcpy(field, &value, sizeof value);
}

static bool whole(scene_reader *r, const scene_key *key, const tree_node *node, double *value) {
    if (!number(r, key, node, value)) return false;
    if (*value == floor(*value)) return true;
    expected(r, key, node);
    return false;
}

static void read_count(scene_reader *r, const scene_key *key, const tree_node *node, void *field) {
    double value = 0;
    if (!is_word(r, key, node) && !whole(r, key, node, &value)) return;
    int count = (int)value; /* the range of every count fits */
    memcpy(field, &count, sizeof count);
}

static void read_seed(scene_reader *r, const scene_key *key, const tree_node *node, void *field) {
    double value = 0;
    if (!whole(r, key, node, &value)) return;
    uint64_t seed = (uint64_t)value;
    memcpy(field, &seed, sizeof seed);
}

/* `count` numbers in a list; each is checked, so that two mistakes are two faults. */
static bool numbers(scene_reader *r, const scene_key *key, const tree_node *node, int count,
                    double *out) {
    if (node->kind != TREE_LIST || node->children != count) {
        expected(r, key, node);
        return false;
    }
    scene_key one = *key; /* a fault of one number tells what that number should be */
    one.kind = KEY_NUMBER;
    one.word = NULL;
    bool good = true;
    int i = 0;
    for (const tree_node *child = node->first; child; child = child->next, i++)
        good = number(r, &one, child, &out[i]) && good;
    return good;
}

static void read_numbers(scene_reader *r, const scene_key *key, const tree_node *node,
                         void *field) {
    double values[4];
    SCENE_ASSERT(key->length > 0 && key->length <= 4);
    if (numbers(r, key, node, key->length, values))
        memcpy(field, values, (size_t)key->length * sizeof *values);
}

/* What a number means is the law's affair, so any dimension will do. */
static void read_values(scene_reader *r, const scene_key *key, const tree_node *node, void *field) {
    if (node->kind != TREE_LIST || node->children > key->length) {
        expected(r, key, node);
        return;
    }
    double *values = field;
    int i = 0;
    for (const tree_node *child = node->first; child; child = child->next, i++) {
        unit_value one;
        if (parse(r, key, child, &one)) values[i] = one.value;
    }
}

static void read_vector(scene_reader *r, const scene_key *key, const tree_node *node, void *field) {
    double values[3] = {0};
    if (is_word(r, key, node) || numbers(r, key, node, 3, values))
        *(clast_vec3 *)field = (clast_vec3){values[0], values[1], values[2]};
}

static void read_spacing(scene_reader *r, const scene_key *key, const tree_node *node,
                         void *field) {
    double one;
    if (node->kind == TREE_LIST)
        read_vector(r, key, node, field);
    else if (number(r, key, node, &one))
        *(clast_vec3 *)field = (clast_vec3){one, one, one};
}

/* 25 /s and 0.04 s say the same; a bare 25 could be either, so it is refused. */
static void read_interval(scene_reader *r, const scene_key *key, const tree_node *node,
                          void *field) {
    double seconds = 0;
    unit_value value;
    if (!is_word(r, key, node)) {
        if (!parse(r, key, node, &value)) return;
        bool rate = unit_same(value.dimension, unit_kind_dimension(UNIT_RATE));
        if (!rate && !unit_same(value.dimension, unit_kind_dimension(UNIT_TIME))) {
            wrong_dimension(r, key, node, &value);
            return;
        }
        seconds = rate ? 1 / value.value : value.value;
        if (!in_range(key->range, seconds) || !isfinite(seconds)) {
            expected(r, key, node);
            return;
        }
    }
    memcpy(field, &seconds, sizeof seconds);
}

static void read_points(scene_reader *r, const scene_key *key, const tree_node *node, void *field) {
    point_list *points = field;
    if (node->kind != TREE_LIST || node->children < 3) {
        expected(r, key, node);
        return;
    }
    points->xz = scene_alloc(r->arena, 2 * (size_t)node->children * sizeof *points->xz);
    for (const tree_node *child = node->first; child; child = child->next)
        if (numbers(r, key, child, 2, &points->xz[2 * points->count])) points->count++;
}

/* ---- words ----------------------------------------------------------------------------------- */

static const char *word(scene_reader *r, const scene_key *key, const tree_node *node) {
    if (node->kind == TREE_SCALAR && !tree_is_empty(node))
        return scene_parameters_replace(r->parameters, node);
    expected(r, key, node);
    return NULL;
}

static int words_count(const char *const *words) {
    int count = 0;
    while (words[count]) count++;
    return count;
}

static int choose(scene_reader *r, const scene_key *key, const tree_node *node, const char *text) {
    int count = words_count(key->choices);
    for (int i = 0; i < count; i++)
        if (!strcmp(text, key->choices[i])) return i;
    const char *near = scene_suggest(text, key->choices, count);
    FAULT(node, "found '%s', expected %s%s%s%s", text, schema_expectation(r->arena, key),
          near ? " (did you mean '" : "", near ? near : "", near ? "'?)" : "");
    return -1;
}

static void read_choice(scene_reader *r, const scene_key *key, const tree_node *node, void *field) {
    const char *text = word(r, key, node);
    int chosen = text ? choose(r, key, node, text) : -1;
    if (chosen >= 0) memcpy(field, &chosen, sizeof chosen);
}

static void read_axes(scene_reader *r, const scene_key *key, const tree_node *node, void *field) {
    bool *axes = field, is_list = node->kind == TREE_LIST;
    for (const tree_node *child = is_list ? node->first : node; child; child = child->next) {
        const char *text = word(r, key, child);
        int chosen = text ? choose(r, key, child, text) : -1;
        if (chosen >= 0 && axes[chosen]) FAULT(child, "found '%s' twice", text);
        if (chosen >= 0) axes[chosen] = true;
        if (!is_list) return;
    }
}

static void read_text(scene_reader *r, const scene_key *key, const tree_node *node, void *field) {
    const char *text = word(r, key, node);
    if (text && (!key->choices || choose(r, key, node, text) >= 0))
        memcpy(field, &text, sizeof text);
}

static void read_switch(scene_reader *r, const scene_key *key, const tree_node *node, void *field) {
    static const char *const YES[] = {"true", "yes", "on"}, *const NO[] = {"false", "no", "off"};
    const char *text = word(r, key, node);
    if (!text) return;
    for (int i = 0; i < 3; i++) {
        bool yes = !strcmp(text, YES[i]);
        if (!yes && strcmp(text, NO[i])) continue;
        memcpy(field, &yes, sizeof yes);
        return;
    }
    expected(r, key, node);
}

static void read_file(scene_reader *r, const scene_key *key, const tree_node *node, void *field) {
    const char *text = word(r, key, node);
    if (!text) return;
    const char *beside = text[0] == '/' ? text : scene_print(r->arena, "%s%s", r->folder, text);
    if (!access(beside, R_OK)) text = beside;
    if (access(text, R_OK)) /* a path of --set is meant from where the user stands */
        FAULT(node, "found '%s', which cannot be opened, expected %s", beside,
              schema_expectation(r->arena, key));
    else
        memcpy(field, &text, sizeof text);
}

/* ---- names ----------------------------------------------------------------------------------- */

static void unknown_name(scene_reader *r, const scene_key *key, const tree_node *node,
                         const char *text, const tree_node *map) {
    int count = map && map->kind == TREE_MAP ? map->children : 0, i = 0;
    const char **names = scene_alloc(r->arena, ((size_t)count + 1) * sizeof *names);
    scene_buffer list = {0};
    scene_append(&list, "%s", count ? "" : "there are none");
    for (const tree_node *entry = map ? map->first : NULL; entry && i < count;
         entry = entry->next) {
        names[i] = entry->key;
        if (i < 20) scene_append(&list, "%s%s", i ? ", " : "", entry->key);
        if (++i == 20) scene_append(&list, ", ...");
    }
    const char *near = scene_suggest(text, names, count);
    FAULT(node, "found '%s', expected a name from %s: %s%s%s%s", text, key->refers, list.text,
          near ? " (did you mean '" : "", near ? near : "", near ? "'?)" : "");
    free(list.text);
}

static bool name(scene_reader *r, const scene_key *key, const tree_node *node, int *index) {
    const char *text = word(r, key, node);
    if (!text) return false;
    const tree_node *map = tree_get(r->root, key->refers);
    const tree_node *entry = tree_get(map, text);
    if (entry)
        *index = entry->index;
    else
        unknown_name(r, key, node, text, map);
    return entry != NULL;
}

static void read_name(scene_reader *r, const scene_key *key, const tree_node *node, void *field) {
    int index;
    if (name(r, key, node, &index)) memcpy(field, &index, sizeof index);
}

static void read_names(scene_reader *r, const scene_key *key, const tree_node *node, void *field) {
    int index[2];
    if (node->kind != TREE_LIST || node->children != 2) {
        expected(r, key, node);
        return;
    }
    bool first = name(r, key, node->first, &index[0]);
    bool second = name(r, key, node->first->next, &index[1]);
    if (first && second) memcpy(field, index, sizeof index);
}

static void read_name_list(scene_reader *r, const scene_key *key, const tree_node *node,
                           void *field) {
    if (node->kind != TREE_LIST || node->children == 0) {
        expected(r, key, node);
        return;
    }
    name_list *list = field;
    list->index = scene_alloc(r->arena, (size_t)node->children * sizeof *list->index);
    for (const tree_node *child = node->first; child; child = child->next)
        if (name(r, key, child, &list->index[list->count])) list->count++;
}

/* ---- sections -------------------------------------------------------------------------------- */

static void read_inner(scene_reader *r, const scene_key *key, const tree_node *node, void *field) {
    read_section(r, key->section, node, field);
}

static void read_items(scene_reader *r, const scene_key *key, const tree_node *node, void *field) {
    tree_kind kind = key->kind == KEY_NAMED ? TREE_MAP : TREE_LIST;
    if (tree_is_empty(node) && !key->required) return;
    if (node->kind != kind || (node->children == 0 && key->required)) {
        expected(r, key, node);
        return;
    }
    item_list *list = field;
    size_t size = key->section->size;
    char *items = scene_alloc(r->arena, ((size_t)node->children + 1) * size);
    void *blank =
        scene_alloc(r->arena, size); /* thousands of bodies share one reading of defaults */
    apply_defaults(r, key->section, blank);
    list->items = items;
    for (const tree_node *child = node->first; child; child = child->next) {
        item *head = (item *)(void *)(items + size * (size_t)list->count++);
        memcpy(head, blank, size);
        head->node = child;
        head->name = child->key ? child->key : "";
        read_section(r, key->section, child, head);
    }
}

static void read_nothing(scene_reader *r, const scene_key *key, const tree_node *node,
                         void *field) {
    (void)r, (void)key, (void)node, (void)field;
}

static read_fn *const READ[] = {
    [KEY_NUMBER] = read_number, [KEY_COUNT] = read_count,        [KEY_SEED] = read_seed,
    [KEY_SWITCH] = read_switch, [KEY_CHOICE] = read_choice,      [KEY_TEXT] = read_text,
    [KEY_FILE] = read_file,     [KEY_NAME] = read_name,          [KEY_NAMES] = read_names,
    [KEY_VECTOR] = read_vector, [KEY_SPACING] = read_spacing,    [KEY_NUMBERS] = read_numbers,
    [KEY_VALUES] = read_values, [KEY_POINTS] = read_points,      [KEY_INTERVAL] = read_interval,
    [KEY_SECTION] = read_inner, [KEY_PART] = read_inner,         [KEY_NAMED] = read_items,
    [KEY_LIST] = read_items,    [KEY_PARAMETERS] = read_nothing, [KEY_NAME_LIST] = read_name_list,
    [KEY_AXES] = read_axes,
};

static void *field_of(const scene_key *key, void *target) {
    return key->kind == KEY_SECTION ? target : (char *)target + key->offset;
}

/* A default is written like a value and read by the same code. Sections have the defaults of their
 * keys, names have none. */
static void apply_default(scene_reader *r, const scene_key *key, void *target) {
    if (key->kind == KEY_SECTION || key->kind == KEY_PART) {
        apply_defaults(r, key->section, field_of(key, target));
    } else if (key->kind == KEY_NAME || key->kind == KEY_NAMES) {
        static const int NONE[2] = {-1, -1};
        memcpy(field_of(key, target), NONE, key->kind == KEY_NAME ? sizeof *NONE : sizeof NONE);
    } else if (key->fallback) {
        const tree_node *node =
            scene_tree_load(r->arena, r->faults, scene_print(r->arena, "v: %s", key->fallback),
                            strlen(key->fallback) + 3);
        SCENE_ASSERT(node && node->first);
        READ[key->kind](r, key, node->first, field_of(key, target));
    }
}

static void apply_defaults(scene_reader *r, const key_section *section, void *target) {
    for (int i = 0; i < section->count; i++) apply_default(r, &section->keys[i], target);
}

static const scene_key *find_key(const key_section *section, const char *name) {
    for (int i = 0; i < section->count; i++)
        if (!strcmp(section->keys[i].name, name)) return &section->keys[i];
    return NULL;
}

static void unknown_key(scene_reader *r, const key_section *section, const tree_node *node) {
    const char **names = scene_alloc(r->arena, ((size_t)section->count + 1) * sizeof *names);
    scene_buffer list = {0};
    scene_append(&list, "%s", section->count ? "" : "none");
    for (int i = 0; i < section->count; i++) {
        names[i] = section->keys[i].name;
        scene_append(&list, "%s%s", i ? ", " : "", names[i]);
    }
    const char *near = scene_suggest(node->key, names, section->count);
    if (near)
        FAULT(node, "unknown key, did you mean '%s'?", near);
    else
        FAULT(node, "unknown key, expected one of: %s", list.text);
    free(list.text);
}

static void missing_key(scene_reader *r, const scene_key *key, const tree_node *node) {
    scene_fault_at(r->arena, r->faults, node, key->name, "missing, expected %s",
                   schema_expectation(r->arena, key));
}

/* Exactly one of the marked keys: a sphere by its radius, or a clump, or a fit. */
static void check_one_of(scene_reader *r, const key_section *section, const tree_node *node) {
    const char *found = NULL;
    scene_buffer list = {0};
    scene_append(&list, "%s", "");
    for (int i = 0; i < section->count; i++) {
        const scene_key *key = &section->keys[i];
        if (!key->one_of) continue;
        scene_append(&list, "%s%s", list.length ? ", " : "", key->name);
        if (!tree_get(node, key->name)) continue;
        if (found)
            scene_fault_at(r->arena, r->faults, node, key->name,
                           "found beside '%s', expected one of the two", found);
        found = key->name;
    }
    if (list.length && !found) FAULT(node, "found none of %s, expected one of them", list.text);
    free(list.text);
}

static void read_section(scene_reader *r, const key_section *section, const tree_node *node,
                         void *target) {
    SCENE_ASSERT(section && node && target);
    if (node->kind != TREE_MAP && !tree_is_empty(node)) {
        FAULT(node, "found %s, expected a map of keys", what(r, node));
        return;
    }
    for (const tree_node *child = node->first; child; child = child->next) {
        const scene_key *key = find_key(section, child->key);
        if (!key)
            unknown_key(r, section, child);
        else
            READ[key->kind](r, key, child, field_of(key, target));
    }
    for (int i = 0; i < section->count; i++)
        if (section->keys[i].required && !tree_get(node, section->keys[i].name))
            missing_key(r, &section->keys[i], node);
    check_one_of(r, section, node);
}

void scene_read(scene_reader *reader, scene_draft *draft) {
    SCENE_ASSERT(reader && reader->root && draft);
    apply_defaults(reader, &SCHEMA_SCENE, draft);
    read_section(reader, &SCHEMA_SCENE, reader->root, draft);
}
