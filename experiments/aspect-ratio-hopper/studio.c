#include "experiments/aspect-ratio-hopper/studio.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/aspect-ratio-hopper/aspect.h"
#include "experiments/study/output.h"
#include "render/render.h"

enum { TOP = 84, BOTTOM = 64, GAP = 16, RIGHT = 170, HOPPER_LINES = 5 };

static const render_rgb STONE = {222, 222, 226}, CHAIN = {178, 24, 43};

struct studio {
    sheet sheet;
    int width, height, panel_height; /* px */
    render_canvas *canvas;           /* of one panel */
    render_camera camera;
    render_font *font;
    render_image panel, page;
    render_encoder *encoder;
    char folder[800];
};

static int check(render_status status, const char *what) {
    if (status == RENDER_OK) return 0;
    fprintf(stderr, "aspect-ratio-hopper: %s: %s\n", what, render_error_text());
    return 4;
}

static int aim(studio *o) {
    const sheet *s = &o->sheet;
    double w = 2 * s->half_width, edge = 1.02 * s->half_width;
    const double low[3] = {-edge, -0.02, s->low * w}, high[3] = {edge, 0.02, s->high * w};
    render_view look = render_view_default();
    look.margins = (render_margins){2, 2, 2, 2};
    return check(render_camera_fit(&o->camera, &look, low, high, s->panel_px, o->panel_height),
                 "camera");
}

studio *studio_new(const sheet *s) {
    CLAST_ASSERT(s && s->panels >= 1 && s->panels <= PANELS_MAX && s->high > s->low);
    studio *o = calloc(1, sizeof *o);
    CLAST_ASSERT(o);
    o->sheet = *s;
    o->panel_height = (int)(s->panel_px / 1.02 * (s->high - s->low));
    o->panel_height += o->panel_height % 2;
    o->width = s->panels * (s->panel_px + GAP) + GAP + RIGHT;
    o->width += o->width % 2; /* films have whole pairs of pixels */
    o->height = TOP + o->panel_height + BOTTOM;
    render_canvas_def def = render_canvas_default(RENDER_FINAL);
    def.width = s->panel_px, def.height = o->panel_height;
    int bad = check(render_canvas_new(&def, &o->canvas), "canvas");
    if (!bad) bad = check(render_font_open(NULL, &o->font), "font");
    if (!bad) bad = aim(o);
    if (!bad) return o;
    studio_free(o);
    return NULL;
}

void studio_free(studio *o) {
    if (!o) return;
    render_image_free(&o->panel), render_image_free(&o->page);
    render_font_close(o->font);
    render_canvas_free(o->canvas);
    free(o);
}

/* ---- one panel ------------------------------------------------------------------------------- */

typedef struct shown {
    double *x, *y, *z, *speed;
    int32_t *body;
    render_rgb *of_body, *colour;
} shown;

static void *room(size_t count, size_t size) {
    void *p = calloc(count + 1, size);
    CLAST_ASSERT(p);
    return p;
}

static double fastest_above(const frame *f, const double *speed) {
    double most = 0;
    for (size_t i = 0; i < f->bodies; i++)
        if (f->position[3 * i + 2] > 0) most = fmax(most, speed[i]);
    return most;
}

/* Directions of an axis come round after half a turn. */
static const render_rgb AXIS[4] = {{68, 119, 170}, {90, 170, 100}, {232, 176, 60}, {190, 75, 110}};
static const char *const AXIS_NAME[4] = {"0°", "45°", "90°", "135°"};

static uint8_t mix(uint8_t a, uint8_t b, double t) {
    return (uint8_t)lround(a + t * (b - a));
}

static render_rgb axis_colour(double angle) {
    double turn = angle / 3.14159265358979 - floor(angle / 3.14159265358979);
    double at = 4 * turn;
    int k = (int)at % 4;
    const render_rgb *a = &AXIS[k], *b = &AXIS[(k + 1) % 4];
    double t = at - floor(at);
    return (render_rgb){mix(a->r, b->r, t), mix(a->g, b->g, t), mix(a->b, b->b, t)};
}

static void colour_bodies(const studio *o, const frame *f, shown *s) {
    switch (o->sheet.colour) {
    case SHEET_SPEED:
        render_colour_map(RENDER_VIRIDIS, s->speed, f->bodies, 0, o->sheet.fastest, s->of_body);
        break;
    case SHEET_BANDS:
        render_colour_bands(s->speed, f->bodies, fastest_above(f, s->speed), s->of_body);
        break;
    case SHEET_FORCES:
        for (size_t i = 0; i < f->bodies; i++) s->of_body[i] = STONE;
        break;
    case SHEET_AXIS:
        for (size_t i = 0; i < f->bodies; i++)
            s->of_body[i] =
                f->spheres > f->bodies ? axis_colour(body_angle(&f->orientation[4 * i])) : STONE;
        break;
    }
}

/* Spheres stand in the order of bodies, so places follow ids by walking along. */
static shown shown_of(const studio *o, const frame *f) {
    shown s = {.x = room(f->spheres, sizeof *s.x),
               .y = room(f->spheres, sizeof *s.y),
               .z = room(f->spheres, sizeof *s.z),
               .speed = room(f->bodies, sizeof *s.speed),
               .body = room(f->spheres, sizeof *s.body),
               .of_body = room(f->bodies, sizeof *s.of_body),
               .colour = room(f->spheres, sizeof *s.colour)};
    size_t place = 0;
    for (size_t i = 0; i < f->bodies; i++) {
        const double *v = &f->velocity[3 * i];
        s.speed[i] = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
    for (size_t i = 0; i < f->spheres; i++) {
        while (f->id[place] != f->sphere_body[i]) place++;
        s.x[i] = f->centre[3 * i], s.y[i] = f->centre[3 * i + 1], s.z[i] = f->centre[3 * i + 2];
        s.body[i] = (int32_t)place;
    }
    colour_bodies(o, f, &s);
    render_colour_spread(s.of_body, f->bodies, s.body, f->spheres, s.colour);
    return s;
}

static void shown_free(shown *s) {
    free(s->x), free(s->y), free(s->z), free(s->speed);
    free(s->body), free(s->of_body), free(s->colour);
}

/* Sides, the two parts of the bottom, the ground of the chamber. */
static render_lines hopper_lines(const studio *o, double from[3 * HOPPER_LINES],
                                 double to[3 * HOPPER_LINES]) {
    const double h = o->sheet.half_width, low = -4 * h, high = 6.5 * h, slot = ORIFICE * h;
    const double ground = o->sheet.closed ? 0 : low;
    const double at[HOPPER_LINES][4] = {{-h, low, -h, high},
                                        {h, low, h, high},
                                        {-h, 0, -slot, 0},
                                        {slot, 0, h, 0},
                                        {-h, ground, h, ground}};
    static const double THICK[HOPPER_LINES] = {2, 2, 4, 4, 2};
    static const render_rgb INK[HOPPER_LINES] = {
        {40, 40, 40}, {40, 40, 40}, {40, 40, 40}, {40, 40, 40}, {40, 40, 40}};
    for (int k = 0; k < HOPPER_LINES; k++)
        for (int i = 0; i < 2; i++) {
            double *end = i ? to : from;
            end[3 * k] = at[k][2 * i], end[3 * k + 1] = -0.05, end[3 * k + 2] = at[k][2 * i + 1];
        }
    return (render_lines){.count = HOPPER_LINES,
                          .from = from,
                          .to = to,
                          .width = THICK,
                          .colour = INK,
                          .on_top = true};
}

/* A radius from the contact along the force to either side: between equal spheres that is from
 * centre to centre. Of a wall only the side of the body. */
static render_lines force_lines(const frame *f) {
    size_t n = f->contacts;
    double *from = room(3 * n, sizeof *from), *to = room(3 * n, sizeof *to);
    double *width = room(n, sizeof *width), mean = 0;
    render_rgb *colour = room(n, sizeof *colour);
    for (size_t i = 0; i < n; i++) mean += f->contact_normal[i] / (double)n;
    for (size_t i = 0; i < n; i++) {
        const double *force = &f->contact_force[3 * i], *at = &f->contact_point[3 * i];
        double size = sqrt(force[0] * force[0] + force[1] * force[1] + force[2] * force[2]);
        for (int k = 0; k < 3; k++) {
            double arm = size > 0 ? f->radius[0] * force[k] / size : 0;
            from[3 * i + (size_t)k] = at[k] - (f->contact_b[i] >= CLAST_WALL_ID ? 0 : arm);
            to[3 * i + (size_t)k] = at[k] + arm;
        }
        width[i] = fmin(0.25 * f->contact_normal[i] / mean, 1.5) * f->radius[0];
        colour[i] = CHAIN;
    }
    return (render_lines){.count = n,
                          .from = from,
                          .to = to,
                          .width = width,
                          .colour = colour,
                          .unit = RENDER_METRES,
                          .on_top = true};
}

static int draw_panel(studio *o, const frame *f) {
    double from[3 * HOPPER_LINES], to[3 * HOPPER_LINES];
    render_lines lines[2] = {hopper_lines(o, from, to)};
    shown s = shown_of(o, f);
    bool forces = o->sheet.colour == SHEET_FORCES && f->contacts > 0;
    if (forces) lines[1] = force_lines(f);
    render_scene all = {.spheres = {.count = f->spheres,
                                    .x = s.x,
                                    .y = s.y,
                                    .z = s.z,
                                    .radius = f->radius,
                                    .body = s.body,
                                    .colour = s.colour},
                        .lines_count = forces ? 2 : 1,
                        .lines = lines};
    int bad = check(render_canvas_draw(o->canvas, &all, &o->camera, &o->panel), "frame");
    if (forces) {
        free((void *)lines[1].from), free((void *)lines[1].to);
        free((void *)lines[1].width), free((void *)lines[1].colour);
    }
    shown_free(&s);
    return bad;
}

static void paste(studio *o, int k) {
    int x = GAP + k * (o->sheet.panel_px + GAP);
    for (int row = 0; row < o->panel_height; row++)
        memcpy(o->page.rgb + 3 * ((size_t)(TOP + row) * (size_t)o->width + (size_t)x),
               o->panel.rgb + 3 * (size_t)row * (size_t)o->sheet.panel_px,
               3 * (size_t)o->sheet.panel_px);
}

/* ---- the sheet ------------------------------------------------------------------------------- */

static render_overlay labels(const studio *o, double time) {
    const sheet *s = &o->sheet;
    render_overlay all = {.time_shown = s->colour != SHEET_AXIS && s->colour != SHEET_FORCES,
                          .time_s = time,
                          .time_decimals = 2,
                          .text_px = 24,
                          .scale_px_per_m = render_camera_scale(&o->camera, o->panel_height),
                          .scale_m = 0.2 * 2 * s->half_width};
    if (s->colour == SHEET_SPEED) {
        all.bar_shown = true, all.bar_map = RENDER_VIRIDIS, all.bar_high = s->fastest;
        snprintf(all.bar_title, sizeof all.bar_title, "speed");
        snprintf(all.bar_unit, sizeof all.bar_unit, "m/s");
    } else if (s->colour == SHEET_AXIS) {
        all.legend_count = 4;
        snprintf(all.legend_title, sizeof all.legend_title, "direction");
        for (int k = 0; k < 4; k++) {
            all.legend[k].colour = AXIS[k];
            snprintf(all.legend[k].label, sizeof all.legend[k].label, "%s", AXIS_NAME[k]);
        }
    } else if (s->colour == SHEET_BANDS) {
        static const char *const BANDS[3] = {"> 70 %", "30–70 %", "< 30 %"};
        all.legend_count = 3;
        snprintf(all.legend_title, sizeof all.legend_title, "of fastest");
        for (int k = 0; k < 3; k++) {
            all.legend[k].colour = RENDER_BAND_TINT[2 - k];
            snprintf(all.legend[k].label, sizeof all.legend[k].label, "%s", BANDS[k]);
        }
    }
    for (int k = 0; k < s->panels; k++) {
        render_note *note = &all.notes[all.notes_count++];
        note->x = GAP + k * (s->panel_px + GAP) + 6, note->y = TOP - 12;
        snprintf(note->text, sizeof note->text, "aspect %s", s->titles[k]);
    }
    return all;
}

static int compose(studio *o, const frame *const *frames, double *time) {
    int bad = check(render_image_resize(&o->page, o->width, o->height), "page");
    if (bad) return bad;
    memset(o->page.rgb, 255, 3 * (size_t)o->width * (size_t)o->height);
    for (int k = 0; k < o->sheet.panels && !bad; k++) {
        if (!frames[k]) continue;
        *time = frames[k]->time;
        bad = draw_panel(o, frames[k]);
        if (!bad) paste(o, k);
    }
    return bad;
}

int studio_still(studio *o, const frame *const *frames, const char *path) {
    CLAST_ASSERT(o && frames && path);
    double time = 0;
    int bad = compose(o, frames, &time);
    if (bad) return bad;
    render_overlay all = labels(o, time);
    bad = check(render_overlay_draw(o->font, &all, &o->page), "labels");
    return bad ? bad : check(render_png_write(path, &o->page, NULL, 0), path);
}

int studio_film_begin(studio *o, const char *folder) {
    CLAST_ASSERT(o && folder && !o->encoder);
    output_folder(folder);
    snprintf(o->folder, sizeof o->folder, "%s", folder);
    render_encoder_def def = render_encoder_default();
    def.folder = o->folder;
    return check(render_encoder_new(&def, &o->encoder), folder);
}

int studio_film_frame(studio *o, const frame *const *frames) {
    CLAST_ASSERT(o && o->encoder);
    double time = 0;
    int bad = compose(o, frames, &time);
    if (bad) return bad;
    render_overlay all = labels(o, time);
    return check(render_encoder_push(o->encoder, &o->page, &all, NULL, 0), "picture");
}

int studio_film_end(studio *o, const char *path) {
    CLAST_ASSERT(o && o->encoder);
    int bad = check(render_encoder_finish(o->encoder), o->folder);
    o->encoder = NULL;
    render_movie_def def = render_movie_default();
    def.folder = o->folder;
    def.path = path;
    if (bad) return bad;
    render_status status = render_movie_make(&def);
    if (status == RENDER_ERR_UNAVAILABLE) return fputs("no ffmpeg: no film\n", stderr), 0;
    return check(status, path);
}
