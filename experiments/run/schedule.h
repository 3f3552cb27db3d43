/* schedule.h - when something is due, as a function of the step number alone.
 *
 * Event k of a series with spacing `every` falls on the step next to k * every. Nothing is added
 * up, so a run that stops and goes on writes at the very same steps. */
#ifndef CLAST_RUN_SCHEDULE_H
#define CLAST_RUN_SCHEDULE_H

#include <stdbool.h>
#include <stdint.h>

#define SCHEDULE_NEVER UINT64_MAX

typedef struct schedule {
    double every; /* s; 0 = never */
    double dt;    /* s, one step */
} schedule;

/* Index k of the event on this step (the last of them when steps are longer than the spacing), or
 * -1. */
int64_t schedule_index(const schedule *s, uint64_t step);
bool schedule_is_due(const schedule *s, uint64_t step);

/* The first step after `step` with an event. */
uint64_t schedule_next(const schedule *s, uint64_t step);

/* Index of the last event at or before `step`; -1 when there is none. */
int64_t schedule_last(const schedule *s, uint64_t step);

#endif
