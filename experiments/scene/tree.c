#include "experiments/scene/tree.h"

#include <string.h>
#include <yaml.h> /* the one place that knows it; the document API keeps line numbers */

enum {
    DEPTH_MAX = 32,      /* no scene nests deeper; an alias may point to what it is part of */
    NODES_MAX = 2000000, /* aliases of aliases multiply: stop before memory does */
};

typedef struct loader {
    scene_arena *arena;
    scene_faults *faults;
    yaml_document_t *document;
    const char *source;
    size_t length;
    size_t character, byte; /* libyaml counts characters; the last place that was looked up */
    int nodes;
    bool stopped; /* too deep or too many: nothing below makes sense any more */
} loader;

/* Marks come nearly in order, so walking on from the last one is cheap. */
static size_t byte_of(loader *l, size_t character) {
    if (character < l->character) l->character = l->byte = 0;
    while (l->character < character && l->byte < l->length) {
        do l->byte++;
        while (l->byte < l->length && ((unsigned char)l->source[l->byte] & 0xc0) == 0x80);
        l->character++;
    }
    return l->byte;
}

static int line_of(const yaml_node_t *node) {
    return (int)node->start_mark.line + 1;
}

/* What is known of a node before its inside is read; faults inside need it for their path. */
typedef struct place {
    const tree_node *parent;
    const char *key;
    int key_line; /* 0 in a list */
    int depth;
} place;

static tree_node *convert(loader *l, int id, place at);

static void append(tree_node *parent, tree_node **last, tree_node *child) {
    if (*last)
        (*last)->next = child;
    else
        parent->first = child;
    *last = child;
    parent->children++;
}

static void convert_list(loader *l, const yaml_node_t *from, tree_node *list, int depth) {
    tree_node *last = NULL;
    const yaml_node_item_t *item = from->data.sequence.items.start;
    for (; item < from->data.sequence.items.top; item++) {
        tree_node *child = convert(l, *item, (place){.parent = list, .depth = depth});
        if (!child) return;
        append(list, &last, child);
    }
}

/* The first of two equal keys stays: either may be the mistake, and one must be checked. */
static bool is_repeated(loader *l, const tree_node *map, const char *key, int line) {
    const tree_node *first = tree_get(map, key);
    if (!first) return false;
    scene_report(l->faults, line, tree_path(l->arena, first, NULL),
                 "found twice, expected once (also in line %d)", first->line);
    return true;
}

static void convert_map(loader *l, const yaml_node_t *from, tree_node *map, int depth) {
    tree_node *last = NULL;
    const yaml_node_pair_t *pair = from->data.mapping.pairs.start;
    for (; pair < from->data.mapping.pairs.top; pair++) {
        const yaml_node_t *name = yaml_document_get_node(l->document, pair->key);
        if (name->type != YAML_SCALAR_NODE) {
            scene_report(l->faults, line_of(name), tree_path(l->arena, map, NULL),
                         "found a list or map as a key, expected a word");
            continue;
        }
        char *key =
            scene_copy(l->arena, (const char *)name->data.scalar.value, name->data.scalar.length);
        if (is_repeated(l, map, key, line_of(name))) continue;
        place at = {.parent = map, .key = key, .key_line = line_of(name), .depth = depth};
        tree_node *child = convert(l, pair->value, at);
        if (!child) return;
        append(map, &last, child);
    }
}

static tree_node *convert_scalar(loader *l, const yaml_node_t *from, tree_node *node) {
    node->kind = TREE_SCALAR;
    node->text =
        scene_copy(l->arena, (const char *)from->data.scalar.value, from->data.scalar.length);
    node->quoted = from->data.scalar.style != YAML_PLAIN_SCALAR_STYLE;
    node->begin = byte_of(l, from->start_mark.index);
    node->end = byte_of(l, from->end_mark.index);
    if (strlen(node->text) != from->data.scalar.length)
        scene_report(l->faults, node->line, "", "found a zero byte in a value, expected text");
    return node;
}

static tree_node *convert(loader *l, int id, place at) {
    const yaml_node_t *from = yaml_document_get_node(l->document, id);
    SCENE_ASSERT(from);
    if (l->stopped) return NULL;
    if (at.depth > DEPTH_MAX || ++l->nodes > NODES_MAX) {
        l->stopped = true;
        scene_report(l->faults, line_of(from), "",
                     "nested too deeply, expected at most %d levels (an alias of itself?)",
                     DEPTH_MAX);
        return NULL;
    }
    tree_node *node = scene_alloc(l->arena, sizeof *node);
    node->parent = at.parent;
    node->key = at.key;
    node->index = at.parent ? at.parent->children : 0;
    node->line = at.key_line > 0 ? at.key_line : line_of(from);
    if (from->type == YAML_SCALAR_NODE) {
        node->line = line_of(from);
        return convert_scalar(l, from, node);
    }
    node->kind = from->type == YAML_MAPPING_NODE ? TREE_MAP : TREE_LIST;
    if (node->kind == TREE_MAP)
        convert_map(l, from, node, at.depth + 1);
    else
        convert_list(l, from, node, at.depth + 1);
    return node;
}

static void report_syntax(scene_faults *faults, const yaml_parser_t *parser) {
    if (parser->error == YAML_READER_ERROR) {
        scene_report(faults, (int)parser->mark.line + 1, "",
                     "found a byte that is no text (%s), expected UTF-8", parser->problem);
        return;
    }
    const char *begun = parser->context
                            ? scene_print(faults->arena, ", %s begun in line %d", parser->context,
                                          (int)parser->context_mark.line + 1)
                            : "";
    scene_report(faults, (int)parser->problem_mark.line + 1, "", "YAML: %s in column %d%s",
                 parser->problem ? parser->problem : "cannot be read",
                 (int)parser->problem_mark.column + 1, begun);
}

static const tree_node *convert_document(loader *l) {
    const yaml_node_t *root = yaml_document_get_root_node(l->document);
    if (!root) {
        tree_node *empty = scene_alloc(l->arena, sizeof *empty);
        empty->kind = TREE_MAP;
        empty->line = 1;
        return empty;
    }
    if (root->type != YAML_MAPPING_NODE) {
        scene_report(l->faults, line_of(root), "", "found no 'key: value' lines, expected a scene");
        return NULL;
    }
    const tree_node *tree = convert(l, 1, (place){0});
    return l->stopped ? NULL : tree;
}

static void refuse_second_document(scene_faults *faults, yaml_parser_t *parser) {
    yaml_document_t second;
    if (!yaml_parser_load(parser, &second)) {
        report_syntax(faults, parser);
        return;
    }
    const yaml_node_t *root = yaml_document_get_root_node(&second);
    if (root)
        scene_report(faults, line_of(root), "",
                     "found a second document, expected one scene a file");
    yaml_document_delete(&second);
}

const tree_node *scene_tree_load(scene_arena *arena, scene_faults *faults, const char *text,
                                 size_t length) {
    SCENE_ASSERT(arena && faults && text);
    yaml_parser_t parser;
    yaml_document_t document;
    if (!yaml_parser_initialize(&parser)) return NULL;
    yaml_parser_set_encoding(&parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&parser, (const unsigned char *)text, length);
    const tree_node *tree = NULL;
    if (yaml_parser_load(&parser, &document)) {
        loader l = {.arena = arena,
                    .faults = faults,
                    .document = &document,
                    .source = text,
                    .length = length};
        tree = convert_document(&l);
        bool more = yaml_document_get_root_node(&document) != NULL;
        yaml_document_delete(&document);
        if (more) refuse_second_document(faults, &parser);
    } else {
        report_syntax(faults, &parser);
    }
    yaml_parser_delete(&parser);
    return tree;
}

const tree_node *tree_get(const tree_node *map, const char *key) {
    SCENE_ASSERT(key);
    if (!map || map->kind != TREE_MAP) return NULL;
    for (const tree_node *child = map->first; child; child = child->next)
        if (!strcmp(child->key, key)) return child;
    return NULL;
}

bool tree_is_empty(const tree_node *node) {
    return !node || (node->kind == TREE_SCALAR && !node->quoted &&
                     (!node->text[0] || !strcmp(node->text, "~") || !strcmp(node->text, "null")));
}

const char *tree_path(scene_arena *arena, const tree_node *node, const char *key) {
    SCENE_ASSERT(node);
    const char *path = "";
    if (node->parent && node->key)
        path = tree_path(arena, node->parent, node->key);
    else if (node->parent)
        path = scene_print(arena, "%s[%d]", tree_path(arena, node->parent, NULL), node->index);
    if (!key) return path;
    return path[0] ? scene_print(arena, "%s.%s", path, key) : scene_copy(arena, key, strlen(key));
}
