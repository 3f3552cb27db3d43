/* Every definition out of its range is refused with a message that names it. */
#include "tests/support/scene.h"

/* ---- the world ------------------------------------------------------------------------------- */

typedef struct world_fault {
    size_t offset; /* of a double in clast_world_def */
    double value;
    const char *says;
} world_fault;

#define FIELD(name) offsetof(clast_world_def, name)

static void world_definitions(void **state) {
    (void)state;
    static const world_fault faults[] = {
        {FIELD(gravity.x), NAN, "gravity"},
        {FIELD(gravity.z), INFINITY, "gravity"},
        {FIELD(global_damping), -1, "global_damping"},
        {FIELD(global_damping), INFINITY, "global_damping"},
        {FIELD(time_step), -1e-5, "time_step"},
        {FIELD(time_step), NAN, "time_step"},
        {FIELD(time_step), INFINITY, "time_step"},
        {FIELD(rayleigh_fraction), 0, "rayleigh_fraction"},
        {FIELD(rayleigh_fraction), 1.01, "rayleigh_fraction"},
        {FIELD(contact_resolution), 4.9, "contact_resolution"},
        {FIELD(contact_resolution), INFINITY, "contact_resolution"},
        {FIELD(impact_speed), -1, "impact_speed"},
        {FIELD(impact_speed), INFINITY, "impact_speed"},
        {FIELD(domain_max.y), -10, "domain"},
        {FIELD(domain_max.y), NAN, "domain"},
        {FIELD(domain_max.y), INFINITY, "domain"},
        {FIELD(domain_min.x), -INFINITY, "domain"},
        {FIELD(newton_tolerance), 0, "newton_tolerance"},
        {FIELD(newton_tolerance), NAN, "newton_tolerance"},
        {FIELD(max_overlap), 0, "guard"},
        {FIELD(max_displacement), -1, "guard"},
        {FIELD(max_residual), NAN, "guard"},
        {FIELD(skin), -1e-3, "skin"},
        {FIELD(skin), INFINITY, "skin"},
    };
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
        clast_world_def def = clast_world_def_default();
        memcpy((char *)&def + faults[i].offset, &faults[i].value, sizeof(double));
        clast_world *w = clast_world_new(&def);
        if (w || !strstr(clast_world_new_error(), faults[i].says))
            fail_msg("fault %zu (%s = %g) gives: %s", i, faults[i].says, faults[i].value,
                     w ? "a world" : clast_world_new_error());
    }
    for (int i = 0; i < 4; i++) {
        clast_world_def def = clast_world_def_default();
        if (i == 0) def.scheme = (clast_scheme)-1;
        if (i == 1) def.scheme = (clast_scheme)CLAST_SCHEMES;
        if (i == 2) def.newton_iterations = 0;
        if (i == 3) def.linear_solver = (clast_linear_solver)2;
        static const char *const says[4] = {"scheme", "scheme", "newton_iterations", "solver"};
        assert_null(clast_world_new(&def));
        assert_non_null(strstr(clast_world_new_error(), says[i]));
    }
    for (int i = 0; i < 4; i++) {
        clast_world_def def = clast_world_def_default();
        if (i < 2)
            def.plane_axis = i ? 3 : -1;
        else
            def.threads = i == 2 ? -1 : 1025;
        assert_null(clast_world_new(&def));
        assert_non_null(strstr(clast_world_new_error(), i < 2 ? "plane_axis" : "threads"));
    }
}

/* ---- what is added --------------------------------------------------------------------------- */

static clast_world *w;
static two_materials m;

static int fresh(void **state) {
    (void)state;
    clast_world_def def = bare_def(CLAST_LAW_LINEAR);
    w = new_world(&def);
    clast_pair_def pair = pair_of(1, 0.3);
    m = add_materials(w, &pair);
    return 0;
}

static int gone(void **state) {
    (void)state;
    clast_world_free(w);
    return 0;
}

static void expect(int result, const char *says) {
    if (result >= 0 || !strstr(clast_world_error(w), says))
        fail_msg("result %d, \"%s\" does not say \"%s\"", result, clast_world_error(w), says);
}

static void materials(void **state) {
    (void)state;
    static const double bad[][3] = {{0, 1e9, 0.3},    {-1, 1e9, 0.3},        {NAN, 1e9, 0.3},
                                    {1000, 0, 0.3},   {1000, INFINITY, 0.3}, {1000, 1e9, -1},
                                    {1000, 1e9, 0.5}, {1000, 1e9, NAN}};
    static const char *const says[] = {"density", "density", "density", "Young",
                                       "Young",   "Poisson", "Poisson", "Poisson"};
    for (int i = 0; i < 8; i++) {
        expect(
            clast_material_add(w, &(clast_material_def){"clay", bad[i][0], bad[i][1], bad[i][2]}),
            says[i]);
        assert_non_null(strstr(clast_world_error(w), "clay"));
    }
    assert_int_equal(clast_world_material_count(w), 2);
}

static void pairs(void **state) {
    (void)state;
    static const clast_pair_def bad[] = {
        {.restitution = 0, .friction = 0.3, .stiffness = 1e4},
        {.restitution = 1.01, .friction = 0.3, .stiffness = 1e4},
        {.restitution = NAN, .friction = 0.3, .stiffness = 1e4},
        {.restitution = 0.5, .friction = -0.1, .stiffness = 1e4},
        {.restitution = 0.5, .friction = INFINITY, .stiffness = 1e4},
        {.restitution = 0.5, .friction = 0.3, .cohesion = -1, .stiffness = 1e4},
        {.restitution = 0.5, .friction = 0.3, .cohesion = INFINITY, .stiffness = 1e4},
        {.restitution = 0.5, .friction = 0.3},
        {.restitution = 0.5, .friction = 0.3, .stiffness = INFINITY},
        {.restitution = 0.5, .friction = 0.3, .stiffness = 1e4, .tangential_ratio = -1},
        {.restitution = 0.5, .friction = 0.3, .stiffness = 1e4, .tangential_restitution = 1.1},
        {.restitution = 0.5, .friction = 0.3, .stiffness = 1e4, .rolling_friction = -0.1},
        {.restitution = 0.5, .friction = 0.3, .stiffness = 1e4, .rolling_friction = NAN}};
    static const char *const says[] = {"restitution",
                                       "restitution",
                                       "restitution",
                                       "friction",
                                       "friction",
                                       "cohesion",
                                       "cohesion",
                                       "stiffness",
                                       "stiffness",
                                       "tangential_ratio",
                                       "tangential_restitution",
                                       "rolling_friction",
                                       "rolling_friction"};
    for (int i = 0; i < 13; i++) {
        assert_int_equal(clast_pair_set(w, m.soft, m.hard, &bad[i]), CLAST_ERR_ARGUMENT);
        expect(-1, says[i]);
        expect(-1, "soft / hard");
    }
    assert_int_equal(clast_pair_set_friction(w, m.soft, m.hard, -0.1), CLAST_ERR_ARGUMENT);
    assert_int_equal(clast_pair_set_friction(w, m.soft, m.hard, NAN), CLAST_ERR_ARGUMENT);
    assert_int_equal(clast_pair_set_friction(w, m.soft, m.hard, 0.1), CLAST_OK);
}

static void dissipation_or_restitution(void **state) {
    (void)state;
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_BRILLIANTOV);
    clast_world *v = new_world(&def);
    int clay = clast_material_add(v, &(clast_material_def){"clay", 700, 1e7, 0.3});
    clast_pair_def bad[3] = {{.restitution = 0.5, .dissipation = -1},
                             {.restitution = 0.5, .reference_speed = NAN},
                             {.restitution = 0}};
    for (int i = 0; i < 3; i++)
        assert_int_equal(clast_pair_set(v, clay, clay, &bad[i]), CLAST_ERR_ARGUMENT);
    bad[2].dissipation = 1e-6; /* instead of a restitution */
    assert_int_equal(clast_pair_set(v, clay, clay, &bad[2]), CLAST_OK);
    clast_world_free(v);
    def.tangent = (clast_tangent)3;
    assert_null(clast_world_new(&def));
    assert_non_null(strstr(clast_world_new_error(), "tangent"));
}

static int shape_of(int count, const clast_vec3 *centre, const double *radius, double mass,
                    clast_vec3 inertia, int material) {
    return clast_shape_add(
        w, &(clast_shape_def){"nut", material, count, centre, radius, mass, inertia, 0, NULL});
}

static void shapes(void **state) {
    (void)state;
    clast_vec3 none = {0, 0, 0}, one = {1, 1, 1}, two[2] = {{-1, 0, 0}, {1, 0, 0}};
    clast_vec3 off[2] = {{0, 0, 0}, {2, 0, 0}}, tilted[2] = {{-1, -1, 0}, {1, 1, 0}};
    double r[2] = {1, 1}, zero[2] = {1, 0}, nan[2] = {1, NAN}, big[2] = {1.2, 1.2};
    expect(shape_of(0, two, r, 0, none, 0), "at least one sphere");
    expect(shape_of(2, two, r, 0, none, 2), "no such material");
    expect(shape_of(2, two, zero, 0, none, 0), "radius");
    expect(shape_of(2, two, nan, 0, none, 0), "radius");
    expect(shape_of(2, (clast_vec3[2]){{-1, 0, 0}, {NAN, 0, 0}}, r, 0, none, 0), "not finite");
    expect(shape_of(2, two, r, -1, none, 0), "negative mass");
    expect(shape_of(2, two, r, INFINITY, one, 0), "not finite");
    expect(shape_of(2, two, r, 1, vec(1, -1, 1), 0), "moment of inertia");
    expect(shape_of(2, two, r, 1, vec(1, 1, 2.1), 0), "triangle");
    expect(shape_of(2, two, big, 0, none, 0), "overlapping");
    expect(shape_of(2, two, big, 5, none, 0), "overlapping");
    expect(shape_of(2, off, r, 0, none, 0), "centre of mass");
    expect(shape_of(2, tilted, r, 0, none, 0), "principal axes");
    expect(clast_shape_add_sphere(w, "nut", -1, 0), "nut has a sphere whose radius");
    assert_int_equal(clast_world_shape_count(w), 0);
    assert_int_equal(shape_of(2, off, r, 5, one, 0), 0); /* the caller's own mass properties */
    assert_int_equal(shape_of(2, two, r, 0, none, 0), 1);
}

/* Mass and moments of touching spheres by parallel axes. */
static void mass_properties(void **state) {
    (void)state;
    clast_shape_def d = clast_world_shape(w, add_rod(w, m.soft, 0.01));
    double ball = 1130 * 4.0 / 3 * 3.14159265358979323846 * 1e-6, own = 0.4 * ball * 1e-4;
    CHECK_CLOSE(d.mass, 2 * ball, 1e-14);
    CHECK_CLOSE(d.inertia.x, 2 * own, 1e-14);
    CHECK_CLOSE(d.inertia.y, 2 * (own + ball * 0.0102 * 0.0102), 1e-14);
    CHECK_CLOSE(d.inertia.z, d.inertia.y, 1e-15);
}

static void parts(void **state) {
    (void)state;
    clast_part_def ram = {.name = "ram", .velocity = {NAN, 0, 0}};
    expect(clast_part_add(w, &ram), "ram: velocity");
    ram = (clast_part_def){.name = "ram", .move_from = NAN};
    expect(clast_part_add(w, &ram), "time");
    ram = (clast_part_def){.name = "ram", .move_from = 2, .move_until = 1};
    expect(clast_part_add(w, &ram), "move_until");
    ram = (clast_part_def){.name = "ram", .removed_at = NAN};
    expect(clast_part_add(w, &ram), "time");
    ram = (clast_part_def){.name = "ram", .stroke = {.travel = {0.03, 0, 0}}};
    expect(clast_part_add(w, &ram), "stroke: speed");
    ram.stroke.speed = 0.01, ram.stroke.pause = -1;
    expect(clast_part_add(w, &ram), "stroke: pause");
    ram.stroke.pause = 0, ram.stroke.phase = 1;
    expect(clast_part_add(w, &ram), "stroke: phase");
    ram = (clast_part_def){.name = "ram", .oscillation = {.amplitude = {0, 0, 0.01}}};
    expect(clast_part_add(w, &ram), "oscillation: frequency");
    ram = (clast_part_def){.name = "ram", .rotation = {.speed = 1}};
    expect(clast_part_add(w, &ram), "rotation: has no axis");
    ram.rotation.axis.z = 2, ram.rotation.swing = 0.1;
    expect(clast_part_add(w, &ram), "rotation: frequency");
    static const double times[3] = {0, 1, 1};
    static const clast_vec3 offsets[3] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    ram = (clast_part_def){.name = "ram", .table = {3, times, offsets, NULL}};
    expect(clast_part_add(w, &ram), "times do not rise");
}

static int wall_of(clast_wall_kind kind, clast_vec3 normal, clast_vec3 side, double half,
                   clast_vec3 belt) {
    return clast_wall_add(
        w, 0, &(clast_wall_def){"gate", kind, m.hard, {0, 0, 0}, normal, side, {half, 1}, belt});
}

static void walls(void **state) {
    (void)state;
    clast_vec3 x = {1, 0, 0}, z = {0, 0, 1}, none = {0, 0, 0};
    expect(wall_of(CLAST_WALL_PLANE, z, x, 1, none), "gate belongs to no part");
    clast_part_add(w, &(clast_part_def){.name = "door"});
    expect(wall_of(CLAST_WALL_PLANE, none, x, 1, none), "normal");
    expect(wall_of(CLAST_WALL_PLANE, vec(NAN, 0, 1), x, 1, none), "normal");
    expect(wall_of(CLAST_WALL_PLANE, vec(INFINITY, 0, 1), x, 1, none), "not finite");
    expect(wall_of(CLAST_WALL_PLANE, z, x, 1, vec(0, 0, 1)), "belt");
    expect(wall_of(CLAST_WALL_PLANE, z, x, 1, vec(NAN, 0, 0)), "belt");
    expect(wall_of(CLAST_WALL_PLATE, z, x, 0, none), "side that is not above zero");
    expect(wall_of(CLAST_WALL_PLATE, z, x, INFINITY, none), "not finite");
    expect(wall_of(CLAST_WALL_PLATE, z, none, 1, none), "no side direction");
    expect(wall_of(CLAST_WALL_PLATE, z, vec(1, 0, 0.1), 1, none), "across");
    expect(
        clast_wall_add(w, 0, &(clast_wall_def){.name = "gate", .material = 7, .normal = {0, 0, 1}}),
        "no such material");
    assert_int_equal(clast_world_wall_count(w), 0);
    assert_int_equal(wall_of(CLAST_WALL_PLATE, z, x, 1, vec(0.3, 0.2, 0)), 0);
}

static void bodies(void **state) {
    (void)state;
    int ball = clast_shape_add_sphere(w, "ball", 0.005, m.soft);
    expect(clast_body_add(w, &(clast_body_def){.shape = ball, .orientation = {2, 0, 0, 0}}),
           "unit quaternion");
    expect(clast_body_add(w, &(clast_body_def){.shape = ball, .orientation = {NAN, 0, 0, 0}}),
           "unit quaternion");
    expect(clast_body_add(w, &(clast_body_def){.shape = ball, .position = {NAN, 0, 0}}),
           "not finite");
    expect(clast_body_add(w, &(clast_body_def){.shape = ball, .velocity = {0, INFINITY, 0}}),
           "not finite");
    expect(clast_body_add(w, &(clast_body_def){.shape = ball, .spin = {0, 0, NAN}}), "not finite");
    assert_int_equal(add_body(w, ball, vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0)), 0);
}

/* ---- preparing ------------------------------------------------------------------------------- */

static void a_world_without_shapes(void **state) {
    (void)state;
    assert_int_equal(clast_world_prepare(w), CLAST_ERR_ARGUMENT);
    expect(-1, "no shape");
    assert_int_equal(clast_world_step(w), CLAST_ERR_ARGUMENT);
}

static int occurrences(const char *text, const char *word) {
    int n = 0;
    for (const char *p = strstr(text, word); p; p = strstr(p + 1, word)) n++;
    return n;
}

static void pairs_that_are_missing_are_named_once(void **state) {
    (void)state;
    int extra = clast_material_add(w, &(clast_material_def){"extra", 1000, 1e7, 0.2});
    clast_shape_add_sphere(w, "a", 0.01, extra), clast_shape_add_sphere(w, "b", 0.02, extra);
    clast_shape_add_sphere(w, "c", 0.01, m.soft), clast_shape_add_sphere(w, "d", 0.01, m.soft);
    assert_int_equal(clast_world_prepare(w), CLAST_ERR_ARGUMENT);
    assert_int_equal(occurrences(clast_world_error(w), "is not set"), 2);
    expect(-1, "soft / extra"), expect(-1, "extra / extra");
}

static void a_plane_of_motion(void **state) {
    (void)state;
    for (int i = 0; i < 4; i++) {
        clast_world_def def = bare_def(CLAST_LAW_LINEAR);
        def.motion = CLAST_MOTION_IN_PLANE;
        clast_world *own = new_world(&def);
        clast_pair_def pair = pair_of(1, 0.3);
        int rod = add_rod(own, add_materials(own, &pair).soft, 0.01);
        clast_body_def b = {.shape = rod, .velocity = {1, i == 0, 0}, .spin = {i == 1, 2, 0}};
        if (i == 2) b.orientation = clast_quat_axis_angle(vec(1, 0, 0), 0.1);
        if (i == 3) b.orientation = (clast_quat){0, 1, 0, 0}; /* upside down */
        clast_body_add(own, &b);
        assert_int_equal(clast_world_prepare(own), CLAST_ERR_ARGUMENT);
        static const char *const says[4] = {"body 0 moves across", "body 0 spins out",
                                            "body 0 is tilted", "body 0 is tilted"};
        assert_non_null(strstr(clast_world_error(own), says[i]));
        clast_world_free(own);
    }
}

/* However many are allowed: threads cost more than they do for few spheres. */
static void few_spheres_take_one_thread(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        clast_world_def def = bare_def(CLAST_LAW_LINEAR);
        def.threads = 3, def.spheres_per_thread = i ? 1 : 1000;
        clast_world *own = new_world(&def);
        clast_pair_def pair = pair_of(0.5, 0);
        int ball = clast_shape_add_sphere(own, "ball", 0.001, add_materials(own, &pair).soft);
        for (int k = 0; k < 30; k++)
            add_body(own, ball, vec(0.01 * k, 0, 0), vec(0, 0, 0), vec(0, 0, 0));
        steps(own, 1);
        assert_int_equal(clast_world_plan(own).threads, i ? 3 : 1);
        clast_world_free(own);
    }
    for (int balls = 999; balls <= 1000; balls++) {
        clast_world_def def = bare_def(CLAST_LAW_LINEAR);
        def.threads = 3;
        assert_int_equal(def.spheres_per_thread, 500);
        clast_world *own = new_world(&def);
        clast_pair_def pair = pair_of(0.5, 0);
        int ball = clast_shape_add_sphere(own, "ball", 0.001, add_materials(own, &pair).soft);
        for (int k = 0; k < balls; k++)
            add_body(own, ball, vec(0.01 * (k % 40), 0.01 * (k / 40), 0), vec(0, 0, 0),
                     vec(0, 0, 0));
        assert_int_equal(clast_world_prepare(own), CLAST_OK);
        assert_int_equal(clast_world_plan(own).threads, balls / 500);
        clast_world_free(own);
    }
    clast_world_def def = clast_world_def_default();
    def.spheres_per_thread = 0;
    assert_null(clast_world_new(&def));
    assert_non_null(strstr(clast_world_new_error(), "spheres_per_thread"));
}

#define WITH_WORLD(test) cmocka_unit_test_setup_teardown(test, fresh, gone)

TEST_MAIN(cmocka_unit_test(world_definitions), WITH_WORLD(materials), WITH_WORLD(pairs),
          cmocka_unit_test(dissipation_or_restitution), WITH_WORLD(shapes),
          WITH_WORLD(mass_properties), WITH_WORLD(parts), WITH_WORLD(walls), WITH_WORLD(bodies),
          WITH_WORLD(a_world_without_shapes), WITH_WORLD(pairs_that_are_missing_are_named_once),
          cmocka_unit_test(a_plane_of_motion), cmocka_unit_test(few_spheres_take_one_thread))
