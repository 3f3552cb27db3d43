/* bed.c - height and bulk density of a bed, read off frames as one would read them through a glass
 * wall: from the bars to the tops of the bodies.
 *
 * A frame is cut into columns across the grate. The floor of a column is the highest bar, the
 * surface the highest body; dips of the surface that are narrower than a body are filled
 * (morphological closing by a square of its diameter), because the eye goes from top to top. The
 * outline with its dips stands beside it: the two bracket what "bed height" can mean. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/grate-rtd/grate.h"

static const double FLYING = 0.3; /* m/s: after a fall of 5 mm */
static const double LYING = 0.01; /* m/s */
static const double PI = 3.14159265358979323846;
enum { CELLS_ACROSS_BODY = 10, BATCHES = 10 };

/* Columns of a stretch of the grate, x along it and y across. */
typedef struct columns {
    double from, cell;       /* m, along the grate; square columns */
    double slope_x, slope_z; /* direction of the grate */
    double half_width;
    int nx, ny, reach;         /* reach: half a body in columns */
    double *floor;             /* m, by x */
    double *surface, *scratch; /* m, by x and y */
} columns;

static columns columns_new(double from, double to, double half_width, double slope, double body) {
    columns c = {.from = from,
                 .cell = body / CELLS_ACROSS_BODY,
                 .slope_x = cos(slope),
                 .slope_z = sin(slope),
                 .half_width = half_width,
                 .reach = CELLS_ACROSS_BODY / 2};
    c.nx = (int)((to - from) / c.cell);
    c.ny = (int)(2 * half_width / c.cell);
    size_t all = (size_t)c.nx * (size_t)c.ny;
    c.floor = calloc((size_t)c.nx, sizeof *c.floor);
    c.surface = calloc(all, sizeof *c.surface);
    c.scratch = calloc(all, sizeof *c.scratch);
    CLAST_ASSERT(c.floor && c.surface && c.scratch);
    return c;
}

static void columns_free(columns *c) {
    free(c->floor), free(c->surface), free(c->scratch);
}

static double along(const columns *c, const double *p) {
    return c->slope_x * p[0] + c->slope_z * p[2];
}

static double above(const columns *c, const double *p) {
    return c->slope_x * p[2] - c->slope_z * p[0];
}

/* ---- the floor ------------------------------------------------------------------------------- */

/* Bars are the same at every y: what of a triangle crosses y = 0 is a stretch of the floor. */
static void raise_floor(columns *c, const double a[2], const double b[2]) {
    const double *low = a[0] < b[0] ? a : b, *high = a[0] < b[0] ? b : a;
    int first = (int)ceil((low[0] - c->from) / c->cell - 0.5);
    int last = (int)floor((high[0] - c->from) / c->cell - 0.5);
    for (int i = first < 0 ? 0 : first; i <= last && i < c->nx; i++) {
        double x = c->from + (i + 0.5) * c->cell;
        double z = low[1] + (high[1] - low[1]) * (x - low[0]) / (high[0] - low[0]);
        c->floor[i] = fmax(c->floor[i], z);
    }
}

static void cut_triangle(columns *c, double corner[3][3]) {
    double cut[2][2];
    int cuts = 0;
    for (int k = 0; k < 3 && cuts < 2; k++) {
        const double *p = corner[k], *q = corner[(k + 1) % 3];
        if ((p[1] < 0) == (q[1] < 0)) continue;
        double t = p[1] / (p[1] - q[1]), at[3];
        for (int d = 0; d < 3; d++) at[d] = p[d] + t * (q[d] - p[d]);
        cut[cuts][0] = along(c, at), cut[cuts][1] = above(c, at);
        cuts++;
    }
    if (cuts == 2) raise_floor(c, cut[0], cut[1]);
}

static void lay_floor(columns *c, const stage *s, double time) {
    for (int i = 0; i < c->nx; i++) c->floor[i] = s->mesh_count > 0 ? -INFINITY : 0;
    for (size_t m = 0; m < s->mesh_count; m++) {
        const stage_mesh *mesh = &s->meshes[m];
        clast_vec3 moved;
        if (!stage_wall_offset(&s->walls[mesh->wall], time, &moved)) continue;
        const double shift[3] = {moved.x, moved.y, moved.z};
        for (size_t t = 0; t < mesh->triangle_count; t++) {
            double corner[3][3];
            for (int k = 0; k < 3; k++)
                for (int d = 0; d < 3; d++)
                    corner[k][d] =
                        mesh->vertex[3 * mesh->triangle[3 * t + (size_t)k] + (size_t)d] + shift[d];
            cut_triangle(c, corner);
        }
    }
}

/* Where the last bar draws back there is no floor: no part of the stretch. */
static void leave_out_what_has_no_floor(columns *c) {
    while (c->nx > 1 && isinf(c->floor[c->nx - 1])) c->nx--;
}

/* ---- the surface ----------------------------------------------------------------------------- */

static void cover(columns *c, const double *p, double radius) {
    double x = along(c, p), z = above(c, p), y = p[1] + c->half_width;
    int first = (int)ceil((x - radius - c->from) / c->cell - 0.5);
    int last = (int)floor((x + radius - c->from) / c->cell - 0.5);
    for (int i = first < 0 ? 0 : first; i <= last && i < c->nx; i++)
        for (int k = 0; k < c->ny; k++) {
            double dx = c->from + (i + 0.5) * c->cell - x, dy = (k + 0.5) * c->cell - y;
            double left = radius * radius - dx * dx - dy * dy;
            double *top = &c->surface[i * c->ny + k];
            if (left > 0) *top = fmax(*top, z + sqrt(left));
        }
}

/* Largest (sign 1) or smallest (-1) value within reach, along one direction. */
static void filter(const columns *c, const double *from, double *to, double sign, bool along_x) {
    for (int i = 0; i < c->nx; i++)
        for (int k = 0; k < c->ny; k++) {
            int at = along_x ? i : k, most = (along_x ? c->nx : c->ny) - 1;
            int low = at > c->reach ? at - c->reach : 0;
            int high = at + c->reach < most ? at + c->reach : most;
            double best = -INFINITY;
            for (int j = low; j <= high; j++)
                best = fmax(best, sign * from[along_x ? j * c->ny + k : i * c->ny + j]);
            to[i * c->ny + k] = sign * best;
        }
}

static void close_dips(columns *c) {
    filter(c, c->surface, c->scratch, 1, true);
    filter(c, c->scratch, c->surface, 1, false);
    filter(c, c->surface, c->scratch, -1, true);
    filter(c, c->scratch, c->surface, -1, false);
}

static double mean_height(const columns *c) {
    double sum = 0;
    for (int i = 0; i < c->nx; i++)
        for (int k = 0; k < c->ny; k++) sum += fmax(0, c->surface[i * c->ny + k] - c->floor[i]);
    return sum / ((double)c->nx * c->ny);
}

/* ---- one frame ------------------------------------------------------------------------------- */

static bed_look look_at(columns *c, const stage *s, const frame *f) {
    bed_look l = {0};
    lay_floor(c, s, f->time);
    leave_out_what_has_no_floor(c);
    double solid = 0, length = c->nx * c->cell;
    for (int i = 0; i < c->nx; i++)
        for (int k = 0; k < c->ny; k++) c->surface[i * c->ny + k] = c->floor[i];
    for (size_t i = 0; i < f->spheres; i++) {
        const double *p = &f->centre[3 * i];
        double x = along(c, p), r = f->radius[i];
        if (f->speed[i] > FLYING) continue;
        cover(c, p, r);
        if (x < c->from || x >= c->from + length) continue;
        l.bodies++;
        l.lying += f->speed[i] < LYING;
        solid += 4 * PI / 3 * r * r * r;
    }
    l.outline = mean_height(c);
    close_dips(c);
    l.height = mean_height(c);
    l.packing = solid / (l.height * length * 2 * c->half_width);
    return l;
}

/* Poured beds: away from the end walls. */
enum { ENDS = 4, LENGTH = 20 }; /* diameters: left out at either end; of the box */

static columns columns_of(const grate_case *c) {
    double half = case_width(c) / 2, d = c->diameter, pitch = case_pitch(c);
    if (c->group == GROUP_PACKING)
        return columns_new(ENDS * d, (LENGTH - ENDS) * d, half, case_slope(c), d);
    return columns_new(-pitch, 10 * pitch, half, case_slope(c), d);
}

bed_look bed_look_at(const grate_case *c, const stage *s, const frame *f) {
    CLAST_ASSERT(c && s && f);
    columns all = columns_of(c);
    bed_look l = look_at(&all, s, f);
    columns_free(&all);
    return l;
}

/* ---- many frames ----------------------------------------------------------------------------- */

/* Means of runs of neighbouring frames, as many as there are batches: frames remember each other.
 */
static interval batches_of(const double *x, int n) {
    double part[BATCHES] = {0};
    int batches = n < BATCHES ? n : BATCHES;
    for (int k = 0; k < batches; k++) {
        int from = n * k / batches, to = n * (k + 1) / batches;
        for (int i = from; i < to; i++) part[k] += x[i] / (to - from);
    }
    return mean_interval(part, batches);
}

grate_bed bed_of(results *r, const grate_case *c, double from) {
    CLAST_ASSERT(r && c);
    size_t count = results_frames(r);
    double *value[5];
    for (int k = 0; k < 5; k++) {
        value[k] = calloc(count + 1, sizeof *value[k]);
        CLAST_ASSERT(value[k]);
    }
    grate_bed bed = {.frames = 0};
    for (size_t i = 0; i < count; i++) {
        frame *f = results_frame(r, i);
        if (!f) fprintf(stderr, "grate-rtd: %s\n", results_error(r));
        if (f && f->time >= from && f->bodies > 0) {
            bed_look l = bed_look_at(c, results_stage(r), f);
            value[0][bed.frames] = l.height, value[1][bed.frames] = l.outline;
            value[2][bed.frames] = l.bodies, value[3][bed.frames] = l.packing;
            value[4][bed.frames] = l.lying;
            bed.frames++;
        }
        if (f) frame_free(f);
    }
    bed.height = batches_of(value[0], bed.frames);
    bed.outline = batches_of(value[1], bed.frames);
    bed.bodies = batches_of(value[2], bed.frames);
    bed.packing = batches_of(value[3], bed.frames);
    bed.lying = batches_of(value[4], bed.frames);
    for (int k = 0; k < 5; k++) free(value[k]);
    return bed;
}
