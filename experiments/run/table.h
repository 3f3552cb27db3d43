/* table.h - a CSV file that grows row by row and survives whatever stops the program.
 *
 * The first two columns are time_s and step. Every row is flushed as a whole; a row that does not
 * fit on the disk is taken back, so the file ends with a whole line. */
#ifndef CLAST_RUN_TABLE_H
#define CLAST_RUN_TABLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct table {
    int descriptor; /* -1 = closed */
    long size;      /* bytes of whole rows in the file */
    char *row;      /* being built */
    size_t length, room;
    bool mute;   /* of a process that leaves writing to the first one */
    int failure; /* errno of the first failure, or 0: later calls do nothing */
} table;

/* Starts a file with this header line (no newline). */
void table_create(table *t, const char *path, const char *header);

/* Goes on with a file: keeps the header and the rows for which keep() is true, cuts the rest off. A
 * missing file is started; another header is a failure (EINVAL). */
void table_continue(table *t, const char *path, const char *header,
                    bool keep(uint64_t step, const void *context), const void *context);

void table_begin(table *t, double time, uint64_t step);
void table_number(table *t, double value);   /* 17 digits, integers as such; not-a-number as nan */
void table_word(table *t, const char *word); /* a space for every comma and quotation mark */
void table_end(table *t);

/* Puts the rows on the disk, not only into the hands of the system. */
void table_sync(table *t);
void table_close(table *t);

#endif
