/* sample.h - one timed run of one scene in a process of its own, so that its peak of memory is its
 * own too. */
#ifndef CLAST_BENCH_SAMPLE_H
#define CLAST_BENCH_SAMPLE_H

#include "tests/bench/scenes.h"

enum {
    BENCH_STAGES = 5
}; /* bodies, walls, neighbours, contacts, measure: in the order of a step */
extern const char *const bench_stage_names[BENCH_STAGES];

typedef struct bench_sample {
    double wall, cpu;                            /* s, of the timed steps; cpu of all threads */
    double stage[BENCH_STAGES];                  /* s, likewise */
    uint64_t steps;                              /* timed */
    size_t spheres, pairs, candidates, contacts; /* at the end */
    uint64_t rebuilds;                           /* in the timed steps */
    double load, first, frame; /* s: building and reading the state; the first step with all that it
                                  prepares; writing a frame */
    size_t engine_bytes;       /* counted by the engine at the end */
    size_t peak_bytes;         /* resident, of the whole process, reading the state included */
    size_t now_bytes;          /* resident after the timed steps */
    uint64_t hash;
    int threads; /* in use */
    char isa[16];
} bench_sample;

typedef struct bench_order {
    const bench_scene *scene;
    bench_wish wish;
    uint64_t steps, warm;
} bench_order;

/* In the process of its own: runs and prints the sample as one line. */
void bench_sample_print(const bench_order *order, const char *states);

/* Starts `program` for it and reads the line; false when it failed (it has said why). */
bool bench_sample_take(const bench_order *order, const char *program, const char *states,
                       bench_sample *sample);

#endif
