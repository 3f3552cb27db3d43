/* sandwich: a ball between two walls, S12 sections 3.9.1 and 3.9.2, and where every scheme fails.
 *
 *     sandwich validate            runs, compares with theory and with what the source says
 *     sandwich figures             runs, writes data for the figures */
#include <stdio.h>

#include "experiments/sandwich/sandwich.h"
#include "experiments/study/output.h"

static const char USAGE[] =
    "usage: sandwich validate|figures [--size quick|published|full]\n"
    "A ball between two walls: schemes beside the exact solution, largest steps beside theory.\n"
    "CLAST_SIZE sets the size, too.\n"
    "example: sandwich validate --size quick\n";

static const sandwich_size SIZES[] = {
    [STUDY_QUICK] = {.fractions = 11,
                     .restitutions = 2,
                     .curve = 5,
                     .budget = 4000,
                     .quiet = 2000,
                     .finest = 10},
    [STUDY_PUBLISHED] = {.fractions = 61,
                         .restitutions = 8,
                         .curve = 39,
                         .budget = 100000,
                         .quiet = 1000000,
                         .finest = 12},
    [STUDY_FULL] = {.fractions = 201,
                    .restitutions = 8,
                    .curve = 96,
                    .budget = 300000,
                    .quiet = 1000000,
                    .finest = 13},
};

int main(int argc, char **argv) {
    study_command command = study_command_of(argc, argv, USAGE);
    const sandwich_size *size = &SIZES[command.size];
    const char *name = study_size_name(command.size);
    char folder[600];
    snprintf(folder, sizeof folder, "%s/studies/sandwich/%s/data", BUILD_FOLDER, name);
    output_folder(folder);
    if (command.figures) return sandwich_write_tables(size, name, folder);
    output_folder(BUILD_FOLDER "/validate");
    return sandwich_verdicts(size, BUILD_FOLDER "/validate/sandwich.csv");
}
