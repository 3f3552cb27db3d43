/* The slope of a heap, from profiles that are known. */
#include "tests/support/check.h"

#include "experiments/scene-needs/study.h"

enum { SECTIONS = 60 };
static const double WIDTH = 0.02, PI = 3.14159265358979323846;

/* Mean height of a section of a triangle with its top at `top` (m from the left end). */
static double mean_height(double peak, double slope, double top, int section) {
    double sum = 0;
    for (int i = 0; i < 1000; i++) {
        double x = (section + (i + 0.5) / 1000) * WIDTH;
        sum += fmax(0, peak - slope * fabs(x - top)) / 1000;
    }
    return sum;
}

static double angle_of(double peak, double degrees, double top) {
    double height[SECTIONS];
    for (int i = 0; i < SECTIONS; i++)
        height[i] = mean_height(peak, tan(degrees * PI / 180), top, i);
    return heap_angle(height, SECTIONS, WIDTH);
}

/* Means over sections of a straight flank lie on it: exact but for rounding. */
static void a_straight_flank_has_its_angle(void **state) {
    (void)state;
    CHECK_NEAR(angle_of(0.12, 24, 0.6), 24, 1e-6);
    CHECK_NEAR(angle_of(0.12, 24, 0.613), 24, 1e-6); /* the top inside a section */
    CHECK_NEAR(angle_of(0.2, 37.5, 0.6), 37.5, 1e-6);
    CHECK_NEAR(angle_of(0.05, 6, 0.59), 6, 1e-6);
}

static void both_flanks_count_alike(void **state) {
    (void)state;
    double height[SECTIONS];
    for (int i = 0; i < SECTIONS; i++) {
        double x = WIDTH * (i - 30);
        height[i] = fmax(0, 0.15 - fabs(x) * tan((x < 0 ? 20 : 30) * PI / 180));
    }
    CHECK_NEAR(heap_angle(height, SECTIONS, WIDTH), 25, 1e-9);
}

/* Grains that have rolled away lie beyond the foot and do not bend the flank. */
static void stragglers_do_not_count(void **state) {
    (void)state;
    double height[SECTIONS];
    for (int i = 0; i < SECTIONS; i++)
        height[i] = fmax(0, 0.12 - WIDTH * abs(i - 30) * tan(25 * PI / 180));
    height[3] = height[50] = 0.01;
    CHECK_NEAR(heap_angle(height, SECTIONS, WIDTH), 25, 1e-9);
}

static void what_is_no_heap_has_no_angle(void **state) {
    (void)state;
    double column[SECTIONS] = {0}, nothing[SECTIONS] = {0};
    column[30] = 0.3, column[31] = 0.1;
    assert_true(isnan(heap_angle(column, SECTIONS, WIDTH)));
    assert_true(isnan(heap_angle(nothing, SECTIONS, WIDTH)));
}

TEST_MAIN(cmocka_unit_test(a_straight_flank_has_its_angle),
          cmocka_unit_test(both_flanks_count_alike), cmocka_unit_test(stragglers_do_not_count),
          cmocka_unit_test(what_is_no_heap_has_no_angle))
