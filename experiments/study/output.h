/* output.h - the folders and tables that a study writes.
 *
 *     study_folders to = study_folders_below(BUILD_FOLDER, "handling", command.size);
 *     int failed = ...;
 *     return study_end("handling", failed, write_verdicts(to.verdicts));
 */
#ifndef CLAST_STUDY_OUTPUT_H
#define CLAST_STUDY_OUTPUT_H

#include <stdio.h>

#include "experiments/study/command.h"

/* Makes a folder and all above it; exits with code 4 and a message when that fails. */
void output_folder(const char *path);

/* Paths below BUILD/studies/NAME; runs are shared between sizes, as their names say what they are.
 */
typedef struct study_folders {
    char runs[600], data[640], frames[640];
    char verdicts[640]; /* the file BUILD/validate/NAME.csv */
} study_folders;

/* Makes them all; exits with code 4 and a message when that fails. */
study_folders study_folders_below(const char *build, const char *name, study_size size);

/* The exit code of a study: what was bad in writing or judging, else 1 where runs failed, which is
 * said on stderr, else 0. */
int study_end(const char *name, int failed_runs, int bad);

/* A new file with its first line; NULL, said on stderr, when it cannot be made. */
FILE *output_table(const char *folder, const char *name, const char *header);

/* 0, or 4 when not all could be written (said on stderr). */
int output_close(FILE *table);

#endif
