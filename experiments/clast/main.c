/* clast - granular experiments from the command line. */
#include <stdio.h>
#include <string.h>

#include "engine/clast.h"
#include "experiments/clast/commands.h"

typedef struct command {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *what;
} command;

static const command COMMANDS[] = {
    {"run", cmd_run, "simulate a scene and write its results into a folder"},
    {"check", cmd_check, "read a scene and report everything that is wrong with it"},
    {"plan", cmd_plan, "say what a scene will take: kernel, time step, cost"},
    {"tune", cmd_tune, "find the cheapest settings that keep what a scene measures"},
    {"shape", cmd_shape, "fill a solid, a profile or a mesh with spheres"},
    {"rtd", cmd_rtd, "say how long bodies stay between a feed and an outlet"},
    {"mesh", cmd_mesh, "say what is wrong with a triangle mesh, draw it, write it out mended"},
    {"render", cmd_render, "draw the frames of a run as pictures and an animation"},
};
enum { COMMAND_COUNT = sizeof COMMANDS / sizeof *COMMANDS };

static void print_help(void) {
    printf("usage: clast COMMAND [ARGUMENTS]\n\n");
    for (int i = 0; i < COMMAND_COUNT; i++)
        printf("  %-8s %s\n", COMMANDS[i].name, COMMANDS[i].what);
    printf("\n`clast COMMAND --help` tells more and has an example.\n"
           "example: clast run hopper.yaml --out build/hopper\n\n"
           "exit codes:\n"
           "  %-4d all is well\n"
           "  %-4d the run failed: a guard stopped it and said what, who, where and when\n"
           "  %-4d unknown command, option or argument\n"
           "  %-4d the scene has faults; each is printed with its line\n"
           "  %-4d a file or folder cannot be read or written (missing, disk full, ...)\n"
           "  %-4d --resume with a checkpoint of another scene\n"
           "  %-4d interrupted; a checkpoint was written\n",
           CLAST_EXIT_OK, CLAST_EXIT_RUN_FAILED, CLAST_EXIT_USAGE, CLAST_EXIT_BAD_SCENE,
           CLAST_EXIT_FILE, CLAST_EXIT_MISMATCH, CLAST_EXIT_INTERRUPTED);
}

/* How many letters two short words differ by, roughly: letters of one that the other has no place
 * for. */
static int distance(const char *a, const char *b) {
    int at[16][16];
    int n = (int)strlen(a), m = (int)strlen(b);
    if (n > 15 || m > 15) return 99;
    for (int i = 0; i <= n; i++)
        for (int j = 0; j <= m; j++) {
            if (i == 0 || j == 0) {
                at[i][j] = i + j;
                continue;
            }
            int change = at[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
            int drop = at[i - 1][j] + 1, add = at[i][j - 1] + 1;
            at[i][j] = change < drop ? change : drop;
            if (add < at[i][j]) at[i][j] = add;
        }
    return at[n][m];
}

static int unknown(const char *name) {
    fprintf(stderr, "clast: unknown command '%s'", name);
    int best = 3;
    const char *meant = NULL;
    for (int i = 0; i < COMMAND_COUNT; i++) {
        int d = distance(name, COMMANDS[i].name);
        if (d < best) best = d, meant = COMMANDS[i].name;
    }
    if (meant) fprintf(stderr, "; did you mean '%s'?", meant);
    fprintf(stderr, "\n`clast --help` lists the commands\n");
    return CLAST_EXIT_USAGE;
}

/* A run is shared by all processes, of which the first one speaks; the rest is its own affair. */
static int run_command(const command *c, int argc, char **argv) {
    if (clast_ranks_begin() != CLAST_OK) return CLAST_EXIT_USAGE;
    bool others = clast_ranks_number() > 0;
    if (others && !freopen("/dev/null", "w", stdout)) return CLAST_EXIT_FILE;
    if (c->run != cmd_run) clast_ranks_end();
    int code = others && c->run != cmd_run ? CLAST_EXIT_OK : c->run(argc, argv);
    clast_ranks_end();
    return code;
}

int main(int argc, char **argv) {
    if (argc < 2) {
        fprintf(stderr, "clast: which command?\n`clast --help` lists them\n");
        return CLAST_EXIT_USAGE;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 ||
        strcmp(argv[1], "help") == 0) {
        print_help();
        return CLAST_EXIT_OK;
    }
    if (strcmp(argv[1], "--version") == 0) {
        printf("clast %s\n", CLAST_VERSION);
        return CLAST_EXIT_OK;
    }
    for (int i = 0; i < COMMAND_COUNT; i++)
        if (strcmp(argv[1], COMMANDS[i].name) == 0)
            return run_command(&COMMANDS[i], argc - 1, argv + 1);
    return unknown(argv[1]);
}
