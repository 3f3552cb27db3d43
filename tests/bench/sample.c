/* sample.c - one timed run in a process of its own. */
#include "tests/bench/sample.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

const char *const bench_stage_names[BENCH_STAGES] = {"bodies", "walls", "neighbours", "contacts",
                                                     "measure"};

static double seconds(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static size_t peak_bytes(void) {
    struct rusage r;
    getrusage(RUSAGE_SELF, &r);
    return (size_t)r.ru_maxrss * 1024;
}

static size_t now_bytes(void) {
    unsigned long pages = 0, resident = 0;
    FILE *f = fopen("/proc/self/statm", "r");
    if (f && fscanf(f, "%lu %lu", &pages, &resident) != 2) resident = 0;
    if (f) fclose(f);
    return (size_t)resident * (size_t)sysconf(_SC_PAGESIZE);
}

/* Seconds per stage since `before`. */
static void stages_since(bench_sample *s, const clast_counters *before,
                         const clast_counters *after) {
    s->stage[0] = after->seconds_bodies - before->seconds_bodies;
    s->stage[1] = after->seconds_walls - before->seconds_walls;
    s->stage[2] = after->seconds_neighbours - before->seconds_neighbours;
    s->stage[3] = after->seconds_contacts - before->seconds_contacts;
    s->stage[4] = after->seconds_measure - before->seconds_measure;
}

static bench_sample run(clast_world *w, const bench_order *order) {
    bench_sample s = {.steps = order->steps};
    bench_steps(w, order->warm);
    clast_counters before = clast_world_counters(w);
    double wall = seconds(CLOCK_MONOTONIC), cpu = seconds(CLOCK_PROCESS_CPUTIME_ID);
    bench_steps(w, order->steps);
    s.cpu = seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu;
    s.wall = seconds(CLOCK_MONOTONIC) - wall;
    clast_counters after = clast_world_counters(w);
    stages_since(&s, &before, &after);
    s.now_bytes = now_bytes();
    s.peak_bytes = peak_bytes(); /* before the hash, which is not part of a run */
    s.spheres = after.spheres, s.pairs = after.pairs, s.candidates = after.candidates;
    s.contacts = after.contacts, s.rebuilds = after.rebuilds - before.rebuilds;
    s.engine_bytes = after.bytes;
    s.hash = clast_world_hash(w);
    clast_plan plan = clast_world_plan(w);
    s.threads = plan.threads;
    snprintf(s.isa, sizeof s.isa, "%s", plan.isa);
    return s;
}

#define LINE                                                                                       \
    "%lf %lf %lf %lf %lf %lf %lf %" SCNu64 " %zu %zu %zu %zu %" SCNu64 " %zu %zu %" SCNx64         \
    " %d %15s %lf %lf %lf %zu"

static double frame_time(clast_world *w, const char *states) {
    char path[4096];
    snprintf(path, sizeof path, "%s/frame-%ld.h5", states, (long)getpid());
    double start = seconds(CLOCK_MONOTONIC);
    if (clast_frame_write(w, path, false)) bench_fail(w, "frame");
    double end = seconds(CLOCK_MONOTONIC);
    remove(path);
    return end - start;
}

void bench_sample_print(const bench_order *order, const char *states) {
    double start = seconds(CLOCK_MONOTONIC);
    clast_world *w = bench_scene_load(order->scene, &order->wish, states);
    double loaded = seconds(CLOCK_MONOTONIC);
    bench_steps(w, 1);
    double stepped = seconds(CLOCK_MONOTONIC);
    bench_sample s = run(w, order);
    s.load = loaded - start, s.first = stepped - loaded, s.frame = frame_time(w, states);
    printf("%.9f %.9f", s.wall, s.cpu);
    for (int i = 0; i < BENCH_STAGES; i++) printf(" %.9f", s.stage[i]);
    printf(" %" PRIu64 " %zu %zu %zu %zu %" PRIu64 " %zu %zu %" PRIx64 " %d %s", s.steps, s.spheres,
           s.pairs, s.candidates, s.contacts, s.rebuilds, s.engine_bytes, s.peak_bytes, s.hash,
           s.threads, s.isa);
    printf(" %.6f %.6f %.6f %zu\n", s.load, s.first, s.frame, s.now_bytes);
    clast_world_free(w);
}

static bool parse(const char *line, bench_sample *s) {
    return sscanf(line, LINE, &s->wall, &s->cpu, &s->stage[0], &s->stage[1], &s->stage[2],
                  &s->stage[3], &s->stage[4], &s->steps, &s->spheres, &s->pairs, &s->candidates,
                  &s->contacts, &s->rebuilds, &s->engine_bytes, &s->peak_bytes, &s->hash,
                  &s->threads, s->isa, &s->load, &s->first, &s->frame, &s->now_bytes) == 22;
}

static void become(const bench_order *o, const char *program, const char *states, int out) {
    char threads[16], isa[16], steps[32], warm[32];
    snprintf(threads, sizeof threads, "%d", o->wish.threads);
    snprintf(isa, sizeof isa, "%d", (int)o->wish.isa);
    snprintf(steps, sizeof steps, "%" PRIu64, o->steps);
    snprintf(warm, sizeof warm, "%" PRIu64, o->warm);
    dup2(out, STDOUT_FILENO);
    char lean[4096]; /* where there is one: without the library that reads meshes */
    ssize_t length = readlink(program, lean, sizeof lean - 8);
    if (length > 0) memcpy(lean + length, "_lean", 6);
    if (length > 0 && !o->scene->meshes && access(lean, X_OK) == 0) program = lean;
    execl(program, program, "--one", o->scene->name, threads, isa, o->wish.fresh ? "1" : "0",
          o->wish.exactly ? "1" : "0", steps, warm, states, (char *)NULL);
    perror(program);
    _exit(127);
}

bool bench_sample_take(const bench_order *order, const char *program, const char *states,
                       bench_sample *sample) {
    int ends[2];
    fflush(NULL);
    if (pipe(ends) != 0) return false;
    pid_t child = fork();
    if (child == 0) become(order, program, states, ends[1]);
    close(ends[1]);
    FILE *from = fdopen(ends[0], "r");
    char line[1024] = "";
    bool read = child > 0 && from && fgets(line, sizeof line, from) && parse(line, sample);
    if (from) fclose(from);
    int status = 1;
    if (child > 0) waitpid(child, &status, 0);
    return read && status == 0;
}
