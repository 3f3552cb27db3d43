/* shape_picture.c - a target and its clumps side by side. */
#include "experiments/clast/shape_level.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "render/render.h"

enum { PANELS_MAX = 5 }; /* the target and four levels: what a picture has room for */

typedef struct sheet_picture {
    const shape_sheet *sheet;
    int panels, width, height;
    double pitch, right[3]; /* m between panels, and in which direction */
    render_camera camera;
    double *x, *y, *z, *radius;
    int32_t *body;
    render_rgb *colour;
    size_t spheres;
    double *vertex[PANELS_MAX];
    uint32_t *index;
    render_walls walls[PANELS_MAX];
} sheet_picture;

static bool fail(const char *path) {
    fprintf(stderr, "clast shape: %s: %s\n", path, render_error_text());
    return false;
}

static void *array(size_t count, size_t size) {
    void *p = calloc(count + 1, size);
    CLAST_ASSERT(p);
    return p;
}

static double text_size(const sheet_picture *p) {
    return fmax(13, p->height / 26.0);
}

/* Where panel `i` stands. */
static shape_vec place(const sheet_picture *p, int i) {
    double d = i * p->pitch;
    return sv(d * p->right[0], d * p->right[1], d * p->right[2]);
}

/* How far the target reaches along a direction, and where its middle is. */
static double extent(const shape_mesh *mesh, const double way[3], double *middle) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        shape_vec v = mesh->vertex[i];
        double at = v.x * way[0] + v.y * way[1] + v.z * way[2];
        low = fmin(low, at), high = fmax(high, at);
    }
    *middle = 0.5 * (low + high);
    return high - low;
}

/* Looks down on the target from the front; the picture is as wide as the panels need, and a panel
 * as wide as its labels. */
static void choose_view(sheet_picture *p, bool bare) {
    const double look[3] = {0.45, 0.8, -0.42}, flat = sqrt(0.45 * 0.45 + 0.8 * 0.8);
    const double length = sqrt(flat * flat + 0.42 * 0.42);
    const double right[3] = {look[1] / flat, -look[0] / flat, 0};
    const double up[3] = {0.42 * look[0] / (flat * length), 0.42 * look[1] / (flat * length),
                          flat / length};
    const shape_mesh *mesh = &p->sheet->target->surface;
    double edge = p->height / 40.0, x, y;
    double wide = extent(mesh, right, &x), high = extent(mesh, up, &y);
    double top = bare ? edge : 4 * edge, bottom = bare ? edge : 6.5 * edge, most = 480;
    double scale = fmin((p->height - top - bottom) / high, most / (1.1 * wide)); /* px per m */
    double panel = fmax(1.1 * wide * scale, bare ? 1.2 * p->height : 13.5 * text_size(p));
    p->pitch = panel / scale;
    p->width = (int)(p->panels * panel + 2 * edge + 0.5);
    p->camera = (render_camera){.projection = RENDER_ORTHOGRAPHIC,
                                .up = {0, 0, 1},
                                .height_m = p->height / scale,
                                .shift_y = 0.5 * (bottom - top) / p->height};
    for (int k = 0; k < 3; k++) {
        p->right[k] = right[k];
        p->camera.target[k] = (x + 0.5 * (p->panels - 1) * p->pitch) * right[k] + y * up[k];
        p->camera.eye[k] = p->camera.target[k] - 10 * p->sheet->target->size * look[k];
    }
}

/* Colour tells the radius: bright is large. */
static void gather_spheres(sheet_picture *p) {
    const shape_sheet *s = p->sheet;
    size_t room = 0;
    for (int i = 0; i < s->count; i++) room += (size_t)s->levels[i].clump.count;
    p->x = array(room, sizeof *p->x), p->y = array(room, sizeof *p->y);
    p->z = array(room, sizeof *p->z), p->radius = array(room, sizeof *p->radius);
    p->body = array(room, sizeof *p->body), p->colour = array(room, sizeof *p->colour);
    double largest = 0;
    for (int i = 0; i + 1 < p->panels; i++)
        for (int k = 0; k < s->levels[i].clump.count; k++) {
            shape_sphere one = s->levels[i].placed[k];
            shape_vec at = sv_add(one.centre, place(p, i + 1));
            size_t n = p->spheres++;
            p->x[n] = at.x, p->y[n] = at.y, p->z[n] = at.z, p->radius[n] = one.radius;
            p->body[n] = (int32_t)n;
            largest = fmax(largest, one.radius);
        }
    render_colour_map(RENDER_VIRIDIS, p->radius, p->spheres, -0.35 * largest, 1.1 * largest,
                      p->colour);
}

static void gather_targets(sheet_picture *p) {
    const shape_mesh *mesh = &p->sheet->target->surface;
    p->index = array(3 * mesh->triangle_count, sizeof *p->index);
    for (size_t i = 0; i < 3 * mesh->triangle_count; i++) p->index[i] = (uint32_t)mesh->triangle[i];
    for (int panel = 0; panel < p->panels; panel++) {
        double *to = p->vertex[panel] = array(3 * mesh->vertex_count, sizeof *to);
        for (size_t i = 0; i < mesh->vertex_count; i++) {
            shape_vec at = sv_add(mesh->vertex[i], place(p, panel));
            to[3 * i] = at.x, to[3 * i + 1] = at.y, to[3 * i + 2] = at.z;
        }
        p->walls[panel] = (render_walls){.vertex_count = mesh->vertex_count,
                                         .vertex = to,
                                         .face_count = mesh->triangle_count,
                                         .corners = 3,
                                         .index = p->index,
                                         .colour = {150, 165, 185},
                                         .opacity = panel == 0 ? 1 : 0.16,
                                         .edge_px = 1.2,
                                         .edge_colour = {60, 68, 78}};
    }
}

static void add_note(render_overlay *o, double middle, double y, double text_px, const char *text) {
    render_note *note = &o->notes[o->notes_count++];
    note->x = middle - 0.28 * text_px * (double)strlen(text);
    note->y = y;
    snprintf(note->text, sizeof note->text, "%s", text);
}

static void add_notes(const sheet_picture *p, render_overlay *o) {
    char text[RENDER_TEXT_MAX];
    for (int i = 0; i + 1 < p->panels; i++) {
        const shape_level *l = &p->sheet->levels[i];
        shape_vec at = place(p, i + 1);
        double pixel[2], depth, point[3] = {at.x, at.y, at.z};
        shape_vec c = p->sheet->target->mass.centre;
        point[0] += c.x, point[1] += c.y, point[2] += c.z;
        if (!render_camera_project(&p->camera, p->width, p->height, point, pixel, &depth)) continue;
        snprintf(text, sizeof text, "%d spheres, density %.2f", l->clump.count, l->filling.density);
        add_note(o, pixel[0], p->height - 2.6 * o->text_px, o->text_px, text);
        snprintf(text, sizeof text, "off %.2g mm, cost %.3g", 1e3 * l->quality.deviation_mean,
                 l->quality.cost);
        add_note(o, pixel[0], p->height - 1.2 * o->text_px, o->text_px, text);
    }
}

static bool label(const sheet_picture *p, render_image *image) {
    render_overlay o = {.text_px = text_size(p)};
    snprintf(o.title, sizeof o.title, "%s", p->sheet->title);
    add_notes(p, &o);
    render_font *font = NULL;
    if (render_font_open(NULL, &font)) return false;
    bool good = !render_overlay_draw(font, &o, image);
    render_font_close(font);
    return good;
}

static bool draw(sheet_picture *p, const char *path, bool bare) {
    render_scene scene = {.spheres = {.count = p->spheres,
                                      .x = p->x,
                                      .y = p->y,
                                      .z = p->z,
                                      .radius = p->radius,
                                      .body = p->body,
                                      .colour = p->colour},
                          .walls_count = (size_t)p->panels,
                          .walls = p->walls};
    render_canvas *canvas = NULL;
    render_image image = {0};
    render_canvas_def def = render_canvas_default(RENDER_FINAL);
    def.width = p->width, def.height = p->height;
    bool good = !render_canvas_new(&def, &canvas) &&
                !render_canvas_draw(canvas, &scene, &p->camera, &image) &&
                (bare || label(p, &image)) && !render_png_write(path, &image, NULL, 0);
    if (!good) fail(path);
    render_image_free(&image);
    render_canvas_free(canvas);
    return good;
}

bool shape_draw(const shape_sheet *sheet, const char *path, int height, bool bare) {
    CLAST_ASSERT(sheet && path && sheet->count > 0 && height >= 16);
    sheet_picture p = {.sheet = sheet, .height = height};
    p.panels = sheet->count + 1 < PANELS_MAX ? sheet->count + 1 : PANELS_MAX;
    choose_view(&p, bare);
    gather_spheres(&p);
    gather_targets(&p);
    bool good = draw(&p, path, bare);
    free(p.x), free(p.y), free(p.z), free(p.radius), free(p.body), free(p.colour), free(p.index);
    for (int i = 0; i < p.panels; i++) free(p.vertex[i]);
    return good;
}
