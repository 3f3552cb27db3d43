/* observable.h - one number of a run: a column of its measures and how it is reduced. */
#ifndef CLAST_TUNE_OBSERVABLE_H
#define CLAST_TUNE_OBSERVABLE_H

#include "experiments/run/results.h"
#include "experiments/scene/scene.h"

typedef enum reduction {
    REDUCE_FINAL, /* the last row */
    REDUCE_MEAN,  /* mean of the rows of the second half of the time */
    REDUCE_RATE   /* slope of the linear part of a cumulative curve, per second (study/statistics.h)
                   */
} reduction;

enum { OBSERVABLE_NAME = 200 };

typedef struct observable {
    char name[OBSERVABLE_NAME];   /* with its reduction: "out.kg:rate" */
    char column[OBSERVABLE_NAME]; /* of series.csv: "out_kg" */
    reduction how;
} observable;

/* Reads "MEASURE.COLUMN[:REDUCTION]" for the measures of this scene. NULL, or a malloc'ed message
 * that lists what there is. Without a reduction: the rate of what is discharged, the final value of
 * what remains, the mean of anything else. */
char *observable_find(observable *o, const scene *s, const char *text);

/* NAN where the run has no such value: no rows, an empty band, no linear part. */
double observable_reduce(const observable *o, const csv *series);

/* "final", "mean" or "rate". */
const char *reduction_name(reduction how);

#endif
