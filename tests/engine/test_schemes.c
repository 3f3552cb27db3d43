/* Schemes beside the leapfrog: their table, what they share with it, friction and clumps, the same
 * bits, restart, bodies that leave, the ledger. */
#include <unistd.h>

#include "tests/support/bed.h"
#include "tests/support/sandwich.h"

#include "engine/world.h"

/* ---- the table ------------------------------------------------------------------------------- */

/* Every rule moves a resting body not at all and a body in steady or falling motion rightly. */
static void rules_keep_free_motion(void **state) {
    (void)state;
    for (int k = 0; k < CLAST_SCHEMES; k++) {
        const clast_scheme_info *s = clast_scheme_info_of((clast_scheme)k);
        double x = 0, way = 0, vx = s->kept.x_next, vway = s->kept.x_next, felt = s->felt.x_next;
        for (int i = 0; i < CLAST_LEVELS; i++) {
            x += s->keep.x[i], way += s->keep.v[i] - i * s->keep.x[i];
            vx += s->kept.x[i], vway += s->kept.v[i] - i * s->kept.x[i];
            felt += s->felt.x[i];
        }
        CHECK_NEAR(x, 1, 1e-14);
        CHECK_NEAR(way, 1, 1e-14);
        CHECK_NEAR(vx, 0, 1e-14);
        CHECK_NEAR(vway, 1, 1e-14);
        CHECK_NEAR(felt, 0, 1e-14);
        for (int other = 0; other < k; other++)
            assert_string_not_equal(s->name, clast_scheme_info_of((clast_scheme)other)->name);
    }
}

/* ---- the same by other words ----------------------------------------------------------------- */

/* S12 2.72-2.78 word by word on a linear spring, against the two-step form of the table. */
static void gear_is_what_is_printed(void **state) {
    (void)state;
    sandwich s = {.law = CLAST_LAW_LINEAR,
                  .scheme = CLAST_SCHEME_GEAR4,
                  .restitution = 0.7,
                  .step = 0.3,
                  .x = 2.1e-4,
                  .v = 0.013};
    oscillator o = sandwich_new(&s);
    double h = s.step / o.omega, w2 = o.omega * o.omega, c = 2 * o.zeta * o.omega,
           a0 = -w2 * s.x - c * s.v;
    steps(o.world, 1);
    double x = sandwich_position(&o), v = sandwich_velocity(&o), a = -w2 * x - c * v,
           b = (a - a0) / h;
    for (int i = 0; i < 40; i++) {
        double xp = x + v * h + a * h * h / 2 + b * h * h * h / 6, vp = v + a * h + b * h * h / 2,
               ap = a + b * h;
        double more = -w2 * xp - c * vp - ap;
        x = xp + more * h * h / 12, v = vp + more * h * 5 / 12, a = ap + more, b += more / h;
        steps(o.world, 1);
        CHECK_NEAR(sandwich_position(&o), x, 1e-12 * s.x);
        CHECK_NEAR(sandwich_velocity(&o), v, 1e-12 * s.v);
    }
    clast_world_free(o.world);
}

/* Symplectic Euler that starts from the velocity of half a step before goes the way of the
 * leapfrog, with dashpots too: it is the same scheme with another name for its velocity. */
static void euler_is_the_leapfrog_shifted(void **state) {
    (void)state;
    sandwich s = {
        .law = CLAST_LAW_LINEAR, .restitution = 0.7, .step = 0.2, .x = 2.1e-4, .v = 0.013};
    oscillator leapfrog = sandwich_new(&s);
    steps(leapfrog.world, 1);
    double x = sandwich_position(&leapfrog);
    s.scheme = CLAST_SCHEME_SYMPLECTIC_EULER;
    s.v = (x - s.x) / clast_world_time_step(leapfrog.world), s.x = x;
    oscillator euler = sandwich_new(&s);
    for (int i = 0; i < 200; i++) {
        steps(euler.world, 1), steps(leapfrog.world, 1);
        CHECK_NEAR(sandwich_position(&euler), sandwich_position(&leapfrog), 1e-12 * 2.1e-4);
    }
    clast_world_free(euler.world), clast_world_free(leapfrog.world);
}

/* Without forces that depend on velocity the Verlet schemes and the leapfrog are one. */
static void verlet_is_the_leapfrog(void **state) {
    (void)state;
    const clast_scheme three[] = {CLAST_SCHEME_LEAPFROG, CLAST_SCHEME_POSITION_VERLET,
                                  CLAST_SCHEME_VELOCITY_VERLET};
    oscillator o[3];
    for (int k = 0; k < 3; k++) {
        sandwich s = {.law = CLAST_LAW_HERTZ_MINDLIN,
                      .scheme = three[k],
                      .step = 0.03,
                      .x = 2.1e-4,
                      .v = 0.013};
        o[k] = sandwich_new(&s);
        steps(o[k].world, 500);
    }
    for (int k = 1; k < 3; k++) {
        CHECK_NEAR(sandwich_position(&o[k]), sandwich_position(&o[0]), 1e-11 * 2.1e-4);
        CHECK_NEAR(sandwich_velocity(&o[k]), sandwich_velocity(&o[0]), 1e-11 * 0.013);
    }
    for (int k = 0; k < 3; k++) clast_world_free(o[k].world);
}

/* ---- friction and clumps --------------------------------------------------------------------- */

typedef struct landing {
    clast_vec3 position, velocity, spin;
} landing;

/* A chain of three falls askew on a rough floor and bounces. */
static landing chain(clast_scheme scheme, double step) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0, 0, -9.81);
    def.scheme = scheme, def.time_step = step;
    def.max_residual = 1e9;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.7, 0.4);
    two_materials m = add_materials(w, &pair);
    int rod = add_uneven_rod(w, m.soft, 0.004);
    add_plane(w, clast_part_add(w, &(clast_part_def){.name = "floor"}), m.hard, vec(0, 0, 0),
              vec(0.1, 0, 1));
    clast_body_def b = {rod,
                        {0, 0, 0.0095},
                        clast_quat_axis_angle(vec(0, 1, 0), 0.5),
                        {0.21, 0.04, -0.33},
                        {3, 12, -4}};
    assert_true(clast_body_add(w, &b) >= 0);
    run_to(w, 0.03);
    assert_true(contact_count(w) == 0 && clast_world_counters(w).overlap_max > 0.01);
    assert_true(clast_world_counters(w).unconverged == 0);
    body_state s = body_of(w, 0);
    clast_world_free(w);
    return (landing){s.position, s.velocity, s.spin};
}

static double apart(landing a, landing b) {
    return norm(minus(a.position, b.position)) / 0.004 + norm(minus(a.velocity, b.velocity)) / 0.3 +
           norm(minus(a.spin, b.spin)) / 60;
}

/* The leapfrog with dashpots is of first order: two of its steps give the limit. */
static landing limit_of_the_leapfrog(double step) {
    landing a = chain(CLAST_SCHEME_LEAPFROG, step), b = chain(CLAST_SCHEME_LEAPFROG, 0.5 * step);
    return (landing){minus(times(2, b.position), a.position),
                     minus(times(2, b.velocity), a.velocity), minus(times(2, b.spin), a.spin)};
}

/* At its onset the dashpot of a Hertz contact rises with the fourth root of the overlap: a velocity
 * is off by dt^1.25, whatever the order of the scheme. */
static void a_bounce_with_friction_converges(void **state) {
    (void)state;
    landing truth = limit_of_the_leapfrog(2.5e-7);
    for (int k = 0; k < CLAST_SCHEMES; k++) {
        const clast_scheme_info *s = clast_scheme_info_of((clast_scheme)k);
        double a = apart(chain((clast_scheme)k, 2e-5), truth),
               b = apart(chain((clast_scheme)k, 5e-6), truth);
        print_message("%-17s chain off by %.1e at 20 us, %.1e at 5 us, order %.2f\n", s->name, a, b,
                      order_of(a, b, 4));
        CHECK_BELOW(b, s->order_damped < 2 ? 0.1 : 0.01);
        CHECK_BELOW(s->order_damped < 2 || k == CLAST_SCHEME_NUMEROV_CENTRAL ? 0.75 : 1.05,
                    order_of(a, b, 4));
    }
}

/* ---- the same bits --------------------------------------------------------------------------- */

static bed_wish wish_of(int scheme) {
    return (bed_wish){.threads = 1,
                      .law = (clast_law)(scheme % 3),
                      .scheme = (clast_scheme)scheme,
                      .motion = scheme % 2 ? CLAST_MOTION_IN_PLANE : CLAST_MOTION_3D};
}

enum { STEPS = 1000 }; /* the bed has landed and one of its parts is gone */

static void the_bed_is_worth_it(void **state) {
    (void)state;
    bed_wish wish = wish_of(CLAST_SCHEME_NUMEROV_BACKWARD);
    clast_world *w = bed_new(&wish);
    steps(w, STEPS);
    clast_counters c = clast_world_counters(w);
    print_message("%zu contacts, %llu rebuilds, %zu bodies left\n", c.contacts,
                  (unsigned long long)c.rebuilds, c.removed);
    assert_true(c.contacts > 30 && c.rebuilds > 20 && c.unconverged == 0);
    assert_false(clast_world_part_present(w, 2));
    clast_world_free(w);
}

/* Of the bed as wish_of() asks for it. */
static uint64_t plain_hash(int scheme) {
    static uint64_t known[CLAST_SCHEMES];
    bed_wish wish = wish_of(scheme);
    if (known[scheme] == 0) known[scheme] = bed_hash(&wish, STEPS);
    return known[scheme];
}

static void expect(const bed_wish *wish, uint64_t want, const char *what) {
    if (bed_hash(wish, STEPS) != want)
        fail_msg("%s: other bits with other %s", clast_scheme_info_of(wish->scheme)->name, what);
}

static void bits_do_not_depend_on_the_machine(void **state) {
    (void)state;
    for (int k = 1; k < CLAST_SCHEMES; k++) {
        bed_wish wish = wish_of(k);
        uint64_t want = plain_hash(k);
        wish.isa = CLAST_ISA_BASELINE, wish.skin = 3e-3;
        expect(&wish, want, "lanes or skin");
        wish.threads = 2, wish.skin = 0;
        if (k % 4 == 0) expect(&wish, want, "threads");
    }
}

/* Before and after a multi-step scheme has its past, and over the removal of a part. */
static void restart_is_never_having_stopped(void **state) {
    (void)state;
    scratch_name file = scratch_file("schemes");
    for (int k = 1; k < CLAST_SCHEMES; k++) {
        bed_wish wish = wish_of(k);
        uint64_t want = plain_hash(k);
        const int stops[2] = {2, 700};
        clast_world *w = bed_new(&wish);
        for (int i = 0; i < 2; i++) {
            steps(w, (uint64_t)stops[i] - clast_world_steps(w));
            assert_int_equal(clast_checkpoint_save(w, file.text, NULL), CLAST_OK);
            clast_world_free(w);
            w = bed_new(&wish);
            if (clast_checkpoint_load(w, file.text, NULL)) fail_msg("%s", clast_world_error(w));
        }
        steps(w, STEPS - 700);
        if (clast_world_hash(w) != want)
            fail_msg("%s: other bits after a restart", clast_scheme_info_of((clast_scheme)k)->name);
        clast_world_free(w);
    }
    bed_wish wish = wish_of(CLAST_SCHEME_TAYLOR);
    clast_world *w = bed_new(&wish);
    assert_int_equal(clast_checkpoint_load(w, file.text, NULL), CLAST_ERR_MISMATCH);
    assert_non_null(strstr(clast_world_error(w), "scheme"));
    clast_world_free(w);
    unlink(file.text);
}

static void readers_change_nothing(void **state) {
    (void)state;
    for (int k = 1; k < CLAST_SCHEMES; k++) {
        bed_wish wish = wish_of(k);
        uint64_t want = bed_hash(&wish, 100);
        clast_world *w = bed_new(&wish);
        for (int i = 0; i < 100; i++) {
            steps(w, 1);
            clast_world_energy(w), clast_world_bodies(w), clast_world_contacts(w, NULL, 0);
            clast_world_part_load(w, 1), clast_world_hash(w), clast_world_spheres(w);
        }
        assert_true(clast_world_hash(w) == want);
        clast_world_free(w);
    }
}

/* ---- the ledger ------------------------------------------------------------------------------ */

/* A sandwich of Hertz contacts with dashpots: of the order of the scheme, at best two. */
static double residual(clast_scheme scheme, double step) {
    sandwich s = {.law = CLAST_LAW_HERTZ_MINDLIN,
                  .scheme = scheme,
                  .restitution = 0.7,
                  .step = step,
                  .x = 3e-4,
                  .v = 0.02};
    oscillator o = sandwich_new(&s);
    double most = 0, time = 20 / o.omega;
    assert_int_equal(clast_world_prepare(o.world), CLAST_OK);
    while (clast_world_time(o.world) < time) {
        steps(o.world, 1);
        clast_energy e = clast_world_energy(o.world);
        most = fmax(most, fabs(e.residual) / e.input);
        CHECK_BELOW(fabs(e.friction), 1e-6 * e.input + 10 * fabs(e.residual));
    }
    clast_world_free(o.world);
    return most;
}

static void the_residual_falls_with_the_step(void **state) {
    (void)state;
    for (int k = 0; k < CLAST_SCHEMES; k++) {
        const clast_scheme_info *s = clast_scheme_info_of((clast_scheme)k);
        double a = residual((clast_scheme)k, 0.004), b = residual((clast_scheme)k, 0.001);
        /* the dashpot of a Hertz contact changes with the overlap, and Numerov's is that of the end
         * of a step with the central velocity */
        bool late = k == CLAST_SCHEME_NUMEROV_CENTRAL;
        int want = s->order_damped < 2 || late ? 1 : 2;
        print_message("%-17s residual %.1e and %.1e, order %.2f\n", s->name, a, b,
                      order_of(a, b, 4));
        CHECK_BELOW(want - 0.15, order_of(a, b, 4));
        CHECK_BELOW(b, 0.05);
    }
}

/* With friction, and where no force depends on velocities and schemes save a pass. */
static void leaving_bodies_are_booked(void **state) {
    (void)state;
    for (int run = 2; run < 2 * CLAST_SCHEMES; run++) {
        int k = run / 2;
        clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
        def.gravity = vec(0, 0, -9.81);
        def.scheme = (clast_scheme)k, def.time_step = 1e-4, def.max_residual = 1e9;
        def.outside = CLAST_OUTSIDE_REMOVE, def.domain_min = vec(-1, -1, -0.05);
        clast_world *w = new_world(&def);
        clast_pair_def pair = run % 2 ? pair_of(0.7, 0.3) : pair_of(1, 0);
        two_materials m = add_materials(w, &pair);
        int ball = clast_shape_add_sphere(w, "ball", 0.005, m.soft);
        for (int i = 0; i < 6; i++)
            add_body(w, ball, vec(0.02 * i, 0, 0.01 * i), vec(0, 0, -0.1), vec(0, 20, 0));
        run_to(w, 0.2);
        clast_energy e = clast_world_energy(w);
        clast_counters c = clast_world_counters(w);
        assert_true(c.removed == 6 && c.bodies == 0);
        CHECK_NEAR(e.kinetic, 0, 0);
        double loss = clast_scheme_info_of((clast_scheme)k)->order == 1 ? 5e-3 : 1e-9;
        CHECK_BELOW(fabs(e.residual), loss * e.input);
        clast_world_free(w);
    }
}

/* A ball that presses another and leaves: what stays moves on as it is. */
static void what_stays_feels_nothing_of_what_left(void **state) {
    (void)state;
    for (int run = 2; run < 2 * CLAST_SCHEMES; run++) {
        const clast_scheme_info *info = clast_scheme_info_of((clast_scheme)(run / 2));
        clast_world_def def = bare_def(CLAST_LAW_LINEAR);
        def.scheme = (clast_scheme)(run / 2), def.time_step = 1e-5, def.max_residual = 1e9;
        clast_world *w = new_world(&def);
        clast_pair_def pair = run % 2 ? pair_of(0.7, 0) : pair_of(1, 0);
        two_materials m = add_materials(w, &pair);
        int ball = clast_shape_add_sphere(w, "ball", 0.005, m.soft);
        add_body(w, ball, vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0));
        add_body(w, ball, vec(0.00995, 0, 0), vec(0.1, 0, 0), vec(0, 0, 0));
        clast_outlet_def out = {.name = "out", .point = {0.00998, 0, 0}, .normal = {1, 0, 0}};
        assert_int_equal(clast_outlet_add(w, &out), 0);
        while (clast_world_counters(w).bodies == 2) steps(w, 1);
        assert_true(clast_world_steps(w) > 10 && body_of(w, 0).velocity.x < -1e-4);
        steps(w, 1);
        clast_vec3 v = body_of(w, 0).velocity, x = body_of(w, 0).position;
        steps(w, 1);
        double way = body_of(w, 0).position.x - x.x, change = body_of(w, 0).velocity.x - v.x;
        if (info->past > 0) { /* they look back to when it was pushed, less and less */
            CHECK_NEAR(way, v.x * 1e-5, 0.05 * fabs(v.x) * 1e-5);
        } else {
            CHECK_NEAR(way, v.x * 1e-5, 1e-12 * 1e-5);
            CHECK_NEAR(change, 0, 1e-12 * fabs(v.x));
        }
        clast_world_free(w);
    }
}

TEST_MAIN(cmocka_unit_test(rules_keep_free_motion), cmocka_unit_test(gear_is_what_is_printed),
          cmocka_unit_test(euler_is_the_leapfrog_shifted), cmocka_unit_test(verlet_is_the_leapfrog),
          cmocka_unit_test(a_bounce_with_friction_converges), cmocka_unit_test(the_bed_is_worth_it),
          cmocka_unit_test(bits_do_not_depend_on_the_machine),
          cmocka_unit_test(restart_is_never_having_stopped),
          cmocka_unit_test(readers_change_nothing),
          cmocka_unit_test(the_residual_falls_with_the_step),
          cmocka_unit_test(leaving_bodies_are_booked),
          cmocka_unit_test(what_stays_feels_nothing_of_what_left))
