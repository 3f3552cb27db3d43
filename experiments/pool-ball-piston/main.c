/* pool-ball-piston: repeats A00 section 4.2, ten two-sphere particles that follow a piston.
 *
 *     pool-ball-piston validate            runs, compares with the published numbers
 *     pool-ball-piston figures             runs, writes data and frames for the figures */
#include <stdio.h>
#include <stdlib.h>

#include "experiments/pool-ball-piston/piston.h"
#include "experiments/study/command.h"
#include "experiments/study/output.h"

static const char USAGE[] =
    "usage: pool-ball-piston validate|figures [--size quick|brief|published|full]\n"
    "Repeats A00 section 4.2: friction scan, step scan, agreement score. Runs are kept below the\n"
    "build folder and not repeated. CLAST_SIZE sets the size, CLAST_JOBS the number of processes.\n"
    "example: pool-ball-piston validate --size quick\n";

static const piston_size SIZES[] = {
    [STUDY_QUICK] = {.fraction = "0.5",
                     .replicates = {[SECTION_BASE] = 7, [SECTION_RIG] = 5},
                     .trials = 500},
    [STUDY_BRIEF] = {.fraction = "0.1", .replicates = {10, 5, 5, 5}, .trials = 2000},
    [STUDY_PUBLISHED] = {.fraction = "0.1",
                         .replicates = {20, 5, 5, 5, 5, 5},
                         .arrangements = 20,
                         .trials = 5000},
    [STUDY_FULL] = {.fraction = "0.1",
                    .replicates = {100, 20, 20, 20, 20, 20},
                    .arrangements = 100,
                    .trials = 20000},
};

static void open_study(piston_study *s, study_size size) {
    *s = (piston_study){.size = &SIZES[size], .name = study_size_name(size)};
    /* runs are shared between sizes: their names say what they are */
    snprintf(s->root, sizeof s->root, "%s/studies/pool-ball-piston/runs", BUILD_FOLDER);
    snprintf(s->data, sizeof s->data, "%s/studies/pool-ball-piston/%s/data", BUILD_FOLDER, s->name);
    output_folder(s->root);
    output_folder(s->data);
    output_folder(BUILD_FOLDER "/validate");
}

static int report(const piston_study *s, const study_command *command) {
    piston_summary *m = calloc(1, sizeof *m);
    if (!m) abort();
    piston_summarise(s, m);
    int code = 0;
    if (!command->figures)
        code = piston_verdicts(s, m, BUILD_FOLDER "/validate/pool-ball-piston.csv");
    else if ((code = piston_write_tables(s, m)) == 0)
        code = piston_pictures(s);
    piston_summary_free(m);
    free(m);
    return code;
}

int main(int argc, char **argv) {
    study_command command = study_command_of(argc, argv, USAGE);
    piston_study *s = calloc(1, sizeof *s);
    if (!s) abort();
    open_study(s, command.size);
    int failed = piston_run_all(s, jobs_processes());
    failed += piston_arches(s, jobs_processes());
    if (failed) fprintf(stderr, "pool-ball-piston: %d runs failed\n", failed);
    int code = report(s, &command);
    free(s);
    return code ? code : failed ? 1 : 0;
}
