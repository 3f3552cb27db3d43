/* Started by mpirun: every scene has the same bits on one process and shared by all of them, for
 * who reads it too, and going on from a checkpoint of either.
 *
 *     mpirun -n 4 ranks_test [--all] [--pieces] [SCENE...]
 *     --all: with 1 and 2 threads each     --pieces: all messages in pieces of a thousand bytes */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "engine/ranks.h"
#include "tests/ranks/crowd.h"
#include "tests/ranks/guards.h"

static bool failed_step(clast_world *w, const char *name) {
    if (clast_world_step(w) == CLAST_OK) return false;
    fprintf(stderr, "%s, process %d: %s\n", name, clast_ranks_number(), clast_world_error(w));
    return true;
}

/* ---- what readers see --------------------------------------------------------------------------
 */

static void mix(uint64_t *hash, const void *bytes, size_t size) {
    const unsigned char *from = bytes;
    for (size_t i = 0; i < size; i++) *hash = (*hash ^ from[i]) * 0x100000001b3u;
}

static void mix_contacts(uint64_t *hash, clast_world *w) {
    size_t count = clast_world_contacts(w, NULL, 0);
    clast_contact *c = calloc(count + 1, sizeof *c);
    if (!c) abort();
    clast_world_contacts(w, c, count);
    mix(hash, c, count * sizeof *c);
    free(c);
}

/* Bodies by id, and how many spheres each has where. */
static void mix_bodies(uint64_t *hash, clast_world *w) {
    clast_bodies b = clast_world_bodies(w);
    clast_spheres s = clast_world_spheres(w);
    uint64_t sum = 0;
    size_t e = 0;
    for (size_t i = 0; i < b.count; i++) {
        uint64_t one = b.id[i];
        const double numbers[] = {b.x[i],  b.y[i],  b.z[i],  b.qw[i], b.qx[i], b.qy[i], b.qz[i],
                                  b.vx[i], b.vy[i], b.vz[i], b.wx[i], b.wy[i], b.wz[i], b.mass[i]};
        mix(&one, numbers, sizeof numbers);
        mix(&one, &b.shape[i], sizeof b.shape[i]);
        for (int k = 0; k < 3; k++)
            if (b.image[k]) mix(&one, &b.image[k][i], sizeof b.image[k][i]);
        for (; e < s.count && (size_t)s.body[e] == i; e++) {
            const double place[] = {s.x[e], s.y[e], s.z[e], s.radius[e]};
            mix(&one, place, sizeof place);
        }
        sum += one;
    }
    if (e != s.count) printf("spheres are not in the order of bodies\n");
    mix(hash, &sum, sizeof sum);
    mix(hash, &b.count, sizeof b.count);
}

static void mix_flow(uint64_t *hash, clast_world *w) {
    clast_passage p;
    for (int in = 0; in < 2; in++)
        while (in ? clast_world_arrivals(w, &p, 1) : clast_world_departures(w, &p, 1)) {
            const double numbers[] = {p.id,         p.shape,      p.gate,       p.mass,
                                      p.position.x, p.position.y, p.position.z, p.velocity.x,
                                      p.velocity.y, p.velocity.z, p.time};
            mix(hash, numbers, sizeof numbers);
        }
}

static uint64_t reading_of(clast_world *w) {
    uint64_t hash = clast_world_hash(w);
    clast_energy e = clast_world_energy(w);
    mix(&hash, &e, sizeof e);
    mix_bodies(&hash, w);
    mix_contacts(&hash, w);
    mix_flow(&hash, w);
    for (int i = 0; i < clast_world_part_count(w); i++) {
        clast_part_load load = clast_world_part_load(w, i);
        mix(&hash, &load, sizeof load);
    }
    clast_counters c = clast_world_counters(w);
    const size_t counts[] = {c.bodies, c.spheres, c.contacts, c.removed, c.fed};
    mix(&hash, counts, sizeof counts);
    return hash;
}

/* ---- a scene
 * ------------------------------------------------------------------------------------- */

typedef struct course {
    uint64_t half, end; /* readings */
} course;

/* Ghosts were sent, or the processes had nothing to do with each other; where work moves about,
 * bodies were divided anew after the start. */
static bool was_shared(clast_world *w, const crowd *c, bool alone) {
    if (alone || clast_ranks_count() == 1) return true;
    clast_counters now = clast_world_counters(w);
    bool sent = clast_ranks_most((double)now.ghosts_sent) > 0;
    bool divided = now.divisions > 1 && clast_ranks_most((double)now.migrated) > 0;
    if (!sent) fprintf(stderr, "%s: no body was a ghost\n", c->name);
    if (c->divides && !divided) fprintf(stderr, "%s: was not divided again\n", c->name);
    return sent && (divided || !c->divides);
}

/* From the start, or from a checkpoint at half its steps; leaves one there. Zeros where it fails.
 */
static course run(const crowd *c, bool alone, int threads, const char *from, const char *to) {
    course all = {0, 0};
    clast_world *w = crowd_new(c, alone, threads);
    if (from && clast_checkpoint_load(w, from, NULL) != CLAST_OK) {
        fprintf(stderr, "%s: %s\n", c->name, clast_world_error(w));
        clast_world_free(w);
        return all;
    }
    bool good = true;
    if (!alone && !from) reading_of(w); /* who reads changes nothing, at the start neither */
    while (good && clast_world_steps(w) < c->steps / 2) good = !failed_step(w, c->name);
    if (good && to && clast_checkpoint_save(w, to, NULL) != CLAST_OK) {
        fprintf(stderr, "%s: %s\n", c->name, clast_world_error(w));
        good = false;
    }
    if (good) all.half = reading_of(w);
    while (good && clast_world_steps(w) < c->steps) good = !failed_step(w, c->name);
    if (good) all.end = reading_of(w);
    if (good && !was_shared(w, c, alone)) all.end = 0;
    clast_world_free(w);
    return all;
}

static bool differs(course a, course b) {
    return clast_ranks_most(a.half != b.half || a.end != b.end || a.end == 0) > 0;
}

static int report(const crowd *c, int threads, const char *how, bool bad) {
    if (clast_ranks_number() == 0)
        printf("%-10s %d x %d, %s: %s\n", c->name, clast_ranks_count(), threads, how,
               bad ? "DIFFERS" : "same");
    fflush(stdout);
    return bad;
}

/* The first process runs it alone and tells the others what to expect. */
static int faults_of(const crowd *c, int from, int to) {
    char ours[64], theirs[64];
    int faults = 0, self = (int)getpid();
    clast_ranks_tell(&self, sizeof self);
    snprintf(ours, sizeof ours, "ranks-%d-shared.h5", self);
    snprintf(theirs, sizeof theirs, "ranks-%d-alone.h5", self);
    course want = {0, 0};
    if (clast_ranks_number() == 0) want = run(c, true, 1, NULL, theirs);
    clast_ranks_tell(&want, sizeof want);
    for (int threads = from; threads <= to; threads++) {
        course got = run(c, false, threads, NULL, ours);
        faults += report(c, threads, "shared", differs(got, want));
    }
    course got = run(c, false, 1, theirs, NULL);
    got.half = want.half; /* of the passages, some have been read before */
    faults += report(c, 1, "resumed from one", clast_ranks_most(got.end != want.end) > 0);
    if (clast_ranks_number() == 0) got = run(c, true, 1, ours, NULL);
    clast_ranks_tell(&got, sizeof got);
    faults += report(c, 1, "one resumed from it", got.end != want.end);
    if (clast_ranks_number() == 0) remove(ours), remove(theirs);
    return faults;
}

/* ---- two that meet ----------------------------------------------------------------------------
 */

/* Each of them is on a process of its own and was far from the other when the lists were made: on
 * its way to the other, neither has a ghost. `gap` in radii. */
static uint64_t meeting(double gap, bool alone) {
    const double radius = 5e-3;
    clast_world_def d = clast_world_def_default();
    d.time_step = 1e-5, d.alone = alone, d.threads = 1;
    d.max_overlap = 0.4, d.impact_speed = 1, d.gravity = (clast_vec3){0, 0, 0};
    d.domain_min = (clast_vec3){-1, -1, -1}, d.domain_max = (clast_vec3){1, 1, 1};
    clast_world *w = clast_world_new(&d);
    clast_material_def m = {.name = "m", .density = 2500, .young = 5e6, .poisson = 0.3};
    clast_pair_def p = {.restitution = 0.5, .friction = 0.5};
    int grain = clast_material_add(w, &m);
    clast_pair_set(w, grain, grain, &p);
    clast_vec3 centre = {0, 0, 0};
    clast_shape_def s = {
        .name = "s", .material = grain, .spheres = 1, .centre = &centre, .radius = &radius};
    int ball = clast_shape_add(w, &s);
    for (int k = 0; k < 2; k++) {
        double side = k ? 1 : -1;
        clast_body_def b = {.shape = ball,
                            .position = {side * radius * (1 + 0.5 * gap), 0, 0},
                            .velocity = {-0.5 * side, 0, 0}};
        clast_body_add(w, &b);
    }
    uint64_t steps = (uint64_t)((gap * radius + 2e-3) / 1e-5);
    bool good = true;
    while (good && clast_world_steps(w) < steps) good = !failed_step(w, "meeting");
    uint64_t end = good ? clast_world_hash(w) : 0;
    clast_world_free(w);
    return end;
}

static int faults_of_meetings(void) {
    int faults = 0;
    for (int i = 0; i < 40; i++) {
        double gap = 0.05 * (i + 1);
        uint64_t want = meeting(gap, true), got = meeting(gap, false);
        faults += clast_ranks_most(want == 0 || got != want) > 0;
    }
    if (clast_ranks_number() == 0)
        printf("meeting: %d of 40 gaps %s\n", faults ? faults : 40, faults ? "DIFFER" : "same");
    return faults;
}

static bool is_asked(const crowd *c, int count, char **names) {
    for (int i = 0; i < count; i++)
        if (strcmp(names[i], c->name) == 0) return true;
    return count == 0;
}

static bool takes(int *argc, char ***argv, const char *option) {
    if (*argc < 2 || strcmp((*argv)[1], option) != 0) return false;
    (*argc)--, (*argv)++;
    return true;
}

int main(int argc, char **argv) {
    if (clast_ranks_begin() != CLAST_OK) return 2;
    bool all = takes(&argc, &argv, "--all");
    if (takes(&argc, &argv, "--pieces")) ranks_piece = 1000;
    int faults = faults_of_meetings() + faults_of_guards();
    for (int i = 0; i < CROWD_COUNT; i++)
        if (is_asked(&CROWDS[i], argc - 1, argv + 1))
            faults += faults_of(&CROWDS[i], all ? 1 : 1 + i % 2, all ? 2 : 1 + i % 2);
    clast_ranks_end();
    return faults > 0;
}
