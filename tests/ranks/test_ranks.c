/* Started by mpirun: every scene has the same hash on one process and shared by all of them.
 *
 *     mpirun -n 4 ranks_test [SCENE...] */
#include <stdio.h>
#include <string.h>

#include "tests/ranks/crowd.h"

static uint64_t hash_after(const crowd *c, bool alone, int threads) {
    clast_world *w = crowd_new(c, alone, threads);
    for (uint64_t i = 0; i < c->steps; i++)
        if (clast_world_step(w) != CLAST_OK) {
            fprintf(stderr, "%s, process %d: %s\n", c->name, clast_ranks_number(),
                    clast_world_error(w));
            return 0;
        }
    uint64_t hash = clast_world_hash(w);
    clast_counters k = clast_world_counters(w);
    if (!alone)
        printf("  process %d: %zu ghosts, %llu messages, %.3g MB, %llu divisions, %llu migrated\n",
               clast_ranks_number(), k.ghosts, (unsigned long long)k.messages,
               1e-6 * (double)k.message_bytes, (unsigned long long)k.divisions,
               (unsigned long long)k.migrated);
    clast_world_free(w);
    return hash;
}

/* Asked alone by the first process, which tells the others. */
static int faults_of(const crowd *c) {
    int faults = 0;
    uint64_t want = clast_ranks_number() == 0 ? hash_after(c, true, 1) : 0;
    clast_ranks_tell(&want, sizeof want);
    for (int threads = 1; threads <= 2; threads++) {
        uint64_t got = hash_after(c, false, threads);
        double differs = clast_ranks_most(got != want || want == 0);
        faults += differs > 0;
        if (clast_ranks_number() == 0)
            printf("%-10s %d processes x %d threads: 0x%016llx %s\n", c->name, clast_ranks_count(),
                   threads, (unsigned long long)got, differs > 0 ? "DIFFERS" : "same");
        fflush(stdout);
    }
    return faults;
}

static bool is_asked(const crowd *c, int argc, char **argv) {
    for (int i = 1; i < argc; i++)
        if (strcmp(argv[i], c->name) == 0) return true;
    return argc < 2;
}

int main(int argc, char **argv) {
    if (clast_ranks_begin() != CLAST_OK) return 2;
    int faults = 0;
    for (int i = 0; i < CROWD_COUNT; i++)
        if (is_asked(&CROWDS[i], argc, argv)) faults += faults_of(&CROWDS[i]);
    clast_ranks_end();
    return faults > 0;
}
