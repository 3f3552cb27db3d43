#include "experiments/clast/mesh_picture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "render/render.h"

/* What is drawn, in the arrays that render/ takes. */
typedef struct sheet {
    const mesh_picture *picture;
    render_walls walls;
    render_lines loose;
    render_camera camera;
    render_overlay overlay;
} sheet;

static bool fail(const char *path) {
    fprintf(stderr, "clast mesh: %s: %s\n", path, render_error_text());
    return false;
}

static void *room(size_t count, size_t size) {
    void *p = calloc(count + 1, size);
    CLAST_ASSERT(p);
    return p;
}

static render_walls walls_of(const mesh_surface *s) {
    uint32_t *index = room(3 * s->triangle_count, sizeof *index);
    for (size_t i = 0; i < 3 * s->triangle_count; i++) index[i] = (uint32_t)s->triangle[i];
    return (render_walls){.vertex_count = s->vertex_count,
                          .vertex = s->vertex,
                          .face_count = s->triangle_count,
                          .corners = 3,
                          .index = index,
                          .colour = {168, 178, 190},
                          .opacity = 1,
                          .edge_px = 1.3,
                          .edge_colour = {48, 54, 64}};
}

static bool loose_edges(const mesh_surface *s, render_lines *lines) {
    int32_t *ends;
    size_t count;
    if (mesh_loose_edges(s, &ends, &count) != MESH_OK) return false;
    double *from = room(3 * count, sizeof *from), *to = room(3 * count, sizeof *to);
    double *width = room(count, sizeof *width);
    render_rgb *colour = room(count, sizeof *colour);
    for (size_t i = 0; i < count; i++) {
        memcpy(from + 3 * i, s->vertex + 3 * (size_t)ends[2 * i], 3 * sizeof *from);
        memcpy(to + 3 * i, s->vertex + 3 * (size_t)ends[2 * i + 1], 3 * sizeof *to);
        width[i] = 2.2;
        colour[i] = (render_rgb){205, 40, 30};
    }
    free(ends);
    *lines = (render_lines){
        .count = count, .from = from, .to = to, .width = width, .colour = colour, .on_top = true};
    return true;
}

/* Millimetres below a metre. */
static void write_size(const mesh_report *r, char text[RENDER_TEXT_MAX]) {
    double size[3], most = 0;
    for (int k = 0; k < 3; k++) size[k] = r->high[k] - r->low[k], most = fmax(most, size[k]);
    double unit = most < 1.5 ? 1e3 : 1;
    snprintf(text, RENDER_TEXT_MAX, "%.4g x %.4g x %.4g %s, %zu triangles, %s", unit * size[0],
             unit * size[1], unit * size[2], unit > 1 ? "mm" : "m",
             r->triangles_read - r->collapsed.count - r->slivers.count - r->duplicates.count,
             r->closed ? "closed" : "not closed");
}

static void write_labels(sheet *s, const mesh_report *r) {
    render_overlay *o = &s->overlay;
    const char *slash = strrchr(s->picture->title, '/');
    snprintf(o->title, sizeof o->title, "%s", slash ? slash + 1 : s->picture->title);
    o->text_px = fmax(12, s->picture->height / 40.0);
    render_note *size = &o->notes[o->notes_count++];
    size->x = 1.1 * o->text_px, size->y = 3 * o->text_px;
    write_size(r, size->text);
    if (s->loose.count == 0) return;
    o->legend_count = 1;
    o->legend[0].colour = (render_rgb){205, 40, 30};
    snprintf(o->legend[0].label, RENDER_TEXT_MAX, "%zu loose edges", s->loose.count);
}

static bool set_camera(sheet *s, const mesh_report *r, render_font *font) {
    const mesh_picture *p = s->picture;
    render_view view = render_view_default();
    for (int k = 0; k < 3; k++) view.direction[k] = -p->from[k];
    if (p->from[0] == 0 && p->from[1] == 0) memcpy(view.up, (double[3]){0, 1, 0}, sizeof view.up);
    s->overlay.scale_px_per_m = 1; /* so that the margins have room for a scale bar */
    if (render_overlay_margins(font, &s->overlay, p->width, p->height, &view.margins)) return false;
    view.margins.top += 2 * s->overlay.text_px;
    if (render_camera_fit(&s->camera, &view, r->low, r->high, p->width, p->height)) return false;
    s->overlay.scale_px_per_m = render_camera_scale(&s->camera, p->height);
    return true;
}

static bool paint(sheet *s, render_font *font, render_image *image) {
    render_canvas_def def = render_canvas_default(RENDER_FINAL);
    def.width = s->picture->width, def.height = s->picture->height;
    render_scene scene = {
        .walls_count = 1, .walls = &s->walls, .lines_count = 1, .lines = &s->loose};
    render_canvas *canvas = NULL;
    bool good = !render_canvas_new(&def, &canvas) &&
                !render_canvas_draw(canvas, &scene, &s->camera, image) &&
                !render_overlay_draw(font, &s->overlay, image);
    render_canvas_free(canvas);
    return good;
}

bool mesh_draw(const mesh_picture *p, const mesh_surface *surface, const mesh_report *report,
               const char *path) {
    CLAST_ASSERT(p && surface && report && path);
    sheet s = {.picture = p, .walls = walls_of(surface)};
    render_font *font = NULL;
    render_image image = {0};
    bool good = loose_edges(surface, &s.loose);
    if (!good) fprintf(stderr, "clast mesh: %s\n", mesh_error_text());
    if (good) {
        write_labels(&s, report);
        good = !render_font_open(NULL, &font) && set_camera(&s, report, font) &&
               paint(&s, font, &image) && !render_png_write(path, &image, NULL, 0);
        if (!good) fail(path);
    }
    render_font_close(font);
    render_image_free(&image);
    free((void *)(uintptr_t)s.walls.index);
    free((void *)(uintptr_t)s.loose.from), free((void *)(uintptr_t)s.loose.to);
    free((void *)(uintptr_t)s.loose.width), free((void *)(uintptr_t)s.loose.colour);
    return good;
}
