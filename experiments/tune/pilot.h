/* pilot.h - pilot runs of one scene under many settings, each with the same seeds, kept in a folder
 * from one start of the program to the next (study/jobs.h). */
#ifndef CLAST_TUNE_PILOT_H
#define CLAST_TUNE_PILOT_H

#include <stdint.h>

#include "experiments/tune/observable.h"
#include "experiments/tune/setting.h"

enum { PILOTS_MAX = 256, TUNE_MESSAGE = 1000 };

/* What all pilots share. */
typedef struct tune {
    const char *path; /* of the scene: files that it names are looked for beside it */
    char *text;       /* with --set put in */
    char *other;      /* text of a scene to verify; NULL: there is none */
    const char *out;  /* folder of the pilots */
    const char *vary; /* parameter that tells replicates apart; NULL: the seed does */
    char **values;    /* its values */
    int value_count;
    uint64_t seed; /* of the scene: replicate i has seed + i */
    int processes;
    observable what;
    double tolerance; /* relative */
    int seeds;        /* pairs of the first look */
    int most; /* pairs of the last; the confirmation has replicates of its own behind them */
    bool confirm;
    setting_space space;
    char failure[TUNE_MESSAGE]; /* why nothing can go on; "" when all is well */
    int failure_code;           /* exit code that goes with it */
} tune;

/* One setting and what its pilots said, by replicate. */
typedef struct candidate {
    setting setting;
    bool known[PILOTS_MAX];
    double value[PILOTS_MAX]; /* of the observable; NAN: it has none */
    double cost[PILOTS_MAX];  /* s of processor time per simulated second; NAN: not timed */
    uint64_t hash[PILOTS_MAX];
    char stopped[TUNE_MESSAGE]; /* why a pilot did not come to its end; "" when all did */
} candidate;

/* The text of a scene file with "name=value" put into its parameters; malloc'ed. For scenes that
 * scene_load() has read with the same: it says what is wrong with them. NULL when the file is gone.
 */
char *tune_source(const char *path, const char *const *set, int set_count);

/* Loads the scene as it stands and under every stiffness: steps and their limits. False with
 * t->failure. */
bool tune_look(tune *t);

/* Runs the replicates from `first` on that are not there yet, side by side. False with t->failure
 * when something else than the setting failed (disk full, interrupted). */
bool pilots_run(tune *t, candidate *c, int first, int count);

/* Mean cost of a over that of b, over the pilots for which both are known; NAN without any. */
double candidate_ratio(const candidate *a, const candidate *b);

/* Mean cost; NAN when none is known. */
double candidate_cost(const candidate *c);

/* The text of the scene under a setting, without what pilots add; malloc'ed, NULL when there is no
 * place for it in the text. */
char *tune_text(const tune *t, setting s);

#endif
