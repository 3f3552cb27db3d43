/* kept.c - results of many calls: kept on disk under their names, worked out side by side. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "engine/check.h"
#include "experiments/hopper-discharge/discharge.h"
#include "experiments/study/jobs.h"
#include "experiments/study/side.h"

#define PROGRAM "/proc/self/exe"

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

/* ---- all of them ----------------------------------------------------------------------------- */

static void find_or_work(const void *context, int which, void *result) {
    const kept_task *task = context;
    if (read_kept(task, which, result)) return;
    task->work(task->context, which, result);
    keep(task, which, result);
}

void kept_results(const kept_task *task, int count, void *results) {
    program_hash();
    side_by_side(&(side_task){task->what, task->processes, find_or_work, task, task->size}, count,
                 results);
}
