/* handling: the worked scenes of A00 Appendix D, and the bin of section 3.9.4.
 *
 *     handling validate            runs, compares with what the source says
 *     handling figures             runs, writes data and frames for the figures
 */
#include <stdio.h>

#include "experiments/handling/handling.h"
#include "experiments/study/output.h"

static const char USAGE[] =
    "usage: handling validate|figures [--size quick|brief|published|full]\n"
    "The worked scenes of A00 Appendix D: two conveyors, singulation, a rotating disc; the bin of "
    "3.9.4.\n"
    "CLAST_SIZE and CLAST_JOBS set size and number of processes, too.\n"
    "example: handling validate --size quick\n";

static void open_study(handling_study *s, study_size size) {
    const char *name = study_size_name(size);
    s->size = &SIZES[size];
    /* runs are shared between sizes: their names say what they are */
    snprintf(s->root, sizeof s->root, "%s/studies/handling/runs", BUILD_FOLDER);
    snprintf(s->data, sizeof s->data, "%s/studies/handling/%s/data", BUILD_FOLDER, name);
    snprintf(s->frames, sizeof s->frames, "%s/studies/handling/%s/frames", BUILD_FOLDER, name);
    output_folder(s->root);
    output_folder(s->data);
    output_folder(s->frames);
}

int main(int argc, char **argv) {
    static handling_study s;
    study_command command = study_command_of(argc, argv, USAGE);
    open_study(&s, command.size);
    handling_plan(&s);
    int failed = handling_run_all(&s), bad;
    if (failed) fprintf(stderr, "handling: %d runs failed\n", failed);
    if (command.figures) {
        bad = handling_write_tables(&s) | handling_pictures(&s);
    } else {
        output_folder(BUILD_FOLDER "/validate");
        bad = handling_verdicts(&s, BUILD_FOLDER "/validate/handling.csv");
    }
    return bad ? bad : failed ? 1 : 0;
}
