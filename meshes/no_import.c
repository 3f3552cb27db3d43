/* In place of import.c where assimp is missing: shapes from measures are there, files are not. */
#include "meshes/status.h"
#include "meshes/work.h"

mesh_status mesh_import(const char *path, mesh_surface *raw, mesh_report *report) {
    MESH_ASSERT(path && raw && report);
    return mesh_fail(MESH_ERR_OPEN,
                     "%s: a mesh, but this program was built without assimp (libassimp-dev)", path);
}
