/* pictures.c - the heap at its end, as it stands and without some features; the silo while it
 * flows. */
#include <stdio.h>

#include "experiments/scene-needs/study.h"
#include "experiments/study/output.h"
#include "experiments/study/pictures.h"

static const struct {
    int scene; /* of NEEDS_SCENES */
    const char *key, *name;
    double time; /* s */
} PICTURES[] = {
    {0, "reference", "heap", 1e9},      {0, "history", "heap-history", 1e9},
    {0, "still", "heap-rotation", 1e9}, {0, "rolling", "heap-rolling", 1e9},
    {0, "layer", "heap-layer", 1e9},    {1, "reference", "silo", 0.9},
};

int needs_pictures(const needs_study *s) {
    char folder[700];
    int bad = 0;
    snprintf(folder, sizeof folder, "%s/../frames", s->data);
    output_folder(folder);
    for (size_t i = 0; i < sizeof PICTURES / sizeof *PICTURES && !bad; i++) {
        const needs_runs *r = &s->runs[PICTURES[i].scene];
        const job *j = &r->jobs[0][needs_variant(r, PICTURES[i].key)];
        if (j->done)
            bad = picture_still(CLAST_COMMAND, j->folder, PICTURES[i].time, folder,
                                PICTURES[i].name, "initial-height");
    }
    return bad;
}
