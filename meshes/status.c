#include "meshes/status.h"

#include <stdarg.h>
#include <stdlib.h>

static _Thread_local char error_text[1024];

void mesh_panic(const char *file, int line, const char *condition) {
    fprintf(stderr, "%s:%d: broken invariant: %s\n", file, line, condition);
    abort();
}

mesh_status mesh_fail(mesh_status code, const char *format, ...) {
    va_list list;
    va_start(list, format);
    vsnprintf(error_text, sizeof error_text, format, list);
    va_end(list);
    return code;
}

const char *mesh_error_text(void) {
    return error_text;
}

void *mesh_array(size_t count, size_t size) {
    void *array = calloc(count > 0 ? count : 1, size);
    if (!array)
        (void)mesh_fail(MESH_ERR_MEMORY, "no memory for %zu items of %zu bytes", count, size);
    return array;
}
