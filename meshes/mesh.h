/* mesh.h: triangle meshes from files as plain arrays, cleaned, with a report of what was found and
 * what was done about it. Reads STL, OBJ, PLY, glTF and whatever else assimp reads.
 *
 *     mesh_options options = mesh_options_default();
 *     options.unit = 1e-3;                                     // the file is in millimetres
 *     mesh_surface silo;
 *     mesh_report report;
 *     if (mesh_load("silo.stl", &options, &silo, &report) != MESH_OK) {
 *         fprintf(stderr, "%s\n", mesh_error_text());
 *         return 1;
 *     }
 *     mesh_report_write(&report, "silo.stl", stdout);
 *     ... silo.vertex, silo.triangle ...
 *     mesh_free(&silo);
 *
 * Conventions. Lengths are in metres; triangles run counter-clockwise seen from outside. Triangles
 * of the file are counted from 1 in messages and findings (a polygon counts as the triangles that
 * it was split into).
 *
 * Failure. What depends on the file, or on values that a user gave, returns a status that must be
 * looked at; mesh_error_text() then names the file and says what was found. A broken promise in the
 * arguments (a null pointer) stops the program with file and line.
 *
 * Threads. Files are read by one thread at a time: assimp has one log for the whole process.
 * Everything else may be used by several threads.
 */
#ifndef CLAST_MESHES_MESH_H
#define CLAST_MESHES_MESH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#if defined(__GNUC__)
#define MESH_MUST_CHECK __attribute__((warn_unused_result))
#else
#define MESH_MUST_CHECK
#endif

/* ---- Status ---- */

typedef enum mesh_status {
    MESH_OK = 0,
    MESH_ERR_ARGUMENT, /* an option is out of its range */
    MESH_ERR_OPEN,     /* the file is missing, unreadable, or no file at all */
    MESH_ERR_FORMAT,   /* empty, cut off, not a mesh, or with coordinates that cannot be */
    MESH_ERR_MEMORY,   /* an allocation was refused */
    MESH_ERR_WRITE     /* a file could not be written in full; nothing half-written is left */
} mesh_status;

/* What went wrong in the last call of this thread that returned anything but MESH_OK. */
const char *mesh_error_text(void);

/* ---- A mesh ---- */

/* Arrays belong to the surface; mesh_free() returns them. Zeroed: no mesh. */
typedef struct mesh_surface {
    size_t vertex_count;
    double *vertex; /* m, x y z x y z ... */
    size_t triangle_count;
    int32_t *triangle; /* three vertex numbers each */
} mesh_surface;

void mesh_free(mesh_surface *surface);

/* ---- Options ---- */

typedef struct mesh_options {
    double unit; /* m per unit of the file, > 0: 1e-3 for millimetres */
    int axis[3]; /* our x, y, z are these axes of the file: 1 x, 2 y, 3 z, negative where reversed.
                    {1, -3, 2} stands a file whose y is up upright. A mirroring choice keeps
                    outsides outside. */
    double weld; /* vertices closer than this share of the diagonal of the box become one, and
                    triangles flatter than this are slivers; 1e-12 to 1e-2, typical 1e-6 */
    bool mend_winding;   /* turn triangles that run against the rest of their piece */
    bool find_crossings; /* look for triangles that pass through each other, too; takes about as
                            long as reading them */
} mesh_options;

/* Metres, axes as they are, weld 1e-6, winding mended, crossings not looked for. */
mesh_options mesh_options_default(void);

/* "mm", "cm", "m", "inch" or a number of metres. */
MESH_MUST_CHECK mesh_status mesh_unit_parse(const char *text, double *unit);

/* Three signed axes such as "xyz", "x -z y" or "x,-z,y": see mesh_options. */
MESH_MUST_CHECK mesh_status mesh_axes_parse(const char *text, int axis[3]);

/* ---- The report ---- */

typedef struct mesh_finding {
    size_t count;
    size_t first; /* triangle of the file where it was seen first, from 1; 0 when count is 0 */
} mesh_finding;

typedef struct mesh_report {
    /* as read */
    size_t vertices_read, triangles_read;
    size_t not_faces;       /* points and lines, left out */
    mesh_finding against;   /* stored normal opposes the winding: the winding is believed */
    size_t loader_warnings; /* what assimp complained of and read all the same */
    char loader_said[200];  /* the first of those; "" when there is none */

    /* vertices */
    double weld_distance; /* m */
    size_t joined;        /* with one at the same place or nearby */
    size_t moved;         /* those of them that were not at the same place */
    double farthest_move; /* m, <= weld_distance */
    size_t unused;        /* in no triangle that is left: removed */

    /* triangles removed */
    mesh_finding collapsed;  /* two corners became one */
    mesh_finding slivers;    /* height below weld_distance */
    mesh_finding duplicates; /* the corners of an earlier triangle, in either direction */

    /* what is left: edges and winding */
    mesh_finding open_edges;      /* of one triangle */
    mesh_finding branching_edges; /* of three and more */
    mesh_finding twisted_edges;   /* no choice of winding agrees here: a Moebius band */
    mesh_finding flipped;         /* triangles that ran against the rest of their piece ... */
    bool mended;                  /* ... and were turned */
    size_t pieces;                /* connected across edges of two triangles */
    size_t inward;                /* closed pieces that face inwards (a cavity?): left so */
    bool closed;                  /* every edge joins two triangles that agree */

    /* left as they are; all of this is 0 unless options.find_crossings */
    bool crossings_sought, crossings_given_up; /* given up: there may be more */
    mesh_finding crossings;   /* pairs that pass through each other by more than weld_distance */
    size_t crossings_partner; /* the other triangle of the first pair */

    double area;            /* m2 */
    double volume;          /* m3, of a closed mesh; 0 otherwise */
    double low[3], high[3]; /* m, the box */
} mesh_report;

/* A few lines for people; `name` starts the first. Nothing is said of what was not found. */
void mesh_report_write(const mesh_report *report, const char *name, FILE *to);

/* ---- Making one ---- */

/* Reads, scales, welds, removes, mends and measures. On failure the surface is empty. `report` may
 * be NULL; on failure it holds what was known by then. */
MESH_MUST_CHECK mesh_status mesh_load(const char *path, const mesh_options *options,
                                      mesh_surface *surface, mesh_report *report);

/* The same for arrays in the caller's units; `name` stands for the file in messages. */
MESH_MUST_CHECK mesh_status mesh_build(const char *name, const mesh_surface *raw,
                                       const mesh_options *options, mesh_surface *surface,
                                       mesh_report *report);

/* The edges that do not join two triangles, as pairs of vertex numbers; the caller frees *ends. */
MESH_MUST_CHECK mesh_status mesh_loose_edges(const mesh_surface *surface, int32_t **ends,
                                             size_t *count);

/* Binary STL in metres, single precision as the format has it; written aside and renamed. The same
 * surface gives the same bytes. */
MESH_MUST_CHECK mesh_status mesh_write_stl(const mesh_surface *surface, const char *path);

#endif
