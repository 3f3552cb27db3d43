#include "experiments/study/jobs.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "digest.h"
#include "engine/fnv.h"
#include "experiments/run/folder.h"
#include "experiments/run/run.h"

void job_set(job *j, const char *format, ...) {
    if (j->set_count == JOB_SETTINGS) abort();
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(j->set[j->set_count++], JOB_TEXT, format, arguments);
    va_end(arguments);
}

/* ---- names ----------------------------------------------------------------------------------- */

/* All of a setting counts, "rate=20 kg/h" too; of a whole path its name and its last part, which
 * holds the hash of what is in it: a build folder may move. */
static uint64_t with_setting(uint64_t hash, const char *setting) {
    const char *value = strchr(setting, '=');
    const char *last = value && value[1] == '/' ? strrchr(value, '/') : setting;
    if (last != setting) hash = fnv_bytes(hash, setting, (size_t)(value - setting));
    return fnv_bytes(hash, last, strlen(last) + 1);
}

void jobs_name(job *j, const char *root) {
    uint64_t hash = FNV_START;
    if (!fnv_file(&hash, j->scene)) {
        fprintf(stderr, "%s: %s\n", j->scene, strerror(errno));
        exit(4);
    }
    for (int i = 0; i < j->set_count; i++) hash = with_setting(hash, j->set[i]);
    hash = fnv_bytes(hash, ENGINE_DIGEST, sizeof ENGINE_DIGEST);
    snprintf(j->folder, JOB_FOLDER, "%s/%s-%016" PRIx64, root, j->label, hash);
}

/* ---- one job, in a process of its own -------------------------------------------------------- */

static void complain(const job *j, const char *message) {
    char path[JOB_FOLDER + 8];
    snprintf(path, sizeof path, "%s.log", j->folder);
    FILE *f = fopen(path, "w");
    if (f) fprintf(f, "%s\n", message), fclose(f);
    if (!j->quiet) fprintf(stderr, "%s: %s\n", j->label, message);
}

static int run_one(const job *j) {
    const char *set[JOB_SETTINGS];
    for (int i = 0; i < j->set_count; i++) set[i] = j->set[i];
    char *faults = NULL;
    scene *s = scene_load(
        j->scene, &(scene_options){.set = set, .set_count = j->set_count, .threads = 1}, &faults);
    if (!s) {
        complain(j, faults ? faults : "the scene cannot be read");
        return 3;
    }
    run_report r =
        run_scene(s, &(run_options){.out = j->folder, .resume = true, .talk = RUN_SILENT});
    if (r.end != RUN_DONE) complain(j, r.message);
    scene_free(s);
    free(faults);
    return r.end == RUN_DONE ? 0 : 1;
}

static pid_t start(const job *j) {
    fflush(NULL);
    pid_t child = fork();
    if (child < 0) {
        perror("fork");
        exit(4);
    }
    if (child == 0) _exit(run_one(j));
    return child;
}

/* ---- what it cost ---------------------------------------------------------------------------- */

static bool was_begun(const job *j) {
    char *checkpoint = path_in(j->folder, FILE_CHECKPOINT);
    bool begun = path_exists(checkpoint);
    free(checkpoint);
    return begun;
}

static void keep_time(const job *j) {
    char path[JOB_FOLDER + 8], text[64];
    snprintf(path, sizeof path, "%s.cpu", j->folder);
    snprintf(text, sizeof text, "%.6g\n", j->seconds);
    file_write_text(path, text); /* without it the cost is unknown, nothing worse */
}

double jobs_processor_time(const job *j) {
    char path[JOB_FOLDER + 8], text[64];
    snprintf(path, sizeof path, "%s.cpu", j->folder);
    FILE *f = fopen(path, "r");
    double seconds = f && fgets(text, sizeof text, f) ? strtod(text, NULL) : (double)NAN;
    if (f) fclose(f);
    return seconds;
}

/* ---- all of them ----------------------------------------------------------------------------- */

int jobs_processes(void) {
    const char *wish = getenv("CLAST_JOBS");
    long n = wish ? strtol(wish, NULL, 10) : sysconf(_SC_NPROCESSORS_ONLN);
    return n < 1 ? 1 : n > 64 ? 64 : (int)n;
}

/* Jobs of the same folder are the same job: only the first of them is started. */
static int twin_before(const job *jobs, int which) {
    for (int i = 0; i < which; i++)
        if (!strcmp(jobs[i].folder, jobs[which].folder)) return i;
    return -1;
}

static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void progress(const char *what, int done, int count, int fresh, double since) {
    double left = fresh > 0 ? (seconds() - since) / fresh * (count - done) : 0;
    bool terminal = isatty(1);
    if (!what) return;
    if (!terminal && done != count && done % 5 != 0) return;
    printf("%s%s: %d of %d runs, %.0f s left%s", terminal ? "\r\033[K" : "", what, done, count,
           left, terminal && done != count ? "" : "\n");
    fflush(stdout);
}

typedef struct pool {
    pid_t child[64];
    int job[64], running;
    bool begun[64]; /* goes on from a checkpoint */
} pool;

/* s of processor time of all children that were waited for. */
static double children_time(void) {
    struct rusage all;
    if (getrusage(RUSAGE_CHILDREN, &all)) return 0;
    return (double)(all.ru_utime.tv_sec + all.ru_stime.tv_sec) +
           1e-6 * (double)(all.ru_utime.tv_usec + all.ru_stime.tv_usec);
}

/* Waits for one child; returns the job it was, whether it did well, and whether its time is that of
 * a whole run. */
static int reap(pool *p, bool *well, bool *whole) {
    int status;
    pid_t ended = waitpid(-1, &status, 0);
    if (ended < 0) {
        perror("waitpid");
        exit(4);
    }
    *well = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    for (int i = 0; i < p->running; i++)
        if (p->child[i] == ended) {
            int which = p->job[i];
            *whole = !p->begun[i];
            p->running--;
            p->child[i] = p->child[p->running], p->job[i] = p->job[p->running];
            p->begun[i] = p->begun[p->running];
            if (WIFSIGNALED(status))
                fprintf(stderr, "a run was killed by signal %d\n", WTERMSIG(status));
            return which;
        }
    abort();
}

int jobs_run(job *jobs, int count, int processes, const char *what) {
    pool p = {.running = 0};
    int done = 0, failed = 0, fresh = 0, next = 0, total = 0;
    double since = seconds();
    for (int i = 0; i < count; i++) {
        jobs[i].done = run_is_finished(jobs[i].folder, &jobs[i].hash);
        if (twin_before(jobs, i) >= 0) continue;
        done += jobs[i].done;
        total++;
    }
    progress(what, done, total, 0, since);
    while (p.running > 0 || next < count) {
        while (next < count && (jobs[next].done || twin_before(jobs, next) >= 0)) next++;
        if (next < count && p.running < processes) {
            p.begun[p.running] = was_begun(&jobs[next]);
            p.child[p.running] = start(&jobs[next]);
            p.job[p.running++] = next++;
            continue;
        }
        if (p.running == 0) break;
        bool well, whole;
        double before = children_time();
        job *j = &jobs[reap(&p, &well, &whole)];
        j->seconds = children_time() - before;
        j->done = well && run_is_finished(j->folder, &j->hash);
        if (j->done && whole) keep_time(j);
        failed += !j->done;
        fresh++;
        progress(what, ++done, total, fresh, since);
    }
    for (int i = 0; i < count; i++) {
        int twin = twin_before(jobs, i);
        if (twin >= 0) jobs[i].done = jobs[twin].done, jobs[i].hash = jobs[twin].hash;
    }
    return failed;
}
