/* precision_test.c - mixed precision keeps every promise of double: the same bits for any thread
 * count and instruction set and after a restart; and stays as near to the truth as single numbers
 * can be. */
#include "tests/counts/grains.h"
#include "tests/precision/precision.h"
#include "tests/support/check.h"

#include <unistd.h>

const char *const PRECISION_NAMES[2] = {"double", "mixed"};

void precision_row(const precision_table *t, const char *quantity, const char *of,
                   const char *precision, double x, double value, double half) {
    (void)t, (void)quantity, (void)of, (void)precision, (void)x, (void)value, (void)half;
}

void precision_demand(bool fine, const clast_world *w) {
    if (!fine) fail_msg("%s", w ? clast_world_error(w) : clast_world_new_error());
}

static const grains FLOW = {"flow", GRAINS_FLOW, 300, 3000};
static char start[4096], halfway[4096];

static int settle(void **state) {
    (void)state;
    snprintf(start, sizeof start, "%s/%ld-start.h5", CLAST_PRECISION_SCRATCH, (long)getpid());
    snprintf(halfway, sizeof halfway, "%s/%ld-half.h5", CLAST_PRECISION_SCRATCH, (long)getpid());
    grains_settle(&FLOW, start);
    return 0;
}

static int clear(void **state) {
    (void)state;
    unlink(start), unlink(halfway);
    return 0;
}

static uint64_t hash_of(const grains_wish *wish, uint64_t steps) {
    clast_world *w = grains_open(&FLOW, wish, start);
    grains_steps(w, steps);
    uint64_t hash = clast_world_hash(w);
    clast_world_free(w);
    return hash;
}

static void mixed_has_the_same_bits_everywhere(void **state) {
    (void)state;
    grains_wish wish = {1, CLAST_ISA_BASELINE, CLAST_PRECISION_MIXED};
    uint64_t want = hash_of(&wish, 400);
    for (int isa = CLAST_ISA_BASELINE; isa <= CLAST_ISA_AVX512; isa++)
        for (int threads = 1; threads <= 3; threads++) {
            wish.isa = (clast_isa)isa, wish.threads = threads;
            uint64_t got = hash_of(&wish, 400);
            if (got != want)
                fail_msg("%d threads, isa %d: %llx, expected %llx", threads, isa,
                         (unsigned long long)got, (unsigned long long)want);
        }
    wish.precision = CLAST_PRECISION_DOUBLE;
    assert_true(hash_of(&wish, 400) != want);
}

/* The world that a checkpoint goes into has no bodies of an earlier one, so both begin at `start`.
 */
static void a_restart_is_as_if_it_had_never_stopped(void **state) {
    (void)state;
    grains_wish wish = {1, CLAST_ISA_AUTO, CLAST_PRECISION_MIXED};
    clast_world *w = grains_open(&FLOW, &wish, start);
    grains_steps(w, 200);
    assert_int_equal(clast_checkpoint_save(w, halfway, NULL), CLAST_OK);
    grains_steps(w, 200);
    uint64_t want = clast_world_hash(w);
    clast_world_free(w);
    wish.threads = 2;
    w = grains_open(&FLOW, &wish, start);
    if (clast_checkpoint_load(w, halfway, NULL)) fail_msg("%s", clast_world_error(w));
    grains_steps(w, 200);
    assert_true(clast_world_hash(w) == want);
    clast_world_free(w);
}

/* Single numbers carry 24 bits: a collision of n steps may be off by some 2^-24 sqrt(n). */
static void a_rebound_is_off_by_rounding_alone(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        rebound_wish wish = {CLAST_PRECISION_DOUBLE, i * 0.6, 30, 0.3};
        rebound_state full = rebound_of(&wish);
        wish.precision = CLAST_PRECISION_MIXED;
        rebound_state mixed = rebound_of(&wish);
        double apart = rebound_distance(&full, &mixed);
        CHECK_BELOW(0, apart);
        CHECK_BELOW(apart, 0x1p-24 * sqrt(30) * 4);
    }
}

static double residual_of(clast_precision precision, const char *path, const grains *g) {
    clast_world *w = grains_open(g, &(grains_wish){.threads = 1, .precision = precision}, path);
    grains_steps(w, 8000);
    clast_energy e = clast_world_energy(w);
    clast_world_free(w);
    return fabs(e.residual) / e.input;
}

static void the_ledger_closes_as_well(void **state) {
    (void)state;
    double full = residual_of(CLAST_PRECISION_DOUBLE, start, &FLOW);
    double mixed = residual_of(CLAST_PRECISION_MIXED, start, &FLOW);
    print_message("residual over input: double %.2e, mixed %.2e\n", full, mixed);
    CHECK_BELOW(mixed, 1e-3);
    CHECK_BELOW(full, 1e-3);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mixed_has_the_same_bits_everywhere),
        cmocka_unit_test(a_restart_is_as_if_it_had_never_stopped),
        cmocka_unit_test(a_rebound_is_off_by_rounding_alone),
        cmocka_unit_test(the_ledger_closes_as_well),
    };
    return cmocka_run_group_tests(tests, settle, clear);
}
