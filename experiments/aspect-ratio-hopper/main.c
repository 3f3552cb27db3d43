/* aspect-ratio-hopper: 5000 particles of aspect ratio 1 to 4 settle in a hopper and flow out, A00
 * chapter 5.
 *
 *     aspect-ratio-hopper validate            runs, compares with what the source says
 *     aspect-ratio-hopper figures             runs, writes data and frames for the figures
 */
#include <stdio.h>
#include <stdlib.h>

#include "experiments/aspect-ratio-hopper/aspect.h"
#include "experiments/study/output.h"

static const char USAGE[] =
    "usage: aspect-ratio-hopper validate|figures [--size quick|brief|published|full]\n"
    "Repeats A00 chapter 5: beds and discharge of particles of aspect ratio 1 to 4.\n"
    "CLAST_SIZE and CLAST_JOBS set size and number of processes, too.\n"
    "example: aspect-ratio-hopper validate --size quick\n";

static void open_study(aspect_study *s, study_size size) {
    const char *name = study_size_name(size);
    s->size = &SIZES[size];
    /* runs are shared between sizes: their names say what they are */
    snprintf(s->root, sizeof s->root, "%s/studies/aspect-ratio-hopper/runs", BUILD_FOLDER);
    snprintf(s->data, sizeof s->data, "%s/studies/aspect-ratio-hopper/%s/data", BUILD_FOLDER, name);
    snprintf(s->frames, sizeof s->frames, "%s/studies/aspect-ratio-hopper/%s/frames", BUILD_FOLDER,
             name);
    output_folder(s->root);
    output_folder(s->data);
    output_folder(s->frames);
}

int main(int argc, char **argv) {
    static aspect_study s;
    study_command command = study_command_of(argc, argv, USAGE);
    open_study(&s, command.size);
    aspect_plan(&s);
    int failed = aspect_run_all(&s), bad;
    if (failed) fprintf(stderr, "aspect-ratio-hopper: %d runs failed\n", failed);
    if (command.figures) {
        bad = aspect_write_tables(&s) | aspect_write_maps(&s) | aspect_pictures(&s);
    } else {
        output_folder(BUILD_FOLDER "/validate");
        bad = aspect_verdicts(&s, BUILD_FOLDER "/validate/aspect-ratio-hopper.csv");
    }
    return bad ? bad : failed ? 1 : 0;
}
