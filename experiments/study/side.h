/* side.h - independent pieces of work on all cores, each core with a process of its own.
 *
 *     side_by_side(&(side_task){.work = run_one, .context = cases, .size = sizeof *results}, count,
 *                  results);
 */
#ifndef CLAST_STUDY_SIDE_H
#define CLAST_STUDY_SIDE_H

#include <stddef.h>

/* Fills one result, which holds no pointer; nothing else that it changes is seen by others. */
typedef void side_work(const void *context, int index, void *result);

typedef struct side_task {
    const char *what; /* begins lines of progress; NULL: there are none */
    int processes;    /* at a time; 0: jobs_processes() */
    side_work *work;
    const void *context;
    size_t size; /* bytes of a result */
} side_task;

/* work(context, i, the i-th of `results`) for i = 0 ... count - 1, count >= 0. Results do not
 * depend on the number of processes. Exits with code 4 when a piece fails. */
void side_by_side(const side_task *task, int count, void *results);

#endif
