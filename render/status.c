#include "render/status.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

/* One text per thread: the encoder's failures must not overwrite the caller's. */
static _Thread_local char error_text[1024];

void render_panic(const char *file, int line, const char *condition) {
    fprintf(stderr, "%s:%d: broken invariant: %s\n", file, line, condition);
    abort();
}

render_status render_fail(render_status code, const char *format, ...) {
    va_list list;
    va_start(list, format);
    vsnprintf(error_text, sizeof error_text, format, list);
    va_end(list);
    return code;
}

const char *render_error_text(void) {
    return error_text;
}

const char *render_status_name(render_status status) {
    switch (status) {
    case RENDER_OK:
        return "ok";
    case RENDER_ERR_ARGUMENT:
        return "bad argument";
    case RENDER_ERR_MEMORY:
        return "out of memory";
    case RENDER_ERR_UNAVAILABLE:
        return "not available";
    case RENDER_ERR_GL:
        return "OpenGL failed";
    case RENDER_ERR_FILE:
        return "file not written";
    case RENDER_ERR_PROCESS:
        return "program failed";
    }
    return "unknown status";
}
