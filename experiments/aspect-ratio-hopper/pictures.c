/* pictures.c - which pictures and films there are: counterparts of A00 Figs 5.2 and 5.16 to 5.18,
 * and the forces that the source does not show. The shapes stand side by side in each. */
#include <math.h>
#include <stdio.h>

#include "experiments/aspect-ratio-hopper/aspect.h"
#include "experiments/aspect-ratio-hopper/studio.h"
#include "experiments/study/pictures.h"

enum { FILM_FRAMES = 400 };
#define FLOWING  0.5 /* s, in the middle of the discharge */
#define IN_SPACE 0.3
#define FASTEST  6.0 /* m/s, top of the scale of speed: the fall through the chamber */

/* Shown is what lies between these heights, in widths of the hopper. */
static const double BED[2] = {-0.03, 3.2}, ALL[2] = {-2.02, 3.2}, LOWER[2] = {-0.05, 1.0};

/* The frame of each main shape that is nearest in time; NULL where there is no run. */
static void take_frames(const aspect_study *s, double time, bool at_rest,
                        frame *taken[MAIN_SHAPES]) {
    for (int shape = 0; shape < MAIN_SHAPES; shape++) {
        const aspect_case *c = shown_case(s, shape);
        taken[shape] = NULL;
        if (!c) continue;
        results *r = run_open(at_rest ? c->rest_folder : c->flow_folder);
        taken[shape] = run_frame(r, time);
        results_free(r);
    }
}

static int still(const aspect_study *s, sheet sheet_of, double time, bool at_rest,
                 const char *name) {
    frame *taken[MAIN_SHAPES];
    char path[800];
    take_frames(s, time, at_rest, taken);
    snprintf(path, sizeof path, "%s/%s.png", s->to.frames, name);
    studio *o = studio_new(&sheet_of);
    int bad = o ? studio_still(o, (const frame *const *)taken, path) : 4;
    studio_free(o);
    for (int k = 0; k < MAIN_SHAPES; k++) frame_free(taken[k]);
    return bad;
}

/* The longest particles at the moment of the lowest rate. */
static int arch_picture(const aspect_study *s) {
    for (int shape = MAIN_SHAPES - 1; shape > 0; shape--) {
        const aspect_case *c = shown_case(s, shape);
        if (!c || isnan(c->flow.lowest_at)) continue;
        char path[800];
        sheet one = {.panels = 1,
                     .low = LOWER[0],
                     .high = 1.4,
                     .half_width = c->half_width,
                     .panel_px = 900,
                     .colour = SHEET_SPEED,
                     .fastest = 2,
                     .titles = {c->chain.name}};
        results *r = run_open(c->flow_folder);
        frame *f = run_frame(r, c->flow.lowest_at);
        snprintf(path, sizeof path, "%s/arch.png", s->to.frames);
        studio *o = studio_new(&one);
        int bad = o ? studio_still(o, (const frame *const *)&f, path) : 4;
        studio_free(o);
        frame_free(f);
        results_free(r);
        return bad;
    }
    return 0;
}

static int film(const aspect_study *s, sheet sheet_of, const char *name) {
    char folder[760], path[800];
    snprintf(folder, sizeof folder, "%s/%s", s->to.frames, name);
    snprintf(path, sizeof path, "%s/%s.mp4", s->to.frames, name);
    results *runs[MAIN_SHAPES] = {NULL};
    size_t longest = 0;
    for (int k = 0; k < MAIN_SHAPES; k++) {
        const aspect_case *c = shown_case(s, k);
        if (!c) continue;
        runs[k] = run_open(c->flow_folder);
        if (results_frames(runs[k]) > longest) longest = results_frames(runs[k]);
    }
    studio *o = studio_new(&sheet_of);
    int bad = o ? studio_film_begin(o, folder) : 4;
    for (size_t i = 0; i < longest && i < FILM_FRAMES && !bad; i++) {
        frame *now[MAIN_SHAPES] = {NULL};
        for (int k = 0; k < MAIN_SHAPES; k++) {
            size_t count = runs[k] ? results_frames(runs[k]) : 0; /* a run at rest keeps its last */
            if (count > 0) now[k] = results_frame(runs[k], i < count ? i : count - 1);
        }
        bad = studio_film_frame(o, (const frame *const *)now);
        for (int k = 0; k < MAIN_SHAPES; k++) frame_free(now[k]);
    }
    if (o && !bad) bad = studio_film_end(o, path);
    studio_free(o);
    for (int k = 0; k < MAIN_SHAPES; k++) results_free(runs[k]);
    return bad;
}

/* Three dimensions have no room on a sheet: one picture each, as the view of the scene has it. */
static int space_pictures(const aspect_study *s) {
    int bad = 0;
    for (int i = 0; i < s->count; i++) {
        const aspect_case *c = &s->cases[i];
        char name[40];
        if (!c->ran || !c->in_space || c->replicate > 0) continue;
        snprintf(name, sizeof name, "space-%s", c->chain.name);
        bad |= picture_still(CLAST_COMMAND, c->flow_folder, IN_SPACE, s->to.frames, name, "speed");
    }
    return bad;
}

int aspect_pictures(const aspect_study *s) {
    sheet base = {.panels = MAIN_SHAPES, .half_width = s->size->half_width, .panel_px = 400};
    for (int k = 0; k < MAIN_SHAPES; k++) base.titles[k] = chain_of(k).name;
    sheet beds = base, forces = base, speed = base, bands = base, turned = base;
    beds.low = BED[0], beds.high = BED[1], beds.colour = SHEET_AXIS;
    forces.low = BED[0], forces.high = BED[1], forces.colour = SHEET_FORCES;
    speed.low = ALL[0], speed.high = ALL[1], speed.colour = SHEET_SPEED, speed.fastest = FASTEST;
    speed.panel_px = 290;
    bands.low = LOWER[0], bands.high = LOWER[1], bands.colour = SHEET_BANDS, bands.panel_px = 480;
    turned = bands;
    turned.low = ALL[0], turned.high = ALL[1], turned.panel_px = 290;
    beds.closed = forces.closed = true;
    int bad = still(s, beds, 1e9, true, "beds") | still(s, forces, 1e9, true, "forces");
    bad |= still(s, speed, SNAPSHOT, false, "snapshots");
    bad |= still(s, speed, FLOWING, false, "flowing");
    bad |= still(s, bands, SHEAR_TIME, false, "bands");
    bad |= arch_picture(s) | space_pictures(s);
    speed.panel_px = turned.panel_px = 200; /* of a film: it is looked at as a whole */
    if (s->size->films && !bad) bad = film(s, speed, "speed") | film(s, turned, "velocity-bands");
    return bad ? 4 : 0;
}
