/* search.h - finds the cheapest setting that keeps the observable.
 *
 * One knob at a time, cheapest level first, until one is kept; then the knobs together, cheapest
 * first; then the best on replicates that had no say in the choice, for the best of many is partly
 * the luckiest. */
#ifndef CLAST_TUNE_SEARCH_H
#define CLAST_TUNE_SEARCH_H

#include <stdio.h>

#include "experiments/tune/paired.h"
#include "experiments/tune/pilot.h"

typedef enum verdict_of_trial {
    TRIAL_KEPT,    /* the interval lies within the tolerance */
    TRIAL_OUTSIDE, /* the interval lies outside */
    TRIAL_OPEN,    /* neither, after the last look: not shown, so not used */
    TRIAL_STOPPED, /* a guard or the check of the scene stopped it */
    TRIAL_NO_GAIN  /* kept, but saves less than 2 % */
} verdict_of_trial;

typedef struct trial {
    candidate pilots;
    paired found; /* at the last look of the search */
    verdict_of_trial verdict;
    bool checked; /* on fresh replicates: */
    paired fresh;
    verdict_of_trial fresh_verdict;
} trial;

enum { TRIALS_MAX = 64 };

typedef struct search {
    tune *t;
    candidate reference;
    trial *trials[TRIALS_MAX]; /* in the order in which they were made */
    int count;
    const trial *chosen; /* NULL: nothing cheaper keeps the observable */
} search;

/* Runs everything. False with t->failure. t->seeds, t->most and t->confirm are set from what
 * replicates there are. */
bool search_run(search *s);

/* Judges t->other against the scene as it stands: all replicates there are, one look, no search.
 * False with t->failure. */
bool search_verify(search *s);

void search_free(search *s);

/* 1 - 0.05 / looks: of every interval of this search, in per cent. */
double search_confidence(const search *s);

/* report.c: what was tried, what is chosen, and why. */
void search_print(const search *s, FILE *to);

/* The text of the chosen scene behind a comment that says why; malloc'ed. */
char *search_scene(const search *s);

#endif
