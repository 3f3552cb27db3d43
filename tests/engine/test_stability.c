/* Limits of the step: what the amplification matrix of a scheme says of the linear oscillator, the
 * running engine does. The matrix is made from the engine's own table of schemes. */
#include <gsl/gsl_complex_math.h>
#include <gsl/gsl_eigen.h>

#include "tests/support/sandwich.h"

/* ---- theory ---------------------------------------------------------------------------------- */

/* What a scheme remembers of x'' = -x - 2 zeta v, in units of 1 / omega. */
typedef struct memory {
    double x[CLAST_LEVELS], v[CLAST_LEVELS], a[CLAST_LEVELS], dashpot;
} memory;

enum { NUMBERS = sizeof(memory) / sizeof(double) };

static double known_position(const clast_scheme_position *r, const memory *m, double h) {
    double sum = 0;
    for (int i = 0; i < CLAST_LEVELS; i++)
        sum += r->x[i] * m->x[i] + h * r->v[i] * m->v[i] + h * h * r->a[i] * m->a[i];
    return sum;
}

static double velocity(const clast_scheme_velocity *r, const memory *m, double h, double x,
                       double a) {
    double sum = r->x_next * x / h + h * r->a_next * a;
    for (int i = 0; i < CLAST_LEVELS; i++)
        sum += r->x[i] * m->x[i] / h + r->v[i] * m->v[i] + h * r->a[i] * m->a[i];
    return sum;
}

/* The new position of an implicit scheme, whose forces feel v = v0 + x_next x / h. */
static double solved(const clast_scheme_info *s, const memory *m, double h, double zeta) {
    double known = known_position(&s->keep, m, h) + h * h * s->dashpot * m->dashpot;
    double b = s->keep.a_next, d = s->splits ? s->dashpot_next : b;
    double v0 = velocity(&s->felt, m, h, 0, 0), slope = s->felt.x_next / h;
    return (known - h * h * d * 2 * zeta * v0) / (1 + h * h * (b + d * 2 * zeta * slope));
}

static memory one_step(const clast_scheme_info *s, const memory *m, double h, double zeta) {
    double felt_x = s->implicit ? solved(s, m, h, zeta) : known_position(&s->predict, m, h);
    double felt_v = velocity(&s->felt, m, h, felt_x, 0);
    double dashpot = -2 * zeta * felt_v, a = -felt_x + (s->splits ? 0 : dashpot);
    double x = s->implicit ? felt_x : known_position(&s->keep, m, h) + h * h * s->keep.a_next * a;
    double v = velocity(&s->kept, m, h, x, a);
    if (s->splits) v += 0.5 * h * (s->dashpot_next * dashpot + s->dashpot * m->dashpot);
    memory next = {.x = {x}, .v = {v}, .a = {a}, .dashpot = s->splits ? dashpot : 0};
    for (int i = 1; i < CLAST_LEVELS; i++)
        next.x[i] = m->x[i - 1], next.v[i] = m->v[i - 1], next.a[i] = m->a[i - 1];
    return next;
}

/* Growth of the fastest growing motion per step. */
static double radius_of(const clast_scheme_info *s, double h, double zeta) {
    gsl_matrix *matrix = gsl_matrix_alloc(NUMBERS, NUMBERS);
    for (size_t j = 0; j < NUMBERS; j++) {
        double unit[NUMBERS] = {0}, column[NUMBERS];
        unit[j] = 1;
        memory m;
        memcpy(&m, unit, sizeof m);
        memory next = one_step(s, &m, h, zeta);
        memcpy(column, &next, sizeof next);
        for (size_t i = 0; i < NUMBERS; i++) gsl_matrix_set(matrix, i, j, column[i]);
    }
    gsl_eigen_nonsymm_workspace *room = gsl_eigen_nonsymm_alloc(NUMBERS);
    gsl_vector_complex *values = gsl_vector_complex_alloc(NUMBERS);
    gsl_eigen_nonsymm(matrix, values, room);
    double most = 0;
    for (size_t i = 0; i < NUMBERS; i++)
        most = fmax(most, gsl_complex_abs(gsl_vector_complex_get(values, i)));
    gsl_vector_complex_free(values);
    gsl_eigen_nonsymm_free(room);
    gsl_matrix_free(matrix);
    return most;
}

/* To rounding of eigenvalues that are not double: which shifts a limit by 1e-8 at most. */
static bool is_stable(const clast_scheme_info *s, double h, double zeta) {
    return radius_of(s, h, zeta) < 1 + 1e-10;
}

/* The step at which stability changes between two steps. */
static double edge(const clast_scheme_info *s, double zeta, double from, double to) {
    bool first = is_stable(s, from, zeta);
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (from + to);
        if (is_stable(s, middle, zeta) == first)
            from = middle;
        else
            to = middle;
    }
    return 0.5 * (from + to);
}

enum { EDGES = 4 };
static const double LEAST = 0.05, MOST = 30;

/* Where stability changes between LEAST and MOST. */
static int edges_of(const clast_scheme_info *s, double zeta, double *at) {
    int count = 0;
    const double ratio = 1.02;
    for (double h = LEAST; h < MOST && count < EDGES; h *= ratio)
        if (is_stable(s, h, zeta) != is_stable(s, h * ratio, zeta))
            at[count++] = edge(s, zeta, h, h * ratio);
    return count;
}

static void limits_by_theory(void **state) {
    (void)state;
    for (int k = 0; k < CLAST_SCHEMES; k++)
        for (int damped = 0; damped < 2; damped++) {
            const clast_scheme_info *s = clast_scheme_info_of((clast_scheme)k);
            double at[EDGES], zeta = damped ? 0.2 : 0;
            int count = edges_of(s, zeta, at);
            print_message("%-17s zeta %.1f: %s below", s->name, zeta,
                          is_stable(s, LEAST, zeta) ? "stable" : "grows");
            for (int i = 0; i < count; i++) print_message(" %.4f", at[i]);
            print_message("%s\n", count ? "" : " any step");
        }
}

typedef struct known_limit {
    clast_scheme scheme;
    double limit; /* omega dt without damping */
} known_limit;

/* Numbers of the literature, so that the table of schemes cannot be wrong and agree with itself. */
static void limits_that_are_known(void **state) {
    (void)state;
    const known_limit known[] = {
        {CLAST_SCHEME_LEAPFROG, 2},
        {CLAST_SCHEME_SYMPLECTIC_EULER, 2},
        {CLAST_SCHEME_POSITION_VERLET, 2},
        {CLAST_SCHEME_VELOCITY_VERLET, 2},
        {CLAST_SCHEME_BEEMAN, 2 * sqrt(3)},
        {CLAST_SCHEME_NUMEROV_BACKWARD, sqrt(6)},
        {CLAST_SCHEME_NUMEROV_FORWARD, sqrt(6)},
        {CLAST_SCHEME_NUMEROV_CENTRAL, sqrt(6)},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        double at[EDGES];
        assert_int_equal(edges_of(clast_scheme_info_of(known[i].scheme), 0, at), 1);
        CHECK_CLOSE(at[0], known[i].limit, 1e-5);
    }
    const clast_scheme any[] = {CLAST_SCHEME_BACKWARD_EULER, CLAST_SCHEME_NEWMARK_BETA,
                                CLAST_SCHEME_TRAPEZOID, CLAST_SCHEME_BDF2};
    for (size_t i = 0; i < sizeof any / sizeof *any; i++) {
        double at[EDGES];
        assert_int_equal(edges_of(clast_scheme_info_of(any[i]), 0, at), 0);
        assert_true(is_stable(clast_scheme_info_of(any[i]), LEAST, 0));
    }
}

/* ---- the running engine ---------------------------------------------------------------------- */

typedef struct outcome {
    uint64_t steps; /* until the guards stopped it, or all of them */
    uint64_t seen;  /* steps until the motion reached LEVEL */
    bool failed;
} outcome;

/* m: the start, where growth is clocked from, and where the guard is set: far from where the
 * contacts would open or stop to push, beyond which nothing is linear. */
static const double SMALL = 1e-12, LEVEL = 1e-9, TRIP = 2e-5;

/* The guard looks at the overlap of the press and what comes to it. */
static outcome run(clast_scheme scheme, double restitution, double step, uint64_t most) {
    sandwich s = {.law = CLAST_LAW_LINEAR,
                  .scheme = scheme,
                  .restitution = restitution,
                  .step = step,
                  .x = SMALL,
                  .v = 0.3 * SMALL,
                  .max_overlap = 0.1 + TRIP / 0.005};
    oscillator o = sandwich_new(&s);
    outcome out = {0, 0, false};
    while (out.steps < most && !out.failed) {
        out.failed = clast_world_step(o.world) != CLAST_OK;
        out.steps++;
        if (out.seen == 0 && fabs(sandwich_position(&o)) > LEVEL) out.seen = out.steps;
    }
    if (out.failed) assert_non_null(strstr(clast_world_error(o.world), "overlap"));
    clast_world_free(o.world);
    return out;
}

static double zeta_of(double restitution) {
    return sqrt(2) * clast_damping_ratio(CLAST_LAW_LINEAR, restitution);
}

/* 0.95 of the edge holds and 1.05 fails, or the other way round; in the time of the growth. */
static void check_edge(clast_scheme scheme, double restitution, double at) {
    const clast_scheme_info *info = clast_scheme_info_of(scheme);
    double zeta = zeta_of(restitution);
    for (int side = 0; side < 2; side++) {
        double step = (side ? 1.05 : 0.95) * at, growth = radius_of(info, step, zeta);
        bool holds = is_stable(info, step, zeta);
        double predicted = holds ? 0 : log(TRIP / LEVEL) / log(growth);
        outcome out = run(scheme, restitution, step, holds ? 4000 : (uint64_t)(4 * predicted + 50));
        print_message("%-17s e = %.1f at %.4f: growth %.5f, %s after %llu steps", info->name,
                      restitution, step, growth, out.failed ? "fails" : "holds",
                      (unsigned long long)out.steps);
        print_message(holds ? "\n" : ", %llu of growth, predicted %.0f\n",
                      (unsigned long long)(out.steps - out.seen), predicted);
        assert_true(out.failed == !holds);
        if (!holds) CHECK_NEAR((double)(out.steps - out.seen), predicted, 0.05 * predicted + 5);
    }
}

static void the_engine_fails_where_theory_says(void **state) {
    (void)state;
    for (int k = 0; k < CLAST_SCHEMES; k++)
        for (int damped = 0; damped < 2; damped++) {
            double at[EDGES], e = damped ? 0.7 : 1;
            int count = edges_of(clast_scheme_info_of((clast_scheme)k), zeta_of(e), at);
            for (int i = 0; i < count; i++) check_edge((clast_scheme)k, e, at[i]);
        }
}

static void schemes_without_a_limit_hold(void **state) {
    (void)state;
    const clast_scheme any[] = {CLAST_SCHEME_BACKWARD_EULER, CLAST_SCHEME_NEWMARK_BETA,
                                CLAST_SCHEME_TRAPEZOID, CLAST_SCHEME_BDF2};
    for (size_t i = 0; i < sizeof any / sizeof *any; i++)
        assert_false(run(any[i], 1, 23, 3000).failed);
}

/* Without damping, the amplitude of the first-order Taylor scheme grows at any step. */
static void taylor_grows_at_any_step(void **state) {
    (void)state;
    const clast_scheme_info *s = clast_scheme_info_of(CLAST_SCHEME_TAYLOR);
    double growth = radius_of(s, 0.1, 0), predicted = log(TRIP / LEVEL) / log(growth);
    outcome out = run(CLAST_SCHEME_TAYLOR, 1, 0.1, (uint64_t)(4 * predicted));
    assert_true(out.failed);
    CHECK_CLOSE((double)(out.steps - out.seen), predicted, 0.02);
}

/* ---- no false alarm -------------------------------------------------------------------------- */

/* A million steps at a tenth of the limit with every guard as it is set by default, but for the
 * overlap with which the ball is pressed. */
static void a_tenth_of_the_limit_is_quiet(void **state) {
    (void)state;
    const clast_scheme calm[] = {CLAST_SCHEME_LEAPFROG, CLAST_SCHEME_SYMPLECTIC_EULER,
                                 CLAST_SCHEME_POSITION_VERLET, CLAST_SCHEME_VELOCITY_VERLET};
    for (size_t i = 0; i < sizeof calm / sizeof *calm; i++) {
        sandwich s = {.law = CLAST_LAW_LINEAR,
                      .scheme = calm[i],
                      .step = 0.2,
                      .x = 2.1e-4,
                      .v = 0.013,
                      .max_overlap = 0.16};
        oscillator o = sandwich_new(&s);
        steps(o.world, 1000000);
        clast_energy e = clast_world_energy(o.world);
        print_message("%-17s after a million steps: residual %.1e of the energy\n",
                      clast_scheme_info_of(calm[i])->name, e.residual / e.input);
        CHECK_BELOW(fabs(e.residual), 0.05 * e.input);
        clast_world_free(o.world);
    }
}

TEST_MAIN(cmocka_unit_test(limits_by_theory), cmocka_unit_test(limits_that_are_known),
          cmocka_unit_test(the_engine_fails_where_theory_says),
          cmocka_unit_test(schemes_without_a_limit_hold),
          cmocka_unit_test(taylor_grows_at_any_step),
          cmocka_unit_test(a_tenth_of_the_limit_is_quiet))
