/* The OSMesa body of context.h, and the only file that knows OSMesa. */
#include "render/context.h"
#include "render/status.h"

#include <GL/osmesa.h> /* types and constants; the library itself is opened at run time */
#include <stdlib.h>

/* OSMesa insists on a buffer of the caller to draw into; ours stays unused. */
enum { DUMMY_SIZE = 16 };

/* A prototype of each, because osmesa.h declares functions and no pointer types. */
typedef OSMesaContext (*create_fn)(const int *attributes, OSMesaContext share);
typedef GLboolean (*current_fn)(OSMesaContext, void *, GLenum, GLsizei, GLsizei);
typedef void (*destroy_fn)(OSMesaContext);
typedef OSMESAproc (*proc_fn)(const char *);

typedef struct osmesa {
    create_fn create;
    current_fn make_current;
    destroy_fn destroy;
    proc_fn proc;
    OSMesaContext context;
    GLubyte buffer[DUMMY_SIZE * DUMMY_SIZE * 4];
} osmesa;

static const char *const LIBRARIES[] = {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so", NULL};

static render_status load(osmesa *mesa) {
    void *library = render_library_open(LIBRARIES);
    if (!library)
        return render_fail(RENDER_ERR_UNAVAILABLE, "OSMesa: no %s on this machine", LIBRARIES[0]);
    mesa->create = (create_fn)render_library_proc(library, "OSMesaCreateContextAttribs");
    mesa->make_current = (current_fn)render_library_proc(library, "OSMesaMakeCurrent");
    mesa->destroy = (destroy_fn)render_library_proc(library, "OSMesaDestroyContext");
    mesa->proc = (proc_fn)render_library_proc(library, "OSMesaGetProcAddress");
    if (!mesa->create || !mesa->make_current || !mesa->destroy || !mesa->proc)
        return render_fail(RENDER_ERR_UNAVAILABLE,
                           "OSMesa: the library is too old (no OSMesaCreateContextAttribs)");
    return RENDER_OK;
}

static render_status osmesa_open(void **state) {
    /* clang-format off */
    static const int attributes[] = {OSMESA_FORMAT, OSMESA_RGBA,
                                     OSMESA_DEPTH_BITS, 0,
                                     OSMESA_STENCIL_BITS, 0,
                                     OSMESA_ACCUM_BITS, 0,
                                     OSMESA_PROFILE, OSMESA_CORE_PROFILE,
                                     OSMESA_CONTEXT_MAJOR_VERSION, 4,
                                     OSMESA_CONTEXT_MINOR_VERSION, 5,
                                     0, 0};
    /* clang-format on */
    osmesa *mesa = calloc(1, sizeof *mesa);
    if (!mesa) return render_fail(RENDER_ERR_MEMORY, "no memory for OSMesa");
    render_status status = load(mesa);
    if (status == RENDER_OK && !(mesa->context = mesa->create(attributes, NULL)))
        status = render_fail(RENDER_ERR_UNAVAILABLE, "OSMesa: no OpenGL 4.5 core context");
    if (status != RENDER_OK) {
        free(mesa);
        return status;
    }
    *state = mesa;
    return RENDER_OK;
}

static render_status osmesa_bind(void *state, bool current) {
    osmesa *mesa = state;
    GLboolean done = current ? mesa->make_current(mesa->context, mesa->buffer, GL_UNSIGNED_BYTE,
                                                  DUMMY_SIZE, DUMMY_SIZE)
                             : mesa->make_current(NULL, NULL, 0, 0, 0);
    if (!done) return render_fail(RENDER_ERR_GL, "OSMesa: the context cannot be made current");
    return RENDER_OK;
}

static render_proc osmesa_proc(const void *state, const char *name) {
    return (render_proc)((const osmesa *)state)->proc(name);
}

static void osmesa_close(void *state) {
    osmesa *mesa = state;
    mesa->destroy(mesa->context);
    free(mesa);
}

const render_backend render_backend_osmesa = {"osmesa", osmesa_open, osmesa_bind, osmesa_proc,
                                              osmesa_close};
