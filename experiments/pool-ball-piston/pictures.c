/* pictures.c - frames of the bed and of one replicate, and its film. */
#include <stdio.h>

#include "experiments/pool-ball-piston/piston.h"
#include "experiments/study/output.h"
#include "experiments/study/pictures.h"

int piston_pictures(const piston_study *s) {
    static const struct {
        double time;
        const char *name;
    } STILLS[] = {{0, "start"}, {1.6, "early"}, {3.2, "late"}, {5, "end"}};
    const group *g = piston_group(s, SECTION_BASE, 0);
    char folder[700];
    snprintf(folder, sizeof folder, "%s/../frames", s->data);
    output_folder(folder);
    if (!g) return 0;
    int bad = 0;
    for (size_t i = 0; i < sizeof STILLS / sizeof *STILLS; i++)
        bad |= picture_still(CLAST_COMMAND, g->model.folder, STILLS[i].time, folder, STILLS[i].name,
                             "body");
    bad |= picture_movie(CLAST_COMMAND, g->model.folder, folder, "piston", "body", NULL);
    return bad ? 4 : 0;
}
