/* The EGL body of context.h: Mesa's surfaceless platform, no display, no window. The only file that
 * knows EGL. */
#include "render/context.h"
#include "render/status.h"

#include <EGL/egl.h> /* types and constants; the library itself is opened at run time */
#include <EGL/eglext.h>
#include <stdlib.h>
#include <string.h>

#ifndef EGL_PLATFORM_SURFACELESS_MESA
#define EGL_PLATFORM_SURFACELESS_MESA 0x31DD
#endif

/* A prototype of each, because egl.h may be built without prototypes and types alike. */
typedef render_proc (*proc_fn)(const char *);
typedef EGLDisplay (*display_fn)(EGLenum, void *, const EGLAttrib *);
typedef EGLBoolean (*initialize_fn)(EGLDisplay, EGLint *, EGLint *);
typedef const char *(*query_fn)(EGLDisplay, EGLint);
typedef EGLBoolean (*api_fn)(EGLenum);
typedef EGLBoolean (*config_fn)(EGLDisplay, const EGLint *, EGLConfig *, EGLint, EGLint *);
typedef EGLContext (*create_fn)(EGLDisplay, EGLConfig, EGLContext, const EGLint *);
typedef EGLBoolean (*current_fn)(EGLDisplay, EGLSurface, EGLSurface, EGLContext);
typedef EGLBoolean (*destroy_fn)(EGLDisplay, EGLContext);
typedef EGLint (*error_fn)(void);

typedef struct egl {
    proc_fn proc;
    display_fn display_of;
    initialize_fn initialize;
    query_fn query;
    api_fn bind_api;
    config_fn choose;
    create_fn create;
    current_fn make_current;
    destroy_fn destroy;
    error_fn error;
    EGLDisplay display;
    EGLContext context;
} egl;

static const char *const LIBRARIES[] = {"libEGL.so.1", "libEGL.so", NULL};

static render_status load(egl *e) {
    void *library = render_library_open(LIBRARIES);
    if (!library)
        return render_fail(RENDER_ERR_UNAVAILABLE, "EGL: no %s on this machine", LIBRARIES[0]);
    e->proc = (proc_fn)render_library_proc(library, "eglGetProcAddress");
    e->display_of = (display_fn)render_library_proc(library, "eglGetPlatformDisplay");
    e->initialize = (initialize_fn)render_library_proc(library, "eglInitialize");
    e->query = (query_fn)render_library_proc(library, "eglQueryString");
    e->bind_api = (api_fn)render_library_proc(library, "eglBindAPI");
    e->choose = (config_fn)render_library_proc(library, "eglChooseConfig");
    e->create = (create_fn)render_library_proc(library, "eglCreateContext");
    e->make_current = (current_fn)render_library_proc(library, "eglMakeCurrent");
    e->destroy = (destroy_fn)render_library_proc(library, "eglDestroyContext");
    e->error = (error_fn)render_library_proc(library, "eglGetError");
    if (!e->proc || !e->display_of || !e->initialize || !e->query || !e->bind_api || !e->choose ||
        !e->create || !e->make_current || !e->destroy || !e->error)
        return render_fail(RENDER_ERR_UNAVAILABLE, "EGL: the library is older than EGL 1.5");
    return RENDER_OK;
}

static render_status open_display(egl *e) {
    const char *platforms = e->query(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!platforms || !strstr(platforms, "EGL_MESA_platform_surfaceless"))
        return render_fail(RENDER_ERR_UNAVAILABLE,
                           "EGL: no surfaceless platform (Mesa's libegl-mesa0 has one)");
    e->display = e->display_of(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (e->display == EGL_NO_DISPLAY || !e->initialize(e->display, NULL, NULL))
        return render_fail(RENDER_ERR_UNAVAILABLE,
                           "EGL: the surfaceless display does not open (error 0x%x)",
                           (unsigned)e->error());
    return RENDER_OK;
}

static render_status create(egl *e) {
    /* clang-format off */
    static const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                    EGL_SURFACE_TYPE, 0,
                                    EGL_NONE};
    static const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 4,
                                     EGL_CONTEXT_MINOR_VERSION, 5,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                     EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                     EGL_NONE};
    /* clang-format on */
    EGLConfig config = NULL;
    EGLint found = 0;
    if (!e->bind_api(EGL_OPENGL_API) || !e->choose(e->display, wanted, &config, 1, &found) ||
        found < 1)
        return render_fail(RENDER_ERR_UNAVAILABLE, "EGL: no configuration for desktop OpenGL");
    e->context = e->create(e->display, config, EGL_NO_CONTEXT, version);
    if (e->context == EGL_NO_CONTEXT)
        return render_fail(RENDER_ERR_UNAVAILABLE, "EGL: no OpenGL 4.5 core context (error 0x%x)",
                           (unsigned)e->error());
    return RENDER_OK;
}

/* The display is shared by the whole process and is not terminated: another user of EGL in the same
 * program would lose its contexts. */
static render_status egl_open(void **state) {
    egl *e = calloc(1, sizeof *e);
    if (!e) return render_fail(RENDER_ERR_MEMORY, "no memory for EGL");
    render_status status = load(e);
    if (status == RENDER_OK) status = open_display(e);
    if (status == RENDER_OK) status = create(e);
    if (status != RENDER_OK) {
        free(e);
        return status;
    }
    *state = e;
    return RENDER_OK;
}

static render_status egl_bind(void *state, bool current) {
    egl *e = state;
    EGLContext context = current ? e->context : EGL_NO_CONTEXT;
    if (!e->make_current(e->display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
        return render_fail(RENDER_ERR_GL, "EGL: the context cannot be made current (error 0x%x)",
                           (unsigned)e->error());
    return RENDER_OK;
}

static render_proc egl_proc(const void *state, const char *name) {
    return ((const egl *)state)->proc(name);
}

static void egl_close(void *state) {
    egl *e = state;
    e->destroy(e->display, e->context);
    free(e);
}

const render_backend render_backend_egl = {"egl", egl_open, egl_bind, egl_proc, egl_close};
