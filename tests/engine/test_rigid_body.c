/* Free rotation of a body with three different moments: what is kept over a million steps, and the
 * solution by elliptic functions (Landau and Lifshitz, Mechanics, section 37). */
#include <gsl/gsl_integration.h>
#include <gsl/gsl_sf_elljac.h>

#include "tests/support/scene.h"

static const double PI = 3.14159265358979323846;

/* x has the smallest, z the largest moment. */
static clast_world *top(double dt, clast_vec3 spin, clast_vec3 *inertia) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_A00);
    def.time_step = dt;
    def.max_displacement = 10;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(1, 0);
    two_materials m = add_materials(w, &pair);
    int shape = add_uneven_rod(w, m.soft, 0.005);
    *inertia = clast_world_shape(w, shape).inertia;
    add_body(w, shape, vec(0, 0, 0), vec(0, 0, 0), spin);
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    return w;
}

static clast_vec3 times_each(clast_vec3 a, clast_vec3 b) {
    return vec(a.x * b.x, a.y * b.y, a.z * b.z);
}

/* From the frame of the body to that of the world: v + 2 u x (u x v + w v). */
static clast_vec3 turned(clast_quat q, clast_vec3 v) {
    clast_vec3 u = vec(q.x, q.y, q.z);
    return plus(v, times(2, cross(u, plus(cross(u, v), times(q.w, v)))));
}

static clast_vec3 turned_back(clast_quat q, clast_vec3 v) {
    return turned((clast_quat){q.w, -q.x, -q.y, -q.z}, v);
}

/* ---- what is kept ---------------------------------------------------------------------------- */

enum { STEPS = 1000000, EVERY = 97, SAMPLES = STEPS / EVERY };

typedef struct flight {
    double momentum;    /* largest relative error of the vector L */
    double size;        /* of |L| */
    double energy;      /* largest relative error of the rotational energy */
    double first, last; /* the same in the first and in the last tenth of the flight */
    double drift;       /* of the energy from start to end, by least squares */
} flight;

/* Slope over the whole flight of samples at equal times. */
static double drift_of(const double *y, int n) {
    double top_sum = 0, bottom = 0;
    for (int i = 0; i < n; i++) {
        double x = (double)i / (n - 1) - 0.5;
        top_sum += x * y[i], bottom += x * x;
    }
    return top_sum / bottom;
}

static double largest_of(const double *y, int from, int to) {
    double most = 0;
    for (int i = from; i < to; i++) most = fmax(most, fabs(y[i]));
    return most;
}

static flight fly(double dt) {
    static double energy[SAMPLES];
    clast_vec3 inertia, spin = {3.1, 41, 0.7}; /* near the middle axis: it tumbles */
    clast_world *w = top(dt, spin, &inertia);
    clast_vec3 start = times_each(inertia, spin);
    flight f = {.momentum = 0};
    for (int i = 0; i < SAMPLES; i++) {
        steps(w, EVERY);
        body_state b = body_of(w, 0);
        clast_vec3 l =
            turned(b.orientation, times_each(inertia, turned_back(b.orientation, b.spin)));
        f.momentum = fmax(f.momentum, norm(minus(l, start)) / norm(start));
        f.size = fmax(f.size, fabs(norm(l) / norm(start) - 1));
        energy[i] = dot(l, b.spin) / dot(start, spin) - 1;
    }
    clast_world_free(w);
    f.energy = largest_of(energy, 0, SAMPLES);
    f.first = largest_of(energy, 0, SAMPLES / 10);
    f.last = largest_of(energy, SAMPLES - SAMPLES / 10, SAMPLES);
    f.drift = drift_of(energy, SAMPLES);
    return f;
}

/* The momentum is a constant of the world frame, so only rounding of the readings is left. The
 * splitting is symplectic and symmetric: the energy error is a bounded wave of second order. Ten
 * thousand samples of a wave say its slope to sqrt(12 / 10 000) = 3.5 % of its size even if they
 * were drawn by chance. */
static void a_million_steps_keep_momentum_and_energy(void **state) {
    (void)state;
    flight coarse = fly(6e-4), fine = fly(3e-4);
    const flight *both[2] = {&coarse, &fine};
    for (int i = 0; i < 2; i++) {
        const flight *f = both[i];
        print_message("|L| off by %.1e, L by %.1e; energy by %.2e (first tenth %.2e, last %.2e), "
                      "drift %.1e\n",
                      f->size, f->momentum, f->energy, f->first, f->last, f->drift);
        CHECK_BELOW(f->size, 1e-12);
        CHECK_BELOW(f->momentum, 1e-12);
        CHECK_NEAR(f->last / f->first, 1, 0.02);
        CHECK_BELOW(fabs(f->drift), 0.05 * f->energy);
    }
    print_message("order of the energy error %.3f\n", order_of(coarse.energy, fine.energy, 2));
    CHECK_NEAR(order_of(coarse.energy, fine.energy, 2), 2, 0.05);
}

/* ---- the solution ---------------------------------------------------------------------------- */

/* Spins in the frame of the body that start without a part about the middle axis. The axis that
 * the spin stays near is c, the other end of the scale a. */
typedef struct solution {
    double ia, ib, ic;      /* kg m2 */
    double wa, wb, wc;      /* rad/s, amplitudes of cn, sn, dn */
    double rate, parameter; /* rad/s, k^2 */
    double momentum;        /* J s */
    bool about_largest;     /* c is z, else x */
} solution;

static solution solve(clast_vec3 i, clast_vec3 spin) {
    double twice = i.x * spin.x * spin.x + i.z * spin.z * spin.z;
    double l2 = i.x * i.x * spin.x * spin.x + i.z * i.z * spin.z * spin.z;
    bool largest = l2 > twice * i.y;
    double a = largest ? i.x : i.z, b = i.y, c = largest ? i.z : i.x;
    return (solution){.ia = a,
                      .ib = b,
                      .ic = c,
                      .wa = sqrt((twice * c - l2) / (a * (c - a))),
                      .wb = sqrt((twice * c - l2) / (b * (c - b))),
                      .wc = sqrt((l2 - twice * a) / (c * (c - a))),
                      .rate = sqrt((c - b) * (l2 - twice * a) / (a * b * c)),
                      .parameter = (b - a) * (twice * c - l2) / ((c - b) * (l2 - twice * a)),
                      .momentum = sqrt(l2),
                      .about_largest = largest};
}

static clast_vec3 spin_at(const solution *s, double time) {
    double sn, cn, dn;
    assert_int_equal(gsl_sf_elljac_e(s->rate * time, s->parameter, &sn, &cn, &dn), 0);
    double a = s->wa * cn, b = s->wb * sn, c = s->wc * dn;
    return s->about_largest ? vec(a, b, c) : vec(c, b, a);
}

/* rad/s, of the axis c about the momentum. */
static double precession(double time, void *context) {
    const solution *s = context;
    clast_vec3 w = spin_at(s, time);
    double a = s->about_largest ? w.x : w.z, la = s->ia * a, lb = s->ib * w.y;
    return s->momentum * (la * a + lb * w.y) / (la * la + lb * lb);
}

static double precession_angle(solution *s, double time) {
    gsl_integration_workspace *room = gsl_integration_workspace_alloc(1000);
    gsl_function rate = {precession, s};
    double angle, error;
    gsl_integration_qag(&rate, 0, time, 0, 1e-12, 1000, GSL_INTEG_GAUSS61, room, &angle, &error);
    gsl_integration_workspace_free(room);
    return angle;
}

/* Angle of the axis c about the momentum since the start, but for whole turns. */
static double azimuth(const solution *s, clast_vec3 momentum, clast_quat q) {
    clast_vec3 axis = s->about_largest ? vec(0, 0, 1) : vec(1, 0, 0);
    clast_vec3 up = times(1 / norm(momentum), momentum);
    clast_vec3 ahead = minus(axis, times(dot(axis, up), up)), now = turned(q, axis);
    return atan2(dot(now, cross(up, ahead)), dot(now, ahead));
}

typedef struct misses {
    double spin, angle; /* of the size of the spin; rad */
} misses;

static misses miss(clast_vec3 start, double dt, double time) {
    clast_vec3 inertia;
    clast_world *w = top(dt, start, &inertia);
    solution s = solve(inertia, start);
    run_to(w, time);
    body_state b = body_of(w, 0);
    time = clast_world_time(w);
    clast_vec3 want = spin_at(&s, time), got = turned_back(b.orientation, b.spin);
    double turn = azimuth(&s, times_each(inertia, start), b.orientation);
    double off = remainder(turn - precession_angle(&s, time), 2 * PI);
    clast_world_free(w);
    return (misses){norm(minus(got, want)) / norm(start), fabs(off)};
}

/* Second order, about either stable axis and nearer to the unstable one. A splitting of second
 * order turns by an angle that is off by some (w dt)^2 / 24 of it: 5e-4 of the 360 rad at the
 * smallest step here, 1.5e-4 s, would be 40 rad/s times 9 s times (0.006)^2 / 24. */
static void a_free_top_is_that_of_elliptic_functions(void **state) {
    (void)state;
    static const clast_vec3 starts[] = {{11, 0, 37}, {39, 0, 8}, {20, 0, 20}};
    for (int i = 0; i < 3; i++) {
        misses m[3];
        for (int k = 0; k < 3; k++) m[k] = miss(starts[i], 6e-4 / (1 << k), 9);
        print_message("spin off by %.2e, %.2e, %.2e, precession by %.2e, %.2e, %.2e rad\n",
                      m[0].spin, m[1].spin, m[2].spin, m[0].angle, m[1].angle, m[2].angle);
        CHECK_NEAR(order_of(m[1].spin, m[2].spin, 2), 2, 0.05);
        CHECK_NEAR(order_of(m[1].angle, m[2].angle, 2), 2, 0.05);
        CHECK_BELOW(m[2].spin, 1e-3);
        CHECK_BELOW(m[2].angle, 1e-3);
    }
}

TEST_MAIN(cmocka_unit_test(a_million_steps_keep_momentum_and_energy),
          cmocka_unit_test(a_free_top_is_that_of_elliptic_functions))
