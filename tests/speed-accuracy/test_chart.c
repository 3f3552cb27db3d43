/* Error against cost: fronts against their definition, bounds that luck does not lower, what is
 * picked, orders, and processor time in batches. */
#include "engine/clast.h"
#include "experiments/speed-accuracy/chart.h"
#include "experiments/speed-accuracy/front.h"
#include "tests/support/check.h"

/* ---- the front ------------------------------------------------------------------------------- */

static void front_of_hand_made_points(void **state) {
    (void)state;
    static const struct {
        double cost, error;
        bool on_front;
    } P[] = {
        {3.1, 0.61, false},      /* beaten by (2.3, 0.52) in both */
        {1.7, 1.13, true},       /* the cheapest */
        {2.3, 0.52, true},       /* */
        {2.3, 0.52, false},      /* equal to the one before: the first counts */
        {2.3, 0.77, false},      /* as dear, and worse */
        {4.9, 0.52, false},      /* as good, and dearer */
        {4.4, 0.09, true},       /* the best */
        {1.7, 1.31, false},      /* as cheap as the cheapest, and worse */
        {0.2, NAN, false},       /* no error is no good error */
        {0.1, INFINITY, false},  /* */
        {NAN, 0.001, false},     /* not timed */
        {INFINITY, 1e-9, false}, /* */
    };
    enum { N = sizeof P / sizeof *P };
    double cost[N], error[N];
    bool on_front[N];
    for (int i = 0; i < N; i++) cost[i] = P[i].cost, error[i] = P[i].error, on_front[i] = true;
    pareto_front(cost, error, N, on_front);
    for (int i = 0; i < N; i++)
        if (on_front[i] != P[i].on_front) fail_msg("point %d: %d", i, on_front[i]);
    pareto_front(NULL, NULL, 0, NULL);
}

/* Few different values, so that many are equal in one of the two, or in both. */
static void front_by_definition(void **state) {
    (void)state;
    enum { N = 60 };
    for (uint64_t seed = 1; seed <= 300; seed++) {
        dice d = {seed, 0};
        double cost[N], error[N];
        bool on_front[N];
        for (int i = 0; i < N; i++) {
            cost[i] = floor(roll(&d, 1, 14)), error[i] = floor(roll(&d, 1, 14)) / 7;
            if (roll(&d, 0, 1) < 0.05) error[i] = INFINITY;
        }
        pareto_front(cost, error, N, on_front);
        for (int i = 0; i < N; i++) {
            bool best = isfinite(error[i]);
            for (int k = 0; k < N; k++) {
                bool no_worse = cost[k] <= cost[i] && error[k] <= error[i];
                bool equal = cost[k] == cost[i] && error[k] == error[i];
                if (no_worse && (!equal || k < i)) best = false;
            }
            if (on_front[i] != best) fail_msg("seed %d, point %d", (int)seed, i);
        }
    }
}

static void order_of_a_front(void **state) {
    (void)state;
    double cost[6], error[6];
    bool use[6] = {true, false, true, true, false, true};
    for (int i = 0; i < 6; i++) cost[i] = 13.7 * pow(1.9, i), error[i] = 0.7 * pow(cost[i], -2.5);
    error[1] = 7, error[4] = 1e-9; /* not to be used */
    CHECK_NEAR(front_order(cost, error, use, 6), 2.5, 1e-12);
    use[0] = use[2] = false;
    assert_true(isnan(front_order(cost, error, use, 6)));
}

/* ---- the chart ------------------------------------------------------------------------------- */

static chart_point point(const char *family, double level, double cost, double error) {
    chart_point p = {.part = "collision",
                     .scene = "here",
                     .quantity = "rebound",
                     .level = level,
                     .step = 1 / level,
                     .cost = {cost, cost, cost},
                     .evaluations = 10 * cost,
                     .difference = NAN,
                     .error = error,
                     .low = error,
                     .high = error};
    snprintf(p.family, sizeof p.family, "%s", family);
    return p;
}

static void add(chart *c, chart_point p) {
    chart_add(c, &p);
}

/* An error that is small between two larger ones has changed its sign there. */
static void luck_does_not_count(void **state) {
    (void)state;
    chart c = {0};
    add(&c, point("a", 4, 1.1, 0.31));
    add(&c, point("a", 8, 2.1, 0.0004)); /* changes its sign */
    add(&c, point("a", 16, 4.1, 0.052));
    add(&c, point("a", 32, 8.1, 0.0088));
    add(&c, point("b", 16, 4.2, 0.043));
    add(&c, point("b", 32, 8.2, INFINITY)); /* nothing coarser is trusted */
    chart_finish(&c);
    const double bound[6] = {0.31, 0.052, 0.052, 0.0088, INFINITY, INFINITY};
    const bool on_front[6] = {true, true, false, true, false, false};
    for (int i = 0; i < 6; i++) {
        if (c.points[i].bound != bound[i]) fail_msg("bound %d: %g", i, c.points[i].bound);
        assert_int_equal(c.points[i].front_cost, on_front[i]);
        assert_int_equal(c.points[i].front_evaluations, on_front[i]);
    }
    const chart_point *panel = chart_panel(&c, "collision", "here", "rebound");
    assert_ptr_equal(panel, &c.points[0]);
    assert_ptr_equal(chart_pick(&c, panel, 0.1, CHART_COST, NULL), &c.points[1]);
    assert_ptr_equal(chart_pick(&c, panel, 0.01, CHART_EVALUATIONS, NULL), &c.points[3]);
    assert_null(chart_pick(&c, panel, 0.001, CHART_COST, NULL));
    assert_null(chart_panel(&c, "collision", "there", "rebound"));
    chart_free(&c);
}

static chart_point scattered(const char *family, double cost, double error, double half) {
    chart_point p = point(family, 1, cost, error);
    p.statistical = true;
    p.low = fmax(0, error - half), p.high = error + half;
    return p;
}

static bool is_a(const chart_point *p) {
    return p->family[0] == 'a';
}

static void intervals_count(void **state) {
    (void)state;
    chart c = {0};
    chart_point reference = scattered("reference", 9.3, 0, 0);
    reference.reference = true;
    add(&c, reference);
    add(&c, scattered("a", 3.3, 0.001, 0.041)); /* small by luck */
    add(&c, scattered("b", 4.7, 0.018, 0.011)); /* known better */
    add(&c, scattered("a", 6.1, 0.022, 0.023));
    add(&c, scattered("lost", 1.2, INFINITY, NAN));
    chart_point elsewhere = scattered("a", 0.1, 0.0001, 0.0001);
    elsewhere.quantity = "duration";
    add(&c, elsewhere);
    chart_point stopped = scattered("b", 0.3, 0.001, 0.002);
    snprintf(stopped.message, sizeof stopped.message, "guards would stop it");
    add(&c, stopped);
    chart_finish(&c);
    const bool on_front[7] = {false, true, true, false, false, true, false};
    for (int i = 0; i < 7; i++) assert_int_equal(c.points[i].front_cost, on_front[i]);
    assert_false(chart_is_distinct(&c.points[1]));
    assert_true(chart_is_distinct(&c.points[2]));
    assert_false(chart_is_distinct(&c.points[3]));
    const chart_point *panel = &c.points[0];
    assert_ptr_equal(chart_pick(&c, panel, 0.05, CHART_COST, NULL), &c.points[1]);
    assert_ptr_equal(chart_pick(&c, panel, 0.03, CHART_COST, NULL), &c.points[2]);
    assert_ptr_equal(chart_pick(&c, panel, 0.01, CHART_COST, NULL), &c.points[0]);
    assert_null(chart_pick(&c, panel, 0.03, CHART_COST, is_a));
    chart_free(&c);
}

static void order_within_levels(void **state) {
    (void)state;
    chart c = {0};
    for (int i = 0; i < 8; i++) {
        double level = 3 * pow(2, i);
        add(&c, point("a", level, 0.3 * level, i < 3 ? 0.9 - 0.1 * i : 5 * pow(level, -2)));
    }
    chart_finish(&c);
    CHECK_NEAR(chart_front_order(&c, &c.points[0], 20, 400), 2, 1e-12);
    chart_free(&c);
}

/* ---- cost ------------------------------------------------------------------------------------ */

static void quartiles(void **state) {
    (void)state;
    double samples[] = {7.5, NAN, 1.5, 3.5, INFINITY, 9.5, 2.5};
    chart_cost c = cost_of(samples, 7);
    CHECK_NEAR(c.median, 3.5, 0);
    CHECK_NEAR(c.low, 2.5, 0);
    CHECK_NEAR(c.high, 7.5, 0);
    assert_true(isnan(cost_of(samples, 0).median));
}

static int passes;

static work_done pass(const void *what, int number) {
    assert_int_equal(number, passes);
    passes++;
    return (work_done){*(const double *)what, 0.25, 40};
}

static void batches(void **state) {
    (void)state;
    double seconds = 0.013, evaluations;
    passes = 0;
    chart_cost c = cost_measure(pass, &seconds, 0.1, &evaluations); /* two passes a batch */
    assert_int_equal(passes, 2 * COST_BATCHES);
    CHECK_CLOSE(c.median, 0.013 / 0.25, 1e-12);
    CHECK_CLOSE(evaluations, 160.0, 1e-12);
    passes = 0;
    c = cost_measure(pass, &seconds, 0, &evaluations);
    assert_int_equal(passes, 1);
    assert_true(isnan(c.median));
    CHECK_CLOSE(evaluations, 160.0, 1e-12);
}

TEST_MAIN(cmocka_unit_test(front_of_hand_made_points), cmocka_unit_test(front_by_definition),
          cmocka_unit_test(order_of_a_front), cmocka_unit_test(luck_does_not_count),
          cmocka_unit_test(intervals_count), cmocka_unit_test(order_within_levels),
          cmocka_unit_test(quartiles), cmocka_unit_test(batches))
