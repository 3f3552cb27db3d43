#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "experiments/clast/commands.h"
#include "experiments/clast/options.h"
#include "experiments/run/run.h"

static const char HELP[] =
    "usage: clast run SCENE --out FOLDER [OPTIONS]\n\n"
    "Simulates a scene and writes frames, series and checkpoints into a folder.\n\n"
    "  --out FOLDER    where the results go; made when missing\n"
    "  --threads N     threads at most (default: cores); as many as pay for the spheres are used\n"
    "  --spheres-per-thread N  so many spheres pay for a thread (default: 500)\n"
    "  --isa WHICH     auto, baseline, avx2 or avx512: vector lanes, the same bits with each\n"
    "  --resume        go on from the checkpoint in FOLDER, as if it had never stopped\n"
    "  --force         throw away the run that is in FOLDER\n"
    "  --set NAME=V    give a parameter of the scene another value; may be said many times\n"
    "  --until T       end at T seconds instead of the scene's own end\n"
    "  --quiet         print the last line alone\n\n"
    "Started by mpirun, processes share the scene: mpirun -n 4 clast run ...\n\n"
    "The last line is the hash of the final state: the same for any number of threads and\n"
    "processes, any --isa, and after any number of stops. Ctrl-C saves everything and ends with\n"
    "exit code 130.\n\n"
    "example: clast run hopper.yaml --out build/hopper --set orifice='8.5 cm'\n"
    "         clast run hopper.yaml --out build/hopper --resume --until 5\n";

typedef struct arguments {
    const char *scene;
    run_options run;
    scene_options load;
    option_list set;
    bool quiet;
} arguments;

static bool read_arguments(int argc, char **argv, arguments *a) {
    static const char *const ISA[] = {"auto", "baseline", "avx2", "avx512", NULL};
    int isa = 0;
    const option options[] = {
        {"--out", OPTION_TEXT, &a->run.out, NULL},
        {"--threads", OPTION_COUNT, &a->load.threads, NULL},
        {"--spheres-per-thread", OPTION_COUNT, &a->load.spheres_per_thread, NULL},
        {"--isa", OPTION_CHOICE, &isa, ISA},
        {"--resume", OPTION_FLAG, &a->run.resume, NULL},
        {"--force", OPTION_FLAG, &a->run.force, NULL},
        {"--set", OPTION_LIST, &a->set, NULL},
        {"--until", OPTION_NUMBER, &a->run.until, NULL},
        {"--quiet", OPTION_FLAG, &a->quiet, NULL},
    };
    int found =
        options_read("run", argc, argv, options, sizeof options / sizeof *options, &a->scene, 1);
    if (found < 0) return false;
    a->load.isa = (clast_isa)isa;
    a->load.set = a->set.items;
    a->load.set_count = a->set.count;
    a->run.talk = a->quiet ? RUN_QUIET : RUN_TALK;
    const char *missing = found < 1                       ? "which scene?"
                          : !a->run.out || !a->run.out[0] ? "--out FOLDER is missing"
                          : a->run.resume && a->run.force
                              ? "--resume and --force exclude each other"
                              : NULL;
    if (missing && clast_ranks_number() == 0)
        fprintf(stderr, "clast run: %s\n`clast run --help` has an example\n", missing);
    return !missing;
}

static int exit_of(run_end end) {
    switch (end) {
    case RUN_DONE:
        return CLAST_EXIT_OK;
    case RUN_GUARD:
        return CLAST_EXIT_RUN_FAILED;
    case RUN_INTERRUPTED:
        return CLAST_EXIT_INTERRUPTED;
    case RUN_MISMATCH:
        return CLAST_EXIT_MISMATCH;
    case RUN_WRITE_FAILED:
    case RUN_UNREADABLE:
    case RUN_REFUSED:
        break;
    }
    return CLAST_EXIT_FILE;
}

/* Every process reads its files for itself, and all end where one cannot. What is wrong is said by
 * the first, or by those who have other files than it has. */
static bool is_heard(bool good) {
    bool first = good;
    clast_ranks_tell(&first, sizeof first);
    return clast_ranks_number() == 0 || first;
}

static bool all_have(bool good) {
    return clast_ranks_most(!good) == 0;
}

static bool scene_is_there(const char *path) {
    int failure = access(path, R_OK) != 0 ? errno : 0;
    bool heard = is_heard(!failure);
    if (failure && heard)
        fprintf(stderr, "clast run: %s: cannot be opened: %s\n", path, strerror(failure));
    return all_have(!failure);
}

static scene *load(const arguments *a) {
    char *faults = NULL;
    scene *s = scene_load(a->scene, &a->load, &faults);
    bool heard = is_heard(s), speaks = clast_ranks_number() == 0;
    if (faults && (speaks || (heard && !s))) fputs(faults, stderr);
    free(faults);
    if (all_have(s)) return s;
    if (s) scene_free(s);
    return NULL;
}

int cmd_run(int argc, char **argv) {
    if (options_ask_help(argc, argv)) {
        fputs(HELP, stdout);
        return CLAST_EXIT_OK;
    }
    arguments a = {0};
    if (!read_arguments(argc, argv, &a)) return CLAST_EXIT_USAGE;
    if (!scene_is_there(a.scene)) return CLAST_EXIT_FILE;
    scene *s = load(&a);
    if (!s) return CLAST_EXIT_BAD_SCENE;
    run_report r = run_scene(s, &a.run);
    if (r.message[0] && clast_ranks_number() == 0) fprintf(stderr, "clast run: %s\n", r.message);
    scene_free(s);
    return exit_of(r.end);
}
