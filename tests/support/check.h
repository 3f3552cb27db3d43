/* check.h - cmocka with its headers, and assertions that print what they compared. */
#ifndef CLAST_TESTS_CHECK_H
#define CLAST_TESTS_CHECK_H

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* |got - want| <= tolerance; `tolerance` is absolute. */
void check_near(const char *file, int line, const char *what, double got, double want,
                double tolerance);
#define CHECK_NEAR(got, want, tolerance)                                                           \
    check_near(__FILE__, __LINE__, #got, (got), (want), (tolerance))

/* Relative to `want`. */
#define CHECK_CLOSE(got, want, relative)                                                           \
    check_near(__FILE__, __LINE__, #got, (got), (want), (relative) * fabs(want))

/* a < b, printing both. */
void check_below(const char *file, int line, const char *what, double a, double b);
#define CHECK_BELOW(a, b) check_below(__FILE__, __LINE__, #a " < " #b, (a), (b))

/* Order of convergence between two errors whose steps stand in the ratio `refined`. */
double order_of(double coarse_error, double fine_error, double refined);

/* A number of a stream of its own: random scenes are a function of their printed seed. */
typedef struct dice {
    uint64_t seed, count;
} dice;
double roll(dice *d, double low, double high);

/* Name of a file of this process in the folder for temporary files (TMPDIR, else /tmp). */
typedef struct scratch_name {
    char text[256];
} scratch_name;
scratch_name scratch_file(const char *what);

#define TEST_MAIN(...)                                                                             \
    int main(void) {                                                                               \
        const struct CMUnitTest tests[] = {__VA_ARGS__};                                           \
        return cmocka_run_group_tests(tests, NULL, NULL);                                          \
    }

#endif
