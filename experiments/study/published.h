/* published.h - the numbers of the source that a study is held against, from its published.csv.
 *
 *     char why[PUBLISHED_ERROR_MAX];
 *     published_table *p = published_read("experiments/button-hopper/published.csv", why);
 *     const published *q = published_find(p, "rate at 5 cm");
 *     printf("%g %s (%s)\n", q->experiment, q->unit, q->source);
 *
 * Columns: quantity,unit,experiment,thesis,tolerance,source,note. A field that holds a comma or a
 * quote is quoted as usual in CSV ("" for a quote). Empty experiment or thesis: the source prints
 * no such number. Every row names its source, and every row with a tolerance says in its note where
 * that comes from. */
#ifndef CLAST_STUDY_PUBLISHED_H
#define CLAST_STUDY_PUBLISHED_H

#include <stdbool.h>
#include <stdio.h>

enum { PUBLISHED_ERROR_MAX = 512 };

typedef enum tolerance_kind {
    TOLERANCE_NONE,     /* "": reported, never judged */
    TOLERANCE_MEAN,     /* "0.02" or "10.8 %": our mean lies this near the target */
    TOLERANCE_EQUAL,    /* "equal 0.05": an equivalence test with this margin shows it, P < 0.05 */
    TOLERANCE_AT_MOST,  /* "at most 10.8": our mean is no larger */
    TOLERANCE_AT_LEAST, /* "at least 1" */
    TOLERANCE_KINDS
} tolerance_kind;

typedef struct tolerance {
    tolerance_kind kind;
    double value;
    bool percent; /* of the target; MEAN and EQUAL only */
} tolerance;

/* False when the text is none of the forms above. */
bool tolerance_parse(const char *text, tolerance *out);
void tolerance_text(const tolerance *t, char *text, size_t room);

typedef struct published {
    char *quantity, *unit;
    double experiment, thesis; /* NAN: not printed in the source */
    tolerance tolerance;
    char *source; /* document, section or table */
    char *note;
} published;

typedef struct published_table {
    published *rows;
    int count;
} published_table;

/* NULL with file, line, column, what was found and what was expected. */
published_table *published_read(const char *path, char error[PUBLISHED_ERROR_MAX]);
void published_free(published_table *t);

/* NULL when there is no such quantity. */
const published *published_find(const published_table *t, const char *quantity);

/* The same where a study cannot do without it: exits with 4, named on stderr, when there is none.
 */
const published *published_need(const published_table *t, const char *quantity);

/* What our result is held against: the experiment; where it has none, the thesis's simulation; NAN
 * without both. */
double published_target(const published *p);

/* Splits one CSV record in place into at most `room` fields; the number of fields, or -1 when a
 * quote is not closed. Fields beyond the room are counted, not stored. */
int csv_split(char *record, char **fields, int room);

/* Writes one field, quoted when it needs to be. */
void csv_put(FILE *f, const char *field);

#endif
