/* status.h: the failures inside meshes/. A broken invariant stops with file and line (MESH_ASSERT,
 * also in release); the outside world returns a status through mesh_fail(). */
#ifndef CLAST_MESHES_STATUS_H
#define CLAST_MESHES_STATUS_H

#include "meshes/mesh.h"

#define MESH_ASSERT(cond) ((cond) ? (void)0 : mesh_panic(__FILE__, __LINE__, #cond))

_Noreturn void mesh_panic(const char *file, int line, const char *condition);

/* Keeps the text for mesh_error_text() of this thread and returns the code. */
mesh_status mesh_fail(mesh_status code, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* malloc that fills in the failure: NULL means "return MESH_ERR_MEMORY". Never NULL for no items.
 */
void *mesh_array(size_t count, size_t size);

#endif
