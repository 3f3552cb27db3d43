/* commands.h - the commands of `clast` and what they leave to the shell. */
#ifndef CLAST_COMMANDS_H
#define CLAST_COMMANDS_H

/* Exit codes of every command, as printed by `clast --help`. */
typedef enum clast_exit {
    CLAST_EXIT_OK = 0,
    CLAST_EXIT_RUN_FAILED = 1,   /* a guard stopped the run: what, who, where and when */
    CLAST_EXIT_USAGE = 2,        /* unknown command, option or argument */
    CLAST_EXIT_BAD_SCENE = 3,    /* the scene has faults; each was printed with its line */
    CLAST_EXIT_FILE = 4,         /* a file or folder cannot be read or written */
    CLAST_EXIT_MISMATCH = 5,     /* --resume with a checkpoint of another scene */
    CLAST_EXIT_INTERRUPTED = 130 /* ctrl-C: a checkpoint was written */
} clast_exit;

/* argv[0] is the name of the command; each knows --help. */
int cmd_check(int argc, char **argv);
int cmd_plan(int argc, char **argv);
int cmd_run(int argc, char **argv);
int cmd_tune(int argc, char **argv);
int cmd_shape(int argc, char **argv);
int cmd_mesh(int argc, char **argv);
int cmd_rtd(int argc, char **argv);
int cmd_render(int argc, char **argv);

#endif
