/* grate-rtd: residence times on forward and backward acting grates (S12 section 3.9.4, chapter 4).
 *
 *     grate-rtd validate           runs, compares with what the source says
 *     grate-rtd figures            runs, writes data and frames for the figures
 */
#include <stdio.h>

#include "experiments/grate-rtd/grate.h"
#include "experiments/study/output.h"

static const char USAGE[] =
    "usage: grate-rtd validate|figures [--size quick|brief|published|full]\n"
    "Residence times on moving grates: S12 section 3.9.4 and chapter 4.\n"
    "CLAST_SIZE and CLAST_JOBS set size and number of processes, too.\n"
    "example: grate-rtd validate --size quick\n";

static void open_study(grate_study *s, study_size size) {
    const char *name = study_size_name(size);
    s->size = size;
    /* runs are shared between sizes: their names say what they are */
    snprintf(s->root, sizeof s->root, "%s/studies/grate-rtd/runs", BUILD_FOLDER);
    snprintf(s->data, sizeof s->data, "%s/studies/grate-rtd/%s/data", BUILD_FOLDER, name);
    snprintf(s->frames, sizeof s->frames, "%s/studies/grate-rtd/%s/frames", BUILD_FOLDER, name);
    output_folder(s->root);
    output_folder(s->data);
    output_folder(s->frames);
}

int main(int argc, char **argv) {
    static grate_study s;
    study_command command = study_command_of(argc, argv, USAGE);
    open_study(&s, command.size);
    grate_plan(&s);
    int failed = grate_run_all(&s), bad;
    if (failed) fprintf(stderr, "grate-rtd: %d runs failed\n", failed);
    grate_measure(&s);
    if (command.figures) {
        bad = grate_write_tables(&s) | grate_pictures(&s);
    } else {
        output_folder(BUILD_FOLDER "/validate");
        bad = grate_verdicts(&s, BUILD_FOLDER "/validate/grate-rtd.csv");
    }
    grate_forget(&s);
    return bad ? bad : failed ? 1 : 0;
}
