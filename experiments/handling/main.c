/* handling: the worked scenes of A00 Appendix D, and the bin of section 3.9.4.
 *
 *     handling validate            runs, compares with what the source says
 *     handling figures             runs, writes data and frames for the figures
 */
#include "experiments/handling/handling.h"

static const char USAGE[] =
    "usage: handling validate|figures [--size quick|brief|published|full]\n"
    "The worked scenes of A00 Appendix D: two conveyors, singulation, a rotating disc; the bin of "
    "3.9.4.\n"
    "CLAST_SIZE and CLAST_JOBS set size and number of processes, too.\n"
    "example: handling validate --size quick\n";

int main(int argc, char **argv) {
    static const char NAME[] = "handling";
    static handling_study s;
    study_command command = study_command_of(argc, argv, USAGE);
    s.size = &SIZES[command.size];
    s.to = study_folders_below(BUILD_FOLDER, NAME, command.size);
    handling_plan(&s);
    int failed = handling_run_all(&s), bad;
    if (command.figures)
        bad = handling_write_tables(&s) | handling_pictures(&s);
    else
        bad = handling_verdicts(&s);
    return study_end(NAME, failed, bad);
}
