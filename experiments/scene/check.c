/* check.c - faults that no single key shows: pairs left out, a plate whose side is not at right
 * angles, spheres that overlap and have no mass. */
#include "experiments/scene/build.h"

#include <math.h>
#include <string.h>

#define FAULT(node, key, ...) scene_fault_at(r->arena, r->faults, (node), (key), __VA_ARGS__)
#define EACH(type, it, list)                                                                       \
    for (const type *it = (list).items, *it##_end = it + (list).count; it != it##_end; it++)

static double dot(clast_vec3 a, clast_vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static double length(clast_vec3 a) {
    return sqrt(dot(a, a));
}

static double component(clast_vec3 v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

static bool is_below(clast_vec3 a, clast_vec3 b) {
    return a.x < b.x && a.y < b.y && a.z < b.z;
}

static bool is_faulty(const scene_reader *r, const tree_node *node, const char *key) {
    if (r->faults->errors == 0) return false;
    const char *path = tree_path(r->arena, node, key);
    for (int i = 0; i < r->faults->count; i++)
        if (!strncmp(r->faults->items[i].key, path, strlen(path))) return true;
    return false;
}

/* A value can be checked against others only where it was given and could be read. */
static bool was_given(const scene_reader *r, const tree_node *node, const char *key) {
    return tree_get(node, key) != NULL && !is_faulty(r, node, key);
}

/* ---- pairs ----------------------------------------------------------------------------------- */

static const char *material_name(const scene_draft *d, int material) {
    SCENE_ASSERT(material >= 0 && material < d->materials.count);
    return ((const material_item *)d->materials.items)[material].item.name;
}

static bool is_pair(const pair_item *p, int a, int b) {
    return (p->between[0] == a && p->between[1] == b) || (p->between[0] == b && p->between[1] == a);
}

/* A number that the law does not read would be believed to matter. */
static void check_unused(scene_reader *r, const tree_node *section, const char *key, bool used,
                         const char *by) {
    const tree_node *node = tree_get(section, key);
    if (node && !used)
        scene_warn(r->faults, node->line, tree_path(r->arena, node, NULL),
                   "used by %s alone, has no effect here", by);
}

/* All that a law of the user's own reads of a pair is friction, cohesion and its parameters. */
static void check_pair_own_law(scene_reader *r, const pair_item *pair) {
    static const char *const UNREAD[] = {"restitution",      "stiffness",
                                         "tangential_ratio", "tangential_restitution",
                                         "dissipation",      "reference_speed"};
    for (int i = 0; i < 6; i++)
        check_unused(r, pair->item.node, UNREAD[i], false, "the engine's own laws");
}

static void check_pair_law(scene_reader *r, const scene_draft *d, const pair_item *pair) {
    const clast_law_info *law = clast_law_info_of(d->def.law);
    const tree_node *node = pair->item.node;
    if (d->def.law == CLAST_LAW_USER) {
        check_pair_own_law(r, pair);
        return;
    }
    check_unused(r, node, "parameters", false, "the law user");
    bool given = law->dissipation && tree_get(node, "dissipation");
    if (law->stiffness && !tree_get(node, "stiffness"))
        FAULT(node, "stiffness", "missing, expected a stiffness in N/m, > 0, for law %s",
              law->name);
    if (!given && !tree_get(node, "restitution"))
        FAULT(node, "restitution", "missing, expected a number, > 0 and <= 1");
    static const char *const INSTEAD[] = {"restitution", "reference_speed"};
    for (int i = 0; i < 2 && given; i++)
        if (tree_get(node, INSTEAD[i]))
            FAULT(node, INSTEAD[i], "found beside dissipation, which it would be solved for");
    check_unused(r, node, "stiffness", law->stiffness, "the laws linear and walton-braun");
    check_unused(r, node, "tangential_ratio", law->linear,
                 "the laws linear, maw, hooke and walton-braun");
    check_unused(r, node, "tangential_restitution", !law->dissipation,
                 "laws other than hertz-brilliantov");
    check_unused(r, node, "dissipation", law->dissipation, "the law hertz-brilliantov");
    check_unused(r, node, "reference_speed", law->dissipation, "the law hertz-brilliantov");
}

static void check_pair(scene_reader *r, const scene_draft *d, const pair_item *pair) {
    const pair_item *first = d->pairs.items;
    for (; first != pair; first++)
        if (is_pair(first, pair->between[0], pair->between[1]) && pair->between[0] >= 0)
            FAULT(pair->item.node, "between",
                  "found %s and %s twice, expected once (also in line %d)",
                  material_name(d, pair->between[0]), material_name(d, pair->between[1]),
                  first->item.node->line);
    check_pair_law(r, d, pair);
}

static void need_pair(scene_reader *r, const scene_draft *d, int a, int b) {
    if (a < 0 || b < 0) return; /* an unknown material has been reported */
    EACH(pair_item, pair, d->pairs) {
        if (is_pair(pair, a, b) || pair->between[0] < 0) return;
    }
    const tree_node *pairs = tree_get(r->root, "pairs");
    if (!pairs) return;
    FAULT(pairs, NULL, "missing between %s and %s, which can touch",
          material_name(d, a < b ? a : b), material_name(d, a < b ? b : a));
}

static void check_pairs(scene_reader *r, const scene_draft *d) {
    EACH(pair_item, pair, d->pairs) check_pair(r, d, pair);
    EACH(shape_item, shape, d->shapes) {
        EACH(shape_item, other, d->shapes) need_pair(r, d, shape->material, other->material);
        EACH(wall_item, wall, d->walls) need_pair(r, d, shape->material, wall->material);
    }
}

/* ---- shapes ---------------------------------------------------------------------------------- */

static bool overlap(const sphere_set *set) {
    for (int i = 0; i < set->count; i++)
        for (int j = 0; j < i; j++) {
            clast_vec3 a = set->centre[i], b = set->centre[j];
            double distance = length((clast_vec3){a.x - b.x, a.y - b.y, a.z - b.z});
            if (distance < (set->radius[i] + set->radius[j]) * (1 - 1e-9)) return true;
        }
    return false;
}

static clast_vec3 centre_of_mass(const sphere_set *set) {
    clast_vec3 sum = {0};
    double weight = 0;
    for (int i = 0; i < set->count; i++) {
        double w = set->radius[i] * set->radius[i] * set->radius[i];
        sum.x += w * set->centre[i].x;
        sum.y += w * set->centre[i].y;
        sum.z += w * set->centre[i].z;
        weight += w;
    }
    return (clast_vec3){sum.x / weight, sum.y / weight, sum.z / weight};
}

static void check_mass(scene_reader *r, const shape_item *shape) {
    const tree_node *node = shape->item.node;
    sphere_set set = scene_shape_spheres(r->arena, shape);
    clast_vec3 centre = centre_of_mass(&set);
    bool overlaps = overlap(&set);
    if (overlaps && shape->mass == 0)
        FAULT(node, "mass",
              "found none, expected a mass in kg, > 0, or mass_from: union: the spheres overlap");
    if (overlaps && shape->inertia.x == 0)
        FAULT(node, "inertia", "found none, expected [x, y, z] in kg m2, > 0: the spheres overlap");
    if (!overlaps && shape->mass == 0 && length(centre) > 1e-6 * set.reach)
        FAULT(node, NULL,
              "centre of mass of the spheres found at [%.6g, %.6g, %.6g] m, "
              "expected at the origin",
              centre.x, centre.y, centre.z);
}

/* No solid has one principal moment above the sum of the other two. */
static void check_inertia(scene_reader *r, const shape_item *shape) {
    clast_vec3 i = shape->inertia;
    double slack = 1 + 1e-9;
    if (i.x > (i.y + i.z) * slack || i.y > (i.x + i.z) * slack || i.z > (i.x + i.y) * slack)
        FAULT(shape->item.node, "inertia",
              "found [%g, %g, %g] kg m2, expected none above the sum of the other two", i.x, i.y,
              i.z);
}

static void check_shape(scene_reader *r, const shape_item *shape) {
    const tree_node *node = shape->item.node, *fit = tree_get(node, "fit");
    if (fit && shape->ellipse[0] < shape->ellipse[1])
        FAULT(fit, "ellipse", "found half axes %g, %g m, expected a >= b", shape->ellipse[0],
              shape->ellipse[1]);
    check_inertia(r, shape);
    if (r->faults->errors == 0) check_mass(r, shape);
    const tree_node *size = tree_get(node, "size");
    if (size && !is_faulty(r, size, NULL)) scene_check_size(r, shape, size);
}

/* ---- parts and walls ------------------------------------------------------------------------- */

static bool has_part(const wall_item *wall, int part) {
    const name_list *parts = &wall->copies.parts;
    for (int i = 0; i < parts->count; i++)
        if (parts->index[i] == part) return true;
    return parts->count == 0 && wall->part == part;
}

static void check_parts(scene_reader *r, const scene_draft *d) {
    EACH(part_item, part, d->parts) {
        const clast_part_def *def = &part->def;
        if (def->move_until > 0 && def->move_until <= def->move_from)
            FAULT(part->item.node, "move_until", "found %g s, expected more than move_from, %g s",
                  def->move_until, def->move_from);
        scene_check_part(r, part);
        bool used = false;
        EACH(wall_item, wall, d->walls) used = used || has_part(wall, part->item.node->index);
        if (!used)
            scene_warn(r->faults, part->item.node->line, tree_path(r->arena, part->item.node, NULL),
                       "has no walls");
    }
}

static void check_direction(scene_reader *r, const tree_node *node, const char *key, clast_vec3 v) {
    if (!was_given(r, node, key)) return;
    if (!(length(v) > 0) || !isfinite(length(v)))
        FAULT(node, key, "found [%g, %g, %g], expected a direction", v.x, v.y, v.z);
}

static void check_turn(scene_reader *r, const tree_node *node, const rotation *t) {
    if (!node) return;
    check_direction(r, node, "axis", t->axis);
    const double *q = t->quaternion;
    if (was_given(r, node, "quaternion") && q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] == 0)
        FAULT(node, "quaternion", "found [0, 0, 0, 0], expected a rotation");
}

static void check_plate(scene_reader *r, const wall_item *wall, const tree_node *plate) {
    clast_vec3 n = wall->plate.normal, s = wall->plate.side;
    check_direction(r, plate, "normal", n);
    check_direction(r, plate, "side", s);
    if (is_faulty(r, plate, NULL)) return;
    if (fabs(dot(n, s)) > 1e-9 * length(n) * length(s))
        FAULT(plate, "side", "found a direction that is not at right angles to the normal");
}

/* A file has its measures in itself. */
static void check_bar(scene_reader *r, const tree_node *bar) {
    static const char *const MEASURES[] = {"length",     "height",   "width",   "nose_radius",
                                           "nose_angle", "undercut", "segments"};
    if (!bar) return;
    bool of_file = tree_get(bar, "mesh") != NULL;
    check_unused(r, bar, "unit", of_file, "mesh");
    for (size_t i = 0; i < sizeof MEASURES / sizeof *MEASURES; i++)
        if (of_file && tree_get(bar, MEASURES[i]))
            FAULT(bar, MEASURES[i], "found beside mesh, expected one of the two");
}

static void check_surface(scene_reader *r, const wall_item *wall) {
    static const char *const OF_FILES[] = {"axes", "weld"};
    static const char *const OF_TRIANGLES[] = {"scale", "rotation", "at", "smooth_angle"};
    const tree_node *node = wall->item.node;
    bool of_file = tree_get(node, "mesh") != NULL;
    check_bar(r, tree_get(node, "bar"));
    check_unused(r, node, "unit", of_file, "mesh");
    for (int i = 0; i < 2; i++)
        check_unused(r, node, OF_FILES[i], of_file || wall->surface.bar_mesh, "mesh");
    for (int i = 0; i < 4; i++)
        check_unused(r, node, OF_TRIANGLES[i], scene_is_surface(wall), "mesh, bar, tube and bend");
    check_turn(r, tree_get(node, "rotation"), &wall->surface.turn);
    int axis[3];
    if (was_given(r, node, "axes") && mesh_axes_parse(wall->surface.axes, axis) != MESH_OK)
        FAULT(node, "axes", "found '%s', expected x, y and z once each, such as x -z y",
              wall->surface.axes);
}

static void check_wall(scene_reader *r, const wall_item *wall) {
    const tree_node *node = wall->item.node;
    const tree_node *plane = tree_get(node, "plane"), *plate = tree_get(node, "plate");
    if (plane) check_direction(r, plane, "normal", wall->plane.normal);
    if (plate) check_plate(r, wall, plate);
    check_surface(r, wall);
    const tree_node *copies = tree_get(node, "copies");
    if (tree_get(node, "part") && tree_get(copies, "parts"))
        FAULT(node, "part", "found beside copies.parts, expected one of the two");
}

/* ---- bodies ---------------------------------------------------------------------------------- */

static void check_box(scene_reader *r, const tree_node *node, clast_vec3 min, clast_vec3 max) {
    if (was_given(r, node, "min") && was_given(r, node, "max") && !is_below(min, max))
        FAULT(node, "max", "found [%g, %g, %g] m, expected each above min, [%g, %g, %g] m", max.x,
              max.y, max.z, min.x, min.y, min.z);
}

static void check_motion(scene_reader *r, const scene_draft *d, const tree_node *node,
                         clast_vec3 velocity, clast_vec3 spin) {
    if (d->motion == 0) return;
    int axis = d->motion - 1;
    if (component(velocity, axis) != 0)
        FAULT(node, "velocity", "found a velocity across the plane of motion, expected 0 along %c",
              "xyz"[axis]);
    if (component(spin, (axis + 1) % 3) != 0 || component(spin, (axis + 2) % 3) != 0)
        FAULT(node, "spin", "found a spin out of the plane of motion, expected one about %c alone",
              "xyz"[axis]);
}

void scene_check_generator(scene_reader *r, const scene_draft *d, const tree_node *node,
                           const generator *g) {
    if (!node || node->kind != TREE_MAP) return;
    clast_vec3 min = g->region_min, max = g->region_max;
    const tree_node *region = tree_get(node, "region");
    if (region && !is_faulty(r, region, NULL) &&
        !(min.x <= max.x && min.y <= max.y && min.z <= max.z))
        FAULT(region, "max", "found a corner below min");
    if (g->orientation == ORIENT_RANDOM_IN_PLANE && d->motion == 0)
        FAULT(node, "orientation",
              "found 'random-in-plane', expected fixed or random: "
              "the motion is 3d");
    if (g->orientation != ORIENT_FIXED && was_given(r, node, "turn"))
        FAULT(node, "turn", "found beside a random orientation, expected orientation fixed");
    scene_check_mixture(r, node, g);
    check_turn(r, tree_get(node, "turn"), &g->turn);
    check_motion(r, d, node, g->velocity, g->spin);
}

static bool is_sized(const scene_draft *d, int shape) {
    const shape_item *shapes = d->shapes.items;
    return tree_get(shapes[shape].item.node, "size") != NULL;
}

static void check_single_body(scene_reader *r, const scene_draft *d, const body_item *body) {
    static const char *const OWN[] = {"position", "orientation", "velocity", "spin"};
    const tree_node *node = body->item.node;
    if (tree_get(node, "shape")) {
        if (was_given(r, node, "shape") && is_sized(d, body->shape))
            FAULT(node, "shape",
                  "found a shape of many sizes, expected one of a single size: grid, "
                  "hexagonal and random place the others");
        if (!tree_get(node, "position"))
            FAULT(node, "position", "missing, expected [x, y, z], each a length in m");
        check_turn(r, tree_get(node, "orientation"), &body->turn);
        check_motion(r, d, node, body->velocity, body->spin);
        return;
    }
    for (int i = 0; i < 4; i++)
        if (tree_get(node, OWN[i]))
            FAULT(node, OWN[i], "found without 'shape', expected only for a single body");
}

static void check_bodies(scene_reader *r, const scene_draft *d) {
    if (!tree_get(r->root, "bodies") && d->feeds.count == 0)
        FAULT(r->root, "bodies", "missing, expected a list, or feeds");
    EACH(feed_item, feed, d->feeds) scene_check_feed(r, d, feed);
    EACH(body_item, body, d->bodies) {
        const tree_node *node = body->item.node;
        check_single_body(r, d, body);
        scene_check_generator(r, d, tree_get(node, "grid"), &body->grid);
        scene_check_generator(r, d, tree_get(node, "hexagonal"), &body->hexagonal);
        scene_check_generator(r, d, tree_get(node, "random"), &body->random);
        if (was_given(r, node, "from") && node->index > 0)
            FAULT(node, "from",
                  "found behind other bodies, expected first: ids and contacts are "
                  "taken over from the earlier run");
    }
}

/* ---- the rest -------------------------------------------------------------------------------- */

static void check_span(scene_reader *r, const tree_node *node, const double x[2]) {
    if (node && was_given(r, node, "x") && !(x[0] < x[1]))
        FAULT(node, "x", "found %g to %g m, expected the smaller first", x[0], x[1]);
}

/* Columns of series.csv that scenes with feeds or outlets have by themselves. */
static bool is_taken(const scene_draft *d, const char *name) {
    static const char *const OURS[] = {"fed", "out", "inside"};
    bool taken = false;
    for (int i = 0; i < 3; i++) taken = taken || !strcmp(name, OURS[i]);
    return taken && d->feeds.count + d->outlets.count > 0;
}

static void check_measures(scene_reader *r, const scene_draft *d) {
    EACH(measure_item, m, d->measures) {
        if (is_taken(d, m->item.name))
            FAULT(m->item.node, NULL,
                  "found the name '%s', which the masses of feeds and outlets "
                  "have, expected another",
                  m->item.name);
        if (tree_get(m->item.node, "discharged") && d->feeds.count > 0)
            FAULT(m->item.node, "discharged",
                  "found in a scene with feeds, expected an outlet: it counts those bodies alone "
                  "that the scene begins with");
        check_span(r, tree_get(m->item.node, "solid_fraction"), m->bed_x);
        check_span(r, tree_get(m->item.node, "band_velocity"), m->band_x);
        if (strpbrk(m->item.name, ",\"\n "))
            FAULT(m->item.node, NULL,
                  "found a name with a space, comma or quote, expected one "
                  "that can head a column");
    }
}

/* A law of the user's own brings its friction along, with its limit and what becomes of it when the
 * load falls. */
static void check_law(scene_reader *r, const scene_draft *d) {
    const tree_node *contact = tree_get(r->root, "contact");
    if (!contact || contact->kind != TREE_MAP || is_faulty(r, contact, "law")) return;
    static const char *const KEYS[] = {"library", "function"};
    bool own = d->def.law == CLAST_LAW_USER;
    for (int i = 0; i < 2; i++) {
        if (own && !tree_get(contact, KEYS[i]))
            FAULT(contact, KEYS[i], "missing, expected %s for law user",
                  i ? "the name of a clast_law_entry" : "a shared object");
        check_unused(r, contact, KEYS[i], own, "the law user");
    }
    check_unused(r, contact, "tangent", !own, "the engine's own laws");
    check_unused(r, contact, "friction_limit", !own, "the engine's own laws");
    check_unused(r, contact, "unloading", !own, "the engine's own laws");
}

static void check_scheme(scene_reader *r, const scene_draft *d) {
    const tree_node *time = tree_get(r->root, "time"), *newton = tree_get(time, "newton");
    if (newton && !is_faulty(r, time, "scheme") && !clast_scheme_info_of(d->def.scheme)->implicit)
        scene_warn(r->faults, newton->line, tree_path(r->arena, newton, NULL),
                   "used by implicit schemes alone, has no effect here");
}

static void check_view(scene_reader *r, const scene_draft *d) {
    const tree_node *node = tree_get(r->root, "view");
    if (!node || node->kind != TREE_MAP) return;
    const view *v = &d->view;
    check_direction(r, node, "look_from", v->look_from);
    check_direction(r, node, "up", v->up);
    if (was_given(r, node, "size") &&
        (d->size[0] != floor(d->size[0]) || d->size[1] != floor(d->size[1])))
        FAULT(node, "size", "found a part of a pixel, expected whole numbers");
    const tree_node *box = tree_get(node, "box");
    if (box) check_box(r, box, v->box_min, v->box_max);
    if (is_faulty(r, node, "look_from") || is_faulty(r, node, "up")) return;
    double cosine = dot(v->look_from, v->up), product = length(v->look_from) * length(v->up);
    if (product > 0 && fabs(cosine) > (1 - 1e-9) * product)
        FAULT(node, was_given(r, node, "up") ? "up" : "look_from",
              "found the direction of view, expected one across it");
}

static void check_domain(scene_reader *r, const scene_draft *d) {
    const tree_node *domain = tree_get(r->root, "domain");
    if (!domain || is_faulty(r, domain, NULL)) return;
    if (!is_below(d->def.domain_min, d->def.domain_max))
        FAULT(domain, "max", "found a corner that is not above min in x, y and z");
    if (d->motion > 0 && d->def.periodic[d->motion - 1])
        FAULT(domain, "periodic", "found %c, expected an axis in the plane of motion",
              "xyz"[d->motion - 1]);
}

void scene_check(scene_reader *r, const scene_draft *draft) {
    SCENE_ASSERT(r && draft);
    check_pairs(r, draft);
    EACH(shape_item, shape, draft->shapes) check_shape(r, shape);
    check_parts(r, draft);
    EACH(wall_item, wall, draft->walls) check_wall(r, wall);
    check_bodies(r, draft);
    check_measures(r, draft);
    check_law(r, draft);
    check_scheme(r, draft);
    check_view(r, draft);
    check_domain(r, draft);
}
