/* speed-accuracy: error against processor time per simulated second, from one collision to the
 * button hopper.
 *
 *     speed-accuracy validate            runs, compares with theory and with what S12 says
 *     speed-accuracy figures             runs, writes data for the figures and the page */
#include <stdio.h>
#include <stdlib.h>

#include "experiments/speed-accuracy/chart.h"
#include "experiments/study/command.h"
#include "experiments/study/output.h"

static const char USAGE[] =
    "usage: speed-accuracy validate|figures [--size quick|brief|published|full]\n"
    "Error against cost: one collision, a ball between two walls, the hopper discharge (from the\n"
    "study hopper-discharge, when it has been run), the button hopper. Runs of the last are kept\n"
    "below the build folder and not repeated. CLAST_SIZE and CLAST_JOBS set size and processes,\n"
    "CLAST_PAIRS the number of pairs of runs of the button hopper (2 to 256).\n"
    "example: speed-accuracy validate --size quick\n";

static const chart_size SIZES[] = {
    [STUDY_QUICK] = {.size = STUDY_QUICK,
                     .name = "quick",
                     .least = 5e-4,
                     .resolutions = 13,
                     .places = 4,
                     .per_decade = 5,
                     .finest = 6e-5,
                     .replicates = 2,
                     .button_step = 9e-6,
                     .settle = "0.5 s",
                     .latest = "0.4 s"},
    [STUDY_BRIEF] = {.size = STUDY_BRIEF,
                     .name = "brief",
                     .least = 0.005,
                     .resolutions = 13,
                     .places = 8,
                     .per_decade = 10,
                     .finest = 4e-5,
                     .replicates = 5,
                     .button_step = 4.5e-6,
                     .settle = "1 s",
                     .latest = "0.5 s"},
    [STUDY_PUBLISHED] = {.size = STUDY_PUBLISHED,
                         .name = "published",
                         .least = 0.01,
                         .resolutions = 15,
                         .places = 16,
                         .per_decade = 10,
                         .finest = 4e-5,
                         .replicates = 16,
                         .button_step = 4.5e-6,
                         .settle = "1 s",
                         .latest = "0.5 s"},
    [STUDY_FULL] = {.size = STUDY_FULL,
                    .name = "full",
                    .least = 0.02,
                    .resolutions = 19,
                    .places = 32,
                    .per_decade = 20,
                    .finest = 2e-5,
                    .replicates = 96,
                    .button_step = 4.5e-6,
                    .settle = "1 s",
                    .latest = "0.5 s"},
};

/* More pairs from the same beds make intervals narrower; those that were run are kept. */
static int pairs_wished(int usual) {
    const char *wish = getenv("CLAST_PAIRS");
    long pairs = wish ? strtol(wish, NULL, 10) : usual;
    return pairs < 2 ? 2 : pairs > 256 ? 256 : (int)pairs;
}

int main(int argc, char **argv) {
    study_command command = study_command_of(argc, argv, USAGE);
    chart_size chosen = SIZES[command.size], *size = &chosen;
    size->replicates = pairs_wished(size->replicates);
    char folder[600], note[200];
    snprintf(folder, sizeof folder, "%s/studies/speed-accuracy/%s/data", BUILD_FOLDER, size->name);
    output_folder(folder);
    output_folder(BUILD_FOLDER "/validate");
    chart c = {0};
    int failed = discharge_points(&c, size, BUILD_FOLDER "/studies", folder, note);
    failed += button_points(&c, size, BUILD_FOLDER "/studies/speed-accuracy/runs", folder);
    /* what is timed for milliseconds comes last, when nothing else of this program runs */
    collision_points(&c, size, command.figures);
    sandwich_points(&c, size, command.figures);
    chart_finish(&c);
    printf("hopper discharge: %s\n", note);
    int code = command.figures ? chart_write_tables(&c, size, note, folder)
                               : chart_verdicts(&c, BUILD_FOLDER "/validate/speed-accuracy.csv");
    chart_free(&c);
    return code ? code : failed > 0;
}
