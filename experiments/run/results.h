/* results.h - reads the folder of a run back: finished, interrupted or killed.
 *
 *     char why[RESULTS_ERROR_MAX];
 *     results *r = results_open("build/hopper", why);
 *     const double *t = results_series(r, "time_s"), *kg = results_series(r, "out_kg");
 *     for (size_t i = 0; i < results_rows(r); i++) printf("%g %g\n", t[i], kg[i]);
 *     for (size_t i = 0; i < results_frames(r); i++) {
 *         frame *f = results_frame(r, i);
 *         ...
 *         frame_free(f);
 *     }
 *     results_free(r);
 */
#ifndef CLAST_RUN_RESULTS_H
#define CLAST_RUN_RESULTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "experiments/run/stage.h"

enum { RESULTS_ERROR_MAX = 1024 };

/* ---- tables: any CSV file of a run ----------------------------------------------------------- */

typedef struct csv {
    size_t rows, columns;
    char **names;    /* from the header line */
    double **values; /* [column][row] */
} csv;

/* NULL with a reason when there is no such file or no header. A last line without an end (a run
 * that was killed while writing) is left out. */
csv *csv_read(const char *path, char error[RESULTS_ERROR_MAX]);
const double *csv_column(const csv *t, const char *name); /* NULL when there is none */
void csv_free(csv *t);

/* ---- who came and who went: feeds.csv, outlets.csv ------------------------------------------- */

enum { TRANSIT_NAME_MAX = 64 };
typedef char transit_name[TRANSIT_NAME_MAX];

/* In the order of time; gate: the feed or the outlet, "domain" for bodies that left the domain.
 * diameter (m): of one sphere its own, else of the sphere of the same volume. */
typedef struct transits {
    size_t count;
    uint32_t *id;
    uint64_t *step;
    double *time, *mass, *diameter; /* s, kg, m */
    transit_name *gate, *shape;
} transits;

/* NULL with a reason when there is no such file, or a line of it is none. A last line without an
 * end is left out. */
transits *transits_read(const char *path, char error[RESULTS_ERROR_MAX]);
void transits_free(transits *t);

/* ---- a run ----------------------------------------------------------------------------------- */

typedef struct results results;

/* NULL with a reason when the folder holds no run. */
results *results_open(const char *folder, char error[RESULTS_ERROR_MAX]);
void results_free(results *r);

/* Walls, domain and view. */
const stage *results_stage(const results *r);

/* Rows and columns of series.csv. */
size_t results_rows(const results *r);
const double *results_series(const results *r, const char *column);

/* Frames in the order of time. */
size_t results_frames(const results *r);
size_t results_frame_at(const results *r, double time); /* the one nearest in time */

/* One frame; bodies by ascending id, spheres in the order of bodies. */
typedef struct frame {
    double time; /* s */
    uint64_t step;
    size_t bodies, spheres, contacts;
    uint32_t *id;
    int32_t *shape, *rank; /* rank: the process that had it; NULL in a run of one */
    double *position, *orientation, *velocity, *spin; /* 3, 4 (w x y z), 3, 3 numbers per body */
    double *centre;                  /* m, 3 per sphere; single precision in the file */
    double *radius, *speed;          /* m, m/s, per sphere */
    uint32_t *sphere_body;           /* id */
    size_t parts;                    /* 0 in runs of earlier versions */
    double *turn, *shift;            /* of parts (clast_pose): 4 (w x y z) and 3 (m) numbers */
    int32_t *present;                /* whether a part is there */
    uint32_t *contact_a, *contact_b; /* NULL when the run did not keep contacts */
    double *contact_point, *contact_force; /* 3 per contact */
    double *contact_normal, *contact_overlap;
} frame;

/* NULL when the frame cannot be read: results_error() says why. */
frame *results_frame(results *r, size_t i);
const char *results_error(const results *r);
void frame_free(frame *f);

#endif
