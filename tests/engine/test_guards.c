/* Runs that fail: the message says what, who, where and when; `report` goes on. */
#include "tests/support/scene.h"

#include "engine/world.h"

static clast_world *drop(clast_guard_mode mode, double step, double height, double max_overlap) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0, 0, -9.81);
    def.guards = mode;
    def.time_step = step;
    def.max_overlap = max_overlap;
    def.max_displacement = 0.1;
    def.max_residual = 0.05;
    def.domain_min = vec(-0.3, -1, -0.1), def.domain_max = vec(0.3, 1, 1);
    clast_world *w = new_world(&def);
    clast_pair_def law = pair_of(0.8, 0.3);
    two_materials m = add_materials(w, &law);
    int ball = clast_shape_add_sphere(w, "marble", 0.005, m.hard);
    int table = clast_part_add(w, &(clast_part_def){.name = "table"});
    clast_wall_add(w, table, &(clast_wall_def){.name = "table top", .kind = CLAST_WALL_PLANE,
                                              .material = m.hard, .normal = {0, 0, 1}});
    add_body(w, ball, vec(0.1, 0.2, 0.005 + height), vec(0, 0, 0), vec(0, 0, 0));
    add_body(w, ball, vec(-0.1, 0.2, 0.005 + 2 * height), vec(0, 0, -0.01), vec(0, 0, 0));
    return w;
}

static void expect(clast_world *w, clast_status got, const char *const *words) {
    assert_int_equal(got, CLAST_ERR_GUARD);
    for (int i = 0; words[i]; i++)
        if (!strstr(clast_world_error(w), words[i]))
            fail_msg("\"%s\" does not say \"%s\"", clast_world_error(w), words[i]);
    /* a failed run stays failed, at the same step, with the same message */
    uint64_t step = clast_world_steps(w);
    assert_int_equal(clast_world_step(w), CLAST_ERR_GUARD);
    assert_int_equal(clast_world_run(w, 100), CLAST_ERR_GUARD);
    assert_true(clast_world_steps(w) == step && clast_world_error(w)[0]);
    clast_world_free(w);
}

static void a_step_far_too_large_is_noticed(void **state) {
    (void)state;
    const char *words[] = {"run failed at step", "t = ", "body 1 (marble) at (-0.1, 0.2",
                           "limit 0.1", NULL};
    clast_world *w = drop(CLAST_GUARD_STOP, 1e-3, 0.3, 0.05);
    expect(w, clast_world_run(w, 1), words);
}

static void a_deep_overlap_is_noticed(void **state) {
    (void)state;
    const char *words[] = {"overlap",
                           "of the smaller radius (limit 0.001)",
                           "force",
                           "body 0 (marble)",
                           "against wall table top",
                           NULL};
    clast_world *w = drop(CLAST_GUARD_STOP, 1e-5, 0.01, 0.001);
    expect(w, clast_world_run(w, 1), words);
}

static void a_speed_that_is_not_a_number_is_noticed(void **state) {
    (void)state;
    const char *words[] = {"body 0 (marble)", "nan", "step 1,", NULL};
    clast_world *w = drop(CLAST_GUARD_STOP, 1e-5, 0.01, 0.05);
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    w->bodies.vy[w->slot_of_id[0]] = NAN;
    expect(w, clast_world_run(w, 1), words);
}

static void a_spin_that_is_not_a_number_is_noticed(void **state) {
    (void)state;
    const char *words[] = {"body 1 (marble)", NULL};
    clast_world *w = drop(CLAST_GUARD_STOP, 1e-5, 0.01, 0.05);
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    w->bodies.lx[w->slot_of_id[1]] = NAN;
    expect(w, clast_world_run(w, 1), words);
}

static void a_body_outside_is_noticed(void **state) {
    (void)state;
    const char *words[] = {"outside the domain", "body 1 (marble) at (-", "velocity (-45", NULL};
    clast_world *w = drop(CLAST_GUARD_STOP, 1e-5, 0.01, 0.05);
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    w->bodies.vx[w->slot_of_id[1]] = -45;
    expect(w, clast_world_run(w, 1), words);
}

/* Half of the energy vanishes between two looks: only the ledger can see it. */
static void a_hole_in_the_books_is_noticed(void **state) {
    (void)state;
    const char *words[] = {"energy residual", "J is", "put in (limit 0.05)", "step 2000", NULL};
    clast_world *w = drop(CLAST_GUARD_STOP, 1e-5, 0.01, 0.05);
    steps(w, 1500);
    for (size_t i = 0; i < w->bodies.count; i++)
        w->bodies.vz[i] = w->bodies.vz[i] < 0 ? -0.05 : 0.05;
    expect(w, clast_world_run(w, 1), words);
}

/* ---- report ---------------------------------------------------------------------------------- */

static void report_counts_and_goes_on(void **state) {
    (void)state;
    for (int fault = 0; fault < 4; fault++) {
        clast_world *w = drop(CLAST_GUARD_REPORT, fault == 0 ? 2e-3 : 1e-5, 0.02, 0.001);
        assert_int_equal(clast_world_prepare(w), CLAST_OK);
        if (fault == 1) w->bodies.vy[0] = NAN;
        if (fault == 2) w->bodies.lz[1] = NAN;
        if (fault == 3) w->bodies.vx[1] = 1e300;
        for (int i = 0; i < 4000; i++)
            if (clast_world_step(w)) fail_msg("fault %d stopped: %s", fault, clast_world_error(w));
        assert_true(clast_world_counters(w).guard_trips > 0 && clast_world_error(w)[0]);
        clast_world_energy(w), clast_world_hash(w), clast_world_contacts(w, NULL, 0);
        clast_world_free(w);
    }
}

/* ---- the start ------------------------------------------------------------------------------- */

static clast_status crowded(clast_world **w, int bodies, double max_overlap) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.max_overlap = max_overlap;
    *w = new_world(&def);
    clast_pair_def law = pair_of(1, 0.3);
    two_materials m = add_materials(*w, &law);
    int ball = clast_shape_add_sphere(*w, "pea", 0.005, m.soft);
    for (int i = 0; i < bodies; i++)
        add_body(*w, ball, vec(0.007 * i, 0, 0), vec(0, 0, 0), vec(0, 0, 0));
    return clast_world_prepare(*w);
}

static void overlaps_at_the_start_are_all_named(void **state) {
    (void)state;
    clast_world *w;
    assert_int_equal(crowded(&w, 4, 0.05), CLAST_ERR_ARGUMENT);
    const char *e = clast_world_error(w);
    assert_non_null(
        strstr(e, "starts with an overlap of 3 mm, 0.6 of the smaller radius (limit 0.05)"));
    assert_non_null(strstr(e, "body 0 (pea) at (0, 0, 0)"));
    assert_non_null(strstr(e, "body 3 (pea)"));
    assert_int_equal(clast_world_step(w), CLAST_ERR_ARGUMENT); /* and again */
    clast_world_free(w);
    assert_int_equal(crowded(&w, 40, 0.05), CLAST_ERR_ARGUMENT);
    assert_non_null(strstr(clast_world_error(w), "... 39 faults in all"));
    clast_world_free(w);
}

/* A heap in the wrong unit: the message stays short, the number is right, and the deepest comes
 * first. */
static void thousands_of_overlaps_are_counted(void **state) {
    (void)state;
    enum { BALLS = 3000 };
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.max_overlap = 0.05;
    clast_world *w = new_world(&def);
    clast_pair_def law = pair_of(1, 0.3);
    int ball = clast_shape_add_sphere(w, "pea", 0.005, add_materials(w, &law).soft);
    for (int i = 0; i < BALLS; i++) { /* two and two */
        double apart = i == 37 ? 0.005 : 0.007;
        add_body(w, ball, vec(0.02 * (i / 2 % 40) + (i % 2) * apart, 0.02 * (i / 80), 0),
                 vec(0, 0, 0), vec(0, 0, 0));
    }
    assert_int_equal(clast_world_prepare(w), CLAST_ERR_ARGUMENT);
    const char *e = clast_world_error(w), *end = strrchr(e, '\n');
    int lines = 1;
    for (const char *c = e; *c; c++) lines += *c == '\n';
    assert_int_equal(lines, 11);
    assert_string_equal(end, "\n... 1500 faults in all");
    assert_ptr_equal(strstr(e, "starts with an overlap of 5 mm, 1 of the smaller radius"), e);
    clast_world_free(w);
}

static void bodies_that_start_outside_are_named(void **state) {
    (void)state;
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.domain_max = vec(1, 1, 0.5);
    clast_world *w = new_world(&def);
    clast_pair_def law = pair_of(1, 0.3);
    two_materials m = add_materials(w, &law);
    int ball = clast_shape_add_sphere(w, "pea", 0.005, m.soft);
    add_body(w, ball, vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0));
    add_body(w, ball, vec(0, 0, 0.51), vec(0, 0, 0), vec(0, 0, 0));
    assert_int_equal(clast_world_prepare(w), CLAST_ERR_ARGUMENT);
    assert_non_null(strstr(clast_world_error(w), "starts outside the domain: body 1 (pea)"));
    assert_null(strstr(clast_world_error(w), "body 0"));
    clast_world_free(w);
}

/* Two bodies at the same place have no normal; that must not slip through. */
static void coinciding_bodies_are_noticed(void **state) {
    (void)state;
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    clast_world *w = new_world(&def);
    clast_pair_def law = pair_of(1, 0.3);
    two_materials m = add_materials(w, &law);
    int ball = clast_shape_add_sphere(w, "pea", 0.005, m.soft);
    for (int i = 0; i < 2; i++) add_body(w, ball, vec(0.1, 0, 0), vec(0, 0, 0), vec(0, 0, 0));
    assert_int_equal(clast_world_prepare(w), CLAST_ERR_ARGUMENT);
    assert_non_null(strstr(clast_world_error(w), "overlap of 10 mm"));
    clast_world_free(w);
}

TEST_MAIN(cmocka_unit_test(a_step_far_too_large_is_noticed),
          cmocka_unit_test(a_deep_overlap_is_noticed),
          cmocka_unit_test(a_speed_that_is_not_a_number_is_noticed),
          cmocka_unit_test(a_spin_that_is_not_a_number_is_noticed),
          cmocka_unit_test(a_body_outside_is_noticed),
          cmocka_unit_test(a_hole_in_the_books_is_noticed),
          cmocka_unit_test(report_counts_and_goes_on),
          cmocka_unit_test(overlaps_at_the_start_are_all_named),
          cmocka_unit_test(thousands_of_overlaps_are_counted),
          cmocka_unit_test(bodies_that_start_outside_are_named),
          cmocka_unit_test(coinciding_bodies_are_noticed))
