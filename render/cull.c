/* Spheres that cannot be seen are dropped before they cost a fragment: front to back, each is first
 * tested against a coarse z-buffer and, if it may be visible, adds the cells it covers for sure.
 * Both steps err on the side of drawing: the picture is the same to the byte with and without. */
#include "render/cull.h"

#include "render/status.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct cells {
    float *depth; /* everything at or behind this view depth is hidden, in the whole cell */
    int width, height;
    double per_px; /* cells per drawn pixel */
} cells;

/* A circle on the picture, in cells, and a depth in m. */
typedef struct disc {
    double x, y, radius, depth;
} disc;

/* Where a sphere's picture lies for certain, in pixels. */
typedef struct bound {
    double x, y, half_x, half_y;
    double radius; /* of a circle around it, for rounding off the corners */
} bound;

/* Rounds down or up into 0..count. By cast: floor() is a function call on baseline x86-64. */
static int cell_down(double at, int count) {
    return at <= 0 ? 0 : at >= count ? count : (int)at;
}

static int cell_up(double at, int count) {
    int down = cell_down(at, count);
    return down + (down < at && down < count);
}

/* Slopes x/z of the two planes that touch the sphere and hold the eye. */
static void tangents(double x, double z, double r, double *low, double *high) {
    double root = r * sqrt(fmax(x * x + z * z - r * r, 0)), under = z * z - r * r;
    *low = (x * z - root) / under;
    *high = (x * z + root) / under;
}

static bound ball_bound(const float place[4], const render_lens *lens) {
    double x = place[0], y = place[1], z = place[2], r = place[3];
    const double margin = 1; /* pixel; covers rounding in the shader and the rasteriser's grid */
    if (!lens->perspective) {
        double half = r * lens->scale + margin;
        return (bound){lens->centre_x + x * lens->scale, lens->centre_y + y * lens->scale, half,
                       half, half};
    }
    if (z <= r * 1.001) /* reaches beside the eye: may be anywhere on the picture */
        return (bound){lens->centre_x, lens->centre_y, 1e9, 1e9, 2e9};
    double x0, x1, y0, y1;
    tangents(x, z, r, &x0, &x1);
    tangents(y, z, r, &y0, &y1);
    double half_x = 0.5 * (x1 - x0) * lens->scale + margin;
    double half_y = 0.5 * (y1 - y0) * lens->scale + margin;
    return (bound){lens->centre_x + 0.5 * (x0 + x1) * lens->scale,
                   lens->centre_y + 0.5 * (y0 + y1) * lens->scale, half_x, half_y,
                   hypot(half_x, half_y)};
}

static bool outside(const bound *b, const render_lens *lens) {
    return b->x + b->half_x < 0 || b->y + b->half_y < 0 || b->x - b->half_x > lens->width ||
           b->y - b->half_y > lens->height;
}

/* True if some cell under the bound is not yet hidden at that depth. */
static bool visible(const cells *c, const bound *b, float depth) {
    double x = b->x * c->per_px, y = b->y * c->per_px, half_x = b->half_x * c->per_px;
    double half_y = b->half_y * c->per_px, round = b->radius * c->per_px * (b->radius * c->per_px);
    int last = cell_up(y + half_y, c->height);
    for (int row = cell_down(y - half_y, c->height); row < last; row++) {
        double away = row > y ? row - y : row + 1 < y ? y - (row + 1) : 0; /* of the nearest line */
        double square = round - away * away;
        if (square < 0) continue;
        double half = sqrt(square);
        if (half > half_x) half = half_x;
        int from = cell_down(x - half, c->width), to = cell_up(x + half, c->width);
        const float *cell = c->depth + (size_t)row * (size_t)c->width;
        int open = 0;
        for (int i = from; i < to; i++) open |= depth < cell[i];
        if (open) return true;
    }
    return false;
}

/* Cells that lie wholly inside the disc are hidden behind its depth. */
static void hide(const cells *c, const disc *d) {
    float depth = (float)d->depth;
    int last = cell_down(d->y + d->radius, c->height);
    for (int row = cell_up(d->y - d->radius, c->height); row < last; row++) {
        double low = d->y - row, high = row + 1 - d->y, away = low > high ? low : high;
        double square = d->radius * d->radius - away * away;
        if (square <= 0) continue;
        double half = sqrt(square);
        int from = cell_up(d->x - half, c->width), to = cell_down(d->x + half, c->width);
        float *cell = c->depth + (size_t)row * (size_t)c->width;
        for (int i = from; i < to; i++) cell[i] = cell[i] < depth ? cell[i] : depth;
    }
}

/* A sphere hides what lies behind its section through the centre and parallel to the picture, whose
 * image is a circle in both projections. (Sections nearer to the eye hide earlier but reach less
 * far: one at 0.3 of the radius kept a fifth more spheres.) */
static void hide_behind_ball(const cells *c, const float place[4], const render_lens *lens,
                             double slack) {
    double z = place[2], r = place[3];
    if (lens->perspective && z <= r * 1.001) return;
    double scale = render_lens_scale(lens, z);
    disc d = {.x = (lens->centre_x + place[0] * scale) * c->per_px,
              .y = (lens->centre_y + place[1] * scale) * c->per_px,
              .radius = (r * scale - 0.25) * c->per_px, /* less, for rounding in the shader */
              .depth = z + slack};
    if (d.radius >= 0.5) hide(c, &d); /* a smaller one holds no cell */
}

static render_status make_room(render_cull *cull, size_t count, size_t cells_needed) {
    if (count > cull->room || !cull->ball) {
        size_t room = count < 64 ? 64 : count;
        free(cull->ball);
        free(cull->key);
        cull->room = 0;
        cull->ball = malloc(2 * room * sizeof *cull->ball);
        cull->key = malloc(3 * room * sizeof *cull->key);
        if (!cull->ball || !cull->key)
            return render_fail(RENDER_ERR_MEMORY, "no memory for %zu spheres", count);
        cull->sorted = cull->ball + room;
        cull->order = cull->key + room;
        cull->spare = cull->key + 2 * room;
        cull->room = room;
    }
    if (cells_needed > cull->cell_room) {
        free(cull->cell);
        cull->cell = malloc(cells_needed * sizeof *cull->cell);
        cull->cell_room = cull->cell ? cells_needed : 0;
        if (!cull->cell) return render_fail(RENDER_ERR_MEMORY, "no memory for the cull");
    }
    return RENDER_OK;
}

static uint32_t pack_colour(render_rgb c, double dark) {
    uint32_t alpha = (uint32_t)(255 * dark + 0.5);
    return (uint32_t)c.r | (uint32_t)c.g << 8 | (uint32_t)c.b << 16 | alpha << 24;
}

/* How dark the outline of a body is: full from fade_px on, none at a quarter of it. */
static double outline_at(double radius_px, const render_cull_def *def) {
    double t = (radius_px / def->outline_fade_px - 0.25) / 0.75;
    return def->outline * (t < 0 ? 0 : t > 1 ? 1 : t);
}

/* Into view coordinates; drops what is outside the picture. Returns how many are left. */
static size_t gather(render_cull *cull, const render_spheres *s, const render_lens *lens,
                     const render_cull_def *def) {
    static const render_rgb NEUTRAL = {196, 188, 174};
    size_t kept = 0;
    for (size_t i = 0; i < s->count; i++) {
        double view[3];
        render_lens_view(lens, s->x[i], s->y[i], s->z[i], view);
        render_ball *ball = &cull->ball[kept];
        for (int k = 0; k < 3; k++) ball->place[k] = (float)view[k];
        ball->place[3] = (float)s->radius[i];
        double r = s->radius[i];
        double square = view[0] * view[0] + view[1] * view[1] + view[2] * view[2];
        if (lens->perspective && (view[2] <= -r || square <= r * r * 1.000001)) continue;
        bound b = ball_bound(ball->place, lens);
        if (outside(&b, lens)) continue;
        double radius_px = r * render_lens_scale(lens, fmax(view[2], r));
        ball->rgba = pack_colour(s->colour ? s->colour[i] : NEUTRAL, outline_at(radius_px, def));
        ball->body = (s->body ? (uint32_t)s->body[i] : (uint32_t)i) + 1;
        ball->unused[0] = ball->unused[1] = 0;
        kept++;
    }
    return kept;
}

/* The order of a float's bits, taken as an unsigned number. */
static uint32_t float_key(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

/* By nearest point; equal ones keep the caller's order. Least significant digit first, 11 bits
 * each. */
static void sort_by_depth(render_cull *cull, size_t count) {
    enum { BITS = 11, BINS = 1 << BITS };
    uint32_t *order = cull->order, *next = cull->spare;
    for (size_t i = 0; i < count; i++) {
        cull->key[i] = float_key(cull->ball[i].place[2] - cull->ball[i].place[3]);
        order[i] = (uint32_t)i;
    }
    for (int shift = 0; shift < 32; shift += BITS) {
        uint32_t start[BINS + 1] = {0};
        for (size_t i = 0; i < count; i++) start[(cull->key[i] >> shift & (BINS - 1)) + 1]++;
        for (int b = 0; b < BINS; b++) start[b + 1] += start[b];
        for (size_t i = 0; i < count; i++)
            next[start[cull->key[order[i]] >> shift & (BINS - 1)]++] = order[i];
        uint32_t *swap = order;
        order = next;
        next = swap;
    }
    if (order != cull->order) memcpy(cull->order, order, count * sizeof *order);
}

render_status render_cull_spheres(render_cull *cull, const render_spheres *spheres,
                                  const render_lens *lens, const render_cull_def *def) {
    RENDER_ASSERT(cull && spheres && lens && def && def->outline_fade_px > 0);
    cells c = {.width = (lens->width + def->cell_px - 1) / def->cell_px,
               .height = (lens->height + def->cell_px - 1) / def->cell_px,
               .per_px = 1.0 / def->cell_px};
    size_t cell_count = (size_t)c.width * (size_t)c.height;
    cull->drawn = 0;
    render_status status = make_room(cull, spheres->count, cell_count);
    if (status != RENDER_OK) return status;
    size_t count = gather(cull, spheres, lens, def);
    sort_by_depth(cull, count);
    c.depth = cull->cell;
    for (size_t i = 0; i < cell_count; i++) c.depth[i] = FLT_MAX;
    for (size_t i = 0; i < count; i++) {
        const render_ball *ball = &cull->ball[cull->order[i]];
        if (def->occlusion) {
            double r = ball->place[3], slack = 1e-3 * r + 1e-6 * fabs(ball->place[2]);
            bound b = ball_bound(ball->place, lens);
            if (!visible(&c, &b, (float)(ball->place[2] - r))) continue;
            hide_behind_ball(&c, ball->place, lens, slack);
        }
        cull->sorted[cull->drawn++] = *ball;
    }
    return RENDER_OK;
}

void render_cull_free(render_cull *cull) {
    free(cull->ball);
    free(cull->key);
    free(cull->cell);
    *cull = (render_cull){0};
}
