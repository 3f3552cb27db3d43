/* scale.c - a scene of the bench shared by several processes: cost of a step, traffic, and the
 * model of the traffic beside it (a bed cut into boxes).
 *
 *     mpirun -n 4 ranks_scale SCENE STATES WARM STEPS THREADS */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "tests/bench/scenes.h"

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

/* ---- the model ----------------------------------------------------------------------------------
 * A box of the bed, cut along its longest side again and again: bodies of other boxes within reach
 * of one of them stand in slabs at its inner faces, quarter cylinders at its inner edges and
 * eighths of a ball at its inner corners. */

typedef struct bed {
    double side[3]; /* m */
    double density; /* 1/m3 */
} bed;

static bed bed_of(clast_world *w) {
    clast_bodies b = clast_world_bodies(w);
    clast_shape_def s = clast_world_shape(w, 0);
    const double *x[3] = {b.x, b.y, b.z};
    bed all = {.density = (double)b.count};
    for (int k = 0; k < 3; k++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t i = 0; i < b.count; i++) low = fmin(low, x[k][i]), high = fmax(high, x[k][i]);
        all.side[k] = high - low + 2 * s.radius[0];
        all.density /= all.side[k];
    }
    return all;
}

/* Of the box at that place among `cuts`: an inner face on either side, along each axis. */
static double ghosts_of_box(const bed *b, const int cuts[3], const int at[3], double reach) {
    double length[3], volume = 0;
    int inner[3];
    for (int k = 0; k < 3; k++) {
        length[k] = b->side[k] / cuts[k];
        inner[k] = (at[k] > 0) + (at[k] < cuts[k] - 1);
    }
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        volume += inner[k] * length[i] * length[j] * reach;
        volume += inner[i] * inner[j] * length[k] * 0.25 * 3.14159265358979 * reach * reach;
    }
    volume += inner[0] * inner[1] * inner[2] * 3.14159265358979 / 6 * reach * reach * reach;
    return b->density * volume;
}

static double ghosts_expected(const bed *b, int processes, double reach) {
    int cuts[3] = {1, 1, 1};
    double ghosts = 0;
    for (int parts = 1; parts < processes; parts *= 2) {
        int longest = 0;
        for (int k = 1; k < 3; k++)
            if (b->side[k] / cuts[k] > b->side[longest] / cuts[longest]) longest = k;
        cuts[longest] *= 2;
    }
    for (int i = 0; i < cuts[0]; i++)
        for (int j = 0; j < cuts[1]; j++)
            for (int k = 0; k < cuts[2]; k++)
                ghosts += ghosts_of_box(b, cuts, (const int[]){i, j, k}, reach);
    return ghosts;
}

/* ---- a run -------------------------------------------------------------------------------------
 */

static void run(clast_world *w, uint64_t steps) {
    for (uint64_t i = 0; i < steps; i++)
        if (clast_world_step(w) != CLAST_OK) {
            fprintf(stderr, "%s\n", clast_world_error(w));
            exit(1);
        }
}

static void report_traffic(clast_world *w, const clast_counters *before, uint64_t steps) {
    clast_counters c = clast_world_counters(w);
    double n = (double)steps, processes = clast_ranks_count();
    double bytes = sum_of_all((double)(c.message_bytes - before->message_bytes)) / n;
    double messages = sum_of_all((double)(c.messages - before->messages)) / n;
    double ghosts = sum_of_all((double)(c.ghosts_sent - before->ghosts_sent)) / n;
    double most = clast_ranks_most((double)c.ghosts), now = sum_of_all((double)c.ghosts);
    bed b = bed_of(w);
    clast_shape_def s = clast_world_shape(w, 0);
    double reach = 2 * s.radius[0] + clast_world_plan(w).skin;
    double expected = ghosts_expected(&b, clast_ranks_count(), reach);
    double model = 8 * (9 * expected + messages);
    if (clast_ranks_number() > 0) return;
    printf("  per step: %.1f messages, %.0f ghosts (now %.0f, most %.0f), %.1f kB\n", messages,
           ghosts, now, most, 1e-3 * bytes);
    printf("  model: %.0f ghosts, %.1f kB: %+.1f %%; %.1f kB per process\n", expected, 1e-3 * model,
           100 * (model / bytes - 1), 1e-3 * bytes / processes);
}

int main(int argc, char **argv) {
    if (argc != 6 || clast_ranks_begin() != CLAST_OK) return 2;
    const bench_scene *scene = bench_scene_find(argv[1]);
    if (!scene) return 2;
    uint64_t warm = strtoull(argv[3], NULL, 10), steps = strtoull(argv[4], NULL, 10);
    bench_wish wish = {.threads = atoi(argv[5]), .isa = CLAST_ISA_AUTO};
    clast_world *w = bench_scene_load(scene, &wish, argv[2]);
    run(w, warm + 1);
    clast_counters before = clast_world_counters(w);
    double start = seconds();
    run(w, steps);
    double wall = clast_ranks_most(seconds() - start);
    uint64_t hash = clast_world_hash(w);
    clast_counters c = clast_world_counters(w);
    double share = (double)c.candidates, largest = clast_ranks_most(share), all = sum_of_all(share);
    if (clast_ranks_number() == 0)
        printf("%s: %d processes x %d threads, %s: %.1f us per step, %.2f M sphere-steps/s, "
               "imbalance %.3f, hash 0x%016llx\n",
               scene->name, clast_ranks_count(), wish.threads, clast_world_plan(w).isa,
               1e6 * wall / (double)steps, 1e-6 * (double)c.spheres * (double)steps / wall,
               largest * clast_ranks_count() / all, (unsigned long long)hash);
    if (clast_ranks_count() > 1) report_traffic(w, &before, steps);
    clast_world_free(w);
    clast_ranks_end();
    return 0;
}
