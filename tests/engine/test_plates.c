/* Plates: faces, edges, corners, seams, removed parts; bodies that leave the domain. */
#include "tests/support/scene.h"

static const double R = 0.005;

typedef struct bench {
    clast_world *w;
    int ball, part, soft, hard;
} bench;

static bench new_bench(double friction) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.time_step = 1e-6;
    bench b = {.w = new_world(&def)};
    clast_pair_def pair = pair_of(1, friction);
    two_materials m = add_materials(b.w, &pair);
    b.soft = m.soft, b.hard = m.hard;
    b.ball = clast_shape_add_sphere(b.w, "ball", R, m.soft);
    b.part = clast_part_add(b.w, &(clast_part_def){.name = "plates"});
    return b;
}

static int add_plate(bench *b, double x, double y, double half_x, double half_y) {
    int wall = clast_wall_add(b->w, b->part,
                              &(clast_wall_def){"plate",
                                                CLAST_WALL_PLATE,
                                                b->hard,
                                                {x, y, 0},
                                                {0, 0, 3},
                                                {1, 0, 0},
                                                {half_x, half_y},
                                                {0, 0, 0}});
    if (wall < 0) fail_msg("%s", clast_world_error(b->w));
    return wall;
}

static double e_star(void) { return 1 / ((1 - .37 * .37) / 7.3e6 + (1 - .23 * .23) / 61e6); }

/* Sum of the forces on body 0, and how many contacts there are. */
static clast_vec3 force_at(bench *b, clast_vec3 p, size_t *count) {
    add_body(b->w, b->ball, p, vec(0, 0, 0), vec(0, 0, 0));
    if (clast_world_prepare(b->w)) fail_msg("%s", clast_world_error(b->w));
    clast_contact c[8];
    *count = clast_world_contacts(b->w, c, 8);
    clast_vec3 f = {0, 0, 0};
    for (size_t i = 0; i < *count; i++) f = plus(f, c[i].force);
    clast_world_free(b->w);
    return f;
}

static void check_force(clast_vec3 f, clast_vec3 away, double overlap) {
    double want = 4.0 / 3 * e_star() * sqrt(R) * pow(overlap, 1.5);
    clast_vec3 n = times(1 / norm(away), away);
    CHECK_NEAR(norm(minus(f, times(want, n))), 0, 1e-9 * want);
}

static void a_face_pushes_from_both_sides(void **state) {
    (void)state;
    for (int side = -1; side <= 1; side += 2) {
        bench b = new_bench(0);
        add_plate(&b, 0, 0, 0.03, 0.02);
        size_t n;
        clast_vec3 f = force_at(&b, vec(0.011, -0.007, side * 0.97 * R), &n);
        assert_int_equal(n, 1);
        check_force(f, vec(0, 0, side), 0.03 * R);
    }
}

static void an_edge_pushes_along_the_shortest_line(void **state) {
    (void)state;
    bench b = new_bench(0);
    add_plate(&b, 0, 0, 0.03, 0.02);
    size_t n;
    clast_vec3 away = {0.6 * R, 0, 0.77 * R};
    clast_vec3 f = force_at(&b, plus(vec(0.03, 0.004, 0), away), &n);
    assert_int_equal(n, 1);
    check_force(f, away, R - norm(away));
}

static void a_corner_pushes_from_its_point(void **state) {
    (void)state;
    bench b = new_bench(0);
    add_plate(&b, 0, 0, 0.03, 0.02);
    size_t n;
    clast_vec3 away = {0.5 * R, 0.6 * R, -0.58 * R};
    clast_vec3 f = force_at(&b, plus(vec(0.03, 0.02, 0), away), &n);
    assert_int_equal(n, 1);
    check_force(f, away, R - norm(away));
}

static void beyond_a_corner_there_is_nothing(void **state) {
    (void)state;
    bench b = new_bench(0);
    add_plate(&b, 0, 0, 0.03, 0.02);
    size_t n;
    force_at(&b, vec(0.03 + 0.8 * R, 0.02 + 0.8 * R, 0.1 * R), &n);
    assert_int_equal(n, 0);
}

/* ---- seams ----------------------------------------------------------------------------------- */

/* Everywhere near a seam, a T, and an overlap, two plates give the force of one. */
static void coplanar_plates_are_one(void **state) {
    (void)state;
    for (int layout = 0; layout < 3; layout++)
        for (int i = -12; i <= 12; i++) {
            bench b = new_bench(0);
            if (layout == 0)
                add_plate(&b, -0.03, 0, 0.03, 0.02), add_plate(&b, 0.03, 0, 0.03, 0.02);
            if (layout == 1)
                add_plate(&b, -0.02, 0.001, 0.03, 0.02), add_plate(&b, 0.02, 0, 0.03, 0.02);
            if (layout == 2) {
                add_plate(&b, -0.03, 0, 0.03, 0.02);
                add_plate(&b, 0.03, -0.015, 0.03, 0.015), add_plate(&b, 0.03, 0.015, 0.03, 0.015);
            }
            size_t n;
            clast_vec3 f =
                force_at(&b, vec(0.1 * R * i, layout == 2 ? 1e-4 * i : 0.002, 0.96 * R), &n);
            if (n != 1) fail_msg("layout %d, place %d: %zu contacts", layout, i, n);
            check_force(f, vec(0, 0, 1), 0.04 * R);
        }
}

/* A ball rolls over a seam without friction history to lose: its path is that on one plate. */
static void a_seam_is_not_felt(void **state) {
    (void)state;
    double height[2], speed[2];
    for (int split = 0; split < 2; split++) {
        bench b = new_bench(0);
        if (split) add_plate(&b, -0.05, 0, 0.05, 0.02), add_plate(&b, 0.05, 0, 0.05, 0.02);
        else add_plate(&b, 0, 0, 0.1, 0.02);
        add_body(b.w, b.ball, vec(-0.003, 0.001, 0.97 * R), vec(1.7, 0.2, 0), vec(0, 0, 0));
        run_to(b.w, 0.003);
        height[split] = body_of(b.w, 0).position.z, speed[split] = body_of(b.w, 0).velocity.x;
        assert_true(body_of(b.w, 0).position.x > 0.0015);
        clast_world_free(b.w);
    }
    CHECK_NEAR(height[1], height[0], 1e-15);
    CHECK_NEAR(speed[1], speed[0], 1e-15);
}

/* With friction the spring starts anew on the second plate: histories are kept per wall. The loss
 * is at most what the spring held. */
static void a_seam_costs_the_spring_at_most(void **state) {
    (void)state;
    double energy[2];
    for (int split = 0; split < 2; split++) {
        bench b = new_bench(0.05);
        if (split) add_plate(&b, -0.05, 0, 0.05, 0.02), add_plate(&b, 0.05, 0, 0.05, 0.02);
        else add_plate(&b, 0, 0, 0.1, 0.02);
        int lid = clast_part_add(b.w, &(clast_part_def){.name = "lid"});
        add_plane(b.w, lid, b.hard, vec(0, 0, 1.95 * R), vec(0, 0, -1));
        add_body(b.w, b.ball, vec(-0.001, 0, 0.975 * R), vec(0.9, 0, 0), vec(0, 0, 0));
        run_to(b.w, 0.003);
        clast_energy e = clast_world_energy(b.w);
        energy[split] = e.kinetic + e.rotational;
        CHECK_BELOW(fabs(e.residual), 1e-4 * e.input);
        clast_world_free(b.w);
    }
    print_message("seam with friction: %.1e of the energy\n", energy[1] / energy[0] - 1);
    assert_true(energy[0] != energy[1]); /* it did cross the seam */
    CHECK_NEAR(energy[1] / energy[0], 1, 2e-2);
}

/* ---- what goes away -------------------------------------------------------------------------- */

static void a_removed_part_lets_go(void **state) {
    (void)state;
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0, 0, -9.81);
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.5, 0.3);
    two_materials m = add_materials(w, &pair);
    int rod = add_rod(w, m.soft, R);
    int plug = clast_part_add(w, &(clast_part_def){.name = "plug", .removed_at = 0.05});
    clast_wall_add(w, plug,
                   &(clast_wall_def){"plug",
                                     CLAST_WALL_PLATE,
                                     m.hard,
                                     {0, 0, 0},
                                     {0, 0, 1},
                                     {1, 0, 0},
                                     {0.1, 0.1},
                                     {0, 0, 0}});
    add_body(w, rod, vec(0, 0, 0.998 * R), vec(0, 0, 0), vec(0, 0, 0));
    run_to(w, 0.0499);
    assert_true(clast_world_part_present(w, plug) && contact_count(w) == 2);
    double z = body_of(w, 0).position.z, stored = elastic_energy(w);
    CHECK_CLOSE(clast_world_part_load(w, plug).force.z, -body_of(w, 0).mass * 9.81, 1e-3);
    run_to(w, 0.15);
    assert_true(!clast_world_part_present(w, plug) && contact_count(w) == 0);
    double t = clast_world_time(w) - 0.05;
    CHECK_NEAR(body_of(w, 0).position.z, z - 0.5 * 9.81 * t * t, 2e-4 * t);
    clast_energy e = clast_world_energy(w);
    CHECK_CLOSE(e.removed, stored, 1e-2);
    CHECK_BELOW(fabs(e.residual), 1e-4 * e.input);
    assert_true(norm(clast_world_part_load(w, plug).force) == 0);
    clast_world_free(w);
}

/* Bodies fall out of the domain, touching each other: the books stay closed. */
static void leaving_the_domain_keeps_the_books(void **state) {
    (void)state;
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0, 0, -9.81);
    def.domain_min = vec(-0.1, -0.1, -0.05), def.domain_max = vec(0.1, 0.1, 0.3);
    def.outside = CLAST_OUTSIDE_REMOVE;
    def.global_damping = 0.7;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.5, 0.3);
    two_materials m = add_materials(w, &pair);
    int shapes[2] = {add_rod(w, m.soft, R), add_uneven_rod(w, m.hard, R)};
    dice d = {8, 0};
    for (int i = 0; i < 18; i++) {
        clast_body_def b = {shapes[i % 2], {0.022 * (i % 3 - 1), 0, 0.03 + 0.022 * (i / 3)},
                            any_orientation(&d), {0, 0, -0.2 * (i / 3)}, {0, 8.0 * (i % 5), 0}};
        assert_true(clast_body_add(w, &b) >= 0);
    }
    add_plane(w, clast_part_add(w, &(clast_part_def){.name = "side"}), m.hard, vec(-0.04, 0, 0),
              vec(1, 0, 0.2));
    double worst = 0;
    while (clast_world_bodies(w).count > 0 && clast_world_time(w) < 3) {
        steps(w, 50);
        clast_energy e = clast_world_energy(w);
        worst = fmax(worst, fabs(e.residual) / e.input);
    }
    assert_int_equal(clast_world_bodies(w).count, 0);
    assert_int_equal(clast_world_counters(w).removed, 18);
    print_message("all gone: residual %.1e of the input at most\n", worst);
    CHECK_BELOW(worst, 1e-3);
    steps(w, 10); /* an empty world goes on */
    clast_world_free(w);
}

TEST_MAIN(cmocka_unit_test(a_face_pushes_from_both_sides),
          cmocka_unit_test(an_edge_pushes_along_the_shortest_line),
          cmocka_unit_test(a_corner_pushes_from_its_point),
          cmocka_unit_test(beyond_a_corner_there_is_nothing),
          cmocka_unit_test(coplanar_plates_are_one), cmocka_unit_test(a_seam_is_not_felt),
          cmocka_unit_test(a_seam_costs_the_spring_at_most),
          cmocka_unit_test(a_removed_part_lets_go),
          cmocka_unit_test(leaving_the_domain_keeps_the_books))
