/* fill.c - shapes that are given as a solid, a profile or a mesh become spheres with mass and
 * inertia before anything else looks at them. */
#include "experiments/scene/build.h"
#include "experiments/scene/clump.h"

#include <math.h>
#include <stdlib.h>

#include "shapes/deviation.h"

#define FAULT(node, key, ...) scene_fault_at(r->arena, r->faults, (node), (key), __VA_ARGS__)

static const tree_node *get(const shape_item *shape, const char *key) {
    return tree_get(shape->item.node, key);
}

static bool is_filled(const shape_item *shape) {
    return get(shape, "solid") || get(shape, "profile") || get(shape, "mesh");
}

/* ---- targets --------------------------------------------------------------------------------- */

static shape_target *solid_target(scene_reader *r, const shape_item *shape) {
    const tree_node *node = get(shape, "solid");
    if (!node || !node->first) return NULL;
    shape_kind kind = shape_kind_of(node->first->key);
    SCENE_ASSERT(kind != SHAPE_KINDS); /* the table of keys has no others */
    shape_solid solid = {kind, {shape->solid[0], shape->solid[1], shape->solid[2]}};
    const char *fault = shape_solid_fault(&solid);
    if (!fault) return shape_target_of_solid(&solid);
    FAULT(node, node->first->key, "found %s", fault);
    return NULL;
}

/* An ellipse that is fitted with spheres is a spheroid. */
static shape_target *fit_target(const shape_item *shape) {
    double a = shape->ellipse[0], b = shape->ellipse[1];
    return shape_target_of_solid(&(shape_solid){SHAPE_ELLIPSOID, {a, b, b}});
}

/* NULL with faults, or for spheres that stand for nothing but themselves. */
static shape_target *target_of(scene_reader *r, const shape_item *shape) {
    if (get(shape, "solid")) return solid_target(r, shape);
    if (get(shape, "profile"))
        return scene_profile_target(r->faults, shape->profile, shape->file_unit);
    if (get(shape, "mesh")) return scene_mesh_target(r->faults, shape->mesh, shape->file_unit);
    return get(shape, "fit") ? fit_target(shape) : NULL;
}

/* ---- stops ----------------------------------------------------------------------------------- */

/* Spheres of the level of detail; 0 where there are no levels, -1 with a fault. */
static int level_of(scene_reader *r, const shape_item *shape) {
    const tree_node *fill = get(shape, "fill"), *levels = tree_get(fill, "levels");
    if (!levels) return 0;
    const fill_rule *rule = &shape->fill;
    if (tree_get(fill, "spheres")) {
        FAULT(fill, "levels", "found beside 'spheres', expected one of the two");
        return -1;
    }
    for (int i = 0; i < levels->children; i++) {
        double n = rule->levels[i];
        if (n >= 1 && n <= SHAPE_SPHERES_MAX && n == floor(n)) continue;
        FAULT(fill, "levels", "found %g, expected whole numbers from 1 to %d", n,
              SHAPE_SPHERES_MAX);
        return -1;
    }
    if (rule->level <= levels->children) return (int)rule->levels[rule->level - 1];
    FAULT(fill, "level", "found %d, expected at most %d, the number of levels", rule->level,
          levels->children);
    return -1;
}

static bool read_stops(scene_reader *r, const shape_item *shape, shape_stops *stops) {
    const fill_rule *rule = &shape->fill;
    int level = level_of(r, shape);
    if (level < 0) return false;
    *stops = (shape_stops){.spheres = level > 0 ? level : rule->spheres,
                           .density = rule->density,
                           .deviation = rule->deviation,
                           .smallest = rule->smallest};
    if (!stops->spheres && !(stops->density > 0) && !(stops->deviation > 0)) stops->density = 2;
    return true;
}

/* ---- spheres --------------------------------------------------------------------------------- */

static int given_spheres(scene_reader *r, const shape_item *shape, shape_sphere *to) {
    sphere_set set = scene_shape_spheres(r->arena, shape);
    for (int i = 0; i < set.count; i++) {
        clast_vec3 c = set.centre[i];
        to[i] = (shape_sphere){{c.x, c.y, c.z}, set.radius[i]};
    }
    return set.count;
}

/* What was asked for and what came of it, at the line of the key that asks. */
static void warn_of_miss(scene_reader *r, const shape_item *shape, const shape_target *target,
                         const shape_stops *stops, const shape_sphere *spheres,
                         const shape_filling *f) {
    const tree_node *node = shape->item.node, *fill = get(shape, "fill");
    const tree_node *asks = tree_get(fill, stops->deviation > 0 ? "deviation" : "density");
    int line = asks ? asks->line : fill ? fill->line : node->line;
    const char *dense = "";
    if (stops->density >= 1)
        dense = scene_print(r->arena, "packing density %g asked for, %.3g reached", stops->density,
                            f->density);
    if (!(stops->deviation > 0)) {
        scene_warn(r->faults, line, tree_path(r->arena, node, "fill"),
                   "not met with %d spheres: %s", f->count, dense);
        return;
    }
    double least = shape_deviation_least(target);
    const char *below = "";
    if (stops->deviation < least)
        below =
            scene_print(r->arena, "; less than %.3g mm of this body cannot be told", 1e3 * least);
    scene_warn(r->faults, line, tree_path(r->arena, node, "fill"),
               "not met with %d spheres: deviation %g mm asked for, %.4g mm reached%s%s%s",
               f->count, 1e3 * stops->deviation,
               1e3 * shape_deviation_max(target, spheres, f->count), below, *dense ? "; " : "",
               dense);
}

static int place_spheres(scene_reader *r, const shape_item *shape, const shape_target *target,
                         shape_sphere *to) {
    if (!is_filled(shape)) return given_spheres(r, shape, to);
    shape_stops stops;
    if (!read_stops(r, shape, &stops)) return 0;
    shape_filling f = target->source == SHAPE_FROM_PROFILE ? shape_fill_row(target, &stops, to)
                                                           : shape_fill(target, &stops, to, NULL);
    if (f.count == 0) FAULT(shape->item.node, "fill", "found no sphere that is large enough");
    if (f.count > 0 && !f.met) warn_of_miss(r, shape, target, &stops, to, &f);
    return f.count;
}

/* ---- mass ------------------------------------------------------------------------------------ */

static double density_of(const scene_draft *d, const shape_item *shape) {
    return ((const material_item *)d->materials.items)[shape->material].def.density;
}

/* A mass that is given makes the body heavier or lighter as a whole. */
static void take_mass(shape_item *shape, const shape_clump *c, double density) {
    if (shape->mass == 0) shape->mass = density * c->volume;
    if (shape->inertia.x != 0) return;
    double scale = shape->mass / c->volume;
    shape->inertia = (clast_vec3){scale * c->frame.moment[0], scale * c->frame.moment[1],
                                  scale * c->frame.moment[2]};
}

static void take_spheres(scene_reader *r, shape_item *shape, const shape_clump *c) {
    size_t count = (size_t)c->count;
    sphere_set *set = &shape->made;
    *set = (sphere_set){.count = c->count,
                        .centre = scene_alloc(r->arena, count * sizeof *set->centre),
                        .radius = scene_alloc(r->arena, count * sizeof *set->radius)};
    for (int i = 0; i < c->count; i++) {
        shape_vec at = c->sphere[i].centre;
        set->centre[i] = (clast_vec3){at.x, at.y, at.z};
        set->radius[i] = c->sphere[i].radius;
        set->reach = fmax(set->reach, sv_norm(at) + set->radius[i]);
    }
}

static const char *in_words(scene_reader *r, const shape_clump *c, mass_choice from,
                            double density) {
    const char *both = scene_print(r->arena, "union %.6g g (volume within %.1e of itself)",
                                   1e3 * density * c->as_union.volume, c->as_union.volume_bound);
    if (c->as_solid.volume > 0)
        both = scene_print(r->arena, "%s, solid %.6g g", both, 1e3 * density * c->as_solid.volume);
    return scene_print(r->arena, "%s; mass from the %s", both,
                       from == MASS_SOLID ? "solid" : "union");
}

static void make(scene_reader *r, const scene_draft *d, shape_item *shape, shape_sphere *room) {
    shape_target *target = target_of(r, shape);
    bool needs = is_filled(shape) || shape->mass_from == MASS_SOLID;
    if (!target && needs) {
        if (r->faults->errors == 0)
            FAULT(shape->item.node, "mass_from", "found solid, expected union: there is no solid");
        return;
    }
    int count = place_spheres(r, shape, target, room);
    if (count > 0) {
        mass_choice from = shape->mass_from == MASS_AUTO ? MASS_SOLID : shape->mass_from;
        shape_clump clump =
            shape_clump_of(room, count, target ? &target->mass : NULL,
                           from == MASS_SOLID ? SHAPE_MASS_SOLID : SHAPE_MASS_UNION);
        double density = density_of(d, shape);
        take_mass(shape, &clump, density);
        take_spheres(r, shape, &clump);
        shape->made_of = in_words(r, &clump, from, density);
        shape_clump_free(&clump);
    }
    shape_target_free(target);
}

static void check_keys(scene_reader *r, const shape_item *shape) {
    const tree_node *fill = get(shape, "fill"), *unit = get(shape, "unit");
    if (fill && !is_filled(shape))
        scene_warn(r->faults, fill->line, tree_path(r->arena, fill, NULL),
                   "used by solid, profile and mesh alone, has no effect here");
    if (unit && !get(shape, "profile") && !get(shape, "mesh"))
        scene_warn(r->faults, unit->line, tree_path(r->arena, unit, NULL),
                   "used by profile and mesh alone, has no effect here");
}

void scene_fill_shapes(scene_reader *r, scene_draft *draft) {
    SCENE_ASSERT(r && draft);
    if (r->faults->errors > 0) return; /* values may be missing */
    shape_item *shapes = draft->shapes.items;
    shape_sphere *room = NULL;
    for (int i = 0; i < draft->shapes.count; i++) {
        check_keys(r, &shapes[i]);
        if (!is_filled(&shapes[i]) && shapes[i].mass_from == MASS_AUTO) continue;
        size_t most = SHAPE_SPHERES_MAX + (size_t)shapes[i].spheres.count;
        room = realloc(room, most * sizeof *room);
        SCENE_ASSERT(room);
        make(r, draft, &shapes[i], room);
    }
    free(room);
}
