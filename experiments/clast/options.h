/* options.h - reading the command line: a table of options per command. */
#ifndef CLAST_COMMAND_OPTIONS_H
#define CLAST_COMMAND_OPTIONS_H

#include <stdbool.h>

typedef enum option_kind {
    OPTION_FLAG,   /* bool */
    OPTION_TEXT,   /* const char * */
    OPTION_NUMBER, /* double, finite and > 0 */
    OPTION_COUNT,  /* int >= 1 */
    OPTION_LIST,   /* option_list: may be given many times */
    OPTION_CHOICE  /* int: place of the word in `words` */
} option_kind;

enum { OPTION_LIST_MAX = 256 };

typedef struct option_list {
    int count;
    const char *items[OPTION_LIST_MAX];
} option_list;

typedef struct option {
    const char *name; /* "--out" */
    option_kind kind;
    void *value;
    const char *const *words; /* choices, NULL at the end */
} option;

/* Reads "--name value" and "--name=value"; the words between go to `arguments` (at most `room`).
 * Returns their number, or -1 after a message on standard error. */
int options_read(const char *command, int argc, char **argv, const option *options, int count,
                 const char **arguments, int room);

/* True when --help or -h is among the arguments. */
bool options_ask_help(int argc, char **argv);

#endif
