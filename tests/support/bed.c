#include "tests/support/bed.h"

#include <stdio.h>
#include <stdlib.h>

static void demand(bool fine, const clast_world *w) {
    if (fine) return;
    fprintf(stderr, "bed: %s\n", w ? clast_world_error(w) : clast_world_new_error());
    exit(2);
}

static int add_clump(clast_world *w, int material, double r, int spheres) {
    clast_vec3 centre[5];
    double radius[5], mass = 2500 * 5 * r * r * r * spheres;
    for (int i = 0; i < spheres; i++) {
        centre[i] = (clast_vec3){1.2 * r * (i - 0.5 * (spheres - 1)), 0, 0};
        radius[i] = i % 2 ? r : 0.9 * r;
    }
    clast_vec3 inertia = {0.4 * mass * r * r, 0.7 * spheres * mass * r * r,
                          0.7 * spheres * mass * r * r};
    return clast_shape_add(w, &(clast_shape_def){.name = "clump",
                                                 .material = material,
                                                 .spheres = spheres,
                                                 .centre = centre,
                                                 .radius = radius,
                                                 .mass = mass,
                                                 .inertia = inertia});
}

/* A plate that swings and shakes. */
static void add_paddle(clast_world *w, int material) {
    clast_part_def turns = {.name = "paddle",
                            .oscillation = {{0.001, 0, 0.001}, 40, 0.2},
                            .rotation = {{0.005, 0, 0.028}, {0, 1, 0}, -6, 0.2, 25, 0.1}};
    int paddle = clast_part_add(w, &turns);
    clast_wall_def blade = {.name = "blade", .kind = CLAST_WALL_PLATE, .material = material,
                            .point = {0.005, 0, 0.028}, .normal = {1, 0, 0}, .side = {0, 0, 1},
                            .half_side = {0.006, 0.03}};
    demand(clast_wall_add(w, paddle, &blade) >= 0, w);
}

static void add_walls(clast_world *w, int material) {
    int box = clast_part_add(w, &(clast_part_def){.name = "box"});
    clast_vec3 points[4] = {{-0.05, 0, 0}, {0.05, 0, 0}, {0, -0.02, 0}, {0, 0.02, 0}};
    clast_vec3 normals[4] = {{1, 0, 0.1}, {-1, 0, 0.1}, {0, 1, 0}, {0, -1, 0}};
    for (int i = 0; i < 4; i++)
        demand(clast_wall_add(w, box, &(clast_wall_def){.name = "side", .kind = CLAST_WALL_PLANE,
                                                        .material = material, .point = points[i],
                                                        .normal = normals[i]}) >= 0, w);
    int floor = clast_part_add(w, &(clast_part_def){.name = "floor"});
    clast_wall_def plate = {.name = "left", .kind = CLAST_WALL_PLATE, .material = material,
                            .point = {-0.04, 0, 0}, .normal = {0, 0, 1}, .side = {1, 0, 0},
                            .half_side = {0.02, 0.03}, .belt_velocity = {0.05, 0, 0}};
    demand(clast_wall_add(w, floor, &plate) >= 0, w);
    plate.name = "right", plate.point.x = 0.04, plate.belt_velocity.x = 0;
    demand(clast_wall_add(w, floor, &plate) >= 0, w);
    int plug = clast_part_add(w, &(clast_part_def){.name = "plug", .removed_at = 0.03});
    plate.name = "plug", plate.point.x = 0, plate.half_side[0] = 0.02;
    demand(clast_wall_add(w, plug, &plate) >= 0, w);
    int ram = clast_part_add(w, &(clast_part_def){.name = "ram", .velocity = {0.2, 0, 0},
                                                  .move_from = 0.01, .move_until = 0.08,
                                                  .stroke = {{0.002, 0, 0}, 0.1, 0.004, 0.3}});
    demand(clast_wall_add(w, ram, &(clast_wall_def){.name = "ram", .kind = CLAST_WALL_PLANE,
                                                    .material = material, .point = {-0.055, 0, 0},
                                                    .normal = {1, 0, 0}}) >= 0, w);
}

static clast_world *new_world_of(const bed_wish *wish) {
    clast_world_def def = clast_world_def_default();
    def.law = wish->law, def.motion = wish->motion, def.plane_axis = 1;
    def.precision = wish->precision, def.tangent = wish->tangent;
    def.clump_contact = wish->clump_contact;
    def.threads = wish->threads, def.spheres_per_thread = 1;
    def.skin = wish->skin, def.isa = wish->isa;
    def.scheme = wish->scheme, def.alone = wish->alone;
    if (wish->scheme != CLAST_SCHEME_LEAPFROG) def.max_residual = 1e9; /* of first order, some */
    def.rayleigh_fraction = 1, def.contact_resolution = 11, def.impact_speed = 2.5;
    def.gravity.z = -30, def.max_overlap = 0.3, def.max_displacement = 0.5,
    def.global_damping = 0.1;
    def.domain_min = (clast_vec3){-0.2, -0.1, -0.015}, def.domain_max = (clast_vec3){0.2, 0.1, 1.0};
    def.outside = CLAST_OUTSIDE_REMOVE;
    clast_world *w = clast_world_new(&def);
    demand(w, w);
    return w;
}

clast_world *bed_new(const bed_wish *wish) {
    clast_world *w = new_world_of(wish);
    int m = clast_material_add(w, &(clast_material_def){"grain", 2500, 5e6, 0.3});
    clast_pair_def pair = {
        .restitution = 0.4, .friction = 0.4, .stiffness = 6000, .rolling_friction = wish->rolling};
    demand(clast_pair_set(w, m, m, &pair) == CLAST_OK, w);
    int shapes[4] = {clast_shape_add_sphere(w, "ball", 0.0043, m), add_clump(w, m, 0.0029, 2),
                     add_clump(w, m, 0.0021, 3), add_clump(w, m, 0.0019, 5)};
    add_walls(w, m);
    add_paddle(w, m);
    int bodies = wish->bodies ? wish->bodies : 63, columns = 7;
    for (int i = 0; i < bodies; i++) {
        uint64_t n = (uint64_t)i;
        clast_vec3 at = {0.0135 * (i % columns - 0.5 * (columns - 1)), 0,
                         0.0052 + 0.0092 * (i / columns)};
        clast_quat q =
            clast_quat_axis_angle((clast_vec3){0, 1, 0}, 0.4 * clast_random(3, 1, n) - 0.2);
        clast_vec3 v = {0.3 * clast_random(3, 2, n) - 0.15, 0, -0.1 * clast_random(3, 3, n)};
        clast_body_def b = {shapes[i % 4], at, q, v, {0, 20 * clast_random(3, 4, n) - 10, 0}};
        if (wish->motion == CLAST_MOTION_3D) b.velocity.y = 0.2 * clast_random(3, 5, n) - 0.1;
        demand(clast_body_add(w, &b) >= 0, w);
    }
    demand(clast_world_prepare(w) == CLAST_OK, w);
    return w;
}

uint64_t bed_hash(const bed_wish *wish, uint64_t steps) {
    clast_world *w = bed_new(wish);
    for (uint64_t i = 0; i < steps; i++) demand(clast_world_step(w) == CLAST_OK, w);
    uint64_t hash = clast_world_hash(w);
    clast_world_free(w);
    return hash;
}
