/* output.h - the folders and tables that a study writes. */
#ifndef CLAST_STUDY_OUTPUT_H
#define CLAST_STUDY_OUTPUT_H

#include <stdio.h>

/* Makes a folder and all above it; exits with code 4 and a message when that fails. */
void output_folder(const char *path);

/* A new file with its first line; NULL, said on stderr, when it cannot be made. */
FILE *output_table(const char *folder, const char *name, const char *header);

/* 0, or 4 when not all could be written (said on stderr). */
int output_close(FILE *table);

#endif
