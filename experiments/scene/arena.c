#include "experiments/scene/arena.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct scene_block {
    struct scene_block *before;
    max_align_t bytes[]; /* keeps what follows aligned for any type */
};

void scene_panic(const char *file, int line, const char *condition) {
    fprintf(stderr, "%s:%d: broken promise: %s\n", file, line, condition);
    abort();
}

static void *must(void *memory) {
    if (!memory) {
        fputs("clast: out of memory while reading a scene\n", stderr);
        abort();
    }
    return memory;
}

void *scene_alloc(scene_arena *arena, size_t bytes) {
    SCENE_ASSERT(arena && bytes < SIZE_MAX / 2);
    struct scene_block *block = must(calloc(1, sizeof *block + bytes));
    block->before = arena->last;
    arena->last = block;
    return block->bytes;
}

char *scene_copy(scene_arena *arena, const char *text, size_t length) {
    SCENE_ASSERT(text || length == 0);
    char *copy = scene_alloc(arena, length + 1);
    if (length) memcpy(copy, text, length);
    return copy;
}

char *scene_vprint(scene_arena *arena, const char *format, va_list arguments) {
    va_list again;
    va_copy(again, arguments);
    int length = vsnprintf(NULL, 0, format, again);
    va_end(again);
    SCENE_ASSERT(length >= 0);
    char *text = scene_alloc(arena, (size_t)length + 1);
    vsnprintf(text, (size_t)length + 1, format, arguments);
    return text;
}

char *scene_print(scene_arena *arena, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    char *text = scene_vprint(arena, format, arguments);
    va_end(arguments);
    return text;
}

void scene_arena_free(scene_arena *arena) {
    SCENE_ASSERT(arena);
    while (arena->last) {
        struct scene_block *block = arena->last;
        arena->last = block->before;
        free(block);
    }
}

void scene_append(scene_buffer *buffer, const char *format, ...) {
    SCENE_ASSERT(buffer && format);
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    SCENE_ASSERT(length >= 0);
    size_t needed = buffer->length + (size_t)length + 1;
    if (needed > buffer->room) {
        buffer->room = needed > 2 * buffer->room ? needed : 2 * buffer->room;
        buffer->text = must(realloc(buffer->text, buffer->room));
    }
    vsnprintf(buffer->text + buffer->length, (size_t)length + 1, format, again);
    va_end(again);
    buffer->length += (size_t)length;
}
