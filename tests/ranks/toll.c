#include "tests/ranks/toll.h"

#include <time.h>

#include "engine/ranks.h"

static const rank_transport *real;
static double spent;

static double clock_of(clockid_t id) {
    struct timespec t;
    clock_gettime(id, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double own_clock(void) {
    return clock_of(CLOCK_THREAD_CPUTIME_ID);
}

static void reduce(double *values, int most, int sums) {
    double since = own_clock();
    real->reduce(values, most, sums);
    spent += own_clock() - since;
}

static void add_words(uint64_t *words, int count) {
    double since = own_clock();
    real->add_words(words, count);
    spent += own_clock() - since;
}

static void tell(void *bytes, size_t size, int from) {
    double since = own_clock();
    real->tell(bytes, size, from);
    spent += own_clock() - since;
}

static char *gather(const void *bytes, size_t size, size_t *sizes) {
    double since = own_clock();
    char *all = real->gather(bytes, size, sizes);
    spent += own_clock() - since;
    return all;
}

static char *exchange(const void *out, const size_t *out_sizes, size_t *in_sizes) {
    double since = own_clock();
    char *in = real->exchange(out, out_sizes, in_sizes);
    spent += own_clock() - since;
    return in;
}

static int swap(const void *out, const size_t *out_sizes, void *in, const size_t *in_sizes) {
    double since = own_clock();
    int sent = real->swap(out, out_sizes, in, in_sizes);
    spent += own_clock() - since;
    return sent;
}

void toll_begin(void) {
    static rank_transport toll;
    if (!ranks_transport) return;
    real = ranks_transport;
    toll = *real;
    toll.reduce = reduce, toll.add_words = add_words, toll.tell = tell;
    toll.gather = gather, toll.exchange = exchange, toll.swap = swap;
    ranks_transport = &toll;
}

double toll_all(void) {
    return clock_of(CLOCK_PROCESS_CPUTIME_ID);
}

double toll_messages(void) {
    return spent;
}
