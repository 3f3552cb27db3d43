/* precision.h - parts of clast_precision: what mixed precision costs in accuracy and saves in time.
 * Every part writes rows "quantity,case,precision,x,value,half"; README.md says what they mean. */
#ifndef CLAST_TESTS_PRECISION_H
#define CLAST_TESTS_PRECISION_H

#include "engine/clast.h"

#include <stdio.h>

extern const char *const PRECISION_NAMES[2]; /* by clast_precision */

typedef struct precision_table {
    FILE *file;
    const char *scratch; /* folder for settled states */
    int seeds;           /* of the discharge */
    double steps;        /* of the drift */
} precision_table;

void precision_row(const precision_table *t, const char *quantity, const char *of,
                   const char *precision, double x, double value, double half);

/* Stops the program with the world's error (of clast_world_new() for NULL). */
void precision_demand(bool fine, const clast_world *w);

/* After one collision of two equal spheres: relative velocity and spin times radius, in units of
 * the impact speed. */
typedef struct rebound_state {
    double v[3], spin[3];
} rebound_state;

typedef struct rebound_wish {
    clast_precision precision;
    double angle;      /* rad, from head-on */
    double resolution; /* steps per contact */
    double phase;      /* of a step, where in it the contact begins */
} rebound_wish;

rebound_state rebound_of(const rebound_wish *wish);
double rebound_distance(const rebound_state *a, const rebound_state *b);

void measure_rebound(const precision_table *t);
void measure_drift(const precision_table *t);
void measure_discharge(const precision_table *t);
void measure_speed(const precision_table *t);

#endif
