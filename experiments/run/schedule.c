#include "experiments/run/schedule.h"

#include <math.h>

#include "engine/check.h"

static uint64_t step_of(const schedule *s, int64_t k) {
    return (uint64_t)llround((double)k * s->every / s->dt);
}

int64_t schedule_last(const schedule *s, uint64_t step) {
    CLAST_ASSERT(s && s->dt > 0 && s->every >= 0);
    if (s->every == 0) return -1;
    int64_t k = (int64_t)((double)step * s->dt / s->every);
    while (step_of(s, k + 1) <= step) k++;
    while (step_of(s, k) > step) k--;
    return k;
}

int64_t schedule_index(const schedule *s, uint64_t step) {
    int64_t k = schedule_last(s, step);
    return k >= 0 && step_of(s, k) == step ? k : -1;
}

bool schedule_is_due(const schedule *s, uint64_t step) {
    return schedule_index(s, step) >= 0;
}

uint64_t schedule_next(const schedule *s, uint64_t step) {
    if (s->every == 0) return SCHEDULE_NEVER;
    return step_of(s, schedule_last(s, step) + 1);
}
