/* build.c - a draft becomes a world. What the engine refuses is reported at the line that asked for
 * it. */
#include "experiments/scene/build.h"

#include "engine/vec.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define FAULT(node, key, ...) scene_fault_at(r->arena, r->faults, (node), (key), __VA_ARGS__)
#define EACH(type, it, list)                                                                       \
    for (const type *it = (list).items, *it##_end = it + (list).count; it != it##_end; it++)

enum { OUTLINE_POINTS = 72 }; /* of a fitted ellipse: below a pixel at any size we draw */

/* ---- shapes ---------------------------------------------------------------------------------- */

static void take_elements(sphere_set *set, const shape_item *shape) {
    const element_item *elements = shape->spheres.items;
    for (int i = 0; i < set->count; i++) {
        set->centre[i] = elements[i].centre;
        set->radius[i] = elements[i].radius;
    }
}

/* In the middle of the body, along x; no spacing is rounded twice. */
static void make_chain(sphere_set *set, const shape_item *shape) {
    for (int i = 0; i < set->count; i++) {
        set->centre[i].x = 0.5 * (2 * i - set->count + 1) * shape->chain_spacing;
        set->radius[i] = shape->radius;
    }
}

/* m, of the bounding sphere about the origin of the body. */
static double reach_of(int count, const clast_vec3 *centre, const double *radius) {
    double most = 0;
    for (int i = 0; i < count; i++) {
        clast_vec3 c = centre[i];
        double reach = sqrt(c.x * c.x + c.y * c.y + c.z * c.z) + radius[i];
        most = reach > most ? reach : most;
    }
    return most;
}

sphere_set scene_shape_spheres(scene_arena *arena, const shape_item *shape) {
    SCENE_ASSERT(arena && shape);
    if (shape->made.count > 0) return shape->made;
    bool fit = tree_get(shape->item.node, "fit") != NULL;
    bool chain = tree_get(shape->item.node, "chain") != NULL;
    sphere_set set = {.count = shape->spheres.count > 0 ? shape->spheres.count
                               : fit                    ? shape->fit_spheres
                               : chain                  ? shape->chain_spheres
                                                        : 1};
    set.centre = scene_alloc(arena, (size_t)set.count * sizeof *set.centre);
    set.radius = scene_alloc(arena, (size_t)set.count * sizeof *set.radius);
    if (shape->spheres.count > 0)
        take_elements(&set, shape);
    else if (chain)
        make_chain(&set, shape);
    else if (!fit)
        set.radius[0] = shape->radius;
    else if (clast_fit_ellipse(shape->ellipse[0], shape->ellipse[1], set.count, set.centre,
                               set.radius))
        set.count = 0;
    set.reach = reach_of(set.count, set.centre, set.radius);
    return set;
}

static point_list outline_of(scene_arena *arena, const shape_item *shape) {
    if (shape->outline.count > 0 || !tree_get(shape->item.node, "fit")) return shape->outline;
    point_list ellipse = {.count = OUTLINE_POINTS};
    ellipse.xz = scene_alloc(arena, 2 * OUTLINE_POINTS * sizeof *ellipse.xz);
    for (int i = 0; i < OUTLINE_POINTS; i++) {
        double sine, cosine;
        clast_sincos(6.283185307179586 * i / OUTLINE_POINTS, &sine, &cosine);
        ellipse.xz[2 * i] = shape->ellipse[0] * cosine;
        ellipse.xz[2 * i + 1] = shape->ellipse[1] * sine;
    }
    return ellipse;
}

/* A flat body has one moment equal to the sum of the others; rounding may put it above. */
static clast_vec3 flat_inertia(clast_vec3 i) {
    if (i.x > i.y + i.z) i.x = i.y + i.z;
    if (i.y > i.x + i.z) i.y = i.x + i.z;
    if (i.z > i.x + i.y) i.z = i.x + i.y;
    return i;
}

/* The same body `scale` times as large: what is given for it grows with its volume. */
static clast_shape_def scaled(scene_arena *arena, const clast_shape_def *d, double scale) {
    clast_shape_def out = *d;
    clast_vec3 *centre = scene_alloc(arena, (size_t)d->spheres * sizeof *centre);
    double *radius = scene_alloc(arena, (size_t)d->spheres * sizeof *radius);
    double *outline = scene_alloc(arena, (2 * (size_t)d->outline_points + 1) * sizeof *outline);
    for (int i = 0; i < d->spheres; i++) {
        clast_vec3 c = d->centre[i];
        centre[i] = (clast_vec3){scale * c.x, scale * c.y, scale * c.z};
        radius[i] = scale * d->radius[i];
    }
    for (int i = 0; i < 2 * d->outline_points; i++) outline[i] = scale * d->outline[i];
    double volume = scale * scale * scale, turning = volume * scale * scale;
    out.name = scene_print(arena, "%s*%.6g", d->name, scale);
    out.centre = centre, out.radius = radius, out.outline = outline;
    out.mass = volume * d->mass;
    out.inertia =
        (clast_vec3){turning * d->inertia.x, turning * d->inertia.y, turning * d->inertia.z};
    return out;
}

/* The template of one class; its index in the world, or -1 with a fault. */
static int add_class(scene_reader *r, clast_world *w, const shape_item *shape, double scale) {
    sphere_set set = scene_shape_spheres(r->arena, shape);
    if (set.count == 0) {
        FAULT(shape->item.node, "fit", "found an ellipse that %d spheres cannot be fitted to",
              shape->fit_spheres);
        return -1;
    }
    point_list outline = outline_of(r->arena, shape);
    clast_shape_def def = {.name = shape->item.name,
                           .material = shape->material,
                           .spheres = set.count,
                           .centre = set.centre,
                           .radius = set.radius,
                           .mass = shape->mass,
                           .inertia = flat_inertia(shape->inertia),
                           .outline_points = outline.count,
                           .outline = outline.xz};
    if (tree_get(shape->item.node, "size")) def = scaled(r->arena, &def, scale);
    int index = clast_shape_add(w, &def);
    if (index < 0) FAULT(shape->item.node, NULL, "%s", clast_world_error(w));
    return index;
}

/* Every shape has its first template at its own place, so that names stand for indices of the
 * world; the other classes of size follow. */
static const shape_family *add_shapes(scene_reader *r, clast_world *w, const scene_draft *d) {
    shape_family *families = scene_alloc(r->arena, (size_t)d->shapes.count * sizeof *families);
    int i = 0;
    EACH(shape_item, shape, d->shapes) {
        size_set sizes = scene_shape_sizes(r, shape);
        int *templates = scene_alloc(r->arena, (size_t)sizes.count * sizeof *templates);
        templates[0] = add_class(r, w, shape, sizes.scale[0]);
        families[i++] = (shape_family){sizes.count, templates, sizes.scale};
    }
    i = 0;
    EACH(shape_item, shape, d->shapes) {
        shape_family *f = &families[i++];
        for (int k = 1; k < f->count && r->faults->errors == 0; k++)
            f->templates[k] = add_class(r, w, shape, f->scale[k]);
    }
    return families;
}

/* ---- materials, pairs, parts, walls ---------------------------------------------------------- */

static void add_materials(scene_reader *r, clast_world *w, const scene_draft *d) {
    EACH(material_item, material, d->materials) {
        clast_material_def def = material->def;
        def.name = material->item.name;
        if (clast_material_add(w, &def) < 0)
            FAULT(material->item.node, NULL, "%s", clast_world_error(w));
    }
    EACH(pair_item, pair, d->pairs) {
        if (clast_pair_set(w, pair->between[0], pair->between[1], &pair->def))
            FAULT(pair->item.node, NULL, "%s", clast_world_error(w));
    }
}

int scene_copies(const wall_item *wall) {
    return wall->copies.count > 0 ? wall->copies.count : 1;
}

const char *scene_copy_name(scene_arena *arena, const wall_item *wall, int copy) {
    if (wall->copies.count == 0) return wall->item.name;
    return scene_print(arena, "%s-%d", wall->item.name, copy + 1);
}

int scene_copy_part(const wall_item *wall, int copy, int still) {
    const name_list *parts = &wall->copies.parts;
    int part = parts->count > 0 ? parts->index[copy % parts->count] : wall->part;
    return part < 0 ? still : part;
}

clast_vec3 scene_copy_shift(const wall_item *wall, int copy) {
    return v3_scale(copy, wall->copies.step);
}

static void add_wall(scene_reader *r, clast_world *w, const wall_item *wall, int still) {
    bool plane = tree_get(wall->item.node, "plane") != NULL;
    for (int i = 0; i < scene_copies(wall); i++) {
        clast_wall_def def = plane ? wall->plane : wall->plate;
        def.name = scene_copy_name(r->arena, wall, i);
        def.kind = plane ? CLAST_WALL_PLANE : CLAST_WALL_PLATE;
        def.point = v3_add(def.point, scene_copy_shift(wall, i));
        def.material = wall->material;
        def.belt_velocity = wall->belt;
        if (clast_wall_add(w, scene_copy_part(wall, i, still), &def) >= 0) continue;
        FAULT(wall->item.node, NULL, "%s", clast_world_error(w));
        return;
    }
}

static bool is_still(const wall_item *wall) {
    return wall->part < 0 && wall->copies.parts.count == 0;
}

static void make_room_for_meshes(scene_reader *r, scene_draft *d) {
    int count = 0;
    EACH(wall_item, wall, d->walls) count += scene_is_surface(wall) ? scene_copies(wall) : 0;
    d->meshes = scene_alloc(r->arena, ((size_t)count + 1) * sizeof *d->meshes);
}

static void add_walls(scene_reader *r, clast_world *w, scene_draft *d) {
    bool needs_still = false;
    scene_add_parts(r, w, d);
    EACH(wall_item, wall, d->walls) needs_still = needs_still || is_still(wall);
    if (r->faults->errors) return; /* indices of parts would be off */
    int still = needs_still ? clast_part_add(w, &(clast_part_def){.name = "still"}) : -1;
    make_room_for_meshes(r, d);
    EACH(wall_item, wall, d->walls) {
        if (scene_is_surface(wall))
            scene_add_surface(r, w, d, wall, still);
        else
            add_wall(r, w, wall, still);
    }
}

/* ---- bodies ---------------------------------------------------------------------------------- */

static const char *checkpoint_path(scene_arena *arena, const char *path) {
    struct stat status;
    bool folder = stat(path, &status) == 0 && S_ISDIR(status.st_mode);
    return folder ? scene_print(arena, "%s/checkpoint.h5", path) : path;
}

static void inherit(scene_reader *r, clast_world *w, crowd *c, const body_item *body) {
    const char *path = checkpoint_path(r->arena, body->from);
    if (clast_checkpoint_inherit(w, path)) {
        FAULT(body->item.node, "from", "%s", clast_world_error(w));
        return;
    }
    clast_bodies b = clast_world_bodies(w);
    for (size_t i = 0; i < b.count; i++)
        crowd_add(c, &(clast_body_def){.shape = b.shape[i], .position = {b.x[i], b.y[i], b.z[i]}},
                  0);
    c->inherited = c->count;
}

static void place(scene_reader *r, clast_world *w, crowd *c, const scene_draft *d,
                  const body_item *body) {
    const tree_node *node = body->item.node;
    int source = node->index;
    if (tree_get(node, "shape"))
        crowd_add(
            c,
            &(clast_body_def){.shape = body->shape,
                              .position = body->position,
                              .orientation = scene_turn(&body->turn, tree_get(node, "orientation")),
                              .velocity = body->velocity,
                              .spin = body->spin},
            source);
    else if (tree_get(node, "grid"))
        scene_place_grid(r, c, tree_get(node, "grid"), &body->grid, source);
    else if (tree_get(node, "hexagonal"))
        scene_place_hexagonal(r, c, tree_get(node, "hexagonal"), &body->hexagonal, source);
    else if (tree_get(node, "random"))
        scene_place_random(r, c, tree_get(node, "random"), &body->random, source);
    else if (tree_get(node, "csv"))
        scene_place_csv(r, c, d, body->csv, node, source);
    else
        inherit(r, w, c, body);
}

static const tree_node *source_of(const scene_draft *d, const crowd *c, int body) {
    return ((const body_item *)d->bodies.items)[c->source[body]].item.node;
}

static void add_bodies(scene_reader *r, clast_world *w, const scene_draft *d, crowd *c) {
    EACH(body_item, body, d->bodies) place(r, w, c, d, body);
    for (int i = c->inherited; i < c->count; i++)
        if (clast_body_add(w, &c->bodies[i]) < 0)
            FAULT(source_of(d, c, i), NULL, "%s", clast_world_error(w));
}

static void measure_shapes(scene_reader *r, const clast_world *w, crowd *c) {
    int count = clast_world_shape_count(w);
    double *reach = scene_alloc(r->arena, (size_t)count * sizeof *reach);
    double *mass = scene_alloc(r->arena, (size_t)count * sizeof *mass);
    for (int i = 0; i < count; i++) {
        clast_shape_def shape = clast_world_shape(w, i);
        reach[i] = reach_of(shape.spheres, shape.centre, shape.radius);
        mass[i] = shape.mass;
    }
    c->shape_reach = reach, c->shape_mass = mass;
}

/* ---- preparing ------------------------------------------------------------------------------- */

/* Of a line that begins with the name of a wall, a patch of which is NAME/0, NAME/1, ... */
static const tree_node *wall_in(scene_reader *r, const char *line) {
    if (strncmp(line, "wall ", 5)) return NULL;
    const char *name = scene_copy(r->arena, line + 5, strcspn(line + 5, ":/"));
    return tree_get(tree_get(r->root, "walls"), name);
}

/* The engine names bodies by id; the reader of the message needs the line that put them there. */
static const tree_node *blame(scene_reader *r, const scene_draft *d, const crowd *c,
                              const char *line) {
    const char *at = strstr(line, "body ");
    const tree_node *wall = wall_in(r, line), *domain = tree_get(r->root, "domain");
    if (wall) return wall;
    if (domain && strstr(line, "the domain is ")) return domain;
    unsigned id;
    if (at && sscanf(at, "body %u", &id) == 1 && id < (unsigned)c->count)
        return source_of(d, c, (int)id);
    EACH(feed_item, feed, d->feeds) {
        const char *named = scene_print(r->arena, "feed %s ", feed->item.name);
        if (!strncmp(line, named, strlen(named))) return feed->item.node;
    }
    const tree_node *bodies = tree_get(r->root, "bodies");
    return bodies ? bodies : r->root;
}

static void report_lines(scene_reader *r, const scene_draft *d, const crowd *c, const char *text) {
    while (*text) {
        size_t length = strcspn(text, "\n");
        const char *line = scene_copy(r->arena, text, length);
        FAULT(blame(r, d, c, line), NULL, "%s", line);
        text += length + (text[length] == '\n');
    }
}

/* Far too large a step is what other codes run to silent garbage. */
static void check_step(scene_reader *r, const scene_draft *d, const clast_world *w) {
    clast_plan p = clast_world_plan(w);
    const tree_node *time = tree_get(r->root, "time"), *step = tree_get(time, "step");
    if (!step || d->def.time_step == 0) return;
    const char *path = tree_path(r->arena, step, NULL);
    const char *means = scene_print(
        r->arena,
        "found %.3g s: %.3g steps in the shortest contact (of %.3g s at %.3g m/s), "
        "%.3g of the Rayleigh step",
        p.time_step, p.resolution, p.contact_time, p.impact_speed, p.time_step / p.rayleigh_step);
    /* a bound for schemes that have one; each has its own */
    bool critical = p.time_step > p.critical_step && !clast_scheme_info_of(d->def.scheme)->implicit;
    if (critical && d->def.guards == CLAST_GUARD_STOP)
        scene_report(r->faults, step->line, path,
                     "%s, expected at most the critical step %.3g s "
                     "(guards.mode: report runs it all the same)",
                     means, p.critical_step);
    else if (critical)
        scene_warn(r->faults, step->line, path, "%s, above the critical step %.3g s", means,
                   p.critical_step);
    else if (p.resolution < d->def.contact_resolution)
        scene_warn(r->faults, step->line, path, "%s, contact_resolution asks for %g", means,
                   d->def.contact_resolution);
    else if (p.time_step > p.rayleigh_step && !clast_law_info_of(d->def.law)->linear)
        scene_warn(r->faults, step->line, path, "%s, expected at most 1 of that", means);
}

static void prepare(scene_reader *r, const scene_draft *d, const crowd *c, clast_world *w) {
    if (clast_world_prepare(w))
        report_lines(r, d, c, clast_world_error(w));
    else
        check_step(r, d, w);
}

/* Which key asked for what the engine refuses. */
static const char *culprit(clast_status status) {
    return status == CLAST_ERR_OPEN ? "library" : status == CLAST_ERR_ARGUMENT ? "law" : "function";
}

static void use_law(scene_reader *r, clast_world *w, scene_draft *d) {
    if (d->def.law != CLAST_LAW_USER) return;
    if (!strchr(d->library, '/')) /* else it would be looked for among the system's libraries */
        d->library = scene_print(r->arena, "./%s", d->library);
    clast_status status = clast_world_use_law(w, d->library, d->function);
    if (status) FAULT(tree_get(r->root, "contact"), culprit(status), "%s", clast_world_error(w));
}

static clast_world *new_world(scene_reader *r, scene_draft *d) {
    d->def.motion = d->motion > 0 ? CLAST_MOTION_IN_PLANE : CLAST_MOTION_3D;
    if (d->motion > 0) d->def.plane_axis = d->motion - 1;
    d->def.seed = d->seed;
    clast_world *w = clast_world_new(&d->def);
    if (!w) scene_report(r->faults, 0, "", "%s", clast_world_new_error());
    return w;
}

clast_world *scene_build(scene_reader *r, scene_draft *draft, bool prepare_too) {
    SCENE_ASSERT(r && draft && r->faults->errors == 0);
    clast_world *w = new_world(r, draft);
    if (!w) return NULL;
    crowd c = {.plane_axis = draft->motion - 1, .seed = draft->seed};
    use_law(r, w, draft);
    add_materials(r, w, draft);
    if (!r->faults->errors) c.families = add_shapes(r, w, draft);
    if (!r->faults->errors) measure_shapes(r, w, &c);
    if (!r->faults->errors) add_walls(r, w, draft);
    if (!r->faults->errors) add_bodies(r, w, draft, &c);
    if (!r->faults->errors) scene_add_flow(r, w, draft, &c);
    if (!r->faults->errors && c.count == 0 && draft->feeds.count == 0)
        scene_report(r->faults, tree_get(r->root, "bodies")->line, "bodies", "found no body");
    if (!r->faults->errors && prepare_too) prepare(r, draft, &c, w);
    crowd_free(&c);
    if (!r->faults->errors) return w;
    clast_world_free(w);
    return NULL;
}
