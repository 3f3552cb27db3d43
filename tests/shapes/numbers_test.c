/* Elementary functions of our own beside libm, which is good to the last bit or two. */
#include "shapes/numbers.h"
#include "tests/support/check.h"

static void angles(void **state) {
    (void)state;
    dice d = {.seed = 1};
    for (int i = 0; i < 20000; i++) {
        double y = roll(&d, -1, 1), x = roll(&d, -1, 1), small = roll(&d, -1, 1) * 1e-9;
        CHECK_NEAR(shape_atan2(y, x), atan2(y, x), 9e-16);
        CHECK_CLOSE(shape_atan2(small, 1), atan2(small, 1), 5e-16);
        CHECK_NEAR(shape_acos(x), acos(x), 9e-16);
        CHECK_NEAR(shape_asin(x), asin(x), 9e-16);
    }
    CHECK_NEAR(shape_atan2(0, 0), 0, 0);
    CHECK_NEAR(shape_atan2(0, -1), SHAPE_PI, 0);
    CHECK_NEAR(shape_acos(1 + 1e-15), 0, 0);
    CHECK_NEAR(shape_acos(-1), SHAPE_PI, 0);
}

static void sines(void **state) {
    (void)state;
    dice d = {.seed = 2};
    for (int i = 0; i < 20000; i++) {
        double angle = roll(&d, -50, 50), s, c;
        shape_sincos(angle, &s, &c);
        CHECK_NEAR(s, sin(angle), 4e-16);
        CHECK_NEAR(c, cos(angle), 4e-16);
    }
}

/* An even sequence gives every eighth of the cube its share, nearer than chance would: that is off
 * by 90 at three standard deviations. */
static void sequences(void **state) {
    (void)state;
    int box[8] = {0};
    double mean = 0;
    for (uint64_t i = 0; i < 8000; i++) {
        int at = 0;
        for (int k = 0; k < 3; k++) at = 2 * at + (shape_even(3, k, i) < 0.5);
        box[at]++;
        double r = shape_random(4, i);
        assert_true(r >= 0 && r < 1);
        mean += r / 8000;
    }
    for (int i = 0; i < 8; i++) CHECK_NEAR(box[i], 1000, 45);
    CHECK_NEAR(mean, 0.5, 4 / sqrt(12 * 8000.0));
}

TEST_MAIN(cmocka_unit_test(angles), cmocka_unit_test(sines), cmocka_unit_test(sequences))
