/* The laws beyond linear and Hertz-Mindlin, one by one: stiffness against its formula, a head-on
 * collision against the closed form or an adaptive integration, and what each keeps or forgets. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <unistd.h>

#include "engine/contact_law.h"
#include "engine/world.h"
#include "tests/support/bed.h"
#include "tests/support/collision.h"

static const double PI = 3.14159265358979323846;

/* ---- Maw and Hooke: linear laws whose stiffness follows from the contact ----------------------
 */

/* Force of the one contact that there is, of two bodies at rest, over its overlap. */
static double stiffness_found(clast_world *w) {
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    clast_contact k;
    assert_int_equal(clast_world_contacts(w, &k, 1), 1);
    return k.normal_force / k.overlap;
}

static clast_world *two_at_rest(const collision *c, bool alike, clast_precision precision) {
    clast_world_def def = bare_def(c->law);
    def.precision = precision;
    clast_world *w = new_world(&def);
    two_materials m = add_materials(w, &c->pair);
    int a = clast_shape_add_sphere(w, "a", c->radius_a, m.soft);
    int b = alike ? a : clast_shape_add_sphere(w, "b", c->radius_b, m.hard);
    add_body(w, a, vec(0, 0, 0.97 * c->radius_a), vec(0, 0, 0), vec(0, 0, 0));
    if (c->against_plane) {
        int ground = clast_part_add(w, &(clast_part_def){.name = "ground"});
        add_plane(w, ground, m.hard, vec(0, 0, 0), vec(0, 0, 1));
    } else {
        double r = alike ? c->radius_a : c->radius_b;
        add_body(w, b, vec(0, 0, -0.97 * r), vec(0, 0, 0), vec(0, 0, 0));
    }
    return w;
}

/* All ways into the lanes: spheres alike and not, walls; both precisions. */
static void stiffness_follows_from_the_contact(void **state) {
    (void)state;
    static const clast_law laws[2] = {CLAST_LAW_MAW, CLAST_LAW_HOOKE};
    for (int l = 0; l < 2; l++)
        for (int plane = 0; plane < 2; plane++)
            for (int precision = 0; precision < 2; precision++) {
                collision c = {.law = laws[l],
                               .pair = pair_of(1, 0.3),
                               .against_plane = plane,
                               .radius_a = 0.0031,
                               .radius_b = 0.0087};
                clast_world *w = two_at_rest(&c, false, (clast_precision)precision);
                CHECK_CLOSE(stiffness_found(w), contact_stiffness(&c), precision ? 1e-6 : 1e-13);
                clast_world_free(w);
            }
}

static void stiffness_of_spheres_alike(void **state) {
    (void)state;
    double r = 0.0041, m = 1130 * 4.0 / 3 * PI * r * r * r / 2, e = 7.3e6 / (2 * (1 - 0.37 * 0.37));
    collision c = {.law = CLAST_LAW_HOOKE, .pair = pair_of(1, 0.3), .radius_a = r};
    clast_world *w = two_at_rest(&c, true, CLAST_PRECISION_DOUBLE);
    CHECK_CLOSE(stiffness_found(w), 4.0 / 3 * e * r / 2, 1e-13);
    clast_world_free(w);
    c.law = CLAST_LAW_MAW;
    w = two_at_rest(&c, true, CLAST_PRECISION_DOUBLE);
    double root = sqrt(r / 2) * e; /* S12 2.29 at the 1 m/s of bare_def() */
    CHECK_CLOSE(stiffness_found(w), 16.0 / 15 * root * pow(15 * m / (16 * root), 0.2), 1e-13);
    clast_world_free(w);
}

/* What S12 2.29 is made for: at the speed it was worked out for, a linear contact as stiff as that
 * goes as deep as a Hertz contact, and stores as much. */
static void maw_goes_as_deep_as_hertz(void **state) {
    (void)state;
    collision c = {.law = CLAST_LAW_MAW, .pair = pair_of(1, 0), .speed = 1, .resolution = 3000};
    double linear = collide(&c).overlap_max;
    c.law = CLAST_LAW_HERTZ_MINDLIN;
    CHECK_CLOSE(linear, collide(&c).overlap_max, 1e-6);
}

/* S12 2.22 and 2.26 with the cut-off 2.23, as for the linear law (test_restitution.c). */
static void maw_and_hooke_collide_like_linear_springs(void **state) {
    (void)state;
    static const clast_law laws[2] = {CLAST_LAW_MAW, CLAST_LAW_HOOKE};
    for (int l = 0; l < 2; l++)
        for (double e = 0.35; e < 1; e += 0.3) {
            collision c = {.law = laws[l], .pair = pair_of(e, 0), .resolution = 3000};
            rebound r = collide(&c);
            double z = clast_damping_ratio(laws[l], e), w = sqrt(1 - z * z);
            double w0 = sqrt(contact_stiffness(&c) / r.effective_mass);
            CHECK_CLOSE(r.overlap_max, 0.83 / w0 * exp(-z / w * atan2(w, z)), 1e-3);
            CHECK_CLOSE(r.duration, (atan2(2 * z * w, 2 * z * z - 1) / w + 2 * z) / w0, 1e-3);
            CHECK_NEAR(r.restitution, e, 1e-3);
        }
}

/* ---- Walton-Braun ---------------------------------------------------------------------------- */

/* Mean over eight places within a step where the contact can begin. */
static double plastic_error(collision c, double resolution) {
    double sum = 0;
    c.resolution = resolution;
    for (int i = 0; i < 8; i++) {
        c.phase = 0.06 + 0.125 * i;
        sum += fabs(collide(&c).restitution - c.pair.restitution) / 8;
    }
    return sum;
}

/* S12 2.49-2.52: depth, plastic overlap, rebound, duration; the overlap that is left, delta_0, is
 * crossed at the speed of the rebound, and no force works there. */
static void walton_braun_has_a_closed_form(void **state) {
    (void)state;
    for (double e = 0.3; e <= 1; e += 0.35)
        for (int plane = 0; plane < 2; plane++) {
            collision c = {.law = CLAST_LAW_WALTON_BRAUN,
                           .pair = pair_of(e, 0),
                           .against_plane = plane,
                           .resolution = 4000};
            rebound r = collide(&c);
            double loading = sqrt(r.effective_mass / c.pair.stiffness), deep = 0.83 * loading;
            double left = (1 - e * e) * deep, force_lasts = 0.5 * PI * loading * (1 + e);
            CHECK_CLOSE(r.overlap_max, deep, 1e-5);
            CHECK_CLOSE(r.restitution, e, 2e-5);
            CHECK_CLOSE(r.duration, force_lasts + left / (e * 0.83), 1e-3);
        }
}

/* The largest overlap falls between two steps: the plastic part misses by the step squared. */
static void walton_braun_is_of_second_order(void **state) {
    (void)state;
    for (double e = 0.4; e < 0.9; e += 0.2) {
        collision c = {.law = CLAST_LAW_WALTON_BRAUN, .pair = pair_of(e, 0.3)};
        double coarse = plastic_error(c, 50), fine = plastic_error(c, 3200);
        print_message("Walton-Braun e %.2f: error %.1e at 50 steps per contact, %.1e at 3200, order"
                      " %.2f\n",
                      e, coarse, fine, order_of(coarse, fine, 64));
        CHECK_NEAR(order_of(coarse, fine, 64), 2, 0.1);
        CHECK_BELOW(coarse, 2e-3);
    }
}

/* One lane by hand: loads at k1, unloads and loads again at k2 below its largest overlap, goes on
 * at k1 beyond, and starts afresh once the spheres have parted. */
static void walton_braun_remembers_its_largest_overlap(void **state) {
    (void)state;
    static batch b;
    real overlap = 0, normal = 0, plastic = 0, k1 = 900, k2 = 2500;
    history_lanes h = {&overlap, &normal, NULL, NULL, NULL, &plastic};
    law_need need = {.linear = true};
    law_choice choice = {.dt = 1, .advance = 1};
    b.k_normal[0] = k2, b.mass[0] = 1, b.yield[0] = 1 - k1 / k2, b.n[2][0] = 1;
    static const double way[] = {0.1, 0.4, 1.0, 0.8, 0.7, 0.5, 0.66, 0.9, 1.2, 1.5, 1.3, 0, 0.3};
    double largest = 0, stored = 0, lost = 0, work = 0, before = 0, old = 0;
    for (size_t i = 0; i < sizeof way / sizeof *way; i++) {
        double d = way[i], left = (1 - k1 / k2) * fmax(largest, d);
        b.overlap[0] = b.depth[0] = d;
        yield_before(&b, h, 0);
        law_normal(&b, h, 0, choice, need);
        yield_after(&b, h, 0);
        largest = d > 0 ? fmax(largest, d) : 0;
        double want = d == largest ? k1 * d : fmax(0, k2 * (d - left));
        CHECK_NEAR(normal, want, 1e-10);
        assert_true(overlap == d && (d > 0 || plastic == 0));
        bool lasting = want > 0 && before > 0;
        if (lasting) work += 0.5 * (before + want) * (d - old);
        if (lasting) stored -= b.elastic[0], lost -= b.dashpot[0];
        before = want, old = d;
    }
    CHECK_NEAR(stored + lost, work, 1e-9); /* nothing is booked twice or not at all */
    CHECK_BELOW(0, lost);
}

/* ---- Hertz-Brilliantov ----------------------------------------------------------------------- */

typedef struct viscoelastic {
    double k, a, m; /* N/m^(3/2), s, kg */
} viscoelastic;

static int rates(double t, const double y[], double f[], void *params) {
    (void)t;
    const viscoelastic *c = params;
    double x = y[0] > 0 ? y[0] : 0;
    f[0] = y[1], f[1] = -c->k / c->m * (x * sqrt(x) + c->a * sqrt(x) * y[1]);
    return GSL_SUCCESS;
}

typedef struct reference {
    double restitution, overlap, force_ends; /* -, m, s */
} reference;

/* S12 2.37 by an adaptive eighth-order scheme; the steps between outputs shrink at the moment at
 * which the force would pull. */
static reference integrate(viscoelastic c, double v, double contact_time) {
    gsl_odeiv2_system system = {rates, NULL, 2, &c};
    double dt = contact_time / 4000, t = 0, y[2] = {0, v}, f[2];
    gsl_odeiv2_driver *d = gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, dt / 100,
                                                         1e-16 * contact_time * v, 1e-12);
    reference r = {0, 0, 0};
    for (;;) {
        double before[2] = {y[0], y[1]};
        gsl_odeiv2_driver_apply(d, &t, t + dt, y);
        rates(t, y, f, &c);
        r.overlap = fmax(r.overlap, y[0]);
        if (!(y[1] < 0 && f[1] >= 0)) continue;
        if (dt < 1e-7 * contact_time) break;
        t -= dt, dt /= 4, y[0] = before[0], y[1] = before[1];
        gsl_odeiv2_driver_reset_hstart(d, dt / 100);
    }
    gsl_odeiv2_driver_free(d);
    r.restitution = -y[1] / v, r.force_ends = t;
    return r;
}

static viscoelastic viscoelastic_of(const rebound *r, double a) {
    return (viscoelastic){4.0 / 3 * contact_modulus() * sqrt(r->effective_radius), a,
                          r->effective_mass};
}

/* Against the integration, at speeds over two decades: the rebound falls as the speed grows. */
static void brilliantov_rebounds_as_its_equation_says(void **state) {
    (void)state;
    double last = 1;
    for (double v = 0.02; v < 3; v *= 3.1) {
        collision c = {.law = CLAST_LAW_HERTZ_BRILLIANTOV,
                       .pair = pair_of(0, 0),
                       .speed = v,
                       .resolution = 4000,
                       .phase = 0.3};
        c.pair.dissipation = 2.3e-4;
        rebound r = collide(&c);
        reference want = integrate(viscoelastic_of(&r, 2.3e-4), v, contact_time(&c));
        print_message("Brilliantov at %.3f m/s: e %.5f, by integration %.5f\n", v, r.restitution,
                      want.restitution);
        CHECK_NEAR(r.restitution, want.restitution, 2e-4);
        CHECK_CLOSE(r.overlap_max, want.overlap, 3e-4); /* a dashpot half a step late */
        CHECK_BELOW(r.restitution, last - 0.01);
        double half_k = clast_restitution(
            CLAST_LAW_HERTZ_BRILLIANTOV,
            2.3e-4 /
                clast_dissipation(0.5, v, r.effective_mass, r.effective_radius, contact_modulus()) *
                clast_damping_ratio(CLAST_LAW_HERTZ_BRILLIANTOV, 0.5));
        CHECK_NEAR(half_k, want.restitution, 2e-6);
        last = r.restitution;
    }
}

static void brilliantov_converges(void **state) {
    (void)state;
    collision c = {
        .law = CLAST_LAW_HERTZ_BRILLIANTOV, .pair = pair_of(0, 0), .resolution = 100, .phase = 0.3};
    c.pair.dissipation = 2.3e-4;
    rebound coarse = collide(&c);
    double want = integrate(viscoelastic_of(&coarse, 2.3e-4), 0.83, contact_time(&c)).restitution;
    c.resolution = 800;
    double a = fabs(coarse.restitution - want), b = fabs(collide(&c).restitution - want);
    print_message("Brilliantov: error %.1e at 100 steps per contact, %.1e at 800, order %.2f\n", a,
                  b, order_of(a, b, 8));
    CHECK_BELOW(0.95, order_of(a, b, 8)); /* the dashpot's velocity is half a step old */
}

/* Solved for a rebound at one speed; a slower impact rebounds better. */
static void brilliantov_rebounds_as_asked(void **state) {
    (void)state;
    collision c = {.law = CLAST_LAW_HERTZ_BRILLIANTOV,
                   .pair = pair_of(0.7, 0),
                   .speed = 0.41,
                   .resolution = 4000};
    c.pair.reference_speed = 0.41;
    CHECK_NEAR(collide(&c).restitution, 0.7, 2e-4);
    c.speed = 0.1;
    CHECK_BELOW(0.75, collide(&c).restitution);
    c.pair.reference_speed = 0, c.speed = 1; /* the impact speed of bare_def() */
    CHECK_NEAR(collide(&c).restitution, 0.7, 2e-4);
}

/* ---- tangential force ------------------------------------------------------------------------ */

/* S12 2.34 with the sign of FACTS 1. */
static void the_tangential_dashpot_has_its_restitution(void **state) {
    (void)state;
    for (int l = 2; l < LAW_COUNT; l++) {
        if (LAWS[l] == CLAST_LAW_HERTZ_BRILLIANTOV) continue;
        clast_world_def def = bare_def(LAWS[l]);
        clast_world *w = new_world(&def);
        clast_pair_def pair = pair_of(0.8, 0.3);
        pair.tangential_restitution = 0.37, pair.tangential_ratio = 0.61;
        two_materials m = add_materials(w, &pair);
        clast_shape_add_sphere(w, "ball", 0.005, m.soft);
        assert_int_equal(clast_world_prepare(w), CLAST_OK);
        const pair_coef *c = &w->coefs[0];
        double k1 = LAWS[l] == CLAST_LAW_WALTON_BRAUN ? pair.stiffness : c->k_normal;
        double log_e = log(0.37);
        CHECK_CLOSE(c->k_tangent, 0.61 * k1, 1e-14);
        CHECK_CLOSE(c->c_tangent, -log_e * sqrt(4 * c->k_tangent / (PI * PI + log_e * log_e)),
                    1e-13);
        clast_world_free(w);
    }
}

/* With equal stiffness and restitution S12 takes c_t = c_n. */
static void the_viscous_dashpot_is_that_of_the_normal_one(void **state) {
    (void)state;
    clast_world_def def = bare_def(CLAST_LAW_HOOKE);
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.8, 0.3);
    two_materials m = add_materials(w, &pair);
    clast_shape_add_sphere(w, "ball", 0.005, m.soft);
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    assert_true(w->coefs[0].c_tangent == w->coefs[0].c_normal && w->coefs[0].c_normal > 0);
    clast_world_free(w);
}

/* S12 2.28 without sliding: the slip of a sphere (mass 2/7 m at the contact point) dies away as
 * exp(-7/2 c_t T / m) while an undamped contact lasts for T. */
static void a_viscous_contact_slows_the_slip(void **state) {
    (void)state;
    static const clast_law laws[3] = {CLAST_LAW_LINEAR, CLAST_LAW_HOOKE, CLAST_LAW_WALTON_BRAUN};
    for (int l = 0; l < 3; l++) {
        collision c = {.law = laws[l],
                       .tangent = CLAST_TANGENT_VISCOUS,
                       .pair = pair_of(1, 1e6),
                       .against_plane = true,
                       .speed = 0.002,
                       .angle = 0.5,
                       .resolution = 2000};
        c.pair.tangential_restitution = 0.8, c.pair.tangential_ratio = 0.9;
        rebound r = collide(&c);
        double log_e = log(0.8), k_t = 0.9 * contact_stiffness(&c), m = r.effective_mass;
        double c_t = -log_e * sqrt(4 * m * k_t / (PI * PI + log_e * log_e));
        double slip = r.velocity.x - r.spin.y * r.effective_radius;
        CHECK_CLOSE(slip / (0.002 * sin(0.5)), exp(-3.5 * c_t * contact_time(&c) / m), 1e-3);
    }
}

typedef struct spring_count {
    double length; /* N */
    size_t touching;
} spring_count;

static void count_springs(const clast_world *w, clast_law law, spring_count *n) {
    const contact_list *l = &w->shares[0].contacts;
    for (size_t k = 0; k < l->count; k++) {
        if (!contact_touches(w, l, k)) continue;
        history h = contact_history(w, l, k, false);
        n->length += norm(h.spring), n->touching++;
        assert_true(law == CLAST_LAW_WALTON_BRAUN ? h.plastic > 0 : h.plastic == 0);
    }
}

/* It has no spring, whatever the law, and with a spring whatever the law it has one. */
static void tangential_forces_combine_with_any_law(void **state) {
    (void)state;
    for (int l = 0; l < LAW_COUNT; l++)
        for (int spring = 0; spring < 2; spring++) {
            bed_wish wish = {.threads = 1,
                             .law = LAWS[l],
                             .bodies = 40,
                             .tangent = spring ? CLAST_TANGENT_SPRING : CLAST_TANGENT_VISCOUS};
            clast_world *w = bed_new(&wish);
            spring_count n = {0, 0};
            for (int i = 0; i < 8; i++) {
                run_to(w, 0.02 + 0.001 * i);
                count_springs(w, LAWS[l], &n);
            }
            assert_true(n.touching > 0 && (spring ? n.length > 0 : n.length == 0));
            clast_world_free(w);
        }
}

/* ---- restart --------------------------------------------------------------------------------- */

static uint64_t hash_at(clast_world *w, uint64_t step) {
    while (clast_world_steps(w) < step)
        if (clast_world_step(w)) fail_msg("%s", clast_world_error(w));
    return clast_world_hash(w);
}

/* Every law, with rolling friction, saved in the middle of the settling and loaded again. */
static void going_on_is_never_having_stopped(void **state) {
    (void)state;
    scratch_name file = scratch_file("laws");
    for (int l = 2; l < LAW_COUNT; l++) {
        bed_wish wish = {.threads = 1, .law = LAWS[l], .rolling = 0.07};
        if (l == LAW_COUNT - 2) wish.precision = CLAST_PRECISION_MIXED;
        clast_world *a = bed_new(&wish);
        hash_at(a, 900);
        assert_int_equal(clast_checkpoint_save(a, file.text, NULL), CLAST_OK);
        wish.threads = 2;
        clast_world *b = bed_new(&wish);
        if (clast_checkpoint_load(b, file.text, NULL)) fail_msg("%s", clast_world_error(b));
        assert_true(hash_at(b, 900) == hash_at(a, 900));
        assert_true(hash_at(b, 1500) == hash_at(a, 1500));
        clast_world_free(a), clast_world_free(b);
    }
    unlink(file.text);
}

/* The plastic overlap is in the hash. */
static void the_hash_sees_the_plastic_overlap(void **state) {
    (void)state;
    bed_wish wish = {.threads = 1, .law = CLAST_LAW_WALTON_BRAUN};
    clast_world *w = bed_new(&wish);
    uint64_t before = hash_at(w, 900);
    contact_list *l = &w->shares[0].contacts;
    size_t k = 0;
    while (k < l->count && !contact_touches(w, l, k)) k++;
    assert_true(k < l->count);
    ((double *)l->column[HISTORY_PLASTIC])[k] *= 1 + 1e-15;
    assert_true(clast_world_hash(w) != before);
    clast_world_free(w);
}

/* ---- the time step --------------------------------------------------------------------------- */

/* S12 2.22, 2.41, 2.52 for two spheres of the one kind that there is, at 1 m/s. */
static void the_plan_knows_how_long_contacts_last(void **state) {
    (void)state;
    double r = 0.0041, m = 1130 * 4.0 / 3 * PI * r * r * r / 2, e = 7.3e6 / (2 * (1 - 0.37 * 0.37));
    double maw = 16.0 / 15 * sqrt(r / 2) * e * pow(15 * m / (16 * sqrt(r / 2) * e), 0.2);
    double hertz = 2.9432751 * pow(15 * m / (16 * sqrt(r / 2) * e), 0.4);
    clast_pair_def pair = pair_of(0.6, 0);
    double k = pair.stiffness, yields = PI / 2 * sqrt(m / k) * 1.6; /* 2.52: 1 + e */
    double want[LAW_COUNT] = {
        hertz, hertz, PI * sqrt(m / k), PI * sqrt(m / maw), PI * sqrt(m / (2.0 / 3 * e * r)),
        hertz, yields};
    for (int l = 0; l < LAW_COUNT; l++) {
        clast_world_def def = bare_def(LAWS[l]);
        clast_world *w = new_world(&def);
        clast_shape_add_sphere(w, "ball", r, add_materials(w, &pair).soft);
        assert_int_equal(clast_world_prepare(w), CLAST_OK);
        clast_plan p = clast_world_plan(w);
        CHECK_CLOSE(p.contact_time, want[l], 1e-7);
        if (LAWS[l] == CLAST_LAW_WALTON_BRAUN)
            CHECK_CLOSE(p.critical_step, 2 * 0.6 * sqrt(m / k), 1e-13);
        clast_world_free(w);
    }
}

TEST_MAIN(cmocka_unit_test(stiffness_follows_from_the_contact),
          cmocka_unit_test(stiffness_of_spheres_alike), cmocka_unit_test(maw_goes_as_deep_as_hertz),
          cmocka_unit_test(maw_and_hooke_collide_like_linear_springs),
          cmocka_unit_test(walton_braun_has_a_closed_form),
          cmocka_unit_test(walton_braun_is_of_second_order),
          cmocka_unit_test(walton_braun_remembers_its_largest_overlap),
          cmocka_unit_test(brilliantov_rebounds_as_its_equation_says),
          cmocka_unit_test(brilliantov_converges), cmocka_unit_test(brilliantov_rebounds_as_asked),
          cmocka_unit_test(the_tangential_dashpot_has_its_restitution),
          cmocka_unit_test(the_viscous_dashpot_is_that_of_the_normal_one),
          cmocka_unit_test(a_viscous_contact_slows_the_slip),
          cmocka_unit_test(tangential_forces_combine_with_any_law),
          cmocka_unit_test(going_on_is_never_having_stopped),
          cmocka_unit_test(the_hash_sees_the_plastic_overlap),
          cmocka_unit_test(the_plan_knows_how_long_contacts_last))
