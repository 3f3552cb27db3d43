/* picks.h - what to pick and what it costs, in words computed from the points. */
#ifndef CLAST_SPEED_ACCURACY_PICKS_H
#define CLAST_SPEED_ACCURACY_PICKS_H

#include <stdio.h>

#include "experiments/speed-accuracy/chart.h"

/* picks.csv: for every panel and every error that can be accepted, the setting with the least
 * processor time and the one with the fewest force evaluations. 0, or 4. */
int picks_write(const chart *c, const char *folder);

/* The picks of a part at one accepted, in a sentence. */
void picks_say(FILE *f, const chart *c, const char *part, double accepted);

/* Settings whose difference from the reference cannot be told from zero, with what it is at most.
 */
void picks_say_unseen(FILE *f, const chart *c, const char *part, const char *quantity);

/* Whether a point is of a scheme of that kind; a setting of another sort is of neither. */
bool point_is_explicit(const chart_point *p);
bool point_is_implicit(const chart_point *p);

/* advice.c: lines "advice_KEY=sentence", the head of the page. */
void advice_write(FILE *f, const chart *c);

#endif
