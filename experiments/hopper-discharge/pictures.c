/* pictures.c - frames of the discharge: stripes of the initial height as in the source (Figs 3.14
 * and 3.15), tracers in a colour of their own. */
#include <math.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "engine/check.h"
#include "experiments/hopper-discharge/discharge.h"
#include "experiments/study/output.h"
#include "render/render.h"

enum { WIDTH = 900, HEIGHT = 860, STRIPES = 8, THROUGH = 4 };

#define FINE 1e-4 /* s, time step of the frames that show how it should be */

static const render_rgb TRACER = {213, 94, 0}, WALL = {40, 40, 40};

typedef struct studio {
    const discharge_study *study;
    const hopper *hopper;
    const bed *bed;
    render_canvas *canvas;
    render_font *font;
    render_rgb colour[SPHERES]; /* by id */
    bool bad;
} studio;

static void check(studio *o, render_status status, const char *what) {
    if (status == RENDER_OK) return;
    fprintf(stderr, "hopper-discharge: %s: %s\n", what, render_error_text());
    o->bad = true;
}

/* ---- one frame ------------------------------------------------------------------------------- */

typedef struct shown {
    size_t count;
    double x[SPHERES], y[SPHERES], z[SPHERES], radius[SPHERES];
    render_rgb colour[SPHERES];
} shown;

static bool in_picture(const clast_bodies *b, size_t i) {
    return fabs(b->x[i]) < 1 && b->z[i] < 2; /* and is a number */
}

static void show(const studio *o, clast_world *w, shown *s) {
    clast_bodies b = clast_world_bodies(w);
    s->count = 0;
    for (size_t i = 0; i < b.count; i++) {
        if (!in_picture(&b, i)) continue;
        size_t k = s->count++;
        s->x[k] = b.x[i], s->y[k] = 0, s->z[k] = b.z[i];
        s->radius[k] = sphere_radius(o->bed->size[b.id[i]]);
        s->colour[k] = o->colour[b.id[i]];
    }
}

/* Walls as lines in front, up to the height of the box. */
static size_t wall_lines(const hopper *h, double top, double from[3 * HOPPER_WALLS],
                         double to[3 * HOPPER_WALLS]) {
    hopper_wall wall[HOPPER_WALLS];
    hopper_walls(h, wall);
    for (int k = 0; k < HOPPER_WALLS; k++) {
        const hopper_wall *l = &wall[k];
        double end = k < 2 ? h->funnel : top, out = (end - l->pz) * -l->nz / l->nx;
        const double a[3] = {l->px, -0.01, l->pz}, b[3] = {l->px + out, -0.01, end};
        for (int i = 0; i < 3; i++) from[3 * k + i] = a[i], to[3 * k + i] = b[i];
    }
    return HOPPER_WALLS;
}

static render_overlay labels(const char *title, double time, const render_camera *camera) {
    render_overlay o = {.time_shown = true, .time_s = time, .time_decimals = 2, .legend_count = 1};
    o.scale_px_per_m = camera ? render_camera_scale(camera, HEIGHT) : 100;
    o.scale_m = 0.1;
    snprintf(o.title, sizeof o.title, "%s", title);
    snprintf(o.legend[0].label, sizeof o.legend[0].label, "tracers");
    o.legend[0].colour = TRACER;
    return o;
}

static void aim(studio *o, render_camera *camera) {
    const hopper *h = o->hopper;
    double side = 0.5 * h->orifice + h->slope * h->funnel;
    const double low[3] = {-side - 0.05, -0.02, -0.06}, high[3] = {side + 0.05, 0.02, 0.62};
    render_view view = render_view_default();
    render_overlay all = labels("title", 0, NULL);
    check(o, render_overlay_margins(o->font, &all, WIDTH, HEIGHT, &view.margins), "margins");
    check(o, render_camera_fit(camera, &view, low, high, WIDTH, HEIGHT), "camera");
}

static void draw(studio *o, clast_world *w, const char *title, const char *name) {
    static shown s;
    const render_rgb INK[HOPPER_WALLS] = {WALL, WALL, WALL, WALL};
    static const double THICK[HOPPER_WALLS] = {3, 3, 3, 3};
    double from[3 * HOPPER_WALLS], to[3 * HOPPER_WALLS];
    show(o, w, &s);
    render_lines lines = {.count = wall_lines(o->hopper, 0.62, from, to),
                          .from = from,
                          .to = to,
                          .width = THICK,
                          .colour = INK,
                          .on_top = true};
    render_scene scene = {.spheres = {.count = s.count,
                                      .x = s.x,
                                      .y = s.y,
                                      .z = s.z,
                                      .radius = s.radius,
                                      .colour = s.colour},
                          .lines_count = 1,
                          .lines = &lines};
    render_camera camera;
    render_image image = {0};
    char path[700];
    aim(o, &camera);
    if (!o->bad) check(o, render_canvas_draw(o->canvas, &scene, &camera, &image), "frame");
    render_overlay overlay = labels(title, clast_world_time(w), &camera);
    if (!o->bad) check(o, render_overlay_draw(o->font, &overlay, &image), "labels");
    snprintf(path, sizeof path, "%s/frames/%s.png", o->study->root, name);
    if (!o->bad) check(o, render_png_write(path, &image, NULL, 0), path);
    render_image_free(&image);
}

/* ---- which frames ---------------------------------------------------------------------------- */

static void frames_of_discharge(studio *o) {
    static const double TIME[3] = {0, 0.25, 0.5};
    static const char *const NAME[3] = {"start", "early", "late"};
    const world_plan plan = {.scheme = METHOD_SCHEME[EXPLICIT], .step = FINE};
    clast_world *w = world_open(o->hopper, o->bed, &plan);
    for (int i = 0; i < 3; i++) {
        clast_world_run(w, TIME[i]);
        draw(o, w, "position Verlet, 0.1 ms", NAME[i]);
    }
    clast_world_free(w);
}

static int spheres_through(studio *o, clast_world *w) {
    hopper_wall wall[HOPPER_WALLS];
    hopper_walls(o->hopper, wall);
    clast_bodies b = clast_world_bodies(w);
    int through = 0;
    for (size_t i = 0; i < b.count; i++) {
        double radius = sphere_radius(o->bed->size[b.id[i]]);
        bool above = !(b.z[i] < 0);
        through += above && !(wall_overlap(wall, b.x[i], b.z[i], radius) < OVERLAP_LIMIT);
    }
    return through;
}

static const char *title_of(int method, double step, char text[80]) {
    snprintf(text, 80, "%s, %.3g ms", method == EXPLICIT ? "position Verlet" : "Numerov",
             1e3 * step);
    return text;
}

/* At a step between those at which the two stop: the explicit run when several spheres are through
 * a wall, or when it stops, and the implicit one at the same instant. Nothing where one of the
 * steps is not known. */
static void frames_of_failure(studio *o) {
    double step = 0.5 * (limit_at(o->study, EXPLICIT, 0, BY_STOP).mean +
                         limit_at(o->study, IMPLICIT, 0, BY_STOP).mean);
    if (!(step > 0)) return;
    char title[80];
    world_plan plan = {.scheme = METHOD_SCHEME[EXPLICIT], .step = step};
    clast_world *w = world_open(o->hopper, o->bed, &plan);
    while (clast_world_time(w) < RESIDENCE_LATEST && spheres_through(o, w) < THROUGH)
        if (clast_world_step(w)) break;
    double time = clast_world_time(w);
    draw(o, w, title_of(EXPLICIT, step, title), "too-large-explicit");
    clast_world_free(w);
    plan.scheme = METHOD_SCHEME[IMPLICIT];
    w = world_open(o->hopper, o->bed, &plan);
    clast_world_run(w, time);
    draw(o, w, title_of(IMPLICIT, step, title), "too-large-implicit");
    clast_world_free(w);
}

static void paint(studio *o) {
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < o->bed->count; i++)
        low = fmin(low, o->bed->z[i]), high = fmax(high, o->bed->z[i]);
    render_colour_stripes(o->bed->z, (size_t)o->bed->count, low, high, STRIPES, o->colour);
    for (int i = 0; i < o->bed->count; i++)
        if (o->bed->tracer[i]) o->colour[i] = TRACER;
}

int discharge_pictures(const discharge_study *s) {
    static studio o;
    o = (studio){.study = s, .hopper = &s->variant[0].hopper, .bed = study_bed(s, 0, 0)};
    char folder[600];
    snprintf(folder, sizeof folder, "%s/frames", s->root);
    output_folder(folder);
    render_canvas_def def = render_canvas_default(RENDER_FINAL);
    def.width = WIDTH, def.height = HEIGHT;
    check(&o, render_canvas_new(&def, &o.canvas), "canvas");
    if (!o.bad) check(&o, render_font_open(NULL, &o.font), "font");
    if (!o.bad) {
        paint(&o);
        frames_of_discharge(&o);
        frames_of_failure(&o);
    }
    render_font_close(o.font);
    render_canvas_free(o.canvas);
    return o.bad ? 4 : 0;
}
