/* progress.h - what a person watching a run sees: one rewritten line on a terminal, plain lines now
 * and then elsewhere. */
#ifndef CLAST_RUN_PROGRESS_H
#define CLAST_RUN_PROGRESS_H

#include "experiments/run/run.h"

typedef struct progress {
    run_talk talk;
    bool terminal, line_open;
    double started, shown; /* s, of the clock */
    uint64_t first_step, last_step, shown_step;
} progress;

double clock_seconds(void);

void progress_start(progress *p, run_talk talk, uint64_t first_step, uint64_t last_step);
bool progress_is_due(const progress *p, const clast_world *w);
void progress_show(progress *p, clast_world *w);
void progress_stop(progress *p); /* ends an open line */

/* Before and after: what was picked, and what it cost. */
void report_plan(const scene *s, const run_options *o);
void report_costs(const scene *s, double seconds, uint64_t steps);

#endif
