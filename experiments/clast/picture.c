#include "experiments/clast/picture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/clast/arrows.h"
#include "experiments/clast/stage_walls.h"

enum { STRIPES = 8, MARK = 48 };

struct painter {
    results *results;
    picture_options options;
    const stage *stage;
    render_canvas *canvas;
    render_camera camera;
    render_image image;
    wall_surfaces walls;
    double low[3], high[3];
    double *height_of_id; /* m, in the first frame; not a number where there was no such body */
    uint32_t ids;
    double height_low, height_high;
    double *x, *y, *z; /* of the current frame */
    int32_t *body;
    render_rgb *colour, *body_colour;
    size_t spheres, bodies; /* room */
};

static bool fail(const char *what) {
    fprintf(stderr, "clast render: %s: %s\n", what, render_error_text());
    return false;
}

/* ---- setting up ------------------------------------------------------------------------------ */

static void choose_box(painter *p) {
    const view *v = &p->stage->view;
    const stage *s = p->stage;
    bool given = v->box_min.x < v->box_max.x && v->box_min.z < v->box_max.z;
    clast_vec3 low = given ? v->box_min : s->domain_min, high = given ? v->box_max : s->domain_max;
    const double a[3] = {low.x, low.y, low.z}, b[3] = {high.x, high.y, high.z};
    memcpy(p->low, a, sizeof a);
    memcpy(p->high, b, sizeof b);
}

static bool remember_heights(painter *p) {
    frame *f = results_frame(p->results, 0);
    if (!f) {
        fprintf(stderr, "clast render: %s\n", results_error(p->results));
        return false;
    }
    p->ids = f->bodies > 0 ? f->id[f->bodies - 1] + 1 : 0;
    p->height_of_id = malloc((p->ids + 1) * sizeof *p->height_of_id);
    CLAST_ASSERT(p->height_of_id);
    for (uint32_t id = 0; id < p->ids; id++) p->height_of_id[id] = (double)NAN;
    p->height_low = HUGE_VAL, p->height_high = -HUGE_VAL;
    for (size_t i = 0; i < f->bodies; i++) {
        double z = f->position[3 * i + 2];
        p->height_of_id[f->id[i]] = z;
        p->height_low = fmin(p->height_low, z);
        p->height_high = fmax(p->height_high, z);
    }
    frame_free(f);
    return true;
}

static void label_colours(const painter *p, double fastest, render_overlay *o) {
    if (p->options.colour == COLOUR_SPEED_BANDS) render_overlay_bands(o, fastest);
    if (p->options.colour != COLOUR_SPEED) return;
    o->bar_shown = true;
    o->bar_map = p->options.map;
    o->bar_low = 0;
    o->bar_high = fastest > 0 ? fastest : 1;
    snprintf(o->bar_title, sizeof o->bar_title, "speed");
    snprintf(o->bar_unit, sizeof o->bar_unit, "m/s");
}

static render_overlay overlay_of(const painter *p, double time, double fastest) {
    render_overlay o = {.time_shown = true, .time_s = time, .time_decimals = 3};
    snprintf(o.title, sizeof o.title, "%s", p->stage->title);
    if (!p->stage->view.perspective)
        o.scale_px_per_m = render_camera_scale(&p->camera, p->options.height);
    label_colours(p, fastest, &o);
    return o;
}

/* The camera looks at the box with margins that leave room for the labels. */
static bool set_camera(painter *p) {
    const view *v = &p->stage->view;
    render_view look = render_view_default();
    double from[3] = {v->look_from.x, v->look_from.y, v->look_from.z};
    double up[3] = {v->up.x, v->up.y, v->up.z};
    if (from[0] != 0 || from[1] != 0 || from[2] != 0)
        for (int k = 0; k < 3; k++) look.direction[k] = -from[k];
    if (up[0] != 0 || up[1] != 0 || up[2] != 0) memcpy(look.up, up, sizeof up);
    if (v->perspective) look.projection = RENDER_PERSPECTIVE;
    if (v->perspective && look.angle_deg == 0) look.angle_deg = 30;
    int width = p->options.width, height = p->options.height;
    if (render_camera_fit(&p->camera, &look, p->low, p->high, width, height)) return fail("camera");
    render_font *font = NULL;
    if (render_font_open(NULL, &font)) return fail("font");
    render_overlay o = overlay_of(p, 0, 1);
    bool good = !render_overlay_margins(font, &o, width, height, &look.margins) &&
                !render_camera_fit(&p->camera, &look, p->low, p->high, width, height);
    render_font_close(font);
    return good || fail("camera");
}

static bool set_canvas(painter *p) {
    render_canvas_def def = render_canvas_default(p->options.preset);
    def.width = p->options.width;
    def.height = p->options.height;
    def.backend = p->options.backend;
    return !render_canvas_new(&def, &p->canvas) || fail("canvas");
}

painter *painter_new(results *r, const picture_options *o) {
    CLAST_ASSERT(r && o && results_frames(r) > 0);
    painter *p = calloc(1, sizeof *p);
    CLAST_ASSERT(p);
    p->results = r;
    p->options = *o;
    p->stage = results_stage(r);
    choose_box(p);
    if (remember_heights(p) && set_canvas(p) && set_camera(p)) return p;
    painter_free(p);
    return NULL;
}

void painter_free(painter *p) {
    if (!p) return;
    render_canvas_free(p->canvas);
    render_image_free(&p->image);
    wall_surfaces_free(&p->walls);
    free(p->height_of_id), free(p->x), free(p->y), free(p->z), free(p->body);
    free(p->colour), free(p->body_colour);
    free(p);
}

const char *painter_backend(const painter *p) {
    return render_canvas_backend(p->canvas);
}

/* ---- a frame --------------------------------------------------------------------------------- */

static void *grown(void *old, size_t count, size_t size) {
    void *p = realloc(old, (count + 1) * size);
    CLAST_ASSERT(p);
    return p;
}

static void make_room(painter *p, const frame *f) {
    if (f->spheres > p->spheres || !p->x) {
        p->spheres = f->spheres;
        p->x = grown(p->x, p->spheres, sizeof *p->x);
        p->y = grown(p->y, p->spheres, sizeof *p->y);
        p->z = grown(p->z, p->spheres, sizeof *p->z);
        p->body = grown(p->body, p->spheres, sizeof *p->body);
        p->colour = grown(p->colour, p->spheres, sizeof *p->colour);
    }
    if (f->bodies > p->bodies || !p->body_colour) {
        p->bodies = f->bodies;
        p->body_colour = grown(p->body_colour, p->bodies, sizeof *p->body_colour);
    }
}

/* Fills one value per body; returns the fastest. */
static double speeds(const frame *f, double *speed) {
    double fastest = 0;
    for (size_t i = 0; i < f->bodies; i++) {
        const double *v = &f->velocity[3 * i];
        speed[i] = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        fastest = fmax(fastest, speed[i]);
    }
    return fastest;
}

static void colour_by_height(painter *p, const frame *f, double *value) {
    for (size_t i = 0; i < f->bodies; i++)
        value[i] = f->id[i] < p->ids ? p->height_of_id[f->id[i]] : (double)NAN;
    render_colour_stripes(value, f->bodies, p->height_low, p->height_high, STRIPES, p->body_colour);
}

/* Bodies to be followed by eye: as black as still shows where one ends and the next begins. */
static void colour_marked(painter *p, const frame *f) {
    for (int k = 0; k < p->options.marked_count; k++)
        for (size_t i = 0; i < f->bodies; i++)
            if (f->id[i] == p->options.marked[k])
                p->body_colour[i] = (render_rgb){MARK, MARK, MARK};
}

/* Colours the bodies; returns the top of the speed scale. */
static double colour_bodies(painter *p, const frame *f) {
    double *value = grown(NULL, f->bodies, sizeof *value);
    int32_t *id = grown(NULL, f->bodies, sizeof *id);
    double fastest = speeds(f, value);
    if (p->options.speed_max > 0) fastest = p->options.speed_max;
    for (size_t i = 0; i < f->bodies; i++) id[i] = (int32_t)f->id[i];
    switch (p->options.colour) {
    case COLOUR_SPEED:
        render_colour_map(p->options.map, value, f->bodies, 0, fastest, p->body_colour);
        break;
    case COLOUR_SPEED_BANDS:
        render_colour_bands(value, f->bodies, fastest, p->body_colour);
        break;
    case COLOUR_INITIAL_HEIGHT:
        colour_by_height(p, f, value);
        break;
    case COLOUR_PROCESS:
        for (size_t i = 0; i < f->bodies; i++) id[i] = f->rank ? f->rank[i] : 0;
        render_colour_bodies(id, f->bodies, p->body_colour);
        break;
    case COLOUR_BODY:
        render_colour_bodies(id, f->bodies, p->body_colour);
        break;
    }
    colour_marked(p, f);
    free(value), free(id);
    return fastest;
}

/* Spheres stand in the order of bodies, so places follow ids by walking along. */
static void place_spheres(painter *p, const frame *f) {
    size_t place = 0;
    for (size_t i = 0; i < f->spheres; i++) {
        while (place < f->bodies && f->id[place] != f->sphere_body[i]) place++;
        CLAST_ASSERT(place < f->bodies);
        p->x[i] = f->centre[3 * i], p->y[i] = f->centre[3 * i + 1], p->z[i] = f->centre[3 * i + 2];
        p->body[i] = (int32_t)place;
    }
    render_colour_spread(p->body_colour, f->bodies, p->body, f->spheres, p->colour);
}

static bool draw(painter *p, const frame *f, render_encoder *encoder) {
    make_room(p, f);
    double fastest = colour_bodies(p, f);
    place_spheres(p, f);
    p->walls.count = 0;
    if (p->stage->view.walls) wall_surfaces_at(&p->walls, p->stage, f, p->low, p->high);
    render_scene scene_now = {.spheres = {.count = f->spheres,
                                          .x = p->x,
                                          .y = p->y,
                                          .z = p->z,
                                          .radius = f->radius,
                                          .body = p->body,
                                          .colour = p->colour},
                              .walls_count = p->walls.count,
                              .walls = p->walls.walls};
    arrows forces = {0};
    if (p->options.forces) arrows_make(&forces, f, &p->camera, p->options.map);
    if (forces.lines.count > 0) scene_now.lines_count = 1, scene_now.lines = &forces.lines;
    bool drawn = !render_canvas_draw(p->canvas, &scene_now, &p->camera, &p->image);
    arrows_free(&forces);
    if (!drawn) return fail("frame");
    render_overlay o = overlay_of(p, f->time, fastest);
    return !render_encoder_push(encoder, &p->image, &o, NULL, 0) || fail("picture");
}

bool painter_draw(painter *p, size_t i, render_encoder *encoder) {
    CLAST_ASSERT(p && encoder);
    frame *f = results_frame(p->results, i);
    if (!f) {
        fprintf(stderr, "clast render: %s\n", results_error(p->results));
        return false;
    }
    bool good = draw(p, f, encoder);
    frame_free(f);
    return good;
}
