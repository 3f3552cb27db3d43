/* Loads in fixed point: what they keep exactly, what they resolve, what they refuse; and kernels
 * that leave out what a scene does not need, against those that do not. */
#include "tests/support/scene.h"

#include <unistd.h>

#include "engine/numbers.h"
#include "engine/world.h"

static const double R = 0.004;

static clast_vec3 weight(double g) {
    return vec(0, 0, -g);
}

/* ---- momentum -------------------------------------------------------------------------------- */

/* Sums of the loads in quanta; only forces have to cancel (torques are taken about each body). */
static void sum_quanta(const clast_world *w, int64_t sum[3]) {
    uint64_t wrapped[3] = {0, 0, 0};
    for (size_t i = 0; i < w->bodies.count; i++)
        for (int k = 0; k < 3; k++) wrapped[k] += (uint64_t)w->rows.loads[i].force[k];
    for (int t = 0; t < w->threads; t++)
        for (size_t i = 0; i < w->shares[t].overhang_count; i++)
            for (int k = 0; k < 3; k++) wrapped[k] += (uint64_t)w->shares[t].overhang[i].force[k];
    for (int k = 0; k < 3; k++) sum[k] = (int64_t)wrapped[k];
}

static int64_t largest_quanta(const clast_world *w) {
    int64_t most = 0;
    for (size_t i = 0; i < w->bodies.count; i++)
        for (int k = 0; k < 3; k++) {
            int64_t q = w->rows.loads[i].force[k];
            if ((q < 0 ? -q : q) > most) most = q < 0 ? -q : q;
        }
    return most;
}

/* Sizes from 1 to 5, two materials, clumps or spheres, without walls. */
static clast_world *colliding_cloud(int threads, clast_precision precision, bool clumps,
                                    uint64_t seed) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.threads = threads, def.spheres_per_thread = 1, def.precision = precision,
    def.time_step = 5e-6;
    def.max_overlap = 0.9;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.6, 0.4);
    two_materials m = add_materials(w, &pair);
    int shapes[2] = {clast_shape_add_sphere(w, "ball", R, m.soft),
                     clumps ? add_uneven_rod(w, m.hard, .6 * R)
                            : clast_shape_add_sphere(w, "small", .2 * R, m.hard)};
    dice d = {seed, 0};
    for (int i = 0; i < 125; i++) {
        clast_vec3 at = times(2.3 * R, vec(i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2));
        clast_body_def b = {shapes[i % 2],
                            at,
                            any_orientation(&d),
                            plus(times(-60, at), vec(roll(&d, -1, 1), roll(&d, -1, 1), 0)),
                            {roll(&d, -99, 99), roll(&d, -99, 99), roll(&d, -99, 99)}};
        assert_true(clast_body_add(w, &b) >= 0);
    }
    return w;
}

static void contacts_make_no_momentum(void **state) {
    (void)state;
    for (uint64_t kind = 0; kind < 8; kind++) {
        clast_precision precision = kind & 1 ? CLAST_PRECISION_MIXED : CLAST_PRECISION_DOUBLE;
        clast_world *w = colliding_cloud(kind & 2 ? 3 : 1, precision, kind & 4, 40 + kind);
        int64_t most = 0;
        size_t contacts = 0;
        for (int i = 0; i < 800; i++) {
            steps(w, 1);
            int64_t sum[3], now = largest_quanta(w);
            sum_quanta(w, sum);
            if (sum[0] != 0 || sum[1] != 0 || sum[2] != 0)
                fail_msg("kind %llu, step %d: quanta left over: %lld %lld %lld",
                         (unsigned long long)kind, i, (long long)sum[0], (long long)sum[1],
                         (long long)sum[2]);
            most = now > most ? now : most;
            contacts += clast_world_counters(w).contacts;
        }
        assert_true(contacts > 1000 && most > (int64_t)1 << 40);
        clast_world_free(w);
    }
}

/* ---- resolution ------------------------------------------------------------------------------ */

typedef struct resting {
    double young, density, radius;
    double other_radius; /* of a second shape in the scene: sets the quanta */
    clast_guard_mode guards;
} resting;

/* Half a quantum of the loads against the weight of the (small) sphere, and what a sphere that has
 * come to rest shows of it. */
static double resolution_of(const resting *r, double *at_rest) {
    clast_world_def def = clast_world_def_default();
    def.threads = 1, def.guards = r->guards, def.impact_speed = 0.1, def.global_damping = 0;
    clast_world *w = new_world(&def);
    int m = clast_material_add(w, &(clast_material_def){"m", r->density, r->young, 0.29});
    clast_pair_def pair = {.restitution = 0.3, .friction = 0.3};
    assert_int_equal(clast_pair_set(w, m, m, &pair), CLAST_OK);
    int ball = clast_shape_add_sphere(w, "ball", r->radius, m);
    if (r->other_radius > 0) clast_shape_add_sphere(w, "other", r->other_radius, m);
    add_plane(w, clast_part_add(w, &(clast_part_def){.name = "floor"}), m, vec(0, 0, 0),
              vec(0, 0, 1));
    double mass = r->density * 4 / 3 * NUMBER_PI * pow(r->radius, 3), force = mass * 9.81;
    double e_star = 0.5 * r->young / (1 - .29 * .29);
    double overlap = pow(0.75 * force / (e_star * sqrt(r->radius)), 2.0 / 3);
    add_body(w, ball, vec(0, 0, r->radius - overlap), vec(0, 0, 0), vec(0, 0, 0));
    steps(w, 20000);
    clast_contact c;
    assert_int_equal(clast_world_contacts(w, &c, 1), 1);
    *at_rest = c.force.z / force - 1;
    double half = 0.5 * w->load_scale.force_quantum / force;
    clast_world_free(w);
    return half;
}

static void a_weight_is_resolved(void **state) {
    (void)state;
    const resting steel = {210e9, 7850, 0.005, 0, CLAST_GUARD_STOP};
    const resting glass = {70e9, 2500, 0.0005, 0, CLAST_GUARD_STOP};
    double rest, half = resolution_of(&steel, &rest);
    print_message("steel, 10 mm: half a quantum is %.1e of the weight, force at rest off by %.1e\n",
                  half, rest);
    CHECK_BELOW(half, 1e-11);
    CHECK_NEAR(rest, 0, 1e-10);
    half = resolution_of(&glass, &rest);
    print_message("glass, 1 mm: %.1e, off by %.1e\n", half, rest);
    CHECK_BELOW(half, 1e-10);
    CHECK_NEAR(rest, 0, 1e-9);
}

/* Quanta go with the largest sphere squared, weights with the radius cubed. */
static void a_small_sphere_beside_a_large_one(void **state) {
    (void)state;
    for (int report = 0; report < 2; report++) {
        clast_guard_mode guards = report ? CLAST_GUARD_REPORT : CLAST_GUARD_STOP;
        const resting grain = {210e9, 7850, 0.0001, 0.005, guards};
        double rest, half = resolution_of(&grain, &rest);
        print_message("steel, 0.2 mm beside 10 mm%s: half a quantum is %.1e of the weight, force "
                      "at rest off by %.1e\n",
                      report ? ", guards report" : "", half, rest);
        CHECK_BELOW(half, report ? 1e-3 : 1e-5);
        CHECK_NEAR(rest, 0, report ? 1e-3 : 1e-5);
    }
}

/* One collision of two grains, in a world whose quanta are set by boulders of 50 times the size and
 * by a stiff material, against one in a world of its own. */
static clast_vec3 grains_after(bool with_boulder, clast_precision precision, clast_vec3 *spin) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.time_step = 2e-7, def.precision = precision, def.max_overlap = 0.05;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.6, 0.4);
    two_materials m = add_materials(w, &pair);
    int grain = clast_shape_add_sphere(w, "grain", 1e-4, m.soft);
    if (with_boulder) {
        int steel = clast_material_add(w, &(clast_material_def){"steel", 7850, 210e9, 0.29});
        assert_int_equal(clast_pair_set(w, steel, steel, &pair), CLAST_OK);
        assert_int_equal(clast_pair_set(w, steel, m.soft, &pair), CLAST_OK);
        clast_shape_add_sphere(w, "boulder", 5e-3, steel);
    }
    add_body(w, grain, vec(0, 0, 0), vec(0.02, 0, 0.03), vec(0, 20, 5));
    add_body(w, grain, vec(2.001e-4, 2e-5, 1e-5), vec(-0.03, 0, 0), vec(3, 0, 9));
    steps(w, 1500);
    assert_int_equal(contact_count(w), 0);
    *spin = body_of(w, 0).spin;
    clast_vec3 v = body_of(w, 0).velocity;
    clast_world_free(w);
    return v;
}

static void small_contacts_beside_stiff_boulders(void **state) {
    (void)state;
    for (int mixed = 0; mixed < 2; mixed++) {
        clast_precision precision = mixed ? CLAST_PRECISION_MIXED : CLAST_PRECISION_DOUBLE;
        clast_vec3 own, beside, v = grains_after(false, precision, &own);
        clast_vec3 dv = minus(grains_after(true, precision, &beside), v);
        double off = norm(dv) / 0.05, spin = norm(minus(beside, own)) / norm(own);
        print_message("%s: grains beside a boulder of 50 times their size and 30 000 times their "
                      "stiffness: velocity off by %.1e, spin by %.1e\n",
                      mixed ? "mixed" : "double", off, spin);
        assert_true(off > 0);
        CHECK_BELOW(off, 1e-5);
        CHECK_BELOW(spin, 1e-3);
    }
}

/* ---- too large for the loads ----------------------------------------------------------------- */

/* Hits a plane at a speed whose dashpot alone is beyond the limit. */
static clast_world *hard_hit(clast_guard_mode guards, double speed, clast_precision precision) {
    clast_world_def def = bare_def(CLAST_LAW_LINEAR);
    def.guards = guards, def.max_overlap = 0.01, def.max_displacement = 1e9;
    def.max_residual = 1e9, def.precision = precision, def.time_step = 1e-9;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.1, 0.3);
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", R, m.soft);
    add_plane(w, clast_part_add(w, &(clast_part_def){.name = "floor"}), m.hard, vec(0, 0, 0),
              vec(0, 0, 1));
    add_body(w, ball, vec(0, 0, R + 1e-10 * speed), vec(0, 0, -speed), vec(0, 0, 0));
    return w;
}

static void a_force_beyond_the_limit_stops_the_run(void **state) {
    (void)state;
    for (int mixed = 0; mixed < 2; mixed++)
        for (double speed = 1e4; speed < 1e11; speed *= 1e2) {
            clast_world *w = hard_hit(CLAST_GUARD_STOP, speed, (clast_precision)mixed);
            clast_status status = CLAST_OK;
            for (int i = 0; i < 5 && status == CLAST_OK; i++) status = clast_world_step(w);
            assert_int_equal(status, CLAST_ERR_GUARD);
            const char *text = clast_world_error(w);
            if (!strstr(text, "body 0")) fail_msg("speed %g: %s", speed, text);
            assert_int_equal(clast_world_step(w), CLAST_ERR_GUARD);
            clast_world_free(w);
        }
}

static void a_force_beyond_the_limit_is_reported(void **state) {
    (void)state;
    for (int mixed = 0; mixed < 2; mixed++)
        for (double speed = 1e4; speed < 1e11; speed *= 1e2) {
            clast_world *w = hard_hit(CLAST_GUARD_REPORT, speed, (clast_precision)mixed);
            for (int i = 0; i < 30; i++) assert_int_equal(clast_world_step(w), CLAST_OK);
            assert_true(clast_world_counters(w).guard_trips > 0);
            clast_world_free(w);
        }
}

/* Many bodies on top of each other, so that sums wrap. */
static void a_heap_at_one_place_is_reported(void **state) {
    (void)state;
    for (int law = 0; law < 3; law++) {
        clast_world_def def = bare_def((clast_law)law);
        def.guards = CLAST_GUARD_REPORT, def.max_overlap = 1e3, def.time_step = 1e-4;
        clast_world *w = new_world(&def);
        clast_pair_def pair = pair_of(0.5, 0.5);
        int ball = clast_shape_add_sphere(w, "ball", R, add_materials(w, &pair).hard);
        dice d = {3, 0};
        for (int i = 0; i < 60; i++)
            add_body(w, ball, vec(roll(&d, 0, 1e-6), roll(&d, 0, 1e-6), roll(&d, 0, 1e-6)),
                     vec(roll(&d, -1e5, 1e5), 0, 0), vec(0, 0, 0));
        for (int i = 0; i < 50; i++) assert_int_equal(clast_world_step(w), CLAST_OK);
        assert_true(clast_world_counters(w).guard_trips > 0);
        clast_world_free(w);
    }
}

/* ---- scenes whose kernel leaves something out ------------------------------------------------ */

typedef struct twin {
    clast_law law;
    clast_precision precision;
    clast_motion motion;
    int threads;
    clast_isa isa;
    double friction, cohesion;
    bool keep_tangent; /* a pair with friction that nothing uses */
    bool keep_depth;   /* a wall across the plane, far away */
    bool keep_clumps;  /* a shape that nothing uses: a clump */
    bool keep_kinds;   /* likewise: a sphere of another size */
} twin;

static void add_twin_walls(clast_world *w, int hard, bool depth) {
    int tray = clast_part_add(w, &(clast_part_def){.name = "tray"});
    add_plane(w, tray, hard, vec(0, 0, 0), vec(0, 0, 1));
    add_plane(w, tray, hard, vec(-.03, 0, 0), vec(1, 0, 0.1));
    add_plane(w, tray, hard, vec(.03, 0, 0), vec(-1, 0, 0.1));
    clast_wall_def belt = {"belt",
                           CLAST_WALL_PLATE,
                           hard,
                           .normal = {0, 0, 1},
                           .point = {0, 0, 1e-4},
                           .side = {1, 0, 0},
                           .half_side = {0.008, 0.05},
                           .belt_velocity = {0.3, 0, 0}};
    assert_true(clast_wall_add(w, tray, &belt) >= 0);
    if (depth) add_plane(w, tray, hard, vec(0, -1, 0), vec(0, 1, 0));
}

static clast_world *new_twin(const twin *t) {
    clast_world_def def = bare_def(t->law);
    def.gravity = weight(9.81), def.motion = t->motion, def.threads = t->threads,
    def.spheres_per_thread = 1;
    def.precision = t->precision, def.isa = t->isa, def.time_step = 2e-5;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.5, t->friction);
    pair.cohesion = t->cohesion;
    two_materials m = add_materials(w, &pair);
    if (t->keep_tangent) {
        int unused = clast_material_add(w, &(clast_material_def){"unused", 1000, 1e6, 0.3});
        clast_pair_def rough = pair_of(0.5, 0.9);
        assert_int_equal(clast_pair_set(w, unused, unused, &rough), CLAST_OK);
    }
    int ball = clast_shape_add_sphere(w, "ball", R, m.soft);
    if (t->keep_clumps) add_rod(w, m.soft, R);
    if (t->keep_kinds) clast_shape_add_sphere(w, "other", 1.0001 * R, m.soft);
    add_twin_walls(w, m.hard, t->keep_depth);
    dice d = {21, 0};
    bool flat = t->motion == CLAST_MOTION_IN_PLANE;
    for (int i = 0; i < 40; i++) {
        clast_vec3 at = {.0085 * (i % 6 - 2.5), flat ? 0 : roll(&d, -1e-3, 1e-3),
                         .0045 + .0085 * (i / 6)};
        add_body(w, ball, at, vec(roll(&d, -.2, .2), 0, -.4), vec(0, roll(&d, -30, 30), 0));
    }
    return w;
}

static bool same_vec(clast_vec3 a, clast_vec3 b) {
    return memcmp(&a, &b, sizeof a) == 0;
}

static bool same_bodies(clast_world *a, clast_world *b, int *which) {
    for (*which = 0; *which < 40; ++*which) {
        body_state x = body_of(a, *which), y = body_of(b, *which);
        if (!same_vec(x.position, y.position) || !same_vec(x.velocity, y.velocity) ||
            !same_vec(x.spin, y.spin))
            return false;
    }
    return true;
}

static void expect_same_bits(clast_world *a, clast_world *b, const char *what) {
    if (clast_world_hash(a) == clast_world_hash(b)) return;
    int id;
    unsigned long long step = clast_world_steps(a);
    if (same_bodies(a, b, &id))
        fail_msg("%s, step %llu: bodies are equal, histories or books are not", what, step);
    body_state x = body_of(a, id), y = body_of(b, id);
    fail_msg("%s, step %llu: body %d is off by %g m, %g m/s, %g rad/s", what, step, id,
             norm(minus(x.position, y.position)), norm(minus(x.velocity, y.velocity)),
             norm(minus(x.spin, y.spin)));
}

static twin twin_of(int kind, clast_motion motion) {
    return (twin){.law = (clast_law)(kind % 3),
                  .motion = motion,
                  .threads = 1,
                  .friction = 0.4,
                  .precision = kind / 3 ? CLAST_PRECISION_MIXED : CLAST_PRECISION_DOUBLE};
}

static void one_layer_has_the_bits_of_three_dimensions(void **state) {
    (void)state;
    for (int kind = 0; kind < 6; kind++)
        for (int rough = 0; rough < 2; rough++) {
            twin t = twin_of(kind, CLAST_MOTION_IN_PLANE);
            t.friction = 0.4 * rough;
            clast_world *flat = new_twin(&t);
            t.keep_depth = true;
            clast_world *deep = new_twin(&t);
            size_t most = 0;
            for (int i = 0; i < 30; i++) {
                steps(flat, 100), steps(deep, 100);
                expect_same_bits(flat, deep, "flat against deep");
                most = contact_count(flat) > most ? contact_count(flat) : most;
            }
            assert_non_null(strstr(clast_world_plan(flat).kernel, "one layer"));
            assert_null(strstr(clast_world_plan(deep).kernel, "one layer"));
            assert_true(most > 20);
            clast_world_free(flat), clast_world_free(deep);
        }
}

static void no_friction_has_the_bits_of_mu_zero(void **state) {
    (void)state;
    for (int kind = 0; kind < 12; kind++) {
        twin t = twin_of(kind % 6, kind < 6 ? CLAST_MOTION_3D : CLAST_MOTION_IN_PLANE);
        t.friction = 0;
        clast_world *smooth = new_twin(&t);
        t.keep_tangent = true;
        clast_world *general = new_twin(&t);
        for (int i = 0; i < 30; i++) {
            steps(smooth, 100), steps(general, 100);
            expect_same_bits(smooth, general, "no friction against mu = 0");
        }
        clast_world_free(smooth), clast_world_free(general);
    }
}

/* A cohesion that is nothing keeps springs that are nothing: bodies are equal, springs are not. */
static void no_friction_against_a_cohesion_of_nothing(void **state) {
    (void)state;
    twin t = twin_of(1, CLAST_MOTION_3D);
    t.friction = 0;
    clast_world *smooth = new_twin(&t);
    t.cohesion = 1e-200;
    clast_world *sticky = new_twin(&t);
    steps(smooth, 3000), steps(sticky, 3000);
    int id;
    if (!same_bodies(smooth, sticky, &id)) fail_msg("body %d differs", id);
    clast_world_free(smooth), clast_world_free(sticky);
}

static void friction_off_and_on_again(void **state) {
    (void)state;
    for (int kind = 0; kind < 12; kind++) {
        twin t = twin_of(kind % 6, kind < 6 ? CLAST_MOTION_3D : CLAST_MOTION_IN_PLANE);
        clast_world *changes = new_twin(&t);
        t.keep_tangent = true;
        clast_world *general = new_twin(&t);
        for (int phase = 0; phase < 6; phase++) {
            double mu = phase % 2 ? 0 : 0.4;
            for (int a = 0; a < 2; a++)
                for (int b = 0; b < 2; b++) {
                    assert_int_equal(clast_pair_set_friction(changes, a, b, mu), CLAST_OK);
                    assert_int_equal(clast_pair_set_friction(general, a, b, mu), CLAST_OK);
                }
            for (int i = 0; i < 5; i++) {
                steps(changes, 97), steps(general, 97);
                expect_same_bits(changes, general, "friction off and on");
            }
        }
        clast_world_free(changes), clast_world_free(general);
    }
}

/* One kind of sphere, spheres among others, and spheres as clumps of one: rounded elsewhere, equal
 * otherwise. */
static void kinds_and_clumps_agree(void **state) {
    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        twin t = twin_of(kind, CLAST_MOTION_3D);
        clast_world *one = new_twin(&t);
        t.keep_kinds = true;
        clast_world *kinds = new_twin(&t);
        t.keep_kinds = false, t.keep_clumps = true;
        clast_world *clumps = new_twin(&t);
        steps(one, 500), steps(kinds, 500), steps(clumps, 500);
        assert_true(contact_count(one) > 3);
        for (int id = 0; id < 40; id++) {
            body_state a = body_of(one, id), b = body_of(kinds, id), c = body_of(clumps, id);
            CHECK_NEAR(norm(minus(a.position, b.position)), 0, 1e-11);
            CHECK_NEAR(norm(minus(a.position, c.position)), 0, 1e-11);
            CHECK_NEAR(norm(minus(a.spin, b.spin)), 0, 1e-6);
            CHECK_NEAR(norm(minus(a.spin, c.spin)), 0, 1e-6);
        }
        clast_world_free(one), clast_world_free(kinds), clast_world_free(clumps);
    }
}

/* ---- mixed precision ------------------------------------------------------------------------- */

/* Saved and loaded half way, also with another number of threads. */
static void mixed_precision_restarts(void **state) {
    (void)state;
    scratch_name file = scratch_file("loads");
    for (int kind = 0; kind < 12; kind++) {
        twin t = twin_of(kind % 6, kind < 6 ? CLAST_MOTION_3D : CLAST_MOTION_IN_PLANE);
        clast_world *whole = new_twin(&t), *half = new_twin(&t);
        steps(whole, 1400), steps(half, 700);
        assert_int_equal(clast_checkpoint_save(half, file.text, NULL), CLAST_OK);
        clast_world_free(half);
        t.threads = 1 + kind % 4;
        clast_world *again = new_twin(&t);
        if (clast_checkpoint_load(again, file.text, NULL)) fail_msg("%s", clast_world_error(again));
        steps(again, 700);
        expect_same_bits(whole, again, "restart");
        clast_world_free(whole), clast_world_free(again);
    }
    unlink(file.text);
}

/* ---- the start ------------------------------------------------------------------------------- */

/* Bodies that touch, and move, when the world begins: dashpots feel them as they are given. */
static clast_world *begun_in_touch(void) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0, 0, -9.81), def.time_step = 1e-5;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.4, 0.3);
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", R, m.soft);
    for (int i = 0; i < 8; i++)
        add_body(w, ball, vec(1.98 * R * i, 0, 0), vec(0.1 * (i % 3), 0.2 * (i % 2), 0),
                 vec(0, 3 * i, 0));
    return w;
}

/* Who reads contacts there changes nothing, and a checkpoint of it goes on with the same bits. */
static void the_start_is_a_state(void **state) {
    (void)state;
    uint64_t end[3];
    scratch_name file = scratch_file("start.h5");
    for (int k = 0; k < 3; k++) {
        clast_world *w = begun_in_touch();
        assert_int_equal(clast_world_prepare(w), CLAST_OK);
        if (k == 1) assert_int_equal(clast_world_contacts(w, NULL, 0), 7);
        if (k == 1) assert_int_equal(clast_checkpoint_save(w, file.text, NULL), CLAST_OK);
        if (k == 2 && clast_checkpoint_load(w, file.text, NULL))
            fail_msg("%s", clast_world_error(w));
        steps(w, 200);
        end[k] = clast_world_hash(w);
        clast_world_free(w);
    }
    remove(file.text);
    assert_true(end[0] == end[1] && end[1] == end[2]);
}

TEST_MAIN(cmocka_unit_test(contacts_make_no_momentum), cmocka_unit_test(a_weight_is_resolved),
          cmocka_unit_test(a_small_sphere_beside_a_large_one),
          cmocka_unit_test(small_contacts_beside_stiff_boulders),
          cmocka_unit_test(a_force_beyond_the_limit_stops_the_run),
          cmocka_unit_test(a_force_beyond_the_limit_is_reported),
          cmocka_unit_test(a_heap_at_one_place_is_reported),
          cmocka_unit_test(one_layer_has_the_bits_of_three_dimensions),
          cmocka_unit_test(no_friction_has_the_bits_of_mu_zero),
          cmocka_unit_test(no_friction_against_a_cohesion_of_nothing),
          cmocka_unit_test(friction_off_and_on_again), cmocka_unit_test(kinds_and_clumps_agree),
          cmocka_unit_test(mixed_precision_restarts), cmocka_unit_test(the_start_is_a_state))
