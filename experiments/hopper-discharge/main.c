/* hopper-discharge: 2010 steel spheres leave a hopper, an explicit scheme beside an implicit one,
 * S12 section 3.9.3.
 *
 *     hopper-discharge validate            runs, compares with theory and with what the source says
 *     hopper-discharge figures             runs, writes data and pictures for the figures */
#include <stdio.h>

#include "experiments/hopper-discharge/discharge.h"
#include "experiments/study/output.h"

static const char USAGE[] =
    "usage: hopper-discharge validate|figures [--size quick|brief|published|full]\n"
    "Repeats S12 section 3.9.3: residence times, steps that fail, and prices of position Verlet "
    "and\n"
    "Numerov. Results are kept below the build folder. CLAST_SIZE sets the size, CLAST_JOBS how\n"
    "many runs go side by side.\n"
    "example: hopper-discharge validate --size quick\n";

static const discharge_size SIZES_OF_STUDY[] = {
    [STUDY_QUICK] = {.rows = 6, .states = 2, .first_step = 2, .scans = SCANS},
    [STUDY_BRIEF] = {.rows = ROWS, .states = 2, .scans = SCANS, .halvings = 3},
    [STUDY_PUBLISHED] =
        {.rows = ROWS, .states = 4, .scans = SCANS, .halvings = 4, .variant_states = 2},
    [STUDY_FULL] =
        {.rows = ROWS, .states = STATES_MAX, .scans = SCANS, .halvings = 4, .variant_states = 4},
};

int main(int argc, char **argv) {
    study_command c = study_command_of(argc, argv, USAGE);
    discharge_study s = {.size = &SIZES_OF_STUDY[c.size], .size_name = study_size_name(c.size)};
    snprintf(s.root, sizeof s.root, "%s/studies/hopper-discharge/%s", BUILD_FOLDER, s.size_name);
    snprintf(s.data, sizeof s.data, "%s/data", s.root);
    output_folder(s.data);
    study_run(&s);
    int bad;
    if (c.figures) {
        bad = discharge_write_tables(&s) | discharge_pictures(&s);
    } else {
        output_folder(BUILD_FOLDER "/validate");
        bad = discharge_verdicts(&s, BUILD_FOLDER "/validate/hopper-discharge.csv");
    }
    study_forget(&s);
    return bad;
}
