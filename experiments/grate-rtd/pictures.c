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

/* One tracer after the other, so that one is always on its way: of those that come within a quarter
 * of the mean behind the last one's leaving, the most typical. Returns how many. */
static int relay(const rtd *r, uint32_t *id, int most) {
    double mean = r->of[RTD_MEAN].mean, at = 0;
    int count = 0;
    for (; count < most; count++) {
        const tracer *next = NULL;
        for (size_t i = 0; i < r->tracers; i++) {
            const tracer *t = &r->items[i];
            if (!t->left || t->entry < at || t->entry > fmax(at, r->from) + 0.25 * mean) continue;
            if (!next || fabs(t->time - mean) < fabs(next->time - mean)) next = t;
        }
        if (!next) break;
        id[count] = next->id;
        at = next->entry + next->time;
    }
    return count;
}

static int film(const grate_study *s, const char *of, const char *name) {
    const grate_result *g = result_of(s, of);
    uint32_t id[PICTURE_MARKS];
    char top[16];
    if (!g || s->size == STUDY_QUICK) return 0;
    int count = relay(g->rtd, id, PICTURE_MARKS);
    return picture_movie_marked(CLAST_COMMAND, g->folder, s->frames, name, "speed",
                                scale_of(s, g->of, top), id, count);
}

/* Those that stay for five mean residence times and to the end, two minutes before it: where it is
 * the bars may pause, and all is of one colour. */
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
              follow(s, "fast 13.6 kg/h", "fast") | film(s, "fast 13.6 kg/h", "fast") |
              held(s, "fast 13.6 kg/h", "held-wood") | held(s, "backward ceramic", "held-ceramic");
    return bad ? 4 : 0;
}
