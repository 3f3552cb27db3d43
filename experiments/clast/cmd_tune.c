/* cmd_tune.c - pilot runs find the cheapest setting that keeps an observable (experiments/tune). */
#include "experiments/clast/commands.h"
#include "experiments/clast/options.h"
#include "experiments/run/folder.h"
#include "experiments/study/jobs.h"
#include "experiments/tune/search.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char HELP[] =
    "usage: clast tune SCENE --observable NAME --tolerance PERCENT% [OPTIONS]\n"
    "\n"
    "Finds the cheapest time step, stiffness, spheres per body, precision and scheme that keep an\n"
    "observable within the tolerance, by pilot runs with the same seeds; prints the evidence and\n"
    "writes the tuned scene.\n"
    "\n"
    "  --observable NAME  MEASURE.COLUMN of the scene, with :final, :mean (second half of the "
    "time) or\n"
    "                     :rate (discharged alone) behind it; a wrong name lists what there is\n"
    "  --tolerance P%     of the observable of the scene as it stands, such as 2%\n"
    "  --seeds N          pairs of runs of the first look, 3 to 32 (default 4); up to four times "
    "as many\n"
    "                     where the answer is not clear, and as many fresh ones to confirm\n"
    "  --vary NAME=A,B,.. tells replicates apart by a parameter instead of the seed: beds, say\n"
    "  --jobs N           runs side by side (default: CLAST_JOBS, else all processors)\n"
    "  --out FOLDER       keeps the pilots; what is there is not run again (default build/tune)\n"
    "  --write FILE       the tuned scene (default: tuned.yaml in that folder)\n"
    "  --verify FILE      no search: judges that scene against SCENE, one look at all values of "
    "--vary\n"
    "                     or all --seeds; exit code 1 unless it keeps the observable\n"
    "  --set NAME=V       as in clast run: changes the scene before it is tuned\n"
    "\n"
    "example: clast tune bounce.yaml --observable out.kg:rate --tolerance 2% --write fast.yaml\n"
    "exit code: 0, 1 the scene as it stands fails, 2 usage, 3 faults in the scene, 4 files, 130\n";

typedef struct arguments {
    const char *path, *observable, *tolerance, *vary, *out, *write, *verify;
    option_list set;
    int seeds, jobs;
} arguments;

/* ---- the command line ------------------------------------------------------------------------ */

static bool read_arguments(int argc, char **argv, arguments *a) {
    const option options[] = {
        {"--observable", OPTION_TEXT, &a->observable, NULL},
        {"--tolerance", OPTION_TEXT, &a->tolerance, NULL},
        {"--seeds", OPTION_COUNT, &a->seeds, NULL},
        {"--vary", OPTION_TEXT, &a->vary, NULL},
        {"--jobs", OPTION_COUNT, &a->jobs, NULL},
        {"--out", OPTION_TEXT, &a->out, NULL},
        {"--write", OPTION_TEXT, &a->write, NULL},
        {"--verify", OPTION_TEXT, &a->verify, NULL},
        {"--set", OPTION_LIST, &a->set, NULL},
    };
    int found =
        options_read("tune", argc, argv, options, sizeof options / sizeof *options, &a->path, 1);
    if (found < 0) return false;
    const char *missing = found < 1        ? "which scene?"
                          : !a->observable ? "--observable MEASURE.COLUMN is missing"
                          : !a->tolerance  ? "--tolerance P% is missing"
                                           : NULL;
    if (missing) fprintf(stderr, "clast tune: %s\n`clast tune --help` has an example\n", missing);
    return !missing;
}

/* "2%" or "0.02"; 0 after a message. */
static double read_tolerance(const char *text) {
    char *end;
    double value = strtod(text, &end);
    bool good = end != text;
    end += strspn(end, " ");
    if (good && *end == '%') value /= 100, end++;
    if (good && !*end && value > 0 && value <= 0.5) return value;
    fprintf(stderr,
            "clast tune: --tolerance %s: expected a part of the observable above 0 and up to 50%%, "
            "such as 2%% or 0.02\n",
            text);
    return 0;
}

/* Splits "NAME=A,B,C" into t->vary and t->values, which point into `copy`. */
static bool read_vary(tune *t, char *copy) {
    static char *values[PILOTS_MAX];
    char *equals = strchr(copy, '='), *rest = NULL;
    if (!equals || equals == copy) {
        fprintf(stderr, "clast tune: --vary %s: expected NAME=A,B,C\n", copy);
        return false;
    }
    *equals = '\0';
    t->vary = copy;
    t->values = values;
    for (char *one = strtok_r(equals + 1, ",", &rest); one && t->value_count < PILOTS_MAX;
         one = strtok_r(NULL, ",", &rest))
        values[t->value_count++] = one;
    return true;
}

/* ---- the work -------------------------------------------------------------------------------- */

/* The scene as it stands: its text with --set, and whether it has the observable. */
static int read_scene(const arguments *a, tune *t) {
    char *faults = NULL, first[JOB_TEXT];
    const char *set[OPTION_LIST_MAX + 1];
    int count = a->set.count;
    memcpy(set, a->set.items, (size_t)count * sizeof *set);
    if (t->vary && t->value_count > 0) {
        snprintf(first, sizeof first, "%s=%s", t->vary, t->values[0]);
        set[count++] = first;
    }
    scene *s = scene_load(a->path, &(scene_options){.set = set, .set_count = count, .threads = 1},
                          &faults);
    if (faults) fputs(faults, stderr);
    free(faults);
    if (!s) return CLAST_EXIT_BAD_SCENE;
    char *wrong = observable_find(&t->what, s, a->observable);
    if (wrong) fprintf(stderr, "clast tune: %s", wrong);
    t->seed = clast_world_definition(s->world)->seed;
    t->text = tune_source(a->path, a->set.items, a->set.count);
    scene_free(s);
    int code = wrong ? CLAST_EXIT_USAGE : t->text ? CLAST_EXIT_OK : CLAST_EXIT_FILE;
    free(wrong);
    return code;
}

/* The text of --verify, which must be a scene. */
static int read_other(const arguments *a, tune *t) {
    char *faults = NULL, first[JOB_TEXT] = "";
    const char *set[1] = {first};
    if (t->vary && t->value_count > 0)
        snprintf(first, sizeof first, "%s=%s", t->vary, t->values[0]);
    scene *s = scene_load(
        a->verify, &(scene_options){.set = set, .set_count = first[0] != 0, .threads = 1}, &faults);
    if (faults) fputs(faults, stderr);
    free(faults);
    if (!s) return access(a->verify, R_OK) == 0 ? CLAST_EXIT_BAD_SCENE : CLAST_EXIT_FILE;
    scene_free(s);
    t->other = tune_source(a->verify, NULL, 0);
    return t->other ? CLAST_EXIT_OK : CLAST_EXIT_FILE;
}

static int write_scene(const search *s, const char *path) {
    char *text = search_scene(s);
    int failure = file_write_text(path, text);
    free(text);
    if (failure) {
        fprintf(stderr, "clast tune: %s: cannot be written: %s\n", path, strerror(failure));
        return CLAST_EXIT_FILE;
    }
    printf("written: %s\n", path);
    return CLAST_EXIT_OK;
}

/* Exit code of what was found, and the scene that it leads to. */
static int finish(const arguments *a, const search *s) {
    search_print(s, stdout);
    if (a->verify) {
        verdict_of_trial verdict = s->trials[0]->verdict;
        return verdict == TRIAL_KEPT || verdict == TRIAL_NO_GAIN ? CLAST_EXIT_OK
                                                                 : CLAST_EXIT_RUN_FAILED;
    }
    char *usual = path_in(a->out, "tuned.yaml");
    int code = write_scene(s, a->write ? a->write : usual);
    free(usual);
    return code;
}

static int tune_scene(const arguments *a, tune *t) {
    int code = read_scene(a, t);
    if (!code && a->verify) code = read_other(a, t);
    if (code) return code;
    search s = {.t = t};
    if (a->verify ? search_verify(&s) : search_run(&s)) {
        code = finish(a, &s);
    } else {
        fprintf(stderr, "clast tune: %s\n", t->failure);
        code = t->failure_code;
    }
    search_free(&s);
    return code;
}

int cmd_tune(int argc, char **argv) {
    if (options_ask_help(argc, argv)) {
        fputs(HELP, stdout);
        return CLAST_EXIT_OK;
    }
    arguments a = {.seeds = 4, .jobs = jobs_processes(), .out = "build/tune"};
    if (!read_arguments(argc, argv, &a)) return CLAST_EXIT_USAGE;
    tune t = {.path = a.path, .out = a.out, .seeds = a.seeds, .processes = a.jobs};
    t.tolerance = read_tolerance(a.tolerance);
    if (t.tolerance == 0) return CLAST_EXIT_USAGE;
    if (access(a.path, R_OK) != 0) {
        fprintf(stderr, "clast tune: %s: cannot be opened: %s\n", a.path, strerror(errno));
        return CLAST_EXIT_FILE;
    }
    if (a.write && strcmp(a.write, a.path) == 0) {
        fprintf(stderr, "clast tune: --write %s: is the scene itself\n", a.write);
        return CLAST_EXIT_USAGE;
    }
    char *copy = strdup(a.vary ? a.vary : "");
    if (!copy) abort();
    int code = a.vary && !read_vary(&t, copy) ? CLAST_EXIT_USAGE : tune_scene(&a, &t);
    free(copy);
    free(t.text);
    free(t.other);
    return code;
}
