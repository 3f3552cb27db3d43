#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include "experiments/particle-checks/side.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "experiments/study/jobs.h"

/* What the processes share: the next piece, then the results. */
typedef struct board {
    _Alignas(64) atomic_int next;
    _Alignas(64) char results[];
} board;

static void stop(const char *what) {
    perror(what);
    exit(4);
}

static void take_turns(board *b, int count, side_work *work, const void *context, size_t size) {
    for (int i = atomic_fetch_add(&b->next, 1); i < count; i = atomic_fetch_add(&b->next, 1))
        work(i, context, b->results + (size_t)i * size);
}

static bool ended_well(pid_t child) {
    int status = 0;
    return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void side_by_side(int count, side_work *work, const void *context, void *results, size_t size) {
    enum { MOST = 256 };
    size_t room = sizeof(board) + (size_t)count * size;
    board *b = mmap(NULL, room, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (b == MAP_FAILED) stop("mmap");
    pid_t child[MOST];
    int processes = jobs_processes(), good = 0;
    if (processes > count) processes = count;
    if (processes > MOST) processes = MOST;
    fflush(NULL); /* or a child would write what waits here once more */
    for (int k = 0; k < processes; k++) {
        child[k] = fork();
        if (child[k] < 0) stop("fork");
        if (child[k] == 0) {
            take_turns(b, count, work, context, size);
            _exit(0);
        }
    }
    for (int k = 0; k < processes; k++) good += ended_well(child[k]);
    if (good < processes) {
        fprintf(stderr, "particle-checks: a piece of work failed\n");
        exit(4);
    }
    memcpy(results, b->results, (size_t)count * size);
    munmap(b, room);
}
