/* pictures.c - frames like those of S12 Figs 3.18, 3.19 and 4.7: a tracer in black on its way. */
#include <math.h>

#include "experiments/grate-rtd/grate.h"
#include "experiments/study/pictures.h"

/* The tracer whose residence time is nearest to the mean, of those that left; they stand in the
 * order of time. */
static const tracer *typical(const rtd *r) {
    const tracer *best = NULL;
    double mean = r->of[RTD_MEAN].mean;
    for (size_t i = 0; i < r->tracers; i++) {
        const tracer *t = &r->items[i];
        if (t->left && (!best || fabs(t->time - mean) < fabs(best->time - mean))) best = t;
    }
    return best;
}

/* Three moments of its way, and one of the whole with the same tracer half-way. */
static int follow(const grate_study *s, const char *of, const char *name) {
    static const double PART[3] = {0.1, 0.5, 0.9};
    const grate_result *g = result_of(s, of);
    const tracer *t = g ? typical(g->rtd) : NULL;
    char file[64];
    int bad = 0;
    for (int k = 0; t && k < 3; k++) {
        double at = (t->entry + PART[k] * t->time) / g->speed_up;
        snprintf(file, sizeof file, "%s-%d", name, k + 1);
        bad |= picture_marked(CLAST_COMMAND, g->folder, at, s->frames, file, "speed", t->id);
    }
    return bad;
}

int grate_pictures(const grate_study *s) {
    int bad = follow(s, "forward clay", "forward") | follow(s, "backward clay", "backward") |
              follow(s, "fast 13.6 kg/h", "fast");
    const grate_result *fast = result_of(s, "fast 13.6 kg/h");
    if (fast && s->size > STUDY_QUICK)
        bad |= picture_movie(CLAST_COMMAND, fast->folder, s->frames, "fast", "speed", NULL);
    return bad ? 4 : 0;
}
