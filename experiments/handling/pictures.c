/* pictures.c - frames like those of A00 Figs 3.25, 3.26, 3.28, 3.30 and 3.32, and films. */
#include <math.h>

#include "experiments/handling/handling.h"
#include "experiments/study/pictures.h"

/* Single particles: seconds from the moment they fall below the upper conveyor; others: from the
 * start. */
typedef struct still {
    scene_kind kind;
    double time; /* s */
    const char *name;
} still;

static const still STILLS[] = {
    {TAPERED, -0.3, "tapered-1"},
    {TAPERED, 0.12, "tapered-2"},
    {TAPERED, 1.0, "tapered-3"},
    {IRREGULAR, -0.12, "irregular-1"},
    {IRREGULAR, 0.12, "irregular-2"},
    {IRREGULAR, 0.8, "irregular-3"},
    {BUNCH, 0.0, "bunch-1"},
    {BUNCH, 0.6, "bunch-2"},
    {BUNCH, 2.0, "bunch-3"},
    {SINGULATION, 0.0, "singulation-1"},
    {SINGULATION, 3.0, "singulation-2"},
    {SINGULATION, 5.5, "singulation-3"},
    {DISC, 2.0, "disc"},
    {MIXTURE, 1e9, "mixture"},
};

static int take(const handling_study *s, const handling_run *run, double time, const char *name,
                const char *colour) {
    return run ? picture_still(CLAST_COMMAND, run->folder, time, s->to.frames, name, colour) : 0;
}

static double time_of(const handling_study *s, const still *one) {
    const handling_run *run = run_of(s, one->kind, 0, 0);
    if (one->kind > IRREGULAR || !run) return one->time;
    results *r = run_open(run);
    double time = fall_time(r, one->kind) + one->time;
    results_free(r);
    return time > 0 ? time : 0;
}

/* The shape in the middle at rest and in flow, as A00 Fig. 3.30 shows its case 3, and all at last.
 */
static int pictures_of_bin(const handling_study *s) {
    const handling_run *middle = flow_of(s, 0, SHAPES / 2, 0, 0);
    int bad = take(s, middle, 0, "bin-rest", "body") | take(s, middle, 0.2, "bin-flow", "body");
    for (int i = 0; i < SHAPES; i++) {
        char name[40];
        snprintf(name, sizeof name, "bin-arch-%d", i + 1);
        bad |= take(s, flow_of(s, 0, i, 0, 0), 1e9, name, "body");
    }
    return bad;
}

static int film(const handling_study *s, const handling_run *run, const char *name,
                const char *colour) {
    return run ? picture_movie(CLAST_COMMAND, run->folder, s->to.frames, name, colour, NULL) : 0;
}

/* Each shape through the widest orifice. */
static int films_of_bin(const handling_study *s) {
    int bad = 0;
    for (int i = 0; i < SHAPES; i++) {
        char name[40];
        snprintf(name, sizeof name, "bin-%d", i + 1);
        bad |= film(s, flow_of(s, 0, i, ORIFICES - 1, 0), name, "body");
    }
    return bad;
}

int handling_pictures(const handling_study *s) {
    int bad = pictures_of_bin(s);
    for (size_t i = 0; i < sizeof STILLS / sizeof *STILLS; i++)
        bad |= take(s, run_of(s, STILLS[i].kind, 0, 0), time_of(s, &STILLS[i]), STILLS[i].name,
                    STILLS[i].kind == MIXTURE ? "body" : "speed");
    if (s->size->shapes == 1) return bad ? 4 : 0; /* films take as long as all runs of that size */
    for (int kind = 0; kind < KINDS; kind++)
        if (kind != BIN)
            bad |= film(s, run_of(s, (scene_kind)kind, 0, 0), KIND_NAME[kind],
                        kind == MIXTURE ? "body" : "speed");
    return bad | films_of_bin(s) ? 4 : 0;
}
