/* pictures.c - frames of chosen runs and the animation, by the `clast render` command that users
 * have. */
#include <stdio.h>
#include <sys/stat.h>

#include "experiments/button-hopper/hopper.h"
#include "experiments/study/pictures.h"

/* m/s: the free fall out of the picture; one scale for all frames of the animation */
#define FASTEST "2"

static const hopper_run *run_of(const hopper_study *s, int fill, int orifice, int replicate) {
    for (int i = 0; i < s->flow_count; i++) {
        const hopper_run *r = &s->runs[i];
        if (r->ran && r->fill == fill && r->orifice == orifice && r->replicate == replicate)
            return r;
    }
    return NULL;
}

/* The run at 5 cm with the longest pause while its bed flowed. */
static const hopper_run *longest_pause(const hopper_study *s) {
    const hopper_run *best = NULL;
    for (int i = 0; i < s->flow_count; i++) {
        const hopper_run *r = &s->runs[i];
        if (!r->ran || r->fill != FRICTIONLESS || r->orifice != 0 || r->pause.length == 0) continue;
        if (!best || r->pause.length > best->pause.length) best = r;
    }
    return best;
}

int hopper_pictures(const hopper_study *s) {
    char folder[700];
    snprintf(folder, sizeof folder, "%s/../frames", s->data);
    mkdir(folder, 0777);
    int bad = 0;
    for (int fill = 0; fill < FILLS; fill++)
        if (s->size->replicates[fill] > 0)
            bad |= picture_still(
                CLAST_COMMAND, s->beds[fill == 0 ? 0 : s->size->replicates[0]].folder, 1e9, folder,
                fill == FRICTIONLESS ? "bed-frictionless" : "bed-frictional", "initial-height");
    const hopper_run *wide = run_of(s, FRICTIONLESS, ORIFICES - 1, 0), *arched = longest_pause(s);
    if (wide)
        bad |=
            picture_still(CLAST_COMMAND, wide->folder, 0.08, folder, "zones-10cm", "speed-bands");
    if (arched)
        bad |= picture_still(CLAST_COMMAND, arched->folder,
                             arched->pause.start + 0.5 * arched->pause.length, folder, "arch-5cm",
                             "speed");
    if (wide)
        bad |=
            picture_movie(CLAST_COMMAND, wide->folder, folder, "discharge-10cm", "speed", FASTEST);
    return bad ? 4 : 0;
}
