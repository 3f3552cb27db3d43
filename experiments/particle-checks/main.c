/* particle-checks: single particles beside theory, A00 chapter 3.
 *
 *     particle-checks validate            runs, compares with theory and with what the source says
 *     particle-checks figures             runs, writes data for the figures */
#include <stdio.h>

#include "experiments/particle-checks/checks.h"
#include "experiments/study/command.h"
#include "experiments/study/output.h"

static const char USAGE[] =
    "usage: particle-checks validate|figures [--size quick|published|full]\n"
    "One particle at rest, in a collision, on a slope, on a belt, struck, sliding over others: "
    "beside\ntheory. CLAST_SIZE sets the size, CLAST_JOBS the number of processes.\n"
    "example: particle-checks validate --size quick\n";

static const checks_size SIZES[] = {
    [STUDY_QUICK] = {.starts = 4, .variant_starts = 1, .densest = 4, .bed_steps = 500},
    [STUDY_PUBLISHED] = {.starts = 16, .variant_starts = 16, .densest = 16, .bed_steps = 300000},
    [STUDY_FULL] = {.starts = 64, .variant_starts = 64, .densest = 16, .bed_steps = 300000},
};

int main(int argc, char **argv) {
    study_command command = study_command_of(argc, argv, USAGE);
    const checks_size *size = &SIZES[command.size];
    const char *name = study_size_name(command.size);
    char folder[600];
    snprintf(folder, sizeof folder, "%s/studies/particle-checks/%s/data", BUILD_FOLDER, name);
    output_folder(folder);
    if (command.figures) return checks_write_tables(size, name, folder);
    output_folder(BUILD_FOLDER "/validate");
    return checks_verdicts(size, BUILD_FOLDER "/validate/particle-checks.csv");
}
