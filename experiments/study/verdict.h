/* verdict.h - our results beside the published ones, and what to make of it.
 *
 *     verdict_table *v = verdict_new("button-hopper");
 *     verdict_published(v, published_find(numbers, "rate at 5 cm"), mean_interval(q, 5), true);
 *     int code = verdict_finish(v, "build/validate/button-hopper.csv", stdout);
 *     verdict_free(v);
 *     return code;
 *
 * A mean near a target is judged where its 95 % interval is no wider than the tolerance: met
 * inside, missed outside. Where it is wider, the row is missed if the whole interval lies outside,
 * or else open: too few runs to say. Where a row says "equal", the data must show equality: an
 * equivalence test with the tolerance as margin, P < 0.05, at least two replicates. "At most" and
 * "at least" are claims too: the whole interval must lie on that side. What a claim does not show
 * is missed, never open. One number without a spread is compared as it is. A mean that does not
 * exist (all runs blocked) is missed. An explanation changes nothing here. */
#ifndef CLAST_STUDY_VERDICT_H
#define CLAST_STUDY_VERDICT_H

#include <stdbool.h>
#include <stdio.h>

#include "experiments/study/published.h"
#include "experiments/study/statistics.h"

typedef enum verdict {
    VERDICT_MET,
    VERDICT_MISSED,
    VERDICT_OPEN,
    VERDICT_NOT_COMPARABLE,
    VERDICTS
} verdict;

typedef struct verdict_table verdict_table;

verdict_table *verdict_new(const char *study);
void verdict_free(verdict_table *v);

/* NAN for an experiment or thesis value that the source does not print; the target is the
 * experiment where there is one. A row that is not comparable, or has no tolerance or no target, is
 * reported and not counted. */
verdict verdict_add(verdict_table *v, const char *quantity, const char *unit, double experiment,
                    double thesis, interval ours, tolerance allowed, bool comparable);

/* The same from a row of published.csv, whose source goes into the table too. p must not be NULL.
 */
verdict verdict_published(verdict_table *v, const published *p, interval ours, bool comparable);

/* The same for the row of that name; without one, exits with code 4. */
verdict verdict_measured(verdict_table *v, const published_table *numbers, const char *quantity,
                         interval ours);

/* The same for one exact number. */
verdict verdict_named(verdict_table *v, const published_table *numbers, const char *quantity,
                      double ours);

/* Pure: what verdict_add decides. */
verdict verdict_of(double target, interval ours, tolerance allowed, bool comparable);

/* Prints one line per quantity and "<study>: N of M met, K open" (K of the M; not said where 0),
 * and writes the table to the file csv (its folders are made, it appears whole or not at all).
 * Returns the exit code: 0 none missed and at least one met, 1 not, 4 the file could not be written
 * (said on stderr). */
int verdict_finish(const verdict_table *v, const char *csv, FILE *out);

/* "47.3 ± 2.1": two digits of the interval decide; "47.31 (n = 1)" without one; "0.0213" where no
 * sample was taken; "none" without a mean. */
void interval_text(const interval *x, char *text, size_t room);

#endif
