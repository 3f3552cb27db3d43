/* The limits of the time step, by hand and as printed. */
#include <gsl/gsl_blas.h>
#include <gsl/gsl_eigen.h>

#include "tests/support/collision.h"

static const double PI = 3.14159265358979323846;

static clast_world *chain_world(int n, double fraction, double speed) {
    clast_world_def def = clast_world_def_default();
    def.rayleigh_fraction = fraction, def.impact_speed = speed, def.threads = 1;
    clast_world *w = new_world(&def);
    int m = clast_material_add(w, &(clast_material_def){"stone", 2650, 3.5e9, 0.3});
    assert_int_equal(clast_pair_set(w, m, m, &(clast_pair_def){.restitution = 0.5}), CLAST_OK);
    double r = 0.01 * cbrt(1.0 / n), radius[4] = {r, r, r, r};
    clast_vec3 centre[4];
    for (int i = 0; i < n; i++) centre[i] = vec(2 * r * (i - 0.5 * (n - 1)), 0, 0);
    int shape = clast_shape_add(
        w, &(clast_shape_def){"chain", m, n, centre, radius, 0, {0, 0, 0}, 0, NULL});
    assert_true(shape >= 0);
    add_body(w, shape, vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0));
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    return w;
}

/* A00 ch. 5: 4.8, 3.8, 3.3, 3.0 x 1e-5 s for chains of 1 to 4 spheres. */
static void rayleigh_steps_of_the_chains(void **state) {
    (void)state;
    static const double printed[4] = {4.8e-5, 3.8e-5, 3.3e-5, 3.0e-5};
    for (int n = 1; n <= 4; n++) {
        clast_world *w = chain_world(n, 0.2, 1);
        double r = 0.01 * cbrt(1.0 / n), shear = 3.5e9 / 2.6;
        double want = PI * r / (0.1631 * 0.3 + 0.8766) * sqrt(2650 / shear);
        CHECK_CLOSE(clast_world_plan(w).rayleigh_step, want, 1e-13);
        CHECK_NEAR(clast_world_plan(w).rayleigh_step, printed[n - 1], 0.05e-5);
        clast_world_free(w);
    }
}

static void auto_takes_the_smaller_limit(void **state) {
    (void)state;
    clast_world *w = chain_world(1, 0.03, 0.01);
    clast_plan p = clast_world_plan(w);
    CHECK_CLOSE(p.time_step, 0.03 * p.rayleigh_step, 1e-15);
    assert_true(p.resolution > 30);
    clast_world_free(w);
    w = chain_world(1, 1, 2000);
    p = clast_world_plan(w);
    CHECK_CLOSE(p.time_step, p.contact_time / 30, 1e-15);
    CHECK_CLOSE(p.resolution, 30.0, 1e-14);
    assert_true(p.time_step < p.rayleigh_step);
    clast_world_free(w);
}

/* The contact time of the plan is that of the collision that it foresees. */
static void contact_time_is_that_of_a_collision(void **state) {
    (void)state;
    clast_world *w = chain_world(1, 1, 3.7);
    double m = 2650 * 4.0 / 3 * PI * 1e-6, e = 3.5e9 / (2 * 0.91), r = 0.005;
    double want = 2.9432751 * pow(15 * m / 2 / (16 * sqrt(r) * e), 0.4) * pow(3.7, -0.2);
    CHECK_CLOSE(clast_world_plan(w).contact_time, want, 1e-7);
    clast_world_free(w);
}

/* Without an expected speed: the fall through the domain. */
static void the_impact_speed_of_a_fall(void **state) {
    (void)state;
    clast_world *w = chain_world(1, 1, 0);
    CHECK_CLOSE(clast_world_plan(w).impact_speed, sqrt(2 * 9.81 * 20), 1e-14);
    clast_world_free(w);
}

/* An undamped linear contact under leapfrog is stable up to the critical step, and not beyond. */
static void the_critical_step_is_the_limit_of_stability(void **state) {
    (void)state;
    for (int over = 0; over < 2; over++) {
        clast_world_def def = bare_def(CLAST_LAW_LINEAR);
        double r = 0.005, k = 310, mass = 1130 * 4.0 / 3 * PI * r * r * r;
        def.time_step = (over ? 1.02 : 0.98) * 2 / sqrt(2 * k / mass); /* two contacts at once */
        def.guards = CLAST_GUARD_REPORT;
        clast_world *w = new_world(&def);
        clast_pair_def pair = pair_of(1, 0);
        pair.stiffness = k;
        two_materials m = add_materials(w, &pair);
        int ball = clast_shape_add_sphere(w, "ball", r, m.soft);
        int part = clast_part_add(w, &(clast_part_def){.name = "press"});
        add_plane(w, part, m.hard, vec(0, 0, -0.9 * r), vec(0, 0, 1));
        add_plane(w, part, m.hard, vec(0, 0, 0.9 * r), vec(0, 0, -1));
        add_body(w, ball, vec(0, 0, 1e-6), vec(0, 0, 0), vec(0, 0, 0));
        double most = 0;
        for (int i = 0; i < 100; i++) {
            steps(w, 1);
            most = fmax(most, fabs(body_of(w, 0).position.z));
        }
        /* the plan foresees that two such balls meet: half the mass */
        CHECK_CLOSE(clast_world_plan(w).critical_step, 2 / sqrt(2 * k / mass), 1e-12);
        if (over)
            CHECK_BELOW(1e-4, most);
        else
            CHECK_BELOW(most, 1e-5);
        clast_world_free(w);
    }
}

/* ---- friction that sticks -------------------------------------------------------------------- */

/* A ball on a plate, or between two, that friction holds; the pair of balls that the plan foresees
 * as well slides, so the plate rules. */
typedef struct held {
    clast_law law;
    bool sandwich;
    double step; /* s; 0: automatic */
} held;

static const double HELD_RADIUS = 0.005, HELD_RATIO = 0.83;

static clast_world *hold_ball(const held *h) {
    clast_world_def def = bare_def(h->law);
    def.time_step = h->step, def.guards = CLAST_GUARD_REPORT, def.impact_speed = 0.1;
    def.gravity = h->sandwich ? vec(0, 0, 0) : vec(0, 0, -9.81);
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(1, 0);
    pair.stiffness = 310, pair.tangential_ratio = HELD_RATIO;
    two_materials m = add_materials(w, &pair);
    pair.friction = 3;
    assert_int_equal(clast_pair_set(w, m.soft, m.hard, &pair), CLAST_OK);
    int ball = clast_shape_add_sphere(w, "ball", HELD_RADIUS, m.soft);
    int part = clast_part_add(w, &(clast_part_def){.name = "press"});
    double gap = (h->sandwich ? 0.999 : 1) * HELD_RADIUS;
    add_plane(w, part, m.hard, vec(0, 0, -gap), vec(0, 0, 1));
    if (h->sandwich) add_plane(w, part, m.hard, vec(0, 0, gap), vec(0, 0, -1));
    double sag = 1130 * 4.0 / 3 * PI * pow(HELD_RADIUS, 3) * 9.81 / pair.stiffness;
    add_body(w, ball, vec(0, 0, h->sandwich ? 0 : -sag), vec(0, 0, 0), vec(0, 1e-6, 0));
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    return w;
}

/* rad/s, the fastest that the ball gets to spin in 200 steps; where it grows by the least that five
 * per cent over the limit make, 1.4 times a step for a while, friction slides long before that. */
static double fastest_spin(const held *h) {
    clast_world *w = hold_ball(h);
    double most = 0;
    for (int i = 0; i < 200; i++) {
        steps(w, 1);
        most = fmax(most, norm(body_of(w, 0).spin));
    }
    clast_world_free(w);
    return most;
}

/* One contact: k_t (1/m + R^2/I) = 3.5 k_t / m beside k_n / m. */
static void a_ball_that_sticks_rolls_on_its_spring(void **state) {
    (void)state;
    held h = {.law = CLAST_LAW_LINEAR, .step = 1e-6};
    clast_world *w = hold_ball(&h);
    double limit = clast_world_plan(w).critical_step, mass = body_of(w, 0).mass;
    clast_world_free(w);
    CHECK_CLOSE(limit, 2 / sqrt(3.5 * HELD_RATIO * 310 / mass), 1e-12);
    h.step = 0.95 * limit;
    CHECK_BELOW(fastest_spin(&h), 1e-5);
    h.step = 1.05 * limit;
    CHECK_BELOW(1e-3, fastest_spin(&h));
}

/* Two contacts across from each other: the centre swings with 2 k_t / m, the spin with
 * 2 k_t R^2 / I = 5 k_t / m, which is 10/7 of what one contact does. */
static void so_it_does_between_two_plates(void **state) {
    (void)state;
    held h = {.law = CLAST_LAW_LINEAR, .sandwich = true, .step = 1e-6};
    clast_world *w = hold_ball(&h);
    double limit = clast_world_plan(w).critical_step * sqrt(0.7);
    clast_world_free(w);
    h.step = 0.95 * limit;
    CHECK_BELOW(fastest_spin(&h), 1e-5);
    h.step = 1.05 * limit;
    CHECK_BELOW(1e-3, fastest_spin(&h));
}

/* Hertz-Mindlin: k_t / k_n = 4 G* / E*, whatever the overlap. */
static void hertzian_spheres_stick_as_mindlin_says(void **state) {
    (void)state;
    clast_world *rough = hold_ball(&(held){.law = CLAST_LAW_HERTZ_MINDLIN, .step = 1e-6});
    double e = 1 / ((1 - 0.37 * 0.37) / 7.3e6 + (1 - 0.23 * 0.23) / 61e6);
    double g = 1 / (2 * 1.37 * (2 - 0.37) / 7.3e6 + 2 * 1.23 * (2 - 0.23) / 61e6);
    double mass = body_of(rough, 0).mass;
    double overlap = pow(15 * mass * 0.01 / (16 * sqrt(HELD_RADIUS) * e), 0.4);
    double k = 2 * e * sqrt(HELD_RADIUS * overlap);
    CHECK_CLOSE(clast_world_plan(rough).critical_step, 2 / sqrt(3.5 * 4 * g / e * k / mass), 1e-9);
    CHECK_BELOW(clast_world_plan(rough).critical_step, 0.65 * 2 / sqrt(k / mass));
    clast_world_free(rough);
}

/* Where contacts are to be resolved coarsely, half the limit is the automatic step. */
static void the_automatic_step_keeps_below_the_limit(void **state) {
    (void)state;
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.contact_resolution = 5, def.rayleigh_fraction = 1, def.impact_speed = 5;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(1, 0.5);
    two_materials m = add_materials(w, &pair);
    add_body(w, clast_shape_add_sphere(w, "ball", 0.004, m.hard), vec(0, 0, 0), vec(0, 0, 0),
             vec(0, 0, 0));
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    clast_plan p = clast_world_plan(w);
    CHECK_CLOSE(p.time_step, 0.5 * p.critical_step, 1e-15);
    CHECK_BELOW(p.time_step, p.contact_time / 5);
    CHECK_BELOW(p.time_step, p.rayleigh_step);
    clast_world_free(w);
}

/* 1/kg, by GSL: the largest eigenvalue of S^(1/2) W S^(1/2) of one contact, W how the body gives
 * way at the contact point, S = 1 along the normal and `ratio` across. */
static double give_way(const clast_shape_def *s, int sphere, clast_vec3 n, double ratio) {
    clast_vec3 arm = minus(s->centre[sphere], times(s->radius[sphere], n));
    double root = sqrt(ratio), side[3][3], in[3] = {s->inertia.x, s->inertia.y, s->inertia.z};
    double nn[3] = {n.x, n.y, n.z}, data[9];
    clast_vec3 lever[3];
    for (int i = 0; i < 3; i++) {
        lever[i] = cross(arm, vec(i == 0, i == 1, i == 2));
        for (int j = 0; j < 3; j++) side[i][j] = (i == j) * root + (1 - root) * nn[i] * nn[j];
    }
    gsl_matrix *m = gsl_matrix_calloc(3, 3), *half = gsl_matrix_calloc(3, 3);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            clast_vec3 p = lever[i], q = lever[j];
            data[3 * i + j] =
                (i == j) / s->mass + p.x * q.x / in[0] + p.y * q.y / in[1] + p.z * q.z / in[2];
        }
    gsl_matrix_view way = gsl_matrix_view_array(data, 3, 3);
    gsl_matrix_view root_s = gsl_matrix_view_array(&side[0][0], 3, 3);
    gsl_blas_dgemm(CblasNoTrans, CblasNoTrans, 1, &root_s.matrix, &way.matrix, 0, half);
    gsl_blas_dgemm(CblasNoTrans, CblasNoTrans, 1, half, &root_s.matrix, 0, m);
    gsl_vector *values = gsl_vector_alloc(3);
    gsl_eigen_symm_workspace *work = gsl_eigen_symm_alloc(3);
    gsl_eigen_symm(m, values, work);
    double most = gsl_vector_max(values);
    gsl_eigen_symm_free(work), gsl_vector_free(values), gsl_matrix_free(half), gsl_matrix_free(m);
    return most;
}

/* The largest of all normals, 3 degrees apart: which misses the top by 0.1 %. */
static double gives_way_most(const clast_shape_def *s, double ratio) {
    double most = 0;
    for (int i = 0; i < 60; i++)
        for (int j = 0; j < 120; j++) {
            double polar = PI * (i + 0.5) / 60, around = 2 * PI * j / 120;
            clast_vec3 n = {sin(polar) * cos(around), sin(polar) * sin(around), cos(polar)};
            most = fmax(most, give_way(s, 0, n, ratio));
        }
    return most;
}

/* One sphere at the end of a lopsided lever: none of all directions gives way more than the plan
 * says. */
static void a_lever_that_sticks_by_brute_force(void **state) {
    (void)state;
    static const double ratios[] = {0.4, 0.83, 1.6};
    const clast_vec3 centres[] = {{0.011, 0.002, -0.003}, {-0.004, 0.0003, 0}, {0, -0.006, 0.005}};
    for (int k = 0; k < 9; k++) {
        clast_world_def def = bare_def(CLAST_LAW_LINEAR);
        clast_world *w = new_world(&def);
        clast_pair_def pair = pair_of(1, 0.4);
        pair.tangential_ratio = ratios[k % 3];
        two_materials m = add_materials(w, &pair);
        clast_vec3 centre = centres[k / 3];
        double radius = 0.004;
        clast_shape_def s = {"lever", m.soft, 1, &centre, &radius, 1.3e-3, {4e-8, 7e-8, 6e-8},
                             0,       NULL};
        int shape = clast_shape_add(w, &s);
        add_body(w, shape, vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0));
        assert_int_equal(clast_world_prepare(w), CLAST_OK);
        /* two of them meet, each with its worst side */
        double critical = clast_world_plan(w).critical_step,
               most = gives_way_most(&s, ratios[k % 3]);
        double found = 4 / (critical * critical * pair.stiffness) / 2;
        CHECK_BELOW(most, found * (1 + 1e-9));
        CHECK_CLOSE(most, found, 2e-3);
        clast_world_free(w);
    }
}

/* ---- chains ---------------------------------------------------------------------------------- */

enum { CHAIN = 10 };
static const double CHAIN_RADIUS = 0.005;

typedef struct press {
    clast_world *world;
    double mass, k; /* of the chain, of one contact */
} press;

/* Of ten spheres in a row `pitch` apart, by slices across the row, which is along x. */
static clast_shape_def chain_of(double pitch, int material) {
    enum { SLICES = 20000 };
    const double r = CHAIN_RADIUS, density = 1130, half = 0.5 * (CHAIN - 1) * pitch + r;
    clast_shape_def d = {.name = "chain", .material = material, .spheres = CHAIN};
    for (int i = 0; i < SLICES; i++) {
        double x = half * ((2 * i + 1.0) / SLICES - 1), nearest = INFINITY;
        for (int k = 0; k < CHAIN; k++)
            nearest = fmin(nearest, fabs(x - pitch * (k - 0.5 * (CHAIN - 1))));
        double rho2 = fmax(0, r * r - nearest * nearest),
               m = density * PI * rho2 * 2 * half / SLICES;
        d.mass += m;
        d.inertia.x += 0.5 * m * rho2;
        d.inertia.y += m * (0.25 * rho2 + x * x);
    }
    d.inertia.z = d.inertia.y;
    return d;
}

/* Pressed between two plates along its whole length. */
static press press_chain(double pitch, double step) {
    press p = {.k = 310};
    clast_world_def def = bare_def(CLAST_LAW_LINEAR);
    def.contact_resolution = 5, def.time_step = step, def.guards = CLAST_GUARD_REPORT;
    p.world = new_world(&def);
    clast_pair_def pair = pair_of(1, 0);
    pair.stiffness = p.k;
    two_materials m = add_materials(p.world, &pair);
    double r = CHAIN_RADIUS, radius[CHAIN];
    clast_vec3 centre[CHAIN];
    for (int i = 0; i < CHAIN; i++)
        radius[i] = r, centre[i] = vec(pitch * (i - 0.5 * (CHAIN - 1)), 0, 0);
    clast_shape_def d = chain_of(pitch, m.soft);
    d.centre = centre, d.radius = radius;
    int chain = clast_shape_add(p.world, &d);
    int part = clast_part_add(p.world, &(clast_part_def){.name = "press"});
    add_plane(p.world, part, m.hard, vec(0, 0, -0.9 * r), vec(0, 0, 1));
    add_plane(p.world, part, m.hard, vec(0, 0, 0.9 * r), vec(0, 0, -1));
    add_body(p.world, chain, vec(0, 0, 1e-6), vec(0, 0, 0), vec(0, 1e-3, 0));
    p.mass = body_of(p.world, 0).mass;
    assert_int_equal(clast_world_prepare(p.world), CLAST_OK);
    return p;
}

/* m, how far the chain gets from the middle in 100 steps. */
static double excursion(clast_world *w) {
    double most = 0;
    for (int i = 0; i < 100; i++) {
        steps(w, 1);
        most = fmax(most, fabs(body_of(w, 0).position.z));
    }
    return most;
}

/* A fifth of the contact of a sphere that carries the whole mass of the chain is 2.8 times over the
 * square root of 20 contacts on it: beyond 2. The engine knows that ten touch at once. */
static void a_chain_is_lighter_than_its_mass(void **state) {
    (void)state;
    const double r = CHAIN_RADIUS;
    press p = press_chain(2 * r, 0);
    double alone = PI * sqrt(p.mass / p.k), inertia = 0;
    for (int i = 0; i < CHAIN; i++)
        inertia += p.mass / CHAIN * (0.4 + pow(2 * i - CHAIN + 1, 2)) * r * r;
    clast_plan plan = clast_world_plan(p.world);
    double turning = 330 * r * r / inertia; /* sum of the arms squared, over I */
    CHECK_BELOW(turning, CHAIN / p.mass);   /* so the motion of the centre counts */
    CHECK_CLOSE(plan.contact_time, PI * sqrt(0.5 * p.mass / CHAIN / p.k), 1e-12);
    CHECK_CLOSE(plan.time_step, plan.contact_time / 5, 1e-12);
    CHECK_BELOW(excursion(p.world), 1e-5);
    clast_world_free(p.world);
    p = press_chain(2 * r, alone / 5);
    CHECK_BELOW(1e-4, excursion(p.world));
    clast_world_free(p.world);
}

/* m, of a chain of overlapping spheres at that step. */
static double overlapping_excursion(double step) {
    press p = press_chain(0.4 * CHAIN_RADIUS, step);
    double most = excursion(p.world);
    clast_world_free(p.world);
    return most;
}

/* Touching spheres bear the chain as they would bear themselves: each has its own mass on its own
 * contact. Overlapping ones share less mass among as many contacts, so the limit of one sphere with
 * the mass of a sphere is too large, between the plates as elsewhere. */
static void overlapping_spheres_have_less_mass_each(void **state) {
    (void)state;
    const double r = CHAIN_RADIUS, sphere = 1130 * 4.0 / 3 * PI * r * r * r;
    press p = press_chain(0.4 * r, 0);
    double limit = 2 / sqrt(2 * CHAIN * p.k / p.mass), of_sphere = 2 / sqrt(2 * p.k / sphere);
    CHECK_BELOW(1.5 * limit, of_sphere);
    /* two chains that meet are foreseen: as stiff as one between two plates */
    CHECK_CLOSE(clast_world_plan(p.world).critical_step, limit, 1e-12);
    CHECK_BELOW(excursion(p.world), 1e-5);
    clast_world_free(p.world);
    CHECK_BELOW(overlapping_excursion(0.95 * limit), 1e-5);
    CHECK_BELOW(1e-4, overlapping_excursion(1.05 * limit));
    CHECK_BELOW(1e-4, overlapping_excursion(0.95 * of_sphere));
}

/* One sphere at the end of a lever: 1/m + a^2 / I, and in a plane about its axis alone. */
static void an_arm_makes_a_contact_lighter(void **state) {
    (void)state;
    for (int plane = 0; plane < 2; plane++) {
        clast_world_def def = bare_def(CLAST_LAW_LINEAR);
        def.motion = plane ? CLAST_MOTION_IN_PLANE : CLAST_MOTION_3D, def.plane_axis = 1;
        clast_world *w = new_world(&def);
        clast_pair_def pair = pair_of(1, 0);
        two_materials m = add_materials(w, &pair);
        clast_vec3 centre = {0.013, 0.004, 0}, inertia = {3e-8, 5e-8, 6e-8};
        double r = 0.005, mass = 1.3e-3;
        int shape = clast_shape_add(
            w, &(clast_shape_def){"lever", m.soft, 1, &centre, &r, mass, inertia, 0, NULL});
        add_plane(w, clast_part_add(w, &(clast_part_def){.name = "floor"}), m.hard, vec(0, 0, -1),
                  vec(0, 0, 1));
        add_body(w, shape, vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0));
        assert_int_equal(clast_world_prepare(w), CLAST_OK);
        /* across x and y the normal z swings the arm about both axes: the stiffest direction is z
         * or lies in the plane of x and y, about z */
        double z = 0.004 * 0.004 / 3e-8 + 0.013 * 0.013 / 5e-8;
        double flat = (0.013 * 0.013 + 0.004 * 0.004) / 6e-8;
        double turning = plane ? 0.013 * 0.013 / 5e-8 : fmax(z, flat), one = 1 / mass + turning;
        double lightest = 0.5 / one; /* two of them meet */
        CHECK_CLOSE(clast_world_plan(w).contact_time, PI * sqrt(lightest / pair.stiffness), 1e-12);
        clast_world_free(w);
    }
}

static clast_vec3 turned_by(clast_quat q, clast_vec3 a) {
    clast_vec3 axis = vec(q.x, q.y, q.z), t = times(2, cross(axis, a));
    return plus(a, plus(times(q.w, t), cross(axis, t)));
}

/* A tetrahedron of four spheres, turned at random within its own frame (its moments are equal, so
 * any frame is principal), comes to lie on three of them, whatever its axes say: 3/m, against 2/m
 * on an edge and 1/m + c^2/I on one sphere. */
static void a_clump_lands_on_its_sides(void **state) {
    (void)state;
    dice d = {.seed = 12};
    const double r = 0.003, half = 0.004, mass = 1.7e-3, inertia = 8 * half * half * mass;
    const clast_vec3 corner[4] = {
        {half, half, half}, {half, -half, -half}, {-half, half, -half}, {-half, -half, half}};
    for (int n = 0; n < 20; n++) {
        clast_world_def def = bare_def(CLAST_LAW_LINEAR);
        clast_world *w = new_world(&def);
        clast_pair_def pair = pair_of(1, 0);
        two_materials m = add_materials(w, &pair);
        clast_quat q = any_orientation(&d);
        clast_vec3 centre[4];
        double radius[4] = {r, r, r, r};
        for (int i = 0; i < 4; i++) centre[i] = turned_by(q, corner[i]);
        int shape = clast_shape_add(w, &(clast_shape_def){"tetrahedron",
                                                          m.soft,
                                                          4,
                                                          centre,
                                                          radius,
                                                          mass,
                                                          {inertia, inertia, inertia},
                                                          0,
                                                          NULL});
        add_body(w, shape, vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0));
        assert_int_equal(clast_world_prepare(w), CLAST_OK);
        CHECK_CLOSE(clast_world_plan(w).contact_time, PI * sqrt(0.5 * mass / 3 / pair.stiffness),
                    1e-12);
        clast_world_free(w);
    }
}

/* A cone of a row: spheres of falling size on a line, which lies on its side. */
static void a_tapered_row_lands_on_its_side(void **state) {
    (void)state;
    enum { ROW = 5 };
    clast_world_def def = bare_def(CLAST_LAW_LINEAR);
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(1, 0);
    two_materials m = add_materials(w, &pair);
    clast_vec3 centre[ROW];
    double radius[ROW], mass = 2e-3, inertia = 1e-6; /* slow to turn: the centre's motion counts */
    for (int i = 0; i < ROW; i++)
        centre[i] = vec(0.004 * (i - 2), 0, 0), radius[i] = 0.005 - 0.0006 * i;
    int shape = clast_shape_add(
        w, &(clast_shape_def){
               "cone", m.soft, ROW, centre, radius, mass, {inertia, inertia, inertia}, 0, NULL});
    add_body(w, shape, vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0));
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    CHECK_CLOSE(clast_world_plan(w).contact_time, PI * sqrt(0.5 * mass / ROW / pair.stiffness),
                1e-3);
    clast_world_free(w);
}

static void time_is_counted_not_summed(void **state) {
    (void)state;
    clast_world *w = chain_world(1, 0.2, 1);
    steps(w, 12345);
    assert_true(clast_world_time(w) == 12345 * clast_world_time_step(w));
    double t = clast_world_time(w), dt = clast_world_time_step(w);
    run_to(w, t + 10 * dt);
    assert_true(clast_world_steps(w) == 12355);
    run_to(w, t); /* the past is no reason to step */
    assert_true(clast_world_steps(w) == 12355);
    clast_world_free(w);
}

TEST_MAIN(cmocka_unit_test(rayleigh_steps_of_the_chains),
          cmocka_unit_test(auto_takes_the_smaller_limit),
          cmocka_unit_test(contact_time_is_that_of_a_collision),
          cmocka_unit_test(the_impact_speed_of_a_fall),
          cmocka_unit_test(the_critical_step_is_the_limit_of_stability),
          cmocka_unit_test(a_ball_that_sticks_rolls_on_its_spring),
          cmocka_unit_test(so_it_does_between_two_plates),
          cmocka_unit_test(hertzian_spheres_stick_as_mindlin_says),
          cmocka_unit_test(the_automatic_step_keeps_below_the_limit),
          cmocka_unit_test(a_lever_that_sticks_by_brute_force),
          cmocka_unit_test(a_chain_is_lighter_than_its_mass),
          cmocka_unit_test(overlapping_spheres_have_less_mass_each),
          cmocka_unit_test(an_arm_makes_a_contact_lighter),
          cmocka_unit_test(a_clump_lands_on_its_sides),
          cmocka_unit_test(a_tapered_row_lands_on_its_side),
          cmocka_unit_test(time_is_counted_not_summed))
