/* memory_test.c - allocations in the step, counted, and bytes per sphere. The linker sends every
 * malloc, calloc, realloc, aligned_alloc and free of the engine through this file (--wrap); what
 * shared libraries do for themselves (the OpenMP run time's start of threads) is not seen.
 *
 * Promised: a step that makes no list anew asks for nothing and gives nothing back, from the first
 * on. A step that refreshes the contact list in place may have to grow it, with room to spare, so a
 * bed that flows steadily comes to ask for nothing. A step that rebuilds the lists does so in a
 * number of calls that depends neither on bodies nor on contacts (limits.txt: lines "calls"). */
#include "tests/counts/grains.h"
#include "tests/support/check.h"

#include <malloc.h>
#include <unistd.h>

/* ---- the wrapper ----------------------------------------------------------------------------- */

static long asked, given_back;
static long heap, heap_most; /* bytes in use, and most of them since heap_watch() */

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void __real_free(void *p);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
void __wrap_free(void *p);

static void tell(long *counter) {
    __atomic_add_fetch(counter, 1, __ATOMIC_RELAXED);
}

static void *take(void *p) {
    long now = __atomic_add_fetch(&heap, (long)malloc_usable_size(p), __ATOMIC_RELAXED);
    long most = __atomic_load_n(&heap_most, __ATOMIC_RELAXED);
    while (now > most && !__atomic_compare_exchange_n(&heap_most, &most, now, true,
                                                      __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {}
    return p;
}

static void leave(void *p) {
    __atomic_sub_fetch(&heap, (long)malloc_usable_size(p), __ATOMIC_RELAXED);
}

static void heap_watch(void) {
    heap_most = heap;
}

void *__wrap_malloc(size_t size) {
    tell(&asked);
    return take(__real_malloc(size));
}

void *__wrap_calloc(size_t count, size_t size) {
    tell(&asked);
    return take(__real_calloc(count, size));
}

void *__wrap_realloc(void *old, size_t size) {
    tell(&asked);
    leave(old);
    return take(__real_realloc(old, size));
}

void *__wrap_aligned_alloc(size_t alignment, size_t size) {
    tell(&asked);
    return take(__real_aligned_alloc(alignment, size));
}

void __wrap_free(void *p) {
    tell(&given_back);
    leave(p);
    __real_free(p);
}

/* ---- beds ------------------------------------------------------------------------------------ */

enum { BIG = GRAINS_COUNT, BEDS };

static grains beds[BEDS];
static char paths[BEDS][4096];

static int settle_beds(void **state) {
    (void)state;
    for (int i = 0; i < BEDS; i++) {
        beds[i] = i == BIG ? (grains){"box5000", GRAINS_BOX, 5000, 4000} : grains_small[i];
        snprintf(paths[i], sizeof paths[i], "%s/memory-%ld-%s.h5", CLAST_COUNTS_SCRATCH,
                 (long)getpid(), beds[i].name);
        grains_settle(&beds[i], paths[i]);
    }
    return 0;
}

static int remove_beds(void **state) {
    (void)state;
    for (int i = 0; i < BEDS; i++) unlink(paths[i]);
    return 0;
}

static clast_world *open_bed(int bed, const grains_wish *wish) {
    return grains_open(&beds[bed], wish, paths[bed]);
}

/* What a step made, and the calls in all steps of its kind. */
enum { NO_LIST, REFRESH, REBUILD, KINDS };

typedef struct tally {
    long steps[KINDS], calls[KINDS], most[KINDS]; /* most: in one step */
} tally;

static tally watch(clast_world *w, int steps) {
    tally t = {0};
    for (int i = 0; i < steps; i++) {
        clast_counters before = clast_world_counters(w);
        long calls = asked + given_back;
        grains_steps(w, 1);
        calls = asked + given_back - calls;
        clast_counters after = clast_world_counters(w);
        int kind = after.rebuilds > before.rebuilds     ? REBUILD
                   : after.refreshes > before.refreshes ? REFRESH
                                                        : NO_LIST;
        t.steps[kind]++;
        t.calls[kind] += calls;
        if (calls > t.most[kind]) t.most[kind] = calls;
    }
    return t;
}

static void say(int bed, const grains_wish *wish, const char *period, const tally *t) {
    print_message(
        "%s, %s, %d thread(s), %s: calls in %ld steps without lists %ld, in %ld refreshes "
        "%ld, in %ld rebuilds %ld (at most %ld)\n",
        beds[bed].name, wish->precision == CLAST_PRECISION_MIXED ? "mixed" : "double",
        wish->threads, period, t->steps[NO_LIST], t->calls[NO_LIST], t->steps[REFRESH],
        t->calls[REFRESH], t->steps[REBUILD], t->calls[REBUILD], t->most[REBUILD]);
}

/* Lines "KIND BED PRECISION any LIMIT" of the table. */
static double limit_of(const char *kind, const char *bed, const char *precision) {
    FILE *table = fopen(CLAST_COUNTS_LIMITS, "r");
    assert_non_null(table);
    char line[400], what[40], name[40], of[40];
    double limit = 0, found = -1;
    while (fgets(line, sizeof line, table))
        if (sscanf(line, "%39s %39s %39s any %lf", what, name, of, &limit) == 4 &&
            !strcmp(what, kind) && !strcmp(name, bed) && !strcmp(of, precision))
            found = limit;
    fclose(table);
    if (found < 0) fail_msg("no limit of %s for %s %s", kind, bed, precision);
    return found;
}

static void watch_bed(int bed, const grains_wish *wish, int warming, int period) {
    clast_world *w = open_bed(bed, wish);
    tally first = watch(w, warming), second = watch(w, period);
    say(bed, wish, "warming", &first);
    say(bed, wish, "warm", &second);
    assert_int_equal(first.calls[NO_LIST], 0);
    assert_int_equal(second.calls[NO_LIST], 0);
    assert_int_equal(second.calls[REFRESH], 0);
    double most = (double)second.most[REBUILD] / wish->threads;
    double limit = limit_of("calls", "rebuild", "thread");
    if (most > limit) fail_msg("%g calls in a rebuild per thread, limit %g", most, limit);
    clast_world_free(w);
}

/* ---- tests ----------------------------------------------------------------------------------- */

/* Otherwise a wrapper that is not linked in would find every engine frugal. */
static void the_wrapper_sees_the_engine(void **state) {
    (void)state;
    long before = asked;
    clast_world *w = open_bed(GRAINS_WALLS, &(grains_wish){.threads = 1});
    CHECK_BELOW(before + 20, asked);
    before = given_back;
    clast_world_free(w);
    CHECK_BELOW(before + 20, given_back);
}

static void beds_at_rest_ask_for_nothing(void **state) {
    (void)state;
    for (int i = 0; i < GRAINS_FLOW; i++) watch_bed(i, &(grains_wish){.threads = 1}, 1000, 1000);
}

static void a_flowing_bed_grows_and_then_asks_for_nothing(void **state) {
    (void)state;
    static const grains_wish WISHES[] = {
        {.threads = 1}, {.threads = 1, .precision = CLAST_PRECISION_MIXED}, {.threads = 2}};
    for (int i = 0; i < 3; i++) watch_bed(GRAINS_FLOW, &WISHES[i], 12000, 3000);
}

static void expect_bytes(const char *kind, const grains_wish *wish, double each) {
    const char *word = wish->precision == CLAST_PRECISION_MIXED ? "mixed" : "double";
    double limit = limit_of(kind, beds[BIG].name, word);
    print_message("%s, %s, %d thread(s), %s: %.0f bytes per sphere, limit %.0f\n", beds[BIG].name,
                  word, wish->threads, kind, each, limit);
    CHECK_BELOW(each, limit);
}

/* What the engine holds while it steps, and the most that the heap has held over some rebuilds. */
static void weigh(clast_precision precision, int threads) {
    grains_wish wish = {threads, .precision = precision};
    long before = heap;
    clast_world *w = open_bed(BIG, &wish);
    grains_steps(w, 100);
    clast_counters start = clast_world_counters(w), c = start;
    heap_watch();
    while (c.rebuilds < start.rebuilds + 2) grains_steps(w, 10), c = clast_world_counters(w);
    double spheres = (double)c.spheres;
    expect_bytes("bytes", &wish, (double)c.bytes / spheres);
    expect_bytes("peak", &wish, (double)(heap_most - before) / spheres);
    clast_world_free(w);
}

static void a_sphere_takes_few_bytes(void **state) {
    (void)state;
    for (int threads = 1; threads <= 2; threads++)
        weigh(CLAST_PRECISION_DOUBLE, threads), weigh(CLAST_PRECISION_MIXED, threads);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_wrapper_sees_the_engine),
        cmocka_unit_test(beds_at_rest_ask_for_nothing),
        cmocka_unit_test(a_flowing_bed_grows_and_then_asks_for_nothing),
        cmocka_unit_test(a_sphere_takes_few_bytes),
    };
    return cmocka_run_group_tests(tests, settle_beds, remove_beds);
}
