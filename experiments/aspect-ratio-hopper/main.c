/* aspect-ratio-hopper: 5000 particles of aspect ratio 1 to 4 settle in a hopper and flow out, A00
 * chapter 5.
 *
 *     aspect-ratio-hopper validate            runs, compares with what the source says
 *     aspect-ratio-hopper figures             runs, writes data and frames for the figures
 */
#include "experiments/aspect-ratio-hopper/aspect.h"

static const char USAGE[] =
    "usage: aspect-ratio-hopper validate|figures [--size quick|brief|published|full]\n"
    "Repeats A00 chapter 5: beds and discharge of particles of aspect ratio 1 to 4.\n"
    "CLAST_SIZE and CLAST_JOBS set size and number of processes, too.\n"
    "example: aspect-ratio-hopper validate --size quick\n";

static int write_figures(const aspect_study *s) {
    return aspect_write_tables(s) | aspect_write_maps(s) | aspect_pictures(s);
}

int main(int argc, char **argv) {
    static const char NAME[] = "aspect-ratio-hopper";
    static aspect_study s;
    study_command command = study_command_of(argc, argv, USAGE);
    s.size = &SIZES[command.size];
    s.to = study_folders_below(BUILD_FOLDER, NAME, command.size);
    aspect_plan(&s);
    int failed = aspect_run_all(&s);
    return study_end(NAME, failed, command.figures ? write_figures(&s) : aspect_verdicts(&s));
}
