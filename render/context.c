#include "render/context.h"

#include "render/status.h"

#include <dlfcn.h> /* a machine that lacks one backend still runs the other */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h> /* sysconf */

struct render_context {
    const render_backend *backend;
    void *state;
};

/* In the order in which "auto" tries them. */
static const render_backend *const BACKENDS[] = {
#ifdef CLAST_RENDER_OSMESA
    &render_backend_osmesa,
#endif
#ifdef CLAST_RENDER_EGL
    &render_backend_egl,
#endif
    NULL, /* a build with neither still links, and says so when asked to draw */
};

void *render_library_open(const char *const *names) {
    for (; *names; names++) {
        void *library = dlopen(*names, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
        if (library) return library;
    }
    return NULL;
}

render_proc render_library_proc(void *library, const char *name) {
    void *address = dlsym(library, name);
    render_proc proc = NULL;
    memcpy(&proc, &address, sizeof proc); /* ISO C has no cast from object to function pointer */
    return proc;
}

/* Mesa reads these when the first context is made. What the user has set wins. */
static void set_environment(void) {
    char cores[24];
    long online = sysconf(_SC_NPROCESSORS_ONLN);
    snprintf(cores, sizeof cores, "%ld", online < 1 ? 1 : online);
    setenv("LP_NUM_THREADS", cores, 0);
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 0); /* or EGL would pick a GPU, with other pixels */
}

static render_status open_one(const render_backend *backend, render_context **context) {
    render_context *made = calloc(1, sizeof *made);
    if (!made) return render_fail(RENDER_ERR_MEMORY, "no memory for an OpenGL context");
    made->backend = backend;
    render_status status = backend->open(&made->state);
    if (status != RENDER_OK) {
        free(made);
        return status;
    }
    *context = made;
    return RENDER_OK;
}

render_status render_context_open(const char *name, render_context **context) {
    RENDER_ASSERT(name && context);
    bool automatic = strcmp(name, "auto") == 0;
    *context = NULL;
    set_environment();
    render_status status = RENDER_ERR_UNAVAILABLE;
    bool tried = false;
    for (const render_backend *const *each = BACKENDS; *each; each++) {
        if (!automatic && strcmp(name, (*each)->name) != 0) continue;
        tried = true;
        status = open_one(*each, context);
        if (status == RENDER_OK) return RENDER_OK;
    }
    if (tried) return status; /* with the text of the last one tried */
    bool known = automatic || strcmp(name, "osmesa") == 0 || strcmp(name, "egl") == 0;
    if (known)
        return render_fail(RENDER_ERR_UNAVAILABLE,
                           "OpenGL backend \"%s\" is not built in: install libosmesa6-dev or "
                           "libegl-dev and build again",
                           name);
    return render_fail(RENDER_ERR_ARGUMENT,
                       "unknown OpenGL backend \"%s\": expected auto, osmesa or egl", name);
}

render_status render_context_bind(render_context *context, bool current) {
    RENDER_ASSERT(context);
    return context->backend->bind(context->state, current);
}

render_proc render_context_proc(const render_context *context, const char *name) {
    RENDER_ASSERT(context && name);
    return context->backend->proc(context->state, name);
}

const char *render_context_name(const render_context *context) {
    return context->backend->name;
}

void render_context_close(render_context *context) {
    if (!context) return;
    context->backend->close(context->state);
    free(context);
}
