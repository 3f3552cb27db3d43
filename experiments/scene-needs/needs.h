/* needs.h - what the features of a model are worth, as the study scene-needs measured it: the error
 * of each observable without the feature, and what leaving it out saves. The table is built into
 * the program (measured.csv, embed.cmake); `clast plan` quotes it.
 *
 *     need_table *t = needs_measured();
 *     for (int i = 0; i < t->count; i++) printf("%s: %+.1f %%\n", t->rows[i].feature, ...);
 *     needs_free(t);
 */
#ifndef CLAST_NEEDS_H
#define CLAST_NEEDS_H

#include <stdbool.h>
#include <stdio.h>

/* What the switches of the study leave out. */
typedef enum need_feature {
    NEED_HISTORY,   /* the spring of friction before it slides */
    NEED_ROTATION,  /* bodies turn */
    NEED_FRICTION,  /* Coulomb friction: spheres without it do not turn either */
    NEED_ROLLING,   /* rolling friction */
    NEED_DAMPING,   /* dashpots of contacts */
    NEED_DEPTH,     /* the third dimension */
    NEED_HERTZ,     /* a contact law that is not linear in the overlap */
    NEED_SPHERES,   /* as many spheres per body */
    NEED_PRECISION, /* double precision at contacts */
    NEED_FEATURES
} need_feature;

/* "tangential history", "rotation", ... as the table has them. */
const char *need_feature_name(need_feature feature);

enum { NEED_TEXT = 80, NEEDS_ERROR_MAX = 300 };

/* One observable of one scene without one feature. Errors are differences to the scene as it stands
 * over its mean, paired by seed; low and high are the ends of their 95 % interval (Student). */
typedef struct need {
    char study[NEED_TEXT], observable[NEED_TEXT];
    need_feature feature;
    char without[NEED_TEXT];             /* how it was left out, as a scene says it */
    double error, error_low, error_high; /* NAN: some runs without it gave no value */
    double cost;      /* processor time per simulated second over that of the scene as it stands */
    double cost_half; /* half its 95 % interval, from the same pairs */
    int replicates;   /* pairs that gave a value */
    int lost;         /* pairs in which the scene without the feature gave none */
} need;

typedef struct need_table {
    need *rows;
    int count;
} need_table;

#define NEEDS_HEADER                                                                               \
    "study,observable,switch,without,error,error_low,error_high,cost_ratio,cost_half,replicates,"  \
    "lost"

/* Reads the text of a needs.csv. NULL with line, what was found and what was expected. */
need_table *needs_parse(const char *text, char error[NEEDS_ERROR_MAX]);

/* The table that is built in. */
need_table *needs_measured(void);

void needs_free(need_table *t);

/* What leaving out these features did to what was measured, in words; nothing about features that
 * have no row. */
void needs_quote(const need_table *t, const bool uses[NEED_FEATURES], FILE *to);

#endif
