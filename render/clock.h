/* clock.h: seconds since some start, for stage timings only; no picture depends on it. */
#ifndef RENDER_CLOCK_H
#define RENDER_CLOCK_H

#include <time.h>

static inline double render_clock_s(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#endif
