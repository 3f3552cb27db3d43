/* scene.c - scene_load() as a list of stages: text, tree, parameters, draft, checks, world. */
#include "experiments/scene/scene.h"
#include "experiments/scene/build.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FILE_MAX = 64 << 20 }; /* bytes: nobody writes a larger scene; bodies may come as CSV */

static const char *read_text(scene_arena *arena, scene_faults *faults, const char *path) {
    FILE *file = fopen(path, "rb");
    if (!file) {
        scene_report(faults, 0, "", "cannot be opened: %s", strerror(errno));
        return NULL;
    }
    char *text = NULL;
    size_t length = 0, room = 0, got = 0;
    do {
        room = room ? 2 * room : 1 << 16;
        char *larger = realloc(text, room + 1);
        if (!larger) abort();
        text = larger;
        got = fread(text + length, 1, room - length, file);
        length += got;
    } while (got > 0 && length == room && length < FILE_MAX);
    const char *copy = NULL;
    if (ferror(file))
        scene_report(faults, 0, "", "cannot be read: %s", strerror(errno));
    else if (length >= FILE_MAX)
        scene_report(faults, 0, "", "found more than %d MiB, expected a scene", FILE_MAX >> 20);
    else if (memchr(text, '\0', length))
        scene_report(faults, 0, "", "found a zero byte, expected text");
    else
        copy = scene_copy(arena, text, length);
    free(text);
    fclose(file);
    return copy;
}

static const char *folder_of(scene_arena *arena, const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? scene_copy(arena, path, (size_t)(slash - path) + 1) : "";
}

static char *duplicate(const char *text) {
    char *copy = text ? strdup(text) : NULL;
    if (text && !copy) abort();
    return copy;
}

/* Which of the kinds the entry has; the tables made sure that it is one. */
static measure measure_of(const measure_item *entry) {
    const tree_node *node = entry->item.node;
    measure m = {.kind = MEASURE_COORDINATION};
    if (tree_get(node, "discharged")) {
        m = entry->discharged;
        m.kind = MEASURE_DISCHARGED;
    } else if (tree_get(node, "remaining")) {
        m = entry->remaining;
        m.kind = MEASURE_REMAINING;
    } else if (tree_get(node, "solid_fraction")) {
        m = entry->solid_fraction;
        m.kind = MEASURE_SOLID_FRACTION;
        m.x_min = entry->bed_x[0];
        m.x_max = entry->bed_x[1];
    } else if (tree_get(node, "band_velocity")) {
        m = entry->band_velocity;
        m.kind = MEASURE_BAND_VELOCITY;
        m.x_min = entry->band_x[0];
        m.x_max = entry->band_x[1];
    } else if (tree_get(node, "part_load")) {
        m = entry->part_load;
        m.kind = MEASURE_PART_LOAD;
    } else if (tree_get(node, "load_profile")) {
        m = entry->load_profile;
        m.kind = MEASURE_LOAD_PROFILE;
    }
    m.name = duplicate(entry->item.name);
    return m;
}

static void *allocate(int count, size_t size) {
    void *memory = calloc((size_t)count + 1, size);
    if (!memory) abort();
    return memory;
}

static void keep_materials(scene *s, const scene_draft *draft) {
    s->material_count = draft->materials.count;
    s->materials = allocate(s->material_count, sizeof *s->materials);
    const material_item *materials = draft->materials.items;
    for (int i = 0; i < s->material_count; i++) {
        s->materials[i] = materials[i].def;
        s->materials[i].name = duplicate(materials[i].item.name);
    }
    s->pair_count = draft->pairs.count;
    s->pairs = allocate(s->pair_count, sizeof *s->pairs);
    const pair_item *pairs = draft->pairs.items;
    for (int i = 0; i < s->pair_count; i++)
        s->pairs[i] = (scene_pair){pairs[i].between[0], pairs[i].between[1], pairs[i].def};
}

static void *copy_of(const void *from, size_t bytes) {
    void *copy = allocate(1, bytes);
    memcpy(copy, from, bytes);
    return copy;
}

static void keep_meshes(scene *s, const scene_draft *draft) {
    s->mesh_count = draft->mesh_count;
    s->meshes = allocate(s->mesh_count, sizeof *s->meshes);
    for (int i = 0; i < s->mesh_count; i++) {
        const scene_mesh *m = &draft->meshes[i];
        s->meshes[i] = *m;
        s->meshes[i].name = duplicate(m->name);
        s->meshes[i].vertex = copy_of(m->vertex, 3 * m->vertex_count * sizeof *m->vertex);
        s->meshes[i].triangle = copy_of(m->triangle, 3 * m->triangle_count * sizeof *m->triangle);
    }
    s->mesh_reports = duplicate(draft->mesh_reports ? draft->mesh_reports : "");
}

static char *clumps_of(const scene_draft *draft) {
    scene_buffer out = {0};
    scene_append(&out, "%s", "");
    const shape_item *shapes = draft->shapes.items;
    for (int i = 0; i < draft->shapes.count; i++)
        if (shapes[i].made_of)
            scene_append(&out, "  %s: %s\n", shapes[i].item.name, shapes[i].made_of);
    return out.text;
}

static scene *make_scene(const scene_draft *draft, clast_world *world, const char *path,
                         const char *text) {
    scene *s = allocate(1, sizeof *s);
    s->path = duplicate(path);
    s->title = duplicate(draft->title);
    s->text = duplicate(text);
    s->world = world;
    s->view = draft->view;
    s->view.width = (int)draft->size[0];
    s->view.height = (int)draft->size[1];
    s->view.perspective = draft->projection == 1;
    s->view.preset = duplicate(draft->preset);
    s->view.map = duplicate(draft->map);
    s->ending = draft->ending;
    s->output = draft->output;
    s->step_given = draft->def.time_step > 0;
    s->measure_count = draft->measures.count;
    s->measures = allocate(s->measure_count, sizeof *s->measures);
    const measure_item *items = draft->measures.items;
    for (int i = 0; i < s->measure_count; i++) s->measures[i] = measure_of(&items[i]);
    keep_materials(s, draft);
    keep_meshes(s, draft);
    s->clumps = clumps_of(draft);
    bool own = draft->def.law == CLAST_LAW_USER;
    s->library = duplicate(own ? draft->library : NULL);
    s->function = duplicate(own ? draft->function : NULL);
    return s;
}

/* The text with --set put in, and its tree. NULL with faults when it is no YAML. */
static const tree_node *load_tree(scene_arena *arena, scene_faults *faults,
                                  const scene_options *options, const char **text) {
    const tree_node *root = scene_tree_load(arena, faults, *text, strlen(*text));
    if (!root || options->set_count == 0) return root;
    scene_faults again = {.arena = arena, .file = faults->file}; /* those of the tree come again */
    *text = scene_parameters_set(arena, faults, root, *text, options->set, options->set_count);
    return scene_tree_load(arena, &again, *text, strlen(*text));
}

static void refit(scene_draft *draft, int spheres) {
    shape_item *shapes = draft->shapes.items;
    for (int i = 0; i < draft->shapes.count; i++)
        if (shapes[i].fit_spheres > 0) shapes[i].fit_spheres = spheres;
}

static scene *load(scene_arena *arena, scene_faults *faults, const char *path,
                   const scene_options *options) {
    const char *text = read_text(arena, faults, path);
    const tree_node *root = text ? load_tree(arena, faults, options, &text) : NULL;
    if (!root) return NULL;
    scene_parameters parameters = scene_parameters_read(arena, faults, root);
    scene_reader reader = {.arena = arena,
                           .faults = faults,
                           .parameters = &parameters,
                           .root = root,
                           .folder = folder_of(arena, path)};
    scene_draft draft = {.def = clast_world_def_default()};
    scene_read(&reader, &draft);
    if (options->threads > 0) draft.def.threads = options->threads;
    if (options->spheres_per_thread > 0) draft.def.spheres_per_thread = options->spheres_per_thread;
    if (options->isa != CLAST_ISA_AUTO) draft.def.isa = options->isa;
    if (options->mixed) draft.def.precision = CLAST_PRECISION_MIXED;
    if (options->fit_spheres > 0) refit(&draft, options->fit_spheres);
    scene_fill_shapes(&reader, &draft);
    scene_check(&reader, &draft);
    if (faults->errors) return NULL;
    scene_parameters_warn_unused(&parameters);
    clast_world *world = scene_build(&reader, &draft, !options->parse_only);
    return world ? make_scene(&draft, world, path, text) : NULL;
}

scene *scene_load(const char *path, const scene_options *options, char **faults_text) {
    SCENE_ASSERT(path && faults_text);
    static const scene_options NONE;
    scene_arena arena = {0};
    scene_faults faults = {.arena = &arena, .file = path};
    scene *s = load(&arena, &faults, path, options ? options : &NONE);
    SCENE_ASSERT((s == NULL) == (faults.errors > 0));
    *faults_text = scene_faults_text(&faults);
    scene_arena_free(&arena);
    return s;
}

void scene_free(scene *s) {
    if (!s) return;
    for (int i = 0; i < s->measure_count; i++) free(s->measures[i].name);
    free(s->measures);
    for (int i = 0; i < s->material_count; i++) free((char *)(uintptr_t)s->materials[i].name);
    free(s->materials);
    free(s->pairs);
    for (int i = 0; i < s->mesh_count; i++)
        free(s->meshes[i].name), free(s->meshes[i].vertex), free(s->meshes[i].triangle);
    free(s->meshes);
    free(s->mesh_reports);
    free(s->clumps);
    free(s->library);
    free(s->function);
    free(s->view.preset);
    free(s->view.map);
    free(s->path);
    free(s->title);
    free(s->text);
    clast_world_free(s->world);
    free(s);
}
