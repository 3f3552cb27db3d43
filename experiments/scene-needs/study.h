/* study.h - which scenes run without which features, and what is read from them.
 *
 * plan.c has the tables of scenes and switches and writes the scene files, runs.c runs them,
 * measure.c reads one run, compare.c sets pairs of runs against each other, tables.c, pictures.c
 * and verdicts.c write the results. */
#ifndef CLAST_SCENE_NEEDS_STUDY_H
#define CLAST_SCENE_NEEDS_STUDY_H

#include "experiments/run/results.h"
#include "experiments/scene-needs/needs.h"
#include "experiments/study/command.h"
#include "experiments/study/jobs.h"
#include "experiments/study/statistics.h"

enum { LEGS = 2, OBSERVABLES = 2, SCENES_COUNT = 3, VARIANTS_MAX = 12, REPLICATES_MAX = 100 };

/* ---- the tables ------------------------------------------------------------------------------ */

/* How one feature is left out of a scene. */
typedef struct needs_switch {
    need_feature feature;
    const char *key;     /* in the names of files */
    const char *without; /* in words */
    const char *set;     /* parameters: "name=value;name=value" */
    const char *put;     /* keys: "section.key=value;key=value" */
    double layers;       /* rates are of so many layers less; 0: of as many */
} needs_switch;

/* One run of a scene; a later leg starts from the bed of the one before. */
typedef struct needs_leg {
    const char *file;  /* below experiments/ */
    const char *set;   /* of every run */
    const char *quick; /* at the size `quick`, on top of that */
    const char *put;
    const char *drawn; /* of the first replicate, which is drawn; NULL: it is not */
} needs_leg;

typedef double needs_read(const csv *series);

typedef struct needs_observable {
    const char *name, *unit;
    int leg;
    needs_read *read; /* NAN: the run has no such value */
    bool rate;        /* grows with the number of layers */
} needs_observable;

typedef struct needs_scene {
    const char *name;
    int legs, switches, observables;
    needs_leg leg[LEGS];
    needs_observable observable[OBSERVABLES];
    const needs_switch *without;
} needs_scene;

extern const needs_scene NEEDS_SCENES[SCENES_COUNT];

/* measure.c */
needs_read needs_flow_rate, needs_solid_fraction, needs_heap_slope;

/* Mean of both flanks of a heap, in degrees: least squares through the sections between 85 and 15 %
 * of the highest one, outwards from it. NAN when a flank has fewer than three of them. Heights of
 * sections of equal width (m). */
double heap_angle(const double *height, int sections, double width);

/* ---- the runs -------------------------------------------------------------------------------- */

typedef struct needs_size {
    int replicates[SCENES_COUNT];
    bool quick;
} needs_size;

/* All runs of one scene: variant 0 is the scene as it stands, variant i lacks switch i - 1. */
typedef struct needs_runs {
    const needs_scene *scene;
    int variants, replicates;
    job *jobs[LEGS]; /* [replicate * variants + variant]: neighbours in time differ by a switch */
    char (*path[LEGS])[JOB_FOLDER]; /* of the scene file, by variant */
} needs_runs;

typedef struct needs_study {
    const char *size_name;
    needs_size size;
    char root[500], data[560];
    needs_runs runs[SCENES_COUNT];
    int processes;
} needs_study;

void needs_plan(needs_study *s);

/* Number of runs of scenes as they stand that failed: without a feature, failure is a result. */
int needs_run(needs_study *s);

/* ---- the results ----------------------------------------------------------------------------- */

/* Of one observable of one variant, by replicate. */
typedef struct needs_values {
    double value[REPLICATES_MAX], cost[REPLICATES_MAX]; /* NAN: none; s of processor time per s */
} needs_values;

needs_values needs_read_values(const needs_runs *r, int observable, int variant);

/* Place of the switch with that key among the variants, or of "reference". */
int needs_variant(const needs_runs *r, const char *key);

need needs_compare(const needs_runs *r, int observable, int variant);

/* The same differences in per cent, with their scatter. */
interval needs_difference(const needs_runs *r, int observable, int variant);

/* tables.c: 0, or 4 when a file cannot be written. */
int needs_write_tables(const needs_study *s);

/* pictures.c: frames of the heap and the silo; 0, or what `clast render` ended with. */
int needs_pictures(const needs_study *s);

/* verdicts.c: exit code of verdict_finish(). */
int needs_verdicts(const needs_study *s, const char *path);

#endif
