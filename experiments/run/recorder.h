/* recorder.h - the tables of a run: series.csv and the samples of its measures. */
#ifndef CLAST_RUN_RECORDER_H
#define CLAST_RUN_RECORDER_H

#include "experiments/run/measure.h"

typedef struct recorder {
    const scene *scene;
    moment now;
    measure_memory *memories; /* one per measure */
    table series;
    table feeds, outlets; /* where there are any */
    bool needs_contacts;
} recorder;

/* Takes note of the bodies that the scene starts with; opens nothing yet. */
void recorder_start(recorder *r, const scene *s);

/* Creates the tables, or goes on with those of the folder, keeping the rows for which keep() holds,
 * and of bodies that came and went those for which keep_passage() does. */
int recorder_create(recorder *r, const char *folder);
typedef bool keep_row_fn(uint64_t step, const void *context);
int recorder_continue(recorder *r, const char *folder, keep_row_fn *keep, keep_row_fn *keep_passage,
                      const void *context);

/* Writes one row of every table but those of bodies that came and went; 0 or errno of the first
 * failure. */
int recorder_row(recorder *r);

/* Writes who came and went since the last call, and puts all rows on the disk. */
int recorder_passages(recorder *r);
int recorder_sync(recorder *r);
void recorder_stop(recorder *r);

/* What measures remember, as text for the checkpoint; and back. */
void recorder_write_memory(const recorder *r, FILE *to);
void recorder_read_memory(recorder *r, const char *note);

#endif
