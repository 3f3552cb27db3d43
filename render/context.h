/* context.h: an off-screen OpenGL 4.5 core context. These four functions are all that render/ knows
 * of where a context comes from; everything is drawn into our own framebuffer objects, so a context
 * has no size and no pixels of its own. */
#ifndef RENDER_CONTEXT_H
#define RENDER_CONTEXT_H

#include "render/render.h"

typedef void (*render_proc)(void);
typedef struct render_context render_context;

/* "osmesa", "egl", or "auto": OSMesa if it can be had, else EGL. Leaves no context current. */
render_status render_context_open(const char *backend, render_context **context);

/* Makes it current for this thread (true) or leaves none current (false). Contexts of both kinds
 * may live in one process, but they share Mesa's per-thread dispatch, so one is released before the
 * other is made current: a caller binds, draws, and unbinds. */
render_status render_context_bind(render_context *context, bool current);

/* The entry point of that name. Not NULL for names that do not exist (OSMesa hands out stubs), so
 * the caller checks the GL version first. */
render_proc render_context_proc(const render_context *context, const char *name);

void render_context_close(render_context *context);

const char *render_context_name(const render_context *context);

/* What a backend provides: one static record per file, listed in context.c. */
typedef struct render_backend {
    const char *name;
    render_status (*open)(void **state);
    render_status (*bind)(void *state, bool current);
    render_proc (*proc)(const void *state, const char *name);
    void (*close)(void *state);
} render_backend;

extern const render_backend render_backend_osmesa, render_backend_egl;

/* The symbol in a library found by the first of the names; NULL ends the list. Libraries stay
 * loaded: Mesa keeps threads and exit handlers that do not survive being unloaded. */
void *render_library_open(const char *const *names);
render_proc render_library_proc(void *library, const char *name);

#endif
