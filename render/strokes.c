#include "render/strokes.h"

#include "render/status.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What is sorted: a face of a wall or a segment, by depth. */
typedef struct render_item {
    double depth; /* m, of the middle */
    size_t group, index, sequence;
    int layer; /* drawn in this order: 0, 1 */
} render_item;

/* A side of a face of a wall. */
typedef struct render_edge {
    uint32_t low, high; /* vertex numbers */
    size_t face;
} render_edge;

static const double CREASE_COSINE = 0.94; /* 20 degrees */

static render_status grow(void **array, size_t *room, size_t needed, size_t element) {
    if (needed <= *room) return RENDER_OK;
    size_t wanted = needed < 2 * *room ? 2 * *room : needed;
    void *bigger = realloc(*array, wanted * element);
    if (!bigger) return render_fail(RENDER_ERR_MEMORY, "no memory for %zu walls or lines", wanted);
    *array = bigger;
    *room = wanted;
    return RENDER_OK;
}

static uint32_t pack(render_rgb c, double shade, double opacity) {
    return (uint32_t)(c.r * shade + 0.5) | (uint32_t)(c.g * shade + 0.5) << 8 |
           (uint32_t)(c.b * shade + 0.5) << 16 | (uint32_t)(255 * opacity + 0.5) << 24;
}

static int compare_items(const void *left, const void *right) {
    const render_item *a = left, *b = right;
    if (a->layer != b->layer) return a->layer < b->layer ? -1 : 1;
    if (a->depth != b->depth) return a->depth > b->depth ? -1 : 1;
    return a->sequence < b->sequence ? -1 : 1; /* as given; qsort alone is not stable */
}

static const double *wall_point(const render_walls *w, size_t face, int corner) {
    return w->vertex + 3 * (size_t)w->index[face * (size_t)w->corners + (size_t)corner];
}

/* The unit normal of a face from its diagonals, or zero. */
static void face_normal(const render_walls *w, size_t face, double normal[3]) {
    const double *p = wall_point(w, face, 0), *q = wall_point(w, face, 1);
    const double *r = wall_point(w, face, 2), *s = wall_point(w, face, w->corners - 1);
    double a[3], b[3];
    for (int k = 0; k < 3; k++) {
        a[k] = r[k] - p[k];
        b[k] = (w->corners == 4 ? s[k] : r[k]) - q[k];
    }
    if (w->corners == 3)
        for (int k = 0; k < 3; k++) b[k] = r[k] - q[k];
    normal[0] = a[1] * b[2] - a[2] * b[1];
    normal[1] = a[2] * b[0] - a[0] * b[2];
    normal[2] = a[0] * b[1] - a[1] * b[0];
    double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    for (int k = 0; k < 3; k++) normal[k] = length > 0 ? normal[k] / length : 0;
}

/* ---- Faces ---- */

static render_status list_faces(render_strokes *st, const render_scene *scene,
                                const render_lens *lens, size_t *count) {
    *count = 0;
    for (size_t g = 0; g < scene->walls_count; g++) {
        const render_walls *w = &scene->walls[g];
        if (w->opacity <= 0) continue;
        render_status status =
            grow((void **)&st->item, &st->item_room, *count + w->face_count, sizeof *st->item);
        if (status != RENDER_OK) return status;
        for (size_t f = 0; f < w->face_count; f++) {
            double depth = 0;
            for (int c = 0; c < w->corners; c++) {
                const double *p = wall_point(w, f, c);
                double view[3];
                render_lens_view(lens, p[0], p[1], p[2], view);
                depth += view[2] / w->corners;
            }
            st->item[*count] = (render_item){depth, g, f, *count, w->opacity < 1};
            ++*count;
        }
    }
    return RENDER_OK;
}

/* The same from both sides. A wall that is seen through is lit a little by how squarely it faces
 * the eye; one that hides what is behind it has the key light of the spheres (shaders.c), so that
 * its faces differ. Either has its own colour where it faces the eye. */
static double shade_of(const render_lens *lens, const double normal[3], double opacity) {
    double right = 0, up = 0, ahead = 0;
    for (int k = 0; k < 3; k++) {
        right += normal[k] * lens->right[k];
        up += normal[k] * lens->up[k];
        ahead += normal[k] * lens->ahead[k];
    }
    if (opacity < 1) return 0.8 + 0.2 * fmin(1, fabs(ahead));
    double towards = ahead > 0 ? -1 : 1;
    double key = 0.5 + 0.5 * towards * (-0.43 * right + 0.62 * up - 0.656 * ahead);
    return 0.4 + 0.6 * fmin(1, key / (0.5 + 0.5 * 0.656));
}

static void add_face(render_strokes *st, const render_walls *w, size_t face,
                     const render_lens *lens) {
    double normal[3];
    face_normal(w, face, normal);
    uint32_t rgba = pack(w->colour, shade_of(lens, normal, w->opacity), w->opacity);
    for (int triangle = 0; triangle + 2 < w->corners; triangle++)
        for (int c = 0; c < 3; c++) {
            const double *p = wall_point(w, face, c == 0 ? 0 : triangle + c);
            double view[3];
            render_lens_view(lens, p[0], p[1], p[2], view);
            st->corner[st->corners++] =
                (render_corner){{(float)view[0], (float)view[1], (float)view[2]}, rgba};
        }
}

static render_status build_faces(render_strokes *st, const render_scene *scene,
                                 const render_lens *lens) {
    size_t count = 0;
    st->corners = st->opaque_corners = 0;
    render_status status = list_faces(st, scene, lens, &count);
    if (status == RENDER_OK)
        status = grow((void **)&st->corner, &st->corner_room, 6 * count, sizeof *st->corner);
    if (status != RENDER_OK || count == 0) return status;
    qsort(st->item, count, sizeof *st->item, compare_items);
    for (size_t i = 0; i < count; i++) {
        add_face(st, &scene->walls[st->item[i].group], st->item[i].index, lens);
        if (st->item[i].layer == 0) st->opaque_corners = st->corners;
    }
    return RENDER_OK;
}

/* ---- Segments ---- */

/* Cuts off what lies behind the eye. False if nothing is left. */
static bool clip(const render_lens *lens, double a[3], double b[3]) {
    if (!lens->perspective) return true;
    double length = fabs(a[2] - b[2]), nearest = 1e-6 * length + 1e-12;
    if (a[2] < nearest && b[2] < nearest) return false;
    double *behind = a[2] < nearest ? a : b[2] < nearest ? b : NULL;
    const double *front = behind == a ? b : a;
    if (!behind) return true;
    double t = (front[2] - nearest) / (front[2] - behind[2]);
    for (int k = 0; k < 3; k++) behind[k] = front[k] + t * (behind[k] - front[k]);
    return true;
}

/* Adds one segment; its half width is in drawn pixels (RENDER_PIXELS) or metres. */
static render_status add_segment(render_strokes *st, const render_lens *lens, const double *from,
                                 const double *to, double half_width, render_width unit,
                                 uint32_t rgba) {
    double a[3], b[3];
    render_lens_view(lens, from[0], from[1], from[2], a);
    render_lens_view(lens, to[0], to[1], to[2], b);
    if (!clip(lens, a, b)) return RENDER_OK;
    render_status status =
        grow((void **)&st->segment, &st->segment_room, st->segments + 1, sizeof *st->segment);
    if (status != RENDER_OK) return status;
    if (unit == RENDER_METRES) half_width *= render_lens_scale(lens, 0.5 * (a[2] + b[2]));
    double scale_a = render_lens_scale(lens, a[2]), scale_b = render_lens_scale(lens, b[2]);
    st->segment[st->segments++] =
        (render_segment){.from = {(float)(lens->centre_x + a[0] * scale_a),
                                  (float)(lens->centre_y + a[1] * scale_a), (float)a[2]},
                         .half_width = (float)half_width,
                         .to = {(float)(lens->centre_x + b[0] * scale_b),
                                (float)(lens->centre_y + b[1] * scale_b), (float)b[2]},
                         .rgba = rgba};
    return RENDER_OK;
}

static render_status add_lines(render_strokes *st, const render_lines *l, const render_lens *lens,
                               int samples) {
    static const render_rgb INK = {40, 40, 44};
    double opacity = l->opacity > 0 ? l->opacity : 1;
    render_width unit = l->width ? l->unit : RENDER_PIXELS;
    for (size_t i = 0; i < l->count; i++) {
        double half = 0.5 * (l->width ? l->width[i] : 1.5);
        if (half <= 0) continue;
        render_status status = add_segment(st, lens, l->from + 3 * i, l->to + 3 * i,
                                           unit == RENDER_PIXELS ? half * samples : half, unit,
                                           pack(l->colour ? l->colour[i] : INK, 1, opacity));
        if (status != RENDER_OK) return status;
    }
    return RENDER_OK;
}

static int compare_edges(const void *left, const void *right) {
    const render_edge *a = left, *b = right;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    if (a->high != b->high) return a->high < b->high ? -1 : 1;
    return a->face < b->face ? -1 : a->face > b->face;
}

/* A crease, or the border of the surface, or a seam of three and more faces. */
static bool is_feature(const render_walls *w, const render_edge *edge, size_t faces) {
    if (faces != 2) return true;
    double a[3], b[3];
    face_normal(w, edge[0].face, a);
    face_normal(w, edge[1].face, b);
    return fabs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) < CREASE_COSINE;
}

static render_status add_wall_edges(render_strokes *st, const render_walls *w,
                                    const render_lens *lens, int samples) {
    size_t corners = (size_t)w->corners, count = w->face_count * corners;
    render_status status = grow((void **)&st->edge, &st->edge_room, count, sizeof *st->edge);
    if (status != RENDER_OK) return status;
    for (size_t i = 0; i < count; i++) {
        size_t face = i / corners;
        uint32_t a = w->index[i], b = w->index[face * corners + (i + 1) % corners];
        st->edge[i] = (render_edge){a < b ? a : b, a < b ? b : a, face};
    }
    qsort(st->edge, count, sizeof *st->edge, compare_edges);
    for (size_t i = 0, next; i < count; i = next) {
        const render_edge *e = &st->edge[i];
        for (next = i + 1; next < count; next++)
            if (st->edge[next].low != e->low || st->edge[next].high != e->high) break;
        if (e->low == e->high || !is_feature(w, e, next - i)) continue;
        status =
            add_segment(st, lens, w->vertex + 3 * (size_t)e->low, w->vertex + 3 * (size_t)e->high,
                        0.5 * w->edge_px * samples, RENDER_PIXELS, pack(w->edge_colour, 1, 1));
        if (status != RENDER_OK) return status;
    }
    return RENDER_OK;
}

/* Puts segment[first..segments) into drawing order. */
static render_status sort_segments(render_strokes *st, size_t first) {
    size_t count = st->segments - first;
    if (count < 2) return RENDER_OK;
    render_status status = grow((void **)&st->item, &st->item_room, count, sizeof *st->item);
    if (status == RENDER_OK) /* the sorted copy goes behind the list, then over it */
        status = grow((void **)&st->segment, &st->segment_room, st->segments + count,
                      sizeof *st->segment);
    if (status != RENDER_OK) return status;
    for (size_t i = 0; i < count; i++) {
        const render_segment *s = &st->segment[first + i];
        st->item[i] = (render_item){0.5 * ((double)s->from[2] + s->to[2]), 0, first + i, i, 0};
    }
    qsort(st->item, count, sizeof *st->item, compare_items);
    for (size_t i = 0; i < count; i++)
        st->segment[st->segments + i] = st->segment[st->item[i].index];
    memcpy(st->segment + first, st->segment + st->segments, count * sizeof *st->segment);
    return RENDER_OK;
}

static render_status build_segments(render_strokes *st, const render_scene *scene,
                                    const render_lens *lens, int samples) {
    render_status status = RENDER_OK;
    st->segments = 0;
    for (size_t g = 0; g < scene->walls_count && status == RENDER_OK; g++)
        if (scene->walls[g].face_count > 0 && scene->walls[g].edge_px > 0)
            status = add_wall_edges(st, &scene->walls[g], lens, samples);
    for (size_t g = 0; g < scene->lines_count && status == RENDER_OK; g++)
        if (!scene->lines[g].on_top) status = add_lines(st, &scene->lines[g], lens, samples);
    if (status == RENDER_OK) status = sort_segments(st, 0);
    st->hidden_segments = st->segments;
    for (size_t g = 0; g < scene->lines_count && status == RENDER_OK; g++)
        if (scene->lines[g].on_top) status = add_lines(st, &scene->lines[g], lens, samples);
    if (status == RENDER_OK) status = sort_segments(st, st->hidden_segments);
    return status;
}

render_status render_strokes_build(render_strokes *strokes, const render_scene *scene,
                                   const render_lens *lens, int samples) {
    RENDER_ASSERT(strokes && scene && lens && samples >= 1);
    render_status status = build_faces(strokes, scene, lens);
    if (status == RENDER_OK) status = build_segments(strokes, scene, lens, samples);
    return status;
}

void render_strokes_free(render_strokes *strokes) {
    free(strokes->corner);
    free(strokes->segment);
    free(strokes->item);
    free(strokes->edge);
    *strokes = (render_strokes){0};
}
