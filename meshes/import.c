/* The one file that knows assimp. It is asked for triangles and for nothing else: its step that
 * drops degenerate triangles uses an absolute area (1e-6 square units, everything in a small part),
 * and its step that joins vertices compares normals too, which keeps a cube's corners apart. */
#include "meshes/status.h"
#include "meshes/work.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <string.h>

/* ---- what assimp says ---- */

typedef struct listener {
    mesh_report *report;
    char broken[200]; /* a complaint that means the file is damaged */
} listener;

/* These two readers warn of what is damage, and go on with corners of other facets. */
static bool is_damage(const char *said) {
    return strncmp(said, "STL: ", 5) == 0 || strncmp(said, "OFF: ", 5) == 0;
}

static void copy_line(char *to, size_t room, const char *line) {
    snprintf(to, room, "%.*s", (int)strcspn(line, "\n"), line);
}

static void hear(const char *message, char *user) {
    listener *l = (listener *)(void *)user;
    if (strncmp(message, "Warn", 4) != 0 && strncmp(message, "Error", 5) != 0) return;
    const char *said = strstr(message, ": ");
    said = said ? said + 2 : message;
    if (is_damage(said) && !l->broken[0]) copy_line(l->broken, sizeof l->broken, said);
    if (l->report->loader_warnings++ == 0)
        copy_line(l->report->loader_said, sizeof l->report->loader_said, said);
}

/* 3: triangles (and points and lines); more: polygons; 0: a face without corners. */
static unsigned corners_of(const struct aiScene *scene) {
    unsigned most = 3;
    for (unsigned i = 0; i < scene->mNumMeshes; i++)
        for (unsigned k = 0; k < scene->mMeshes[i]->mNumFaces; k++) {
            unsigned corners = scene->mMeshes[i]->mFaces[k].mNumIndices;
            if (corners == 0) return 0;
            if (corners > most) most = corners;
        }
    return most;
}

/* Polygons are split in a second step: it stops the program (an assertion, on in Debian's build)
 * when a mesh calls itself polygonal and has only faces without corners. */
static const struct aiScene *read_scene(const char *path, listener *l) {
    struct aiLogStream stream = {hear, (char *)l};
    struct aiPropertyStore *wishes = aiCreatePropertyStore();
    aiSetImportPropertyInteger(wishes, AI_CONFIG_IMPORT_NO_SKELETON_MESHES, 1);
    aiAttachLogStream(&stream);
    const struct aiScene *scene =
        aiImportFileExWithProperties(path, aiProcess_ValidateDataStructure, NULL, wishes);
    unsigned corners = scene ? corners_of(scene) : 3;
    if (corners == 0) copy_line(l->broken, sizeof l->broken, "a face without corners");
    if (corners > 3) scene = aiApplyPostProcessing(scene, aiProcess_Triangulate);
    aiDetachLogStream(&stream);
    aiReleasePropertyStore(wishes);
    return scene;
}

/* ---- from its scene to ours ---- */

typedef struct place {
    double m[3][4]; /* node to file */
} place;

static place compose(const place *p, const struct aiMatrix4x4 *a) {
    const double n[4][4] = {{a->a1, a->a2, a->a3, a->a4},
                            {a->b1, a->b2, a->b3, a->b4},
                            {a->c1, a->c2, a->c3, a->c4},
                            {0, 0, 0, 1}};
    place out = {{{0}}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            out.m[i][j] = p->m[i][0] * n[0][j] + p->m[i][1] * n[1][j] + p->m[i][2] * n[2][j] +
                          p->m[i][3] * n[3][j];
    return out;
}

static bool mirrors(const place *p) {
    const double(*m)[4] = p->m;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]) <
           0;
}

typedef struct filling {
    const struct aiScene *scene;
    mesh_surface *raw; /* arrays NULL while counting */
    mesh_report *report;
} filling;

static bool is_against(const struct aiMesh *m, const unsigned *index) {
    const struct aiVector3D *a = &m->mVertices[index[0]], *b = &m->mVertices[index[1]],
                            *c = &m->mVertices[index[2]];
    double ux = (double)b->x - a->x, uy = (double)b->y - a->y, uz = (double)b->z - a->z;
    double vx = (double)c->x - a->x, vy = (double)c->y - a->y, vz = (double)c->z - a->z;
    double dot = 0;
    for (int k = 0; k < 3; k++) {
        const struct aiVector3D *n = &m->mNormals[index[k]];
        dot += n->x * (uy * vz - uz * vy) + n->y * (uz * vx - ux * vz) + n->z * (ux * vy - uy * vx);
    }
    return dot < 0;
}

/* A coordinate that is not a number must not spread to the others of its vertex. */
static double times(double factor, float x) {
    return factor == 0 ? 0 : factor * x;
}

static void fill_vertices(const filling *f, const struct aiMesh *m, const place *p) {
    for (unsigned v = 0; v < m->mNumVertices; v++) {
        const struct aiVector3D *a = &m->mVertices[v];
        double *to = f->raw->vertex + 3 * (f->raw->vertex_count + v);
        for (int k = 0; k < 3; k++)
            to[k] = times(p->m[k][0], a->x) + times(p->m[k][1], a->y) + times(p->m[k][2], a->z) +
                    p->m[k][3];
    }
}

static void fill_triangle(const filling *f, const struct aiMesh *m, const unsigned *index,
                          bool mirrored) {
    size_t t = f->raw->triangle_count;
    int32_t *to = f->raw->triangle + 3 * t;
    for (int k = 0; k < 3; k++) to[k] = (int32_t)(f->raw->vertex_count + index[k]);
    if (m->mNormals && is_against(m, index)) mesh_note(&f->report->against, (int32_t)t);
    if (mirrored) mesh_turn(to);
}

static void take_mesh(const filling *f, const struct aiMesh *m, const place *p) {
    bool filling_in = f->raw->vertex != NULL, mirrored = mirrors(p);
    if (filling_in) fill_vertices(f, m, p);
    for (unsigned i = 0; i < m->mNumFaces; i++) {
        if (m->mFaces[i].mNumIndices != 3) {
            f->report->not_faces += filling_in;
            continue;
        }
        if (filling_in) fill_triangle(f, m, m->mFaces[i].mIndices, mirrored);
        f->raw->triangle_count++;
    }
    f->raw->vertex_count += m->mNumVertices;
}

static void take_node(const filling *f, const struct aiNode *node, const place *above) {
    place p = compose(above, &node->mTransformation);
    for (unsigned i = 0; i < node->mNumMeshes; i++)
        take_mesh(f, f->scene->mMeshes[node->mMeshes[i]], &p);
    for (unsigned i = 0; i < node->mNumChildren; i++) take_node(f, node->mChildren[i], &p);
}

static mesh_status take_scene(const char *path, const filling *f) {
    const place here = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    mesh_surface *raw = f->raw;
    take_node(f, f->scene->mRootNode, &here);
    if (raw->vertex_count > INT32_MAX || raw->triangle_count > INT32_MAX / 3)
        return mesh_fail(MESH_ERR_FORMAT, "%s: %zu triangles, %zu vertices: more than %d, %d", path,
                         raw->triangle_count, raw->vertex_count, INT32_MAX / 3, INT32_MAX);
    raw->vertex = mesh_array(raw->vertex_count, 3 * sizeof *raw->vertex);
    raw->triangle = mesh_array(raw->triangle_count, 3 * sizeof *raw->triangle);
    raw->vertex_count = raw->triangle_count = 0;
    if (!raw->vertex || !raw->triangle) return MESH_ERR_MEMORY;
    take_node(f, f->scene->mRootNode, &here);
    return MESH_OK;
}

mesh_status mesh_import(const char *path, mesh_surface *raw, mesh_report *report) {
    listener l = {.report = report};
    const struct aiScene *scene = read_scene(path, &l);
    mesh_status status = MESH_OK;
    if (!scene)
        status = mesh_fail(MESH_ERR_FORMAT, "%s: not a mesh that can be read: %s", path,
                           aiGetErrorString());
    else if (l.broken[0])
        status = mesh_fail(MESH_ERR_FORMAT, "%s: damaged: %s", path, l.broken);
    else
        status = take_scene(path, &(filling){scene, raw, report});
    if (scene) aiReleaseImport(scene);
    return status;
}
