/* scene-needs: what the features of a model are worth. Three scenes run as they stand and without
 * one feature at a time, with the same seeds; error of what they measure against the time saved.
 *
 *     scene-needs figures             runs, writes data for the figures
 *     scene-needs validate            runs, compares with what theory and the source say */
#include <stdio.h>

#include "experiments/scene-needs/study.h"
#include "experiments/study/output.h"

static const char USAGE[] =
    "usage: scene-needs validate|figures [--size quick|brief|published|full]\n"
    "A heap, a silo and the button hopper without one feature of the model at a time. Runs are "
    "kept "
    "below\n"
    "the build folder and not repeated. CLAST_SIZE and CLAST_JOBS set size and processes.\n"
    "example: scene-needs validate --size quick\n";

/* Differences of a pair scatter by 6 % at the button hopper (experiments/tune/README.md) and less
 * in beds of ten times as many bodies. `published` takes some 12 minutes of one core. */
static const needs_size SIZES[] = {
    [STUDY_QUICK] = {{2, 2, 2}, true},
    [STUDY_BRIEF] = {{2, 2, 3}, false},
    [STUDY_PUBLISHED] = {{6, 6, 8}, false},
    [STUDY_FULL] = {{20, 20, 48}, false},
};

int main(int argc, char **argv) {
    study_command command = study_command_of(argc, argv, USAGE);
    needs_study s = {.size_name = study_size_name(command.size),
                     .size = SIZES[command.size],
                     .processes = jobs_processes()};
    snprintf(s.root, sizeof s.root, "%s/studies/scene-needs/runs", BUILD_FOLDER);
    snprintf(s.data, sizeof s.data, "%s/studies/scene-needs/%s/data", BUILD_FOLDER, s.size_name);
    output_folder(s.data);
    needs_plan(&s);
    int failed = needs_run(&s);
    if (failed) fprintf(stderr, "scene-needs: %d runs of scenes as they stand failed\n", failed);
    int code;
    if (command.figures) {
        code = needs_write_tables(&s);
        if (!code && !s.size.quick) code = needs_pictures(&s);
    } else {
        output_folder(BUILD_FOLDER "/validate");
        code = needs_verdicts(&s, BUILD_FOLDER "/validate/scene-needs.csv");
    }
    return code ? code : failed ? 1 : 0;
}
