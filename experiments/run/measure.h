/* measure.h - what is read off a moving bed, as the experimenter did: one short file per kind.
 *
 * A measure sees a moment: bodies in the order of ids, their spheres, and the contacts. Sums run in
 * that order, so their bits depend neither on threads nor on where bodies lie in memory. */
#ifndef CLAST_RUN_MEASURE_H
#define CLAST_RUN_MEASURE_H

#include <stdio.h>

#include "experiments/run/table.h"
#include "experiments/scene/scene.h"

enum { MEASURE_COLUMNS_MAX = 80, MEASURE_SECTIONS_MAX = 64 };

typedef struct moment {
    clast_world *world;
    double time;
    uint64_t step;
    clast_bodies bodies;
    size_t *order; /* places in bodies, by ascending id; bodies.count of them */
    clast_spheres spheres;
    size_t *first_sphere; /* by place in bodies, bodies.count + 1 of them */
    bool with_contacts;
    clast_contact *contacts;
    size_t contact_count, contact_room;
    size_t room;
} moment;

/* Looks at the world now; memory is kept from call to call. */
void moment_take(moment *m, clast_world *w, bool with_contacts);
void moment_free(moment *m);

/* Whether a body has been below the level; absent bodies had left before the run began. */
enum { BELOW_NOT_YET, BELOW_ONCE, BELOW_ABSENT };

/* What a measure remembers between moments. */
typedef struct measure_memory {
    uint32_t ids;         /* bodies ever added */
    double *mass;         /* kg, by id */
    unsigned char *below; /* discharged: by id */
    table samples;        /* band velocity: every body of the band */
    bool sampling;
} measure_memory;

typedef struct measure_class {
    measure_kind kind;
    const char *word; /* in messages */
    bool needs_contacts;
    bool writes_samples;                        /* a table <name>.samples.csv beside the series */
    void (*header)(const measure *m, FILE *to); /* ",name_unit,..." */
    int (*values)(const measure *m, measure_memory *memory, const moment *now, double *values);
    const char *samples_header;
} measure_class;

const measure_class *measure_class_of(measure_kind kind);

/* Called with the bodies that the scene starts with. */
void measure_start(measure_memory *memory, const moment *start, uint32_t ids);
void measure_stop(measure_memory *memory);

/* The classes, one per file. */
extern const measure_class MEASURE_DISCHARGED_CLASS, MEASURE_REMAINING_CLASS,
    MEASURE_SOLID_FRACTION_CLASS, MEASURE_BAND_VELOCITY_CLASS, MEASURE_COORDINATION_CLASS,
    MEASURE_PART_LOAD_CLASS, MEASURE_LOAD_PROFILE_CLASS;

#endif
