/* arena.h - memory that lives exactly as long as one reading of a scene file.
 *
 * A scene is read into some thousand small texts and nodes which all die together, so they are
 * freed together; a ladder of free() per fault path was rejected.
 */
#ifndef CLAST_SCENE_ARENA_H
#define CLAST_SCENE_ARENA_H

#include <stdarg.h>
#include <stddef.h>

/* A broken promise of a caller stops the program with file and line, in release builds too. */
#define SCENE_ASSERT(condition)                                                                    \
    ((condition) ? (void)0 : scene_panic(__FILE__, __LINE__, #condition))
_Noreturn void scene_panic(const char *file, int line, const char *condition);

typedef struct scene_arena {
    struct scene_block *last;
} scene_arena; /* {0} is an empty arena */

/* Zeroed memory, aligned for any type; stops the program when there is none. */
void *scene_alloc(scene_arena *arena, size_t bytes);
char *scene_copy(scene_arena *arena, const char *text, size_t length);
char *scene_print(scene_arena *arena, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
char *scene_vprint(scene_arena *arena, const char *format, va_list arguments);
void scene_arena_free(scene_arena *arena);

/* A text that grows by pieces; `text` belongs to the caller of free(). */
typedef struct scene_buffer {
    char *text;
    size_t length, room;
} scene_buffer;

void scene_append(scene_buffer *buffer, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
