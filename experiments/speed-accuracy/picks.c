/* picks.c - what to pick and what it costs, in words: the table picks.csv and a sentence for each
 * part. Every word is computed from the points. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "engine/clast.h"
#include "experiments/speed-accuracy/picks.h"
#include "experiments/study/output.h"
#include "experiments/study/published.h"

typedef struct panel_words {
    const char *const *part;
    const char *scene, *quantity, *words;
} panel_words;

/* In the order of the page. */
static const panel_words PANELS[] = {
    {&PART_COLLISION, "linear e=1", "largest", "linear contact, e = 1"},
    {&PART_COLLISION, "linear e=0.5", "largest", "linear contact, e = 0.5"},
    {&PART_COLLISION, "Hertz e=1", "largest", "Hertz contact, e = 1"},
    {&PART_COLLISION, "Hertz e=0.5", "largest", "Hertz contact, e = 0.5"},
    {&PART_SANDWICH, "e=1", "phase", "phase after 44 oscillations, of a period"},
    {&PART_SANDWICH, "e=1", "largest", "phase and energy, the larger"},
    {&PART_DISCHARGE, "S12 3.9.3", "residence", "mean residence time"},
    {&PART_DISCHARGE, "S12 3.9.3", "energy", "energy"},
    {&PART_BUTTONS, "10 cm", "rate", "flow rate"},
    {&PART_BUTTONS, "10 cm", "density", "bulk density of the flowing bed"},
};
enum { PANEL_COUNT = sizeof PANELS / sizeof *PANELS };

static const chart_point *panel_of(const chart *c, const panel_words *w) {
    return chart_panel(c, *w->part, w->scene, w->quantity);
}

/* ---- words ----------------------------------------------------------------------------------- */

typedef struct phrase {
    char text[160];
} phrase;

static bool is_scheme(const chart_point *p) {
    return strcmp(p->part, PART_BUTTONS) != 0;
}

/* "leapfrog, 16 steps per contact"; of the button hopper the setting alone. */
static phrase setting_words(const chart_point *p) {
    phrase w = {"none of those tried"};
    if (!p) return w;
    snprintf(w.text, sizeof w.text, "%s%s%s%s", is_scheme(p) ? p->family : "",
             is_scheme(p) ? ", " : "", p->setting, p->reference ? " (the reference itself)" : "");
    return w;
}

static phrase number_words(double value, const char *unit) {
    phrase w = {"-"};
    if (isfinite(value)) snprintf(w.text, sizeof w.text, "%.2g%s", value, unit);
    return w;
}

/* "0.4 %", or "at most 3 %" where the interval holds zero. */
static phrase error_words(const chart_point *p) {
    phrase w = {"-"};
    if (!p) return w;
    bool open = p->statistical && !chart_is_distinct(p);
    if (p->reference && p->error == 0)
        snprintf(w.text, sizeof w.text, "0, by definition");
    else
        snprintf(w.text, sizeof w.text, "%s%.2g %%", open ? "not seen, at most " : "",
                 100 * (open ? p->high : p->error));
    return w;
}

/* ---- kinds of schemes ------------------------------------------------------------------------ */

/* Schemes of the table alone: what another study calls its methods begins alike. */
static const clast_scheme_info *scheme_of(const chart_point *p) {
    for (int k = 0; k < CLAST_SCHEMES; k++) {
        const clast_scheme_info *info = clast_scheme_info_of((clast_scheme)k);
        if (!strcmp(info->name, p->family)) return info;
    }
    return NULL;
}

bool point_is_explicit(const chart_point *p) {
    return scheme_of(p) && !scheme_of(p)->implicit;
}
bool point_is_implicit(const chart_point *p) {
    return scheme_of(p) && scheme_of(p)->implicit;
}

/* ---- the table ------------------------------------------------------------------------------- */

static void write_pick(FILE *f, const chart *c, const panel_words *w, double accepted) {
    const chart_point *panel = panel_of(c, w);
    if (!panel) return;
    const chart_point *fast = chart_pick(c, panel, accepted, CHART_COST, NULL);
    const chart_point *few = chart_pick(c, panel, accepted, CHART_EVALUATIONS, NULL);
    phrase cells[7];
    snprintf(cells[0].text, sizeof cells[0].text, "%g %%", 100 * accepted);
    cells[1] = setting_words(fast);
    cells[2] = number_words(fast ? fast->cost.median : NAN, " s");
    cells[3] = error_words(fast);
    cells[4] = number_words(fast ? 1e6 * fast->step : NAN, " us");
    cells[5] = setting_words(few);
    cells[6] = number_words(few ? few->evaluations : NAN, "");
    fprintf(f, "%s,", *w->part);
    csv_put(f, w->words);
    for (int i = 0; i < 7; i++) {
        fputc(',', f);
        csv_put(f, cells[i].text);
    }
    fputc('\n', f);
}

int picks_write(const chart *c, const char *folder) {
    FILE *f = output_table(folder, "picks.csv",
                           "part,of,accepted,pick,cost,error,step,fewest,evaluations");
    if (!f) return 4;
    for (int i = 0; i < PANEL_COUNT; i++)
        for (int k = 0; k < TOLERANCES; k++) write_pick(f, c, &PANELS[i], TOLERANCE[k]);
    return output_close(f);
}

/* ---- sentences ------------------------------------------------------------------------------- */

static void say_pick(FILE *f, const chart *c, const panel_words *w, double accepted) {
    const chart_point *panel = panel_of(c, w);
    const chart_point *p = panel ? chart_pick(c, panel, accepted, CHART_COST, NULL) : NULL;
    if (!p)
        fprintf(f, "%s: no setting is shown to keep it", w->words);
    else
        fprintf(f, "%s: %s, %.2g s of processor time per simulated second", w->words,
                setting_words(p).text, p->cost.median);
}

void picks_say(FILE *f, const chart *c, const char *part, double accepted) {
    const char *between = "";
    for (int i = 0; i < PANEL_COUNT; i++) {
        if (strcmp(*PANELS[i].part, part) != 0) continue;
        fputs(between, f);
        say_pick(f, c, &PANELS[i], accepted);
        between = "; ";
    }
}

void picks_say_unseen(FILE *f, const chart *c, const char *part, const char *quantity) {
    const char *between = "";
    for (int i = 0; i < c->count; i++) {
        const chart_point *p = &c->points[i];
        bool unseen = !p->reference && isfinite(p->error) && !chart_is_distinct(p);
        if (strcmp(p->part, part) != 0 || strcmp(p->quantity, quantity) != 0 || !unseen) continue;
        fprintf(f, "%s%s (at most %.2g %%)", between, p->setting, 100 * p->high);
        between = ", ";
    }
    if (!between[0]) fputs("none", f);
}
