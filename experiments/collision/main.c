/* collision: single head-on collisions of a sphere with a wall, S12 sections 2.6, 2.7 and 3.4.
 *
 *     collision validate            runs, compares with theory and with what the source says
 *     collision figures             runs, writes data for the figures */
#include <stdio.h>

#include "experiments/collision/collision.h"
#include "experiments/study/command.h"
#include "experiments/study/output.h"

static const char USAGE[] =
    "usage: collision validate|figures [--size quick|published|full]\n"
    "One sphere against a wall: impact models beside their closed forms, time stepping schemes "
    "beside\nthe exact solution. CLAST_SIZE sets the same.\n"
    "example: collision validate --size quick\n";

static const int PLACES[] = {
    [STUDY_QUICK] = 4, [STUDY_PUBLISHED] = 32, [STUDY_FULL] = 256}; /* of onset */

int main(int argc, char **argv) {
    study_command c = study_command_of(argc, argv, USAGE);
    collision_study s = {.size = study_size_name(c.size), .places = PLACES[c.size]};
    snprintf(s.data, sizeof s.data, "%s/studies/collision/%s/data", BUILD_FOLDER, s.size);
    output_folder(s.data);
    if (c.figures) return collision_write_tables(&s);
    return collision_verdicts(BUILD_FOLDER "/validate/collision.csv");
}
