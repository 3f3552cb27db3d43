/* scale.c - a scene of the bench, or of a file, shared by several processes: cost of a step,
 * counted work, processor time in and out of messages, traffic and its model. All means of one
 * step.
 *
 *     mpirun -n 4 ranks_scale SCENE STATES WARM STEPS THREADS
 *     mpirun -n 4 ranks_scale SCENE.yaml - WARM STEPS THREADS [NAME=VALUE...] */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "engine/ranks.h"
#include "experiments/scene/scene.h"
#include "tests/bench/scenes.h"
#include "tests/ranks/toll.h"
#include "tests/ranks/traffic.h"

static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double sum_of_all(double value) {
    double sum = 0;
    for (int q = 0; q < clast_ranks_count(); q++)
        sum += clast_ranks_most(q == clast_ranks_number() ? value : -INFINITY);
    return sum;
}

/* ---- a run -------------------------------------------------------------------------------------
 */

typedef struct reading {
    clast_counters counters;
    double clock, all, messages;
} reading;

static reading read_now(const clast_world *w) {
    return (reading){clast_world_counters(w), seconds(), toll_all(), toll_messages()};
}

/* Counted work, and that of the process with the most. */
typedef struct work {
    double sum, most;
} work;

enum { SAMPLE_EVERY = 32 };

static work run(clast_world *w, uint64_t steps) {
    work found = {0, 0};
    double samples = 0;
    for (uint64_t i = 0; i < steps; i++) {
        if (clast_world_step(w) != CLAST_OK) {
            fprintf(stderr, "%s\n", clast_world_error(w));
            exit(1);
        }
        if (i % SAMPLE_EVERY) continue;
        double here = ranks_work(w);
        found.most += clast_ranks_most(here), found.sum += sum_of_all(here), samples++;
    }
    found.most /= samples, found.sum /= samples;
    return found;
}

/* ---- what it came to --------------------------------------------------------------------------
 */

static void report_cost(const char *name, clast_world *w, const reading *from, const reading *to,
                        uint64_t steps) {
    double n = (double)steps, spent = clast_ranks_most(to->clock - from->clock);
    uint64_t hash = clast_world_hash(w);
    clast_counters c = clast_world_counters(w);
    if (clast_ranks_number() > 0) return;
    printf(
        "%s: %d processes x %d threads, %s, %zu spheres: %.1f us per step, %.2f M sphere-steps/s, "
        "%llu divisions, hash 0x%016llx\n",
        name, clast_ranks_count(), clast_world_plan(w).threads, clast_world_plan(w).isa, c.spheres,
        1e6 * spent / n, 1e-6 * (double)c.spheres * n / spent, (unsigned long long)c.divisions,
        (unsigned long long)hash);
}

static void report_work(work counted, const reading *from, const reading *to, uint64_t steps) {
    double us = 1e6 / (double)steps, waits = us * (to->messages - from->messages);
    double own = us * (to->all - from->all) - waits;
    double own_sum = sum_of_all(own), own_most = clast_ranks_most(own), in = sum_of_all(waits);
    double processes = clast_ranks_count();
    if (clast_ranks_number() > 0) return;
    printf("  counted work: %.0f, the most on one %.0f, mean over it %.3f\n", counted.sum,
           counted.most, counted.sum / processes / counted.most);
    printf("  processor time out of messages: %.1f us, the most on one %.1f, mean over it %.3f; in "
           "messages %.1f us\n",
           own_sum, own_most, own_sum / processes / own_most, in);
}

static void report_traffic(clast_world *w, double counted, const reading *from, const reading *to,
                           uint64_t steps) {
    const clast_counters *a = &from->counters, *b = &to->counters;
    double n = (double)steps;
    double bytes = sum_of_all((double)(b->message_bytes - a->message_bytes)) / n;
    double messages = sum_of_all((double)(b->messages - a->messages)) / n;
    double ghosts = sum_of_all((double)(b->ghosts_sent - a->ghosts_sent)) / n;
    double moved = sum_of_all((double)(b->migrated - a->migrated)) / n;
    double expected = traffic_ghosts(w, counted, (double)to->counters.steps);
    double row = ghosts > 0 ? bytes / ghosts : 0;
    if (clast_ranks_number() > 0) return;
    printf("  %.1f messages, %.0f ghosts, %.1f kB, %.0f bytes each; %.2f bodies moved house\n",
           messages, ghosts, 1e-3 * bytes, row, moved);
    printf("  model: %.0f ghosts, %.1f kB: %+.1f %%\n", expected, 1e-3 * row * expected,
           100 * (expected / ghosts - 1));
}

static clast_world *load_file(int argc, char **argv) {
    char *faults = NULL;
    scene_options o = {
        .set = (const char *const *)argv + 6, .set_count = argc - 6, .threads = atoi(argv[5])};
    scene *s = scene_load(argv[1], &o, &faults);
    if (!s) fputs(faults, stderr), exit(2);
    return s->world;
}

static clast_world *load(int argc, char **argv) {
    if (strstr(argv[1], ".yaml")) return load_file(argc, argv);
    const bench_scene *of_bench = bench_scene_find(argv[1]);
    if (!of_bench || argc > 6) exit(2);
    bench_wish wish = {.threads = atoi(argv[5]), .isa = CLAST_ISA_AUTO};
    return bench_scene_load(of_bench, &wish, argv[2]);
}

int main(int argc, char **argv) {
    if (argc < 6 || clast_ranks_begin() != CLAST_OK) return 2;
    toll_begin();
    clast_world *w = load(argc, argv);
    uint64_t warm = strtoull(argv[3], NULL, 10), steps = strtoull(argv[4], NULL, 10);
    run(w, warm + 1);
    reading from = read_now(w);
    work counted = run(w, steps);
    reading to = read_now(w);
    report_cost(argv[1], w, &from, &to, steps);
    report_work(counted, &from, &to, steps);
    if (clast_ranks_count() > 1) report_traffic(w, counted.sum, &from, &to, steps);
    clast_world_free(w);
    clast_ranks_end();
    return 0;
}
