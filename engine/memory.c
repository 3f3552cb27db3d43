#include "engine/check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/world.h"

void clast_panic(const char *file, int line, const char *what) {
    fprintf(stderr, "clast: broken promise at %s:%d: %s\n", file, line, what);
    abort();
}

/* Threads grow their own lists side by side. */
static void count_bytes(clast_world *w, size_t more) {
    __atomic_add_fetch(&w->counters.bytes, more, __ATOMIC_RELAXED);
}

void *memory_grow(clast_world *w, void *old, size_t old_count, size_t count, size_t size) {
    CLAST_ASSERT(size > 0 && count >= old_count);
    void *p = realloc(old, count * size);
    if (!p && count > 0) clast_panic(__FILE__, __LINE__, "out of memory");
    memset((char *)p + old_count * size, 0, (count - old_count) * size);
    count_bytes(w, (count - old_count) * size);
    return p;
}

void *memory_lines(clast_world *w, void *old, size_t old_bytes, size_t bytes) {
    free(old);
    size_t whole = (bytes + LINE - 1) / LINE * LINE;
    void *p = aligned_alloc(LINE, whole > 0 ? whole : LINE);
    if (!p) clast_panic(__FILE__, __LINE__, "out of memory");
    memset(p, 0, whole);
    count_bytes(w, bytes - old_bytes);
    return p;
}

void *memory_copy(clast_world *w, const void *from, size_t count, size_t size) {
    void *p = memory_grow(w, NULL, 0, count > 0 ? count : 1, size);
    if (count > 0) memcpy(p, from, count * size);
    return p;
}

void memory_adopt(clast_world *w, size_t bytes) {
    count_bytes(w, bytes);
}

void memory_return(clast_world *w, size_t bytes) {
    __atomic_sub_fetch(&w->counters.bytes, bytes, __ATOMIC_RELAXED);
}

char *memory_text(clast_world *w, const char *text) {
    return memory_copy(w, text ? text : "", strlen(text ? text : "") + 1, 1);
}

void memory_release(void *p) {
    free(p);
}
