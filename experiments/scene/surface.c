/* surface.c - walls of triangles: read from a file or made from measures, put at their place, and
 * given to the engine, which knows no other curved wall. */
#include "experiments/scene/build.h"

#include "engine/vec.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FAULT(node, key, ...) scene_fault_at(r->arena, r->faults, (node), (key), __VA_ARGS__)

typedef enum surface_kind { OF_MESH, OF_BAR, OF_TUBE, OF_BEND, SURFACE_KINDS } surface_kind;

static const char *const KEYS[SURFACE_KINDS] = {"mesh", "bar", "tube", "bend"};

/* Where triangles are read from, or NULL. */
static const char *file_of(const wall_item *wall) {
    return tree_get(wall->item.node, "bar") ? wall->surface.bar_mesh : wall->surface.mesh;
}

static surface_kind kind_of(const wall_item *wall) {
    for (int k = 0; k < SURFACE_KINDS; k++)
        if (tree_get(wall->item.node, KEYS[k])) return (surface_kind)k;
    return SURFACE_KINDS;
}

bool scene_is_surface(const wall_item *wall) {
    SCENE_ASSERT(wall);
    return kind_of(wall) != SURFACE_KINDS;
}

/* ---- triangles ------------------------------------------------------------------------------- */

static mesh_status make_shape(const wall_item *wall, mesh_surface *raw) {
    const surface_rule *s = &wall->surface;
    mesh_tube tube = s->tube;
    if (tube.end_radius == 0) tube.end_radius = tube.radius;
    switch (kind_of(wall)) {
    case OF_BAR:
        return mesh_make_bar(&s->bar, raw);
    case OF_TUBE:
        return mesh_make_tube(&tube, raw);
    case OF_BEND:
        return mesh_make_bend(&s->bend, raw);
    case OF_MESH:
    case SURFACE_KINDS:
        break;
    }
    SCENE_ASSERT(!"a wall of triangles");
    return MESH_ERR_ARGUMENT;
}

static mesh_status read_or_make(const wall_item *wall, mesh_surface *surface, mesh_report *report) {
    mesh_options options = mesh_options_default();
    const surface_rule *s = &wall->surface;
    if (file_of(wall)) {
        options.unit = kind_of(wall) == OF_BAR ? s->bar_unit : s->unit;
        options.weld = s->weld;
        mesh_status status = mesh_axes_parse(s->axes, options.axis);
        return status == MESH_OK ? mesh_load(file_of(wall), &options, surface, report) : status;
    }
    mesh_surface raw;
    mesh_status status = make_shape(wall, &raw);
    if (status != MESH_OK) return status;
    status = mesh_build(wall->item.name, &raw, &options, surface, report);
    mesh_free(&raw);
    return status;
}

/* Enlarged, turned, moved. */
static void place(const wall_item *wall, mesh_surface *surface) {
    const surface_rule *s = &wall->surface;
    mat3 turn = q_matrix(scene_turn(&s->turn, tree_get(wall->item.node, "rotation")));
    for (size_t v = 0; v < surface->vertex_count; v++) {
        double *p = surface->vertex + 3 * v;
        vec3 at = v3_scale(s->scale, v3(p[0], p[1], p[2]));
        at = v3_add(m3_apply(&turn, at), s->at);
        p[0] = at.x, p[1] = at.y, p[2] = at.z;
    }
}

/* ---- into the world -------------------------------------------------------------------------- */

static clast_vec3 *vertices_of(scene_arena *arena, const mesh_surface *surface, clast_vec3 shift) {
    clast_vec3 *to = scene_alloc(arena, surface->vertex_count * sizeof *to);
    for (size_t v = 0; v < surface->vertex_count; v++) {
        const double *p = surface->vertex + 3 * v;
        to[v] = v3_add(v3(p[0], p[1], p[2]), shift);
    }
    return to;
}

static void remember(scene_reader *r, scene_draft *d, const clast_mesh_def *def, int first,
                     int walls) {
    scene_mesh *m = &d->meshes[d->mesh_count++];
    size_t vertices = (size_t)def->vertices, triangles = (size_t)def->triangles;
    *m = (scene_mesh){.name = scene_copy(r->arena, def->name, strlen(def->name)),
                      .wall = first,
                      .walls = walls,
                      .vertex_count = vertices,
                      .triangle_count = triangles};
    m->vertex = scene_alloc(r->arena, 3 * vertices * sizeof *m->vertex);
    m->triangle = scene_alloc(r->arena, 3 * triangles * sizeof *m->triangle);
    for (size_t v = 0; v < vertices; v++) {
        clast_vec3 p = def->vertex[v];
        memcpy(m->vertex + 3 * v, (double[3]){p.x, p.y, p.z}, 3 * sizeof(double));
    }
    memcpy(m->triangle, def->triangle, 3 * triangles * sizeof *m->triangle);
}

static bool add_copy(scene_reader *r, clast_world *w, scene_draft *d, const wall_item *wall,
                     const mesh_surface *surface, int copy, int still) {
    double angle = wall->surface.smooth_angle; /* 0 is "none" here, "as usual" in the engine */
    clast_mesh_def def = {.name = scene_copy_name(r->arena, wall, copy),
                          .material = wall->material,
                          .vertices = (int)surface->vertex_count,
                          .triangles = (int)surface->triangle_count,
                          .triangle = surface->triangle,
                          .belt_velocity = wall->belt,
                          .smooth_angle = angle > 0 ? angle : -1};
    def.vertex = vertices_of(r->arena, surface, scene_copy_shift(wall, copy));
    int first = clast_world_wall_count(w);
    int walls = clast_mesh_add(w, scene_copy_part(wall, copy, still), &def);
    if (walls < 0)
        FAULT(wall->item.node, KEYS[kind_of(wall)], "%s", clast_world_error(w));
    else
        remember(r, d, &def, first, walls);
    return walls >= 0;
}

/* What was found in it, behind what was found in those before. */
static void add_report(scene_reader *r, scene_draft *d, const wall_item *wall,
                       const mesh_report *report) {
    char *text = NULL;
    size_t length;
    FILE *to = open_memstream(&text, &length);
    SCENE_ASSERT(to);
    const char *file = file_of(wall) ? file_of(wall) : KEYS[kind_of(wall)];
    mesh_report_write(report, scene_print(r->arena, "%s, %s", wall->item.name, file), to);
    SCENE_ASSERT(fclose(to) == 0);
    d->mesh_reports = scene_print(r->arena, "%s%s", d->mesh_reports ? d->mesh_reports : "", text);
    free(text);
}

void scene_add_surface(scene_reader *r, clast_world *w, scene_draft *draft, const wall_item *wall,
                       int still) {
    SCENE_ASSERT(r && w && draft && wall && scene_is_surface(wall));
    mesh_surface surface = {0};
    mesh_report report;
    if (read_or_make(wall, &surface, &report) != MESH_OK) {
        FAULT(wall->item.node, KEYS[kind_of(wall)], "found %s", mesh_error_text());
        return;
    }
    add_report(r, draft, wall, &report);
    place(wall, &surface);
    bool good = true;
    for (int i = 0; i < scene_copies(wall) && good; i++)
        good = add_copy(r, w, draft, wall, &surface, i, still);
    mesh_free(&surface);
}
