#include "experiments/run/stage_mesh.h"

#include <stdlib.h>
#include <string.h>

#include "engine/check.h"

/* All meshes one behind the other, and a row of whole numbers for each. */
enum { ROW = 4 };
static const char ROW_TEXT[] = "first wall, vertices, triangles, part";

static void *room(size_t count, size_t size) {
    void *p = calloc(count + 1, size);
    CLAST_ASSERT(p);
    return p;
}

void stage_meshes_write(h5_file *f, const scene *s) {
    CLAST_ASSERT(f && s);
    size_t count = (size_t)s->mesh_count, vertices = 0, triangles = 0;
    if (count == 0) return;
    int32_t *rows = room(count * ROW, sizeof *rows);
    for (size_t i = 0; i < count; i++) {
        const scene_mesh *m = &s->meshes[i];
        rows[ROW * i] = m->wall;
        rows[ROW * i + 1] = (int32_t)m->vertex_count;
        rows[ROW * i + 2] = (int32_t)m->triangle_count;
        rows[ROW * i + 3] = clast_world_wall_part(s->world, m->wall);
        vertices += m->vertex_count, triangles += m->triangle_count;
    }
    double *vertex = room(3 * vertices, sizeof *vertex), *v = vertex;
    int32_t *triangle = room(3 * triangles, sizeof *triangle), *t = triangle;
    for (const scene_mesh *m = s->meshes; m < s->meshes + count; m++) {
        memcpy(v, m->vertex, 3 * m->vertex_count * sizeof *v);
        memcpy(t, m->triangle, 3 * m->triangle_count * sizeof *t);
        v += 3 * m->vertex_count, t += 3 * m->triangle_count;
    }
    h5_write(f, "/meshes/rows", H5_I32, 2, (size_t[]){count, ROW}, rows);
    h5_write(f, "/meshes/vertices", H5_F64, 2, (size_t[]){vertices, 3}, vertex);
    h5_write(f, "/meshes/triangles", H5_I32, 2, (size_t[]){triangles, 3}, triangle);
    h5_attribute_text(f, "/meshes", "columns", ROW_TEXT);
    free(rows), free(vertex), free(triangle);
}

/* The arrays of a file, and how much of them has been taken. */
typedef struct source {
    double *vertex;
    int32_t *triangle;
    size_t vertices, triangles, vertices_taken, triangles_taken;
} source;

/* False where a row asks for more than there is, or a triangle for a vertex of another mesh. */
static bool take(source *from, const int32_t row[ROW], size_t walls, stage_mesh *m) {
    if (row[0] < 0 || (size_t)row[0] >= walls || row[1] < 0 || row[2] < 0 || row[3] < 0)
        return false;
    *m = (stage_mesh){.wall = (size_t)row[0],
                      .part = row[3],
                      .vertex_count = (size_t)row[1],
                      .triangle_count = (size_t)row[2]};
    if (m->vertex_count > from->vertices - from->vertices_taken ||
        m->triangle_count > from->triangles - from->triangles_taken)
        return false;
    m->vertex = room(3 * m->vertex_count, sizeof *m->vertex);
    m->triangle = room(3 * m->triangle_count, sizeof *m->triangle);
    memcpy(m->vertex, from->vertex + 3 * from->vertices_taken,
           3 * m->vertex_count * sizeof *m->vertex);
    const int32_t *t = from->triangle + 3 * from->triangles_taken;
    for (size_t i = 0; i < 3 * m->triangle_count; i++) {
        if (t[i] < 0 || (size_t)t[i] >= m->vertex_count) return false;
        m->triangle[i] = (uint32_t)t[i];
    }
    from->vertices_taken += m->vertex_count, from->triangles_taken += m->triangle_count;
    return true;
}

stage_mesh *stage_meshes_read(h5_file *f, size_t walls, size_t *count) {
    CLAST_ASSERT(f && count);
    *count = 0;
    if (h5_status(f) != CLAST_OK || !h5_has(f, "/meshes")) return NULL;
    size_t rows, vertices, triangles;
    int32_t *row = h5_read_all(f, "/meshes/rows", H5_I32, &rows);
    source from = {.vertex = h5_read_all(f, "/meshes/vertices", H5_F64, &vertices),
                   .triangle = h5_read_all(f, "/meshes/triangles", H5_I32, &triangles)};
    from.vertices = vertices / 3, from.triangles = triangles / 3;
    stage_mesh *meshes = room(rows / ROW, sizeof *meshes);
    bool good = h5_status(f) == CLAST_OK;
    for (size_t i = 0; i < rows / ROW && good; i++) {
        good = take(&from, row + ROW * i, walls, &meshes[i]);
        *count = i + 1;
        if (!good) h5_fail(f, CLAST_ERR_FORMAT, "mesh %zu does not fit what is stored", i);
    }
    free(row), free(from.vertex), free(from.triangle);
    return meshes;
}

void stage_meshes_free(stage_mesh *meshes, size_t count) {
    for (size_t i = 0; i < count; i++) free(meshes[i].vertex), free(meshes[i].triangle);
    free(meshes);
}
