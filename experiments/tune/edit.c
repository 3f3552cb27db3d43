#include "experiments/tune/edit.h"

#include <stdlib.h>
#include <string.h>

scene_edit scene_edit_start(scene_arena *arena, const char *source) {
    SCENE_ASSERT(arena && source);
    scene_edit e = {.arena = arena, .faults = {.arena = arena, .file = ""}, .source = source};
    e.root = scene_tree_load(arena, &e.faults, source, strlen(source));
    return e;
}

static void add(scene_edit *e, size_t begin, size_t end, const char *text) {
    for (int i = 0; i < e->count; i++)
        if (begin < end && e->edits[i].begin == begin && e->edits[i].end == end) return;
    e->full = e->full || e->count == EDITS_MAX;
    if (!e->full) e->edits[e->count++] = (text_edit){begin, end, text};
}

/* ---- values that are there ------------------------------------------------------------------- */

static bool is_parameter(const char *text) {
    static const char NAME[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
    return text[0] == '$' && text[1] && strspn(text + 1, NAME) == strlen(text + 1);
}

void scene_edit_scale(scene_edit *e, const tree_node *node, const char *operation) {
    SCENE_ASSERT(e && node && node->kind == TREE_SCALAR && operation);
    const char *form = is_parameter(node->text) ? "%s%s %s%s" : "%s(%s) %s%s";
    const char *quote = node->quoted ? "'" : ""; /* what had to be quoted still has to */
    add(e, node->begin, node->end,
        scene_print(e->arena, form, quote, node->text, operation, quote));
}

void scene_edit_replace(scene_edit *e, const tree_node *node, const char *text) {
    SCENE_ASSERT(e && node && node->kind == TREE_SCALAR && text);
    add(e, node->begin, node->end, text);
}

/* ---- values that are not --------------------------------------------------------------------- */

/* The next byte that is no space, line end or comment, from `at` on. */
static size_t next_word(const char *text, size_t at) {
    for (;;) {
        at += strspn(text + at, " \t\r\n");
        if (text[at] != '#') return at;
        at += strcspn(text + at, "\n");
    }
}

/* In braces an entry is followed by a comma or the closing brace; in a block neither can follow. */
static bool is_in_braces(const char *text, const tree_node *node) {
    char next = text[next_word(text, node->end)];
    return next == ',' || next == '}';
}

static size_t line_start(const char *text, size_t at) {
    while (at > 0 && text[at - 1] != '\n') at--;
    return at;
}

/* A new entry behind a scalar one of the same map. */
static void put_behind(scene_edit *e, const tree_node *node, const char *key, const char *value) {
    const char *text = e->source;
    if (is_in_braces(text, node)) {
        add(e, node->end, node->end, scene_print(e->arena, ", %s: %s", key, value));
        return;
    }
    size_t start = line_start(text, node->begin), end = node->end + strcspn(text + node->end, "\n");
    int indent = (int)strspn(text + start, " ");
    add(e, end, end, scene_print(e->arena, "\n%*s%s: %s", indent, "", key, value));
}

static const tree_node *first_scalar(const tree_node *map) {
    for (const tree_node *child = map->first; child; child = child->next)
        if (child->kind == TREE_SCALAR && child->end > child->begin) return child;
    return NULL;
}

/* Behind the last line of the scene, on a line of its own. */
static void put_last(scene_edit *e, const char *line) {
    size_t end = strlen(e->source);
    bool open = end > 0 && e->source[end - 1] != '\n';
    add(e, end, end, scene_print(e->arena, "%s%s\n", open ? "\n" : "", line));
}

bool scene_edit_put(scene_edit *e, const char *section, const char *key, const char *value) {
    SCENE_ASSERT(e && e->root && key && value);
    const tree_node *map = section ? tree_get(e->root, section) : e->root;
    if (!map) {
        put_last(e, scene_print(e->arena, "%s: {%s: %s}", section, key, value));
        return true;
    }
    const tree_node *there = tree_get(map, key), *beside;
    if (there && there->kind == TREE_SCALAR) {
        scene_edit_replace(e, there, value);
    } else if (there || map->kind != TREE_MAP) {
        return false;
    } else if (!section) {
        put_last(e, scene_print(e->arena, "%s: %s", key, value));
    } else if ((beside = first_scalar(map))) {
        put_behind(e, beside, key, value);
    } else {
        return false;
    }
    return true;
}

/* ---- the text -------------------------------------------------------------------------------- */

/* What is put in at one place keeps the order in which it was asked for. */
static void sort_edits(scene_edit *e) {
    for (int i = 1; i < e->count; i++)
        for (int k = i; k > 0 && e->edits[k].begin < e->edits[k - 1].begin; k--) {
            text_edit later = e->edits[k - 1];
            e->edits[k - 1] = e->edits[k];
            e->edits[k] = later;
        }
}

char *scene_edit_finish(scene_edit *e) {
    SCENE_ASSERT(e);
    if (e->full) return NULL;
    sort_edits(e);
    scene_buffer out = {0};
    size_t at = 0;
    for (int i = 0; i < e->count; i++) {
        const text_edit *one = &e->edits[i];
        SCENE_ASSERT(one->begin >= at);
        scene_append(&out, "%.*s%s", (int)(one->begin - at), e->source + at, one->text);
        at = one->end;
    }
    scene_append(&out, "%s", e->source + at);
    return out.text;
}
