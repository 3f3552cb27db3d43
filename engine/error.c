#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "engine/world.h"

static void append(clast_world *w, const char *format, va_list arguments) {
    size_t used = strlen(w->error);
    if (used + 2 >= sizeof w->error) return;
    if (used > 0) w->error[used++] = '\n';
    vsnprintf(w->error + used, sizeof w->error - used, format, arguments);
}

int world_fail(clast_world *w, clast_status status, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    w->error[0] = '\0';
    append(w, format, arguments);
    va_end(arguments);
    return (int)status;
}

void world_complain(clast_world *w, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    append(w, format, arguments);
    va_end(arguments);
}

const char *clast_world_error(const clast_world *w) {
    return w->error;
}

double world_seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}
