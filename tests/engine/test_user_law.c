/* Laws of the user's own in shared objects: the linear law once more beside the engine's, the
 * example against its closed form, and what is said when a law cannot be had. */
#include "tests/support/collision.h"

static const char LINEAR[] = USER_LAW_LINEAR, EXAMPLE[] = USER_LAW_EXAMPLE;
static const char HIDDEN[] = "hidden_again";
static const double STIFF = 9100, TANGENT = 2600, RATIO = 0.17, MU = 0.31, COHESION = 3e-4;

/* ---- the linear law, twice ------------------------------------------------------------------- */

static clast_pair_def linear_pair(void) {
    return (clast_pair_def){.restitution = clast_restitution(CLAST_LAW_LINEAR, RATIO),
                            .friction = MU,
                            .cohesion = COHESION,
                            .stiffness = STIFF,
                            .tangential_ratio = TANGENT / STIFF,
                            .parameter = {STIFF, TANGENT, RATIO, MU, COHESION}};
}

/* A ball meets an uneven rod above a floor, sliding and spinning. law: a name in the shared object;
 * NULL: the engine's. */
static clast_world *scene_of(const char *law, clast_motion motion) {
    clast_world_def def = bare_def(law ? CLAST_LAW_USER : CLAST_LAW_LINEAR);
    def.gravity = (clast_vec3){0, 0, -9.81};
    def.motion = motion;
    def.time_step = 4e-6;
    def.max_residual = 1e9;
    clast_world *w = new_world(&def);
    if (law) assert_int_equal(clast_world_use_law(w, LINEAR, law), CLAST_OK);
    clast_pair_def pair = linear_pair();
    if (law == HIDDEN) pair.friction = pair.cohesion = 0; /* the engine is told of none */
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", 0.0031, m.soft);
    int rod = add_uneven_rod(w, m.hard, 0.0042);
    add_plane(w, clast_part_add(w, &(clast_part_def){.name = "floor"}), m.hard, vec(0, 0, 0),
              vec(0, 0, 1));
    bool space = motion == CLAST_MOTION_3D;
    add_body(w, rod, vec(0, 0, 0.0062), vec(0.2, 0, -0.3), vec(0, 11, 0));
    add_body(w, ball, vec(0.001, space ? 0.0007 : 0, 0.0172), vec(-0.4, 0, -0.9),
             vec(space ? 31 : 0, -54, space ? 13 : 0));
    return w;
}

static double difference(clast_vec3 a, clast_vec3 b) {
    return norm(minus(a, b));
}

/* Largest difference of a contact force, of the largest force so far. */
static void compare_forces(clast_world *one, clast_world *other, double *most, double *worst) {
    clast_contact a[16], b[16];
    size_t n = clast_world_contacts(one, a, 16);
    assert_int_equal(n, clast_world_contacts(other, b, 16));
    for (size_t i = 0; i < n; i++) {
        *most = fmax(*most, norm(a[i].force));
        *worst = fmax(*worst, difference(a[i].force, b[i].force));
    }
}

static void compare_linear(const char *law, clast_motion motion) {
    clast_world *own = scene_of(law, motion), *built_in = scene_of(NULL, motion);
    double most = 0, worst = 0;
    int touching = 0;
    for (int i = 0; i < 2500; i++) {
        steps(own, 1), steps(built_in, 1);
        compare_forces(own, built_in, &most, &worst);
        touching += contact_count(own) > 0;
    }
    print_message("linear law as a law of the user's own: %d steps in contact, "
                  "forces differ by "
                  "%.1e of the largest\n",
                  touching, worst / most);
    assert_true(touching > 300);
    CHECK_BELOW(worst, 1e-12 * most);
    clast_energy a = clast_world_energy(own), b = clast_world_energy(built_in);
    CHECK_NEAR(a.elastic, b.elastic, 1e-12 * a.input);
    CHECK_NEAR(a.damping, b.damping, 1e-12 * a.input);
    CHECK_NEAR(a.friction, b.friction, 1e-12 * a.input);
    CHECK_NEAR(a.residual, b.residual, 1e-12 * a.input);
    clast_world_free(own), clast_world_free(built_in);
}

static void linear_law_is_the_engines_in_space(void **state) {
    (void)state;
    compare_linear("linear_again", CLAST_MOTION_3D);
}

static void linear_law_is_the_engines_in_a_plane(void **state) {
    (void)state;
    compare_linear("linear_again", CLAST_MOTION_IN_PLANE);
}

/* Tangential history and turning do not hang on the friction that the engine knows of. */
static void a_friction_of_its_own_is_felt(void **state) {
    (void)state;
    compare_linear(HIDDEN, CLAST_MOTION_3D);
}

/* ---- a law that remembers ------------------------------------------------------------------- */

static clast_world *plastic_scene(bool own) {
    clast_world_def def = bare_def(own ? CLAST_LAW_USER : CLAST_LAW_WALTON_BRAUN);
    def.gravity = (clast_vec3){0, 0, -9.81};
    def.time_step = 4e-6;
    def.max_residual = 1e9;
    clast_world *w = new_world(&def);
    if (own) assert_int_equal(clast_world_use_law(w, LINEAR, "plastic_again"), CLAST_OK);
    clast_pair_def pair = {
        .restitution = 0.6, .stiffness = STIFF, .parameter = {STIFF, STIFF / 0.36}};
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", 0.0031, m.soft);
    add_plane(w, clast_part_add(w, &(clast_part_def){.name = "floor"}), m.hard, vec(0, 0, 0),
              vec(0, 0, 1));
    add_body(w, ball, vec(0, 0, 0.0032), vec(0, 0, -0.4), vec(0, 0, 0));
    add_body(w, ball, vec(0.0004, 0, 0.0096), vec(0, 0, -0.8), vec(0, 0, 0));
    return w;
}

/* The one in the middle unloads and is hit again. */
static void memory_is_kept_as_a_plastic_overlap(void **state) {
    (void)state;
    clast_world *own = plastic_scene(true), *built_in = plastic_scene(false);
    double most = 0, worst = 0;
    for (int i = 0; i < 2000; i++) {
        steps(own, 1), steps(built_in, 1);
        compare_forces(own, built_in, &most, &worst);
    }
    print_message("Walton-Braun likewise: forces differ by %.1e of the largest\n", worst / most);
    assert_true(most > 0.3);
    CHECK_BELOW(worst, 1e-12 * most);
    clast_world_free(own), clast_world_free(built_in);
}

/* A checkpoint goes on to the same bits, under the law and the numbers that it was made with. */
static void a_restart_asks_for_the_same_law(void **state) {
    (void)state;
    scratch_name file = scratch_file("user_law.h5");
    clast_world *first = plastic_scene(true), *again = plastic_scene(true);
    steps(first, 300);
    assert_int_equal(clast_checkpoint_save(first, file.text, ""), CLAST_OK);
    if (clast_checkpoint_load(again, file.text, NULL) != CLAST_OK)
        fail_msg("%s", clast_world_error(again));
    steps(first, 500), steps(again, 500);
    assert_true(clast_world_hash(first) == clast_world_hash(again));
    clast_world *other = plastic_scene(true);
    clast_pair_def pair = {
        .restitution = 0.6, .stiffness = STIFF, .parameter = {STIFF, STIFF / 0.5}};
    assert_int_equal(clast_pair_set(other, 0, 0, &pair), CLAST_OK);
    assert_int_equal(clast_checkpoint_load(other, file.text, NULL), CLAST_ERR_MISMATCH);
    clast_world_free(first), clast_world_free(again), clast_world_free(other);
    remove(file.text);
}

/* ---- the example ----------------------------------------------------------------------------- */

/* With u = delta'^2 both ways are linear in u: on the way in u' = -a u - b x, a = 2q/m, b = 2k/m,
 * on the way out u' = a u - b x; the force ends at x_r = x_m - ln(1 + a x_m)/a with u = (b/a) x_r.
 */
static double quadratic_restitution(double k, double q, double m, double v) {
    double a = 2 * q / m, b = 2 * k / m, low = 0, high = v * sqrt(m / k);
    for (int i = 0; i < 80; i++) {
        double x = 0.5 * (low + high);
        double u = (v * v - b / (a * a)) * exp(-a * x) + b / (a * a) - b / a * x;
        if (u > 0)
            low = x;
        else
            high = x;
    }
    double left = low - log1p(a * low) / a;
    return sqrt(b / a * left) / v;
}

static double quadratic_rebound(double q, double speed, double dt) {
    clast_world_def def = bare_def(CLAST_LAW_USER);
    def.time_step = dt;
    def.max_residual = def.max_displacement = 1e9;
    clast_world *w = new_world(&def);
    assert_int_equal(clast_world_use_law(w, EXAMPLE, "quadratic_dashpot"), CLAST_OK);
    clast_pair_def pair = {.friction = MU, .parameter = {STIFF, q, 0}};
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", 0.0031, m.soft);
    add_plane(w, clast_part_add(w, &(clast_part_def){.name = "floor"}), m.hard, vec(0, 0, 0),
              vec(0, 0, 1));
    add_body(w, ball, vec(0, 0, 0.0031 + 0.4 * speed * dt), vec(0, 0, -speed), vec(0, 0, 0));
    double time = 4 * sqrt(body_of(w, 0).mass / STIFF);
    steps(w, (uint64_t)(1.5 * time / dt));
    assert_int_equal(contact_count(w), 0);
    double e = body_of(w, 0).velocity.z / speed;
    clast_energy energy = clast_world_energy(w);
    CHECK_NEAR(energy.damping, energy.input - energy.kinetic, 1e-5 * energy.input);
    clast_world_free(w);
    return e;
}

/* First order, as every dashpot of the leapfrog. */
static void the_example_rebounds_as_its_closed_form(void **state) {
    (void)state;
    double q = 0.021, mass = 1130 * 4.0 / 3 * 3.14159265358979323846 * pow(0.0031, 3);
    double natural = sqrt(mass / STIFF), last = 1;
    for (double v = 0.05; v < 4; v *= 4) {
        double want = quadratic_restitution(STIFF, q, mass, v);
        double coarse = quadratic_rebound(q, v, natural / 100) - want;
        double fine = quadratic_rebound(q, v, natural / 400) - want;
        print_message("quadratic dashpot at %.2f m/s: e = %.5f, error %.1e and %.1e\n", v, want,
                      coarse, fine);
        CHECK_BELOW(fabs(fine), 2e-5);
        CHECK_BELOW(fabs(fine), 0.5 * fabs(coarse) + 1e-6);
        CHECK_BELOW(want, last);
        last = want;
    }
}

/* ---- what can go wrong ----------------------------------------------------------------------- */

static void refused(clast_world *w, const char *path, const char *name, clast_status status,
                    const char *says) {
    assert_int_equal(clast_world_use_law(w, path, name), status);
    if (!strstr(clast_world_error(w), says))
        fail_msg("'%s' does not say '%s'", clast_world_error(w), says);
    assert_non_null(strstr(clast_world_error(w), path));
}

static void what_cannot_be_loaded_is_said(void **state) {
    (void)state;
    clast_world_def def = bare_def(CLAST_LAW_USER);
    clast_world *w = new_world(&def);
    refused(w, "./no/such/law.so", "x", CLAST_ERR_OPEN, "no/such/law.so");
    refused(w, __FILE__, "x", CLAST_ERR_OPEN, "");
    refused(w, LINEAR, "quadratic_dashpot", CLAST_ERR_FORMAT, "has no 'quadratic_dashpot'");
    refused(w, LINEAR, "of_tomorrow", CLAST_ERR_VERSION, "version 2, expected 1");
    clast_world_free(w);
    def.law = CLAST_LAW_LINEAR;
    w = new_world(&def);
    refused(w, LINEAR, "linear_again", CLAST_ERR_ARGUMENT, "another law");
    clast_world_free(w);
    def.law = CLAST_LAW_USER, def.precision = CLAST_PRECISION_MIXED;
    w = new_world(&def);
    refused(w, LINEAR, "linear_again", CLAST_ERR_ARGUMENT, "double precision");
    clast_world_free(w);
}

static void a_world_without_its_law_does_not_run(void **state) {
    (void)state;
    clast_world_def def = bare_def(CLAST_LAW_USER);
    def.time_step = 1e-5;
    clast_world *w = new_world(&def);
    clast_pair_def pair = {.parameter = {STIFF}};
    two_materials m = add_materials(w, &pair);
    clast_shape_add_sphere(w, "ball", 0.0031, m.soft);
    assert_int_equal(clast_world_prepare(w), CLAST_ERR_ARGUMENT);
    assert_non_null(strstr(clast_world_error(w), "clast_world_use_law"));
    clast_world_free(w);
}

/* Without a step of its own the world takes it from the law's stiffness at the impact speed. */
static void the_step_follows_from_the_law(void **state) {
    (void)state;
    clast_world_def def = bare_def(CLAST_LAW_USER);
    def.contact_resolution = 40, def.impact_speed = 0.7;
    clast_world *w = new_world(&def);
    assert_int_equal(clast_world_use_law(w, LINEAR, "linear_again"), CLAST_OK);
    clast_pair_def pair = linear_pair();
    two_materials m = add_materials(w, &pair);
    add_body(w, clast_shape_add_sphere(w, "ball", 0.0031, m.soft), vec(0, 0, 0), vec(0, 0, 0),
             vec(0, 0, 0));
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    double mass = 0.5 * body_of(w, 0).mass, pi = 3.14159265358979323846;
    CHECK_CLOSE(clast_world_time_step(w), pi * sqrt(mass / STIFF) / 40, 1e-9);
    clast_world_free(w);
}

/* ---- the critical step ----------------------------------------------------------------------- */

static const double STICKING = 0.83; /* tangential over normal stiffness; 2/7 and less has no say */

static clast_pair_def held_pair(const char *law, double friction) {
    return (clast_pair_def){.restitution = 1,
                            .friction = law == HIDDEN ? 0 : friction,
                            .stiffness = STIFF,
                            .tangential_ratio = STICKING,
                            .parameter = {STIFF, STICKING * STIFF, 0, friction}};
}

static double ball_mass(void) {
    return 1130 * 4.0 / 3 * 3.14159265358979323846 * pow(0.0031, 3);
}

/* A ball that friction holds on a plate; the pair of balls that the plan foresees as well slides,
 * so the plate rules. law: a name in `path`; NULL: the engine's. */
static clast_world *held_ball(const char *path, const char *law, double step) {
    clast_world_def def = bare_def(law ? CLAST_LAW_USER : CLAST_LAW_LINEAR);
    def.time_step = step, def.guards = CLAST_GUARD_REPORT, def.impact_speed = 0.1;
    def.gravity = vec(0, 0, -9.81);
    clast_world *w = new_world(&def);
    if (law) assert_int_equal(clast_world_use_law(w, path, law), CLAST_OK);
    clast_pair_def slides = held_pair(law, 0), sticks = held_pair(law, 3);
    if (path == EXAMPLE) slides.parameter[2] = sticks.parameter[2] = 4; /* N s/m, across */
    two_materials m = add_materials(w, &slides);
    assert_int_equal(clast_pair_set(w, m.soft, m.hard, &sticks), CLAST_OK);
    int ball = clast_shape_add_sphere(w, "ball", 0.0031, m.soft);
    add_plane(w, clast_part_add(w, &(clast_part_def){.name = "plate"}), m.hard, vec(0, 0, 0),
              vec(0, 0, 1));
    double sag = ball_mass() * 9.81 / STIFF;
    add_body(w, ball, vec(0, 0, 0.0031 - sag), vec(0, 0, 0), vec(0, 1e-6, 0));
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    return w;
}

static double critical_of(const char *path, const char *law) {
    clast_world *w = held_ball(path, law, 1e-6);
    double critical = clast_world_plan(w).critical_step;
    clast_world_free(w);
    return critical;
}

/* The ball rolls on it with 3.5 k_t / m. The engine asks the law, whoever has the friction. */
static void the_critical_step_knows_its_spring(void **state) {
    (void)state;
    double engine = critical_of(LINEAR, NULL);
    CHECK_CLOSE(engine, 2 / sqrt(3.5 * STICKING * STIFF / ball_mass()), 1e-12);
    CHECK_CLOSE(critical_of(LINEAR, "linear_again"), engine, 1e-6);
    CHECK_CLOSE(critical_of(LINEAR, HIDDEN), engine, 1e-6);
}

/* Friction without a spring springs back nowhere: the two balls rule. */
static void friction_without_a_spring_has_no_say(void **state) {
    (void)state;
    CHECK_CLOSE(critical_of(EXAMPLE, "quadratic_dashpot"), 2 / sqrt(2 * STIFF / ball_mass()), 1e-6);
}

static double fastest_spin(double step) {
    clast_world *w = held_ball(LINEAR, "linear_again", step);
    double most = 0;
    for (int i = 0; i < 200; i++) {
        steps(w, 1);
        most = fmax(most, norm(body_of(w, 0).spin));
    }
    clast_world_free(w);
    return most;
}

static void a_ball_held_by_it_fails_above_that_step(void **state) {
    (void)state;
    double limit = critical_of(LINEAR, "linear_again");
    CHECK_BELOW(fastest_spin(0.95 * limit), 1e-5);
    CHECK_BELOW(1e-3, fastest_spin(1.05 * limit));
}

TEST_MAIN(cmocka_unit_test(linear_law_is_the_engines_in_space),
          cmocka_unit_test(linear_law_is_the_engines_in_a_plane),
          cmocka_unit_test(a_friction_of_its_own_is_felt),
          cmocka_unit_test(memory_is_kept_as_a_plastic_overlap),
          cmocka_unit_test(a_restart_asks_for_the_same_law),
          cmocka_unit_test(the_example_rebounds_as_its_closed_form),
          cmocka_unit_test(what_cannot_be_loaded_is_said),
          cmocka_unit_test(a_world_without_its_law_does_not_run),
          cmocka_unit_test(the_step_follows_from_the_law),
          cmocka_unit_test(the_critical_step_knows_its_spring),
          cmocka_unit_test(friction_without_a_spring_has_no_say),
          cmocka_unit_test(a_ball_held_by_it_fails_above_that_step))
