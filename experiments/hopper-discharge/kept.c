/* kept.c - results of many calls: kept on disk under their names, worked out side by side. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include <errno.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "engine/check.h"
#include "experiments/hopper-discharge/discharge.h"
#include "experiments/study/jobs.h"

#define PROGRAM "/proc/self/exe"

/* What the processes share; the results follow. */
typedef struct shared {
    _Alignas(64) atomic_int next;
    atomic_int done;
} shared;

static _Noreturn void stop(const char *what) {
    fprintf(stderr, "hopper-discharge: %s: %s\n", what, strerror(errno));
    exit(4);
}

/* ---- names ----------------------------------------------------------------------------------- */

/* The hash of this program: any change of engine or study makes new names. */
static const char *program_hash(void) {
    static job self = {.scene = PROGRAM};
    if (!self.folder[0]) jobs_name(&self, "");
    return self.folder;
}

static void path_of(const kept_task *task, int which, char path[JOB_FOLDER + 8]) {
    char name[NAME_MAX_TEXT];
    task->name(task->context, which, name);
    job j = {.scene = SCENES "/published.csv", .label = "result"};
    job_set(&j, "program=%s", strrchr(program_hash(), '-'));
    job_set(&j, "name=%s", name);
    jobs_name(&j, BUILD_FOLDER "/studies/hopper-discharge/kept");
    snprintf(path, JOB_FOLDER + 8, "%s.bin", j.folder);
}

static bool read_kept(const kept_task *task, int which, void *result) {
    char path[JOB_FOLDER + 8];
    path_of(task, which, path);
    FILE *f = fopen(path, "rb");
    if (!f) return false;
    bool whole = fread(result, task->size, 1, f) == 1 && fgetc(f) == EOF;
    fclose(f);
    return whole;
}

/* Whole or not at all. */
static void keep(const kept_task *task, int which, const void *result) {
    char path[JOB_FOLDER + 8], part[JOB_FOLDER + 40];
    path_of(task, which, path);
    snprintf(part, sizeof part, "%s.%ld", path, (long)getpid());
    FILE *f = fopen(part, "wb");
    if (!f) stop(part);
    bool whole = fwrite(result, task->size, 1, f) == 1;
    whole &= fclose(f) == 0;
    if (!whole || rename(part, path)) stop(part);
}

/* ---- side by side ---------------------------------------------------------------------------- */

static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void progress(const kept_task *task, shared *s, int count, double since) {
    int done = atomic_fetch_add(&s->done, 1) + 1, every = count / 10 + 1;
    if (done != count && done % every != 0) return;
    printf("%s: %d of %d, %.0f s\n", task->what, done, count, seconds() - since);
    fflush(stdout);
}

static void work(const kept_task *task, shared *s, char *results, int count, double since) {
    for (int i = atomic_fetch_add(&s->next, 1); i < count; i = atomic_fetch_add(&s->next, 1)) {
        char *result = results + (size_t)i * task->size;
        if (!read_kept(task, i, result)) {
            task->work(task->context, i, result);
            keep(task, i, result);
        }
        progress(task, s, count, since);
    }
}

static void wait_for(int children) {
    bool well = true;
    for (int i = 0; i < children; i++) {
        int status;
        if (wait(&status) < 0) stop("wait");
        well &= WIFEXITED(status) && WEXITSTATUS(status) == 0;
    }
    if (well) return;
    fputs("hopper-discharge: a process has died\n", stderr);
    exit(4);
}

void kept_results(const kept_task *task, int count, void *results) {
    CLAST_ASSERT(task && task->size > 0 && count >= 0);
    if (count == 0) return;
    size_t bytes = sizeof(shared) + (size_t)count * task->size;
    void *memory = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) stop("mmap");
    shared *s = memory;
    char *all = (char *)memory + sizeof *s;
    int processes = task->processes > 0 ? task->processes : jobs_processes();
    double since = seconds();
    program_hash();
    fflush(NULL);
    for (int i = 0; i < processes; i++) {
        pid_t child = fork();
        if (child < 0) stop("fork");
        if (child > 0) continue;
        work(task, s, all, count, since);
        _exit(0);
    }
    wait_for(processes);
    memcpy(results, all, (size_t)count * task->size);
    munmap(memory, bytes);
}
