/* pictures.c - frames like those of S12 Figs 3.18, 3.19 and 4.7: a tracer in black on its way. */
#include <math.h>
#include <string.h>

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

/* A little faster than the bars: what creeps with them is told from what lies and from what rolls.
 */
static const char *scale_of(const grate_study *s, const grate_case *c, char text[16]) {
    snprintf(text, 16, "%.3g", 1.2 * case_bar_speed(c, s->size));
    return text;
}

/* Three moments of its way, and one of the whole with the same tracer half-way. */
static int follow(const grate_study *s, const char *of, const char *name) {
    static const double PART[3] = {0.1, 0.5, 0.9};
    const grate_result *g = result_of(s, of);
    const tracer *t = g ? typical(g->rtd) : NULL;
    char file[64], top[16];
    int bad = 0;
    for (int k = 0; t && k < 3; k++) {
        double at = (t->entry + PART[k] * t->time) / g->speed_up;
        snprintf(file, sizeof file, "%s-%d", name, k + 1);
        bad |= picture_marked(CLAST_COMMAND, g->folder, at, s->frames, file, "speed",
                              scale_of(s, g->of, top), &t->id, 1);
    }
    return bad;
}

enum { ONE_IN = 20, FILM_FRAMES = 400 };

static const grate_result *film_of(const grate_study *s, const char *name) {
    for (int i = 0; i < s->count; i++)
        if (!strcmp(s->results[i].of->name, name) && s->results[i].passages) return &s->results[i];
    return NULL;
}

/* The last frames of a run, every twentieth of the bodies in them in black. */
static int film(const grate_study *s, const char *of, const char *name) {
    const grate_result *g = film_of(s, of);
    uint32_t id[PICTURE_MARKS];
    char top[16], why[RESULTS_ERROR_MAX];
    results *r = g ? results_open(g->folder, why) : NULL;
    int count = 0;
    if (!r) return 0;
    size_t frames = results_frames(r), first = frames > FILM_FRAMES ? frames - FILM_FRAMES : 0;
    frame *f = results_frame(r, first);
    double from = f ? f->time : 0;
    frame_free(f);
    results_free(r);
    const passages *p = g->passages;
    for (size_t i = 0; i < p->count && count < PICTURE_MARKS; i += ONE_IN)
        if (p->items[i].out > from) id[count++] = p->items[i].id;
    return picture_movie_marked(CLAST_COMMAND, g->folder, s->frames, name, "speed",
                                scale_of(s, g->of, top), first, id, count);
}

/* Those that stay for five mean residence times and to the end, drawn two minutes before it: at the
 * end of the run of ceramic the bars pause, and all is of one colour. */
static int held(const grate_study *s, const char *of, const char *name) {
    const grate_result *g = result_of(s, of);
    uint32_t id[PICTURE_MARKS];
    char top[16];
    int count = 0;
    if (!g) return 0;
    const passages *p = g->passages;
    double before = p->end - 5 * g->rtd->of[RTD_MEAN].mean;
    for (size_t i = 0; i < p->count && count < PICTURE_MARKS; i++)
        if (p->items[i].in < before && p->items[i].out > p->end) id[count++] = p->items[i].id;
    return picture_marked(CLAST_COMMAND, g->folder, (p->end - 120) / g->speed_up, s->frames, name,
                          "speed", scale_of(s, g->of, top), id, count);
}

int grate_pictures(const grate_study *s) {
    int bad = follow(s, "forward clay", "forward") | follow(s, "backward clay", "backward") |
              follow(s, "fast 13.6 kg/h", "fast") | film(s, "film of wood", "fast") |
              film(s, "film of forward clay", "forward") | held(s, "fast 13.6 kg/h", "held-wood") |
              held(s, "backward ceramic", "held-ceramic");
    return bad ? 4 : 0;
}
