#include "tests/support/cell.h"

static double snap(double x) {
    return floor(x * 0x1p40) * 0x1p-40;
}

static clast_world_def def_of(const cell_wish *wish) {
    clast_world_def d = bare_def(wish->law);
    d.gravity = vec(2.5, wish->motion == CLAST_MOTION_IN_PLANE ? 0 : -1.25, -4.75);
    d.domain_min = vec(CELL_LOW, CELL_LOW, CELL_LOW);
    double high[3];
    for (int k = 0; k < 3; k++) {
        d.periodic[k] = wish->periodic[k];
        high[k] = CELL_LOW + (wish->doubled == k + 1 ? 2 : 1) * CELL_LENGTH;
    }
    d.domain_max = vec(high[0], high[1], high[2]);
    d.scheme = wish->scheme, d.clump_contact = wish->clump_contact;
    d.precision = wish->precision, d.isa = wish->isa, d.motion = wish->motion;
    d.threads = wish->threads ? wish->threads : 1, d.spheres_per_thread = 1;
    d.skin = wish->skin, d.time_step = 0x1p-15, d.max_residual = 0.2;
    return d;
}

static void add_plate(clast_world *w, int part, const clast_wall_def *plate) {
    if (clast_wall_add(w, part, plate) < 0) fail_msg("%s", clast_world_error(w));
}

/* Planes across the axes that are not periodic. */
static void add_box(clast_world *w, const cell_wish *wish, int part, int material) {
    for (int k = 0; k < 3; k++) {
        clast_vec3 along = {k == 0, k == 1, k == 2}, low = {CELL_LOW, CELL_LOW, CELL_LOW};
        double length = (wish->doubled == k + 1 ? 2 : 1) * CELL_LENGTH;
        if (wish->periodic[k]) continue;
        add_plane(w, part, material, plus(low, times(0x1p-11, along)), along);
        add_plane(w, part, material, plus(low, times(length - 0x1p-11, along)), times(-1, along));
    }
}

/* Two plates for a floor, with a seam in it, that span y; one of them is a belt. A post that moves
 * and stands where the shift wants it. */
static void add_walls(clast_world *w, const cell_wish *wish, int material, bool twice) {
    double half = (twice ? 1 : 0.5) * CELL_LENGTH, x = CELL_LOW + 0.5 * CELL_LENGTH;
    int still = clast_part_add(w, &(clast_part_def){.name = "still"});
    add_box(w, wish, still, material);
    if (wish->periodic[2] || wish->no_plates) return;
    clast_wall_def floor = {.name = "floor",
                            .kind = CLAST_WALL_PLATE,
                            .material = material,
                            .normal = {0, 0, 1},
                            .side = {0, 1, 0}};
    floor.half_side[0] = half, floor.half_side[1] = 0.25 * CELL_LENGTH;
    floor.point = vec(x - 0.25 * CELL_LENGTH + wish->shift.x, CELL_LOW + half, CELL_LOW + 0x1p-9);
    add_plate(w, still, &floor);
    floor.name = "floor 2", floor.point.x += 0.5 * CELL_LENGTH;
    floor.belt_velocity = vec(0, 0.125, 0);
    add_plate(w, still, &floor);
    clast_wall_def post = {.name = "post",
                           .kind = CLAST_WALL_PLATE,
                           .material = material,
                           .normal = {1, 0, 0},
                           .side = {0, 1, 0},
                           .half_side = {0x1p-8, 0x1p-7}};
    post.point = plus(vec(snap(CELL_LOW + CELL_LENGTH / 3), x, CELL_LOW + 0x1p-7), wish->shift);
    clast_part_def moves = {.name = "moves", .velocity = {-0.0625, 0.125, 0}};
    add_plate(w, clast_part_add(w, &moves), &post);
    post.name = "its copy", post.point.y += CELL_LENGTH;
    if (twice) add_plate(w, clast_part_add(w, &moves), &post);
}

static void add_bodies(clast_world *w, const cell_wish *wish, const int *shape, clast_vec3 away) {
    dice d = {11, 0};
    bool flat = wish->motion == CLAST_MOTION_IN_PLANE;
    for (int i = 0; i < (flat ? 9 : CELL_BODIES); i++) {
        int j = flat ? 3 * (i / 3 * 3) + i % 3 : i;
        clast_vec3 at = {i % 3, flat ? 1 : j / 3 % 3, j / 9};
        clast_body_def b = {.shape = shape[i % 4]};
        b.position.x = snap(CELL_LOW + CELL_LENGTH * (at.x + 0.5 + roll(&d, -0.05, 0.05)) / 3);
        b.position.y = snap(CELL_LOW + CELL_LENGTH * (at.y + 0.5 + roll(&d, -0.05, 0.05)) / 3);
        b.position.z = snap(CELL_LOW + CELL_LENGTH * (at.z + 0.5 + roll(&d, -0.05, 0.05)) / 3);
        if (flat) b.position.y = CELL_LOW + 0.5 * CELL_LENGTH;
        b.position = plus(plus(b.position, wish->shift), away);
        b.velocity = vec(roll(&d, -1, 1), flat ? 0 : roll(&d, -1, 1), roll(&d, -1, 1));
        b.spin = vec(flat ? 0 : roll(&d, -30, 30), roll(&d, -30, 30), flat ? 0 : roll(&d, -30, 30));
        b.orientation = any_orientation(&d);
        if (flat) b.orientation = clast_quat_axis_angle(vec(0, 1, 0), roll(&d, -3, 3));
        if (clast_body_add(w, &b) < 0) fail_msg("%s", clast_world_error(w));
    }
}

clast_world *cell_new(const cell_wish *wish) {
    clast_world_def def = def_of(wish);
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.8, 0.4);
    two_materials m = add_materials(w, &pair);
    int shape[4] = {clast_shape_add_sphere(w, "ball", 0.0087, m.soft)};
    shape[1] = wish->spheres ? clast_shape_add_sphere(w, "small", 0.0071, m.hard)
                             : add_rod(w, m.soft, 0.0048);
    shape[2] = wish->spheres ? shape[0] : add_triangle(w, m.hard, 0.0041);
    shape[3] = wish->spheres ? shape[1] : add_uneven_rod(w, m.soft, 0.0048);
    add_walls(w, wish, m.hard, wish->doubled == 2);
    add_bodies(w, wish, shape, vec(0, 0, 0));
    clast_vec3 away = {wish->doubled == 1, wish->doubled == 2, wish->doubled == 3};
    if (wish->doubled) add_bodies(w, wish, shape, times(CELL_LENGTH, away));
    return w;
}

uint64_t cell_hash(const cell_wish *wish, uint64_t count) {
    clast_world *w = cell_new(wish);
    steps(w, count);
    uint64_t hash = clast_world_hash(w);
    clast_world_free(w);
    return hash;
}
