/* clump_contact: rebound, slide and torque of a body that touches at 1 to 9 spheres, with dashpots
 * shared and of each contact. */
#include "tests/support/scene.h"

enum { COUNTS = 5 };
static const int SPHERES[COUNTS] = {1, 2, 3, 5, 9};

/* Tolerances: of the linear law, whose rebound is that of the damping ratio, and of Hertz, whose
 * dashpots go with a power of the overlap that each contact has for itself. */
static const double TOLERANCE[2] = {0.01, 0.03};
static const clast_law LAW[2] = {CLAST_LAW_LINEAR, CLAST_LAW_HERTZ_MINDLIN};
static const char *const NAME[2] = {"linear", "hertz-mindlin"};

static const double PI = 3.14159265358979323846;
static const double R = 0.004, L = 0.012, M = 1.1e-3; /* m, m, kg */
static const double E = 0.55, SPEED = 0.1;            /* restitution; m/s */

typedef enum form { ROD, RAKE } form; /* spheres along x from end to end; side by side at one end */

typedef struct landing {
    int law;
    clast_clump_contact mode;
    form form;
    int spheres;
    double restitution, tilt; /* tilt: rad, x axis below the horizontal */
    double resolution;        /* 0 reads as 200 */
    clast_scheme scheme;
} landing;

/* Moments of the same body, however many spheres stand for it. */
static clast_vec3 moments(void) {
    return vec(0.4 * M * R * R, 0.5 * M * L * L, 0.52 * M * L * L);
}

static int add_clump(clast_world *w, int material, form kind, int n, clast_vec3 inertia) {
    clast_vec3 centre[128];
    double radius[128];
    assert_true(n <= 128);
    for (int i = 0; i < n; i++) {
        double place = n > 1 ? 2.0 * i / (n - 1) - 1 : 0; /* from -1 to 1 */
        centre[i] = kind == ROD ? vec(L * place, 0, 0) : vec(L, 0.6 * L * place, 0);
        radius[i] = R;
    }
    clast_shape_def def = {"clump", material, n, centre, radius, M, inertia, 0, NULL};
    int shape = clast_shape_add(w, &def);
    if (shape < 0) fail_msg("%s", clast_world_error(w));
    return shape;
}

static clast_world *new_landing(const landing *l) {
    clast_world_def def = bare_def(LAW[l->law]);
    def.clump_contact = l->mode, def.scheme = l->scheme;
    def.impact_speed = SPEED, def.rayleigh_fraction = 1;
    def.contact_resolution = l->resolution > 0 ? l->resolution : 200;
    def.max_residual = 1e9;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(l->restitution, 0);
    two_materials m = add_materials(w, &pair);
    int shape = add_clump(w, m.soft, l->form, l->spheres, moments());
    add_plane(w, clast_part_add(w, &(clast_part_def){.name = "floor"}), m.hard, vec(0, 0, 0),
              vec(0, 0, 1));
    double arm = l->form == ROD && l->spheres == 1 ? 0 : L;
    clast_body_def body = {shape,
                           {0, 0, 1.001 * R + arm * sin(l->tilt)},
                           clast_quat_axis_angle(vec(0, 1, 0), l->tilt),
                           {0, 0, -SPEED},
                           {0, 0, 0}};
    assert_true(clast_body_add(w, &body) >= 0);
    return w;
}

typedef struct rebound {
    double up;         /* of the centre, over the speed of the impact */
    double at_contact; /* of the lowest point, over that speed */
    double spin;       /* rad/s about y */
    double energy;     /* J, of motion afterwards over that before, less one */
    double damping;    /* J, as booked, over what is lost */
    double residual;   /* J, over the energy before */
    size_t touching;
} rebound;

static rebound land(const landing *l) {
    clast_world *w = new_landing(l);
    rebound r = {.up = 0};
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    double before = motion_energy(w);
    for (int i = 0; i < 100000; i++) {
        steps(w, 1);
        size_t now = contact_count(w);
        if (r.touching > 0 && now == 0) break;
        if (now > r.touching) r.touching = now;
    }
    assert_true(r.touching > 0 && contact_count(w) == 0);
    body_state b = body_of(w, 0);
    clast_energy e = clast_world_energy(w);
    double arm = l->form == ROD && l->spheres == 1 ? 0 : L;
    clast_vec3 end = vec(arm * cos(l->tilt), 0, -arm * sin(l->tilt));
    r.up = b.velocity.z / SPEED;
    r.at_contact = (b.velocity.z + cross(b.spin, end).z) / SPEED;
    r.spin = b.spin.y;
    r.energy = motion_energy(w) / before - 1;
    r.damping = e.damping / (before - motion_energy(w));
    r.residual = e.residual / before;
    clast_world_free(w);
    return r;
}

/* ---- flat ------------------------------------------------------------------------------------ */

static void a_flat_landing_rebounds_as_one_sphere(void **state) {
    (void)state;
    for (int law = 0; law < 2; law++)
        for (int i = 0; i < COUNTS; i++) {
            landing l = {law, CLAST_CLUMP_SHARED, ROD, SPHERES[i], E, 0, 0, CLAST_SCHEME_LEAPFROG};
            rebound r = land(&l);
            print_message("%s, %d touch: rebound %.4f of %.2f\n", NAME[law], SPHERES[i], r.up, E);
            assert_true(r.touching == (size_t)SPHERES[i]);
            CHECK_CLOSE(r.up, E, TOLERANCE[law]);
            CHECK_NEAR(r.damping, 1, 1e-3); /* of the ledger; 0.5 / 200^2 for the integration */
            CHECK_BELOW(fabs(r.residual), 1e-3);
        }
}

/* The masses that share a dashpot hang on positions alone, so any scheme may ask for forces. */
static void other_schemes_rebound_alike(void **state) {
    (void)state;
    static const clast_scheme schemes[4] = {CLAST_SCHEME_VELOCITY_VERLET, CLAST_SCHEME_GEAR4,
                                            CLAST_SCHEME_TRAPEZOID, CLAST_SCHEME_NUMEROV_CENTRAL};
    for (int law = 0; law < 2; law++)
        for (int i = 0; i < 4; i++) {
            landing l = {law, CLAST_CLUMP_SHARED, ROD, 5, E, 0, 0, schemes[i]};
            rebound r = land(&l);
            print_message("%s, %s: rebound %.4f of %.2f\n", NAME[law],
                          clast_scheme_info_of(schemes[i])->name, r.up, E);
            CHECK_CLOSE(r.up, E, TOLERANCE[law]);
        }
}

/* A00 3.4 and Fig. 3.11: every sphere damps for itself. n dashpots of one contact over the root of
 * n times its stiffness are a damping ratio that grows with the root of n: the rebound follows for
 * either law, since the tangent stiffness has that factor at every overlap. */
static void dashpots_of_each_contact_damp_more(void **state) {
    (void)state;
    for (int law = 0; law < 2; law++) {
        double ratio = clast_damping_ratio(LAW[law], E), last = 1;
        for (int i = 0; i < COUNTS; i++) {
            landing l = {law, CLAST_CLUMP_EACH, ROD, SPHERES[i], E, 0, 0, CLAST_SCHEME_LEAPFROG};
            rebound r = land(&l);
            double want = clast_restitution(LAW[law], sqrt(SPHERES[i]) * ratio);
            print_message("%s, %d touch: rebound %.4f, foreseen %.4f\n", NAME[law], SPHERES[i],
                          r.up, want);
            CHECK_NEAR(r.up, want, TOLERANCE[law] * E);
            CHECK_BELOW(r.up, last);
            last = r.up;
        }
    }
}

/* Struck at its end a rod is lighter than its mass: the damping ratio of the whole mass is too
 * large by the root of their ratio. */
static void dashpots_of_the_whole_mass_damp_more(void **state) {
    (void)state;
    for (int law = 0; law < 2; law++) {
        double arm = L * cos(0.5), lighter = 1 + M * arm * arm / moments().y;
        double want = clast_restitution(LAW[law], sqrt(lighter) * clast_damping_ratio(LAW[law], E));
        landing l = {law, CLAST_CLUMP_EACH, ROD, 2, E, 0.5, 0, CLAST_SCHEME_LEAPFROG};
        rebound r = land(&l);
        print_message("%s, on its end: rebound %.4f, foreseen %.4f\n", NAME[law], r.at_contact,
                      want);
        CHECK_NEAR(r.at_contact, want, TOLERANCE[law] * E);
    }
}

/* More contacts than one batch of the kernel holds, listed with a body. */
static void a_hundred_touch_at_once(void **state) {
    (void)state;
    for (int law = 0; law < 2; law++) {
        landing l = {law, CLAST_CLUMP_SHARED, ROD, 100, E, 0, 0, CLAST_SCHEME_LEAPFROG};
        rebound r = land(&l);
        assert_true(r.touching == 100);
        CHECK_CLOSE(r.up, E, TOLERANCE[law]);
    }
}

/* ---- tilted ---------------------------------------------------------------------------------- */

/* A rigid body struck at its end: impulse (1 + e) m_eff v with 1/m_eff = 1/m + L^2 cos^2 / I. */
static void check_impulse(const landing *l) {
    double arm = L * cos(l->tilt), inertia = moments().y;
    double mass = 1 / (1 / M + arm * arm / inertia), impulse = (1 + E) * mass * SPEED;
    rebound r = land(l);
    double up = impulse / (M * SPEED) - 1, spin = -impulse * arm / inertia;
    print_message("%s, %d touch, tilt %.1f: at the contact %.4f, centre %.4f of %.4f, spin %.3f of "
                  "%.3f rad/s\n",
                  NAME[l->law], (int)r.touching, l->tilt, r.at_contact, r.up, up, r.spin, spin);
    CHECK_CLOSE(r.at_contact, E, TOLERANCE[l->law]);
    CHECK_NEAR(r.up, up, TOLERANCE[l->law]); /* of the speed of the impact */
    CHECK_CLOSE(r.spin, spin, TOLERANCE[l->law]);
}

static void a_rod_lands_on_its_end(void **state) {
    (void)state;
    for (int law = 0; law < 2; law++)
        for (int i = 1; i < COUNTS; i++)
            for (int tilt = 0; tilt < 2; tilt++)
                check_impulse(&(landing){law, CLAST_CLUMP_SHARED, ROD, SPHERES[i], E,
                                         tilt ? 1.2 : 0.5, 0, CLAST_SCHEME_LEAPFROG});
}

/* 1 to 9 spheres side by side at the end strike at once. */
static void a_rake_lands_as_one_sphere_would(void **state) {
    (void)state;
    for (int law = 0; law < 2; law++)
        for (int i = 0; i < COUNTS; i++)
            check_impulse(&(landing){law, CLAST_CLUMP_SHARED, RAKE, SPHERES[i], E, 0.5, 0,
                                     CLAST_SCHEME_LEAPFROG});
}

typedef struct leaving {
    double up, spin, energy; /* of the speed of the impact; rad/s; of the energy before */
} leaving;

/* After the other end has struck too. */
static leaving leave(const landing *l) {
    clast_world *w = new_landing(l);
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    double before = motion_energy(w);
    run_to(w, 0.06);
    assert_true(contact_count(w) == 0);
    body_state b = body_of(w, 0);
    leaving r = {b.velocity.z / SPEED, b.spin.y, motion_energy(w) / before};
    clast_world_free(w);
    return r;
}

/* One end strikes, then the other: the spheres between them make no difference. */
static void both_ends_land_as_those_of_two_spheres(void **state) {
    (void)state;
    static const double tilts[3] = {0.06, 0.1, 0.2};
    for (int law = 0; law < 2; law++)
        for (int k = 0; k < 3; k++) {
            leaving want = {0, 0, 0};
            for (int i = 1; i < COUNTS; i++) {
                landing l = {law, CLAST_CLUMP_SHARED, ROD, SPHERES[i],
                             E,   tilts[k],           0,   CLAST_SCHEME_LEAPFROG};
                leaving r = leave(&l);
                if (i == 1) want = r;
                CHECK_CLOSE(r.up, want.up, TOLERANCE[law]);
                CHECK_CLOSE(r.spin, want.spin, TOLERANCE[law]);
                CHECK_CLOSE(r.energy, want.energy, TOLERANCE[law]);
            }
            print_message("%s, tilt %.2f: up at %.3f, spin %.2f rad/s, energy %.3f\n", NAME[law],
                          tilts[k], want.up, want.spin, want.energy);
        }
}

/* Nearly flat, the neighbour of the end touches while the end is pressed: a rod of more spheres is
 * another spring, also without damping. Of a rigid rod on springs F = K d^1.5 with the dashpot of
 * shared_lanes.h, integrated apart from the engine (steps of 0.5 us). */
static void nearly_flat_rods_are_other_springs(void **state) {
    (void)state;
    static const double undamped[COUNTS] = {0, 0.851, 0.851, 0.821, 0.836};
    static const double damped[COUNTS] = {0, 0.421, 0.421, 0.396, 0.391};
    static const double kept[COUNTS] = {0, 0.220, 0.220, 0.210, 0.214};
    for (int i = 1; i < COUNTS; i++) {
        landing l = {1, CLAST_CLUMP_SHARED, ROD, SPHERES[i], 1, 0.01, 0, CLAST_SCHEME_LEAPFROG};
        leaving free = leave(&l);
        l.restitution = E;
        leaving r = leave(&l);
        print_message("0.01 rad, %d spheres: undamped %.3f, damped %.3f, energy %.3f\n", SPHERES[i],
                      free.up, r.up, r.energy);
        CHECK_NEAR(free.up, undamped[i], 3e-3);
        CHECK_NEAR(r.up, damped[i], 3e-3);
        CHECK_NEAR(r.energy, kept[i], 3e-3);
    }
}

/* Ten onsets of which each may be off by 0.5 / n^2 of the energy at n = 400 steps per contact. */
static void without_damping_nothing_is_lost(void **state) {
    (void)state;
    double worst = 0;
    for (int law = 0; law < 2; law++)
        for (int i = 1; i < COUNTS; i++)
            for (int k = 0; k < 12; k++) {
                double tilt = k < 4 ? 1e-3 * k * k : 0.13 * (k - 3);
                landing l = {law, CLAST_CLUMP_SHARED,   ROD, SPHERES[i], 1, tilt,
                             400, CLAST_SCHEME_LEAPFROG};
                worst = fmax(worst, fabs(land(&l).energy));
            }
    print_message("undamped: energy off by %.1e\n", worst);
    CHECK_BELOW(worst, 10 * 0.5 / (400.0 * 400));
}

/* ---- against another body -------------------------------------------------------------------- */

/* A ball falls between the two spheres of a rod: normals that are not parallel. */
static double into_the_gap(int law, bool ball_first) {
    clast_world_def def = bare_def(LAW[law]);
    def.clump_contact = CLAST_CLUMP_SHARED;
    def.impact_speed = SPEED, def.rayleigh_fraction = 1, def.contact_resolution = 200;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(E, 0);
    two_materials m = add_materials(w, &pair);
    clast_vec3 centre[2] = {{-0.7 * R, 0, 0}, {0.7 * R, 0, 0}};
    double radius[2] = {R, R};
    clast_shape_def two = {"two", m.hard, 2, centre, radius, 2.3 * M, moments(), 0, NULL};
    int rod = clast_shape_add(w, &two), ball = clast_shape_add_sphere(w, "ball", R, m.soft);
    double height = sqrt(4 - 0.49) * R;
    for (int i = 0; i < 2; i++) {
        bool is_ball = (i == 0) == ball_first;
        add_body(w, is_ball ? ball : rod, vec(0, 0, is_ball ? 1.001 * height : 0),
                 vec(0, 0, is_ball ? -SPEED : 0), vec(0, 0, 0));
    }
    bool touched = false;
    for (int i = 0; i < 100000 && !(touched && contact_count(w) == 0); i++) {
        steps(w, 1);
        touched |= contact_count(w) == 2;
    }
    assert_true(touched);
    double apart = body_of(w, 0).velocity.z - body_of(w, 1).velocity.z;
    clast_world_free(w);
    return (ball_first ? apart : -apart) / SPEED;
}

static void two_normals_make_one_dashpot(void **state) {
    (void)state;
    for (int law = 0; law < 2; law++) {
        double e = into_the_gap(law, true), other = into_the_gap(law, false);
        print_message("%s: a ball between two spheres rebounds at %.4f of %.2f\n", NAME[law], e, E);
        CHECK_CLOSE(e, E, TOLERANCE[law]);
        assert_true(e == other);
    }
}

/* Where the ball swings after 50 steps, squeezed between the teeth of a fork; m/s across. */
static double between_teeth(int law, clast_clump_contact mode, double angle) {
    clast_world_def def = bare_def(LAW[law]);
    def.clump_contact = mode, def.impact_speed = SPEED;
    def.contact_resolution = 100, def.max_residual = 1e9;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(E, 0);
    two_materials m = add_materials(w, &pair);
    double away = 1.998 * R, x = away * sin(angle), radius[2] = {R, R};
    clast_vec3 teeth[2] = {vec(x, 0, 0), vec(-x, 0, 0)};
    clast_shape_def fork = {"fork", m.soft, 2, teeth, radius, M, moments(), 0, NULL};
    int shape = clast_shape_add(w, &fork), ball = clast_shape_add_sphere(w, "ball", R, m.soft);
    add_body(w, shape, vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0));
    add_body(w, ball, vec(0, 0, away * cos(angle)), vec(0.01 * SPEED, 0, 0), vec(0, 0, 0));
    steps(w, 50);
    double across = body_of(w, 1).velocity.x;
    clast_world_free(w);
    return across;
}

/* Normals that oppose each other leave no mass along their sum; each contact then has the dashpot
 * that it has for itself, bit by bit. */
static void opposing_normals_have_dashpots_of_their_own(void **state) {
    (void)state;
    static const double DEGREES[] = {80, 89.9, 90}; /* of the normals, from the fork's axis */
    for (int law = 0; law < 2; law++)
        for (int i = 0; i < 3; i++) {
            double angle = DEGREES[i] * PI / 180;
            double one = between_teeth(law, CLAST_CLUMP_SHARED, angle);
            assert_true(isfinite(one) && one != 0.01 * SPEED);
            assert_true(one == between_teeth(law, CLAST_CLUMP_EACH, angle));
        }
}

/* ---- sliding --------------------------------------------------------------------------------- */

/* m, down a slope of 30 degrees within 0.25 s. One sphere would roll, so it is hard to turn. */
static double slide(int law, int n) {
    clast_world_def def = bare_def(LAW[law]);
    def.clump_contact = CLAST_CLUMP_SHARED;
    def.gravity = vec(9.81 * sin(PI / 6), 0, -9.81 * cos(PI / 6));
    def.impact_speed = SPEED, def.rayleigh_fraction = 1, def.contact_resolution = 40;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(E, 0.3);
    two_materials m = add_materials(w, &pair);
    int shape = add_clump(w, m.soft, ROD, n, n > 1 ? moments() : times(1e6, moments()));
    add_plane(w, clast_part_add(w, &(clast_part_def){.name = "slope"}), m.hard, vec(0, 0, 0),
              vec(0, 0, 1));
    add_body(w, shape, vec(0, 0, R), vec(0, 0, 0), vec(0, 0, 0));
    run_to(w, 0.25);
    double way = body_of(w, 0).position.x, t = clast_world_time(w);
    clast_world_free(w);
    return way / (0.5 * 9.81 * (sin(PI / 6) - 0.3 * cos(PI / 6)) * t * t);
}

static void all_slide_alike(void **state) {
    (void)state;
    for (int law = 0; law < 2; law++)
        for (int i = 0; i < COUNTS; i++) {
            double way = slide(law, SPHERES[i]);
            print_message("%s, %d touch: slides %.4f of the formula\n", NAME[law], SPHERES[i], way);
            CHECK_NEAR(way, 1, TOLERANCE[law]);
        }
}

/* ---- rocking --------------------------------------------------------------------------------- */

/* A rod at rest on n spheres rocks without leaving the floor: with c / n at each of them a damped
 * oscillator, I a'' = -k sum x^2 a - c / n sum x^2 a'. Amplitude: a tenth of the overlap at rest,
 * which makes the shares of force uneven and leaves sum w x^2 as it is, to second order. */
static void rocking_is_damped(void **state) {
    (void)state;
    for (int i = 1; i < COUNTS; i++) {
        int n = SPHERES[i];
        clast_world_def def = bare_def(CLAST_LAW_LINEAR);
        def.clump_contact = CLAST_CLUMP_SHARED, def.gravity = vec(0, 0, -9.81);
        def.time_step = 4e-7;
        clast_world *w = new_world(&def);
        clast_pair_def pair = pair_of(E, 0);
        two_materials m = add_materials(w, &pair);
        int shape = add_clump(w, m.soft, ROD, n, moments());
        add_plane(w, clast_part_add(w, &(clast_part_def){.name = "floor"}), m.hard, vec(0, 0, 0),
                  vec(0, 0, 1));
        double rest = M * 9.81 / (n * pair.stiffness), squares = 0, inertia = moments().y;
        for (int k = 0; k < n; k++) squares += pow(L * (2.0 * k / (n - 1) - 1), 2);
        double c = 2 * clast_damping_ratio(CLAST_LAW_LINEAR, E) * sqrt(n * pair.stiffness * M);
        double square = pair.stiffness * squares / inertia, decay = c * squares / n / (2 * inertia);
        double omega = sqrt(square - decay * decay), spin = 0.1 * rest * omega / L;
        add_body(w, shape, vec(0, 0, R - rest), vec(0, 0, 0), vec(0, spin, 0));
        for (int k = 1; k <= 4; k++) {
            run_to(w, 1.5e-4 * k);
            double t = clast_world_time(w);
            double want = exp(-decay * t) * (cos(omega * t) - decay / omega * sin(omega * t));
            CHECK_NEAR(body_of(w, 0).spin.y / spin, want, 0.02);
        }
        print_message("%d touch: rocking falls to %.3f in %.1e s\n", n, exp(-decay * 6e-4), 6e-4);
        clast_world_free(w);
    }
}

/* ---- where there is nothing to share --------------------------------------------------------- */

static uint64_t hash_of_spheres(clast_clump_contact mode) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0, 0, -9.81);
    def.clump_contact = mode;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.5, 0.3);
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", R, m.soft);
    add_plane(w, clast_part_add(w, &(clast_part_def){.name = "floor"}), m.hard, vec(0, 0, 0),
              vec(0.1, 0, 1));
    for (int i = 0; i < 8; i++)
        add_body(w, ball, vec(0.0011 * i, 0.0007 * (i % 3), 2.1 * R * (i + 1)), vec(0, 0, 0),
                 vec(0, 0, 0));
    steps(w, 4000);
    assert_true(contact_count(w) > 0);
    uint64_t hash = clast_world_hash(w);
    clast_world_free(w);
    return hash;
}

static void single_spheres_see_no_difference(void **state) {
    (void)state;
    assert_true(hash_of_spheres(CLAST_CLUMP_EACH) == hash_of_spheres(CLAST_CLUMP_SHARED));
}

/* Laws without a dashpot that goes with the mass refuse clumps, and take spheres. */
static void other_laws_say_so(void **state) {
    (void)state;
    static const clast_law laws[2] = {CLAST_LAW_HERTZ_BRILLIANTOV, CLAST_LAW_WALTON_BRAUN};
    for (int k = 0; k < 4; k++) {
        clast_world_def def = bare_def(laws[k / 2]);
        def.clump_contact = CLAST_CLUMP_SHARED;
        clast_world *w = new_world(&def);
        clast_pair_def pair = pair_of(E, 0);
        two_materials m = add_materials(w, &pair);
        bool clump = k % 2;
        int shape = clump ? add_clump(w, m.soft, ROD, 3, moments())
                          : clast_shape_add_sphere(w, "ball", R, m.soft);
        add_body(w, shape, vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0));
        assert_int_equal(clast_world_prepare(w), clump ? CLAST_ERR_ARGUMENT : CLAST_OK);
        if (clump) assert_non_null(strstr(clast_world_error(w), "clump_contact"));
        clast_world_free(w);
    }
}

TEST_MAIN(cmocka_unit_test(a_flat_landing_rebounds_as_one_sphere),
          cmocka_unit_test(other_schemes_rebound_alike), cmocka_unit_test(rocking_is_damped),
          cmocka_unit_test(dashpots_of_each_contact_damp_more),
          cmocka_unit_test(dashpots_of_the_whole_mass_damp_more),
          cmocka_unit_test(a_hundred_touch_at_once), cmocka_unit_test(a_rod_lands_on_its_end),
          cmocka_unit_test(a_rake_lands_as_one_sphere_would),
          cmocka_unit_test(both_ends_land_as_those_of_two_spheres),
          cmocka_unit_test(nearly_flat_rods_are_other_springs),
          cmocka_unit_test(without_damping_nothing_is_lost),
          cmocka_unit_test(two_normals_make_one_dashpot),
          cmocka_unit_test(opposing_normals_have_dashpots_of_their_own),
          cmocka_unit_test(all_slide_alike), cmocka_unit_test(single_spheres_see_no_difference),
          cmocka_unit_test(other_laws_say_so))
