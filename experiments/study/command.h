/* command.h - the command line of a study that takes no scene file:
 *
 *     STUDY validate|figures [--size quick|brief|published|full]
 *
 * The size is the option, else CLAST_SIZE, else `published`. `quick` is for tests; `brief` is what
 * `make figures` can do in half an hour for all studies together, of those whose published size
 * cannot. */
#ifndef CLAST_STUDY_COMMAND_H
#define CLAST_STUDY_COMMAND_H

#include <stdbool.h>

typedef enum study_size { STUDY_QUICK, STUDY_BRIEF, STUDY_PUBLISHED, STUDY_FULL } study_size;

typedef struct study_command {
    bool figures; /* else validate */
    study_size size;
} study_command;

/* Exits with 0 after --help, with 2 and the usage on stderr for anything else. A study has the
 * sizes that its usage names. */
study_command study_command_of(int argc, char **argv, const char *usage);

const char *study_size_name(study_size size);

#endif
