#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include "experiments/study/side.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "engine/check.h"
#include "experiments/study/jobs.h"

/* What the processes share: the next piece, how many are done, then the results. */
typedef struct board {
    _Alignas(64) atomic_int next;
    atomic_int done;
    _Alignas(64) char results[];
} board;

static void stop(const char *what) {
    perror(what);
    exit(4);
}

static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void progress(const side_task *task, board *b, int count, double since) {
    int done = atomic_fetch_add(&b->done, 1) + 1, every = count / 10 + 1;
    if (!task->what || (done != count && done % every != 0)) return;
    printf("%s: %d of %d, %.0f s\n", task->what, done, count, seconds() - since);
    fflush(stdout);
}

static void take_turns(const side_task *task, board *b, int count, double since) {
    for (int i = atomic_fetch_add(&b->next, 1); i < count; i = atomic_fetch_add(&b->next, 1)) {
        task->work(task->context, i, b->results + (size_t)i * task->size);
        progress(task, b, count, since);
    }
}

static bool ended_well(pid_t child) {
    int status = 0;
    return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void side_by_side(const side_task *task, int count, void *results) {
    enum { MOST = 256 };
    CLAST_ASSERT(task && task->work && task->size > 0 && count >= 0);
    if (count == 0) return;
    size_t room = sizeof(board) + (size_t)count * task->size;
    board *b = mmap(NULL, room, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (b == MAP_FAILED) stop("mmap");
    pid_t child[MOST];
    int processes = task->processes > 0 ? task->processes : jobs_processes(), good = 0;
    if (processes > count) processes = count;
    if (processes > MOST) processes = MOST;
    double since = seconds();
    fflush(NULL); /* or a child would write what waits here once more */
    for (int k = 0; k < processes; k++) {
        child[k] = fork();
        if (child[k] < 0) stop("fork");
        if (child[k] == 0) {
            take_turns(task, b, count, since);
            _exit(0);
        }
    }
    for (int k = 0; k < processes; k++) good += ended_well(child[k]);
    if (good < processes) {
        fputs("a process that worked on results has failed\n", stderr);
        exit(4);
    }
    memcpy(results, b->results, (size_t)count * task->size);
    munmap(b, room);
}
