/* Pieces of work in processes of their own: the same results for any number of processes, and a
 * piece that fails ends the program. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "experiments/study/side.h"

enum { COUNT = 100 };

static void square_of(const void *context, int index, void *result) {
    *(double *)result = *(const double *)context * index * index;
}

static void results_do_not_hang_on_processes(void **state) {
    (void)state;
    static const int processes[] = {0, 1, 3, 400};
    double factor = 0.7;
    for (int k = 0; k < 4; k++) {
        double results[COUNT] = {0};
        side_by_side(&(side_task){.processes = processes[k],
                                  .work = square_of,
                                  .context = &factor,
                                  .size = sizeof *results},
                     COUNT, results);
        for (int i = 0; i < COUNT; i++) assert_true(results[i] == 0.7 * i * i);
    }
}

static void nothing_to_do(void **state) {
    (void)state;
    double factor = 1, untouched = 3;
    side_by_side(&(side_task){.work = square_of, .context = &factor, .size = sizeof untouched}, 0,
                 &untouched);
    assert_true(untouched == 3);
}

static void fails_at_seven(const void *context, int index, void *result) {
    square_of(context, index, result);
    if (index == 7) _exit(1);
}

static void a_piece_that_fails_is_not_passed_over(void **state) {
    (void)state;
    fflush(NULL);
    pid_t child = fork();
    if (child == 0) {
        double results[COUNT], factor = 1;
        fclose(stderr);
        side_by_side(
            &(side_task){.work = fails_at_seven, .context = &factor, .size = sizeof *results},
            COUNT, results);
        _exit(0);
    }
    int status = 0;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 4);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(results_do_not_hang_on_processes),
                                       cmocka_unit_test(nothing_to_do),
                                       cmocka_unit_test(a_piece_that_fails_is_not_passed_over)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
