/* fillet_make.c - which seams of a mesh get a fillet, and how wide it is along them. A place of a
 * facet belongs to the fillet of a seam where it is nearer to that seam than to any other side of
 * the facet; a fillet ends with its seam, and there it has no width. Both facets of a seam have the
 * same balls, so it is as wide as the narrower of them lets it be.
 * Sides are those of facets, not of triangles: pieces of a seam between the same two facets are one
 * seam, however the facets are cut. */
#include <stdlib.h>

#include "engine/geometry.h"
#include "engine/world.h"

/* Width per length over which it rises: below one, so that all balls near it lie side by side. */
#define STEEPEST 0.9

/* Of its largest width, that the sides of the triangles may be off the line of two facets: they are
 * off by what single precision is, and more than this tells nothing of how the facets meet. */
#define OFF_LINE 0.02

/* A fillet narrower than this share of its seam is none. */
#define NARROWEST 1e-6

/* width <= at + slope s, m */
typedef struct bound {
    double at, slope;
} bound;

typedef struct bound_list {
    bound *item;
    size_t count, room;
} bound_list;

typedef struct mesh_sides {
    const clast_world *w;
    const clast_mesh_def *def;
    int first_wall;
    border *sides; /* by facet, then by neighbour */
    int count;
    int *first;         /* of each facet, and one more */
    bound_list *bounds; /* scratch */
} mesh_sides;

/* Pieces from .. to - 1 of a facet's sides, which follow each other along one line. */
typedef struct seam_line {
    int from, to;
    vec3 start, way; /* m; unit */
    double length;   /* m */
    double off;      /* m, farthest of a vertex from the line */
    vec3 inward[2];  /* into its two facets, unit */
    double tangent;  /* of half the angle */
    double side[2];  /* where it is hollow, seen from either */
    int facet[2];
    double width, rise[2]; /* m */
    double endless;        /* m */
} seam_line;

typedef struct made_list {
    seam_line *seam;
    size_t count, room;
} made_list;

/* ---- which sides are of one seam ------------------------------------------------------------- */

static int by_facets(const void *left, const void *right) {
    const border *a = left, *b = right;
    if (a->facet != b->facet) return a->facet < b->facet ? -1 : 1;
    if (a->other != b->other) return a->other < b->other ? -1 : 1;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    return (a->high > b->high) - (a->high < b->high);
}

static const wall *wall_at(const mesh_sides *m, int facet) {
    return &m->w->walls[m->first_wall + facet];
}

/* The line in which the planes of two facets meet, from near the first vertex on. */
static bool meet(const mesh_sides *m, const border *side, seam_line *line) {
    const wall *a = wall_at(m, side->facet), *b = wall_at(m, side->other);
    vec3 cross = v3_cross(a->def.normal, b->def.normal);
    double sine = v3_norm(cross), cosine = v3_dot(a->def.normal, b->def.normal);
    if (!(sine > 0)) return false;
    vec3 low = m->def->vertex[side->low];
    double x = v3_dot(a->def.normal, v3_sub(a->def.point, low));
    double y = v3_dot(b->def.normal, v3_sub(b->def.point, low));
    double of_a = (x - cosine * y) / (sine * sine), of_b = (y - cosine * x) / (sine * sine);
    line->start = v3_add(low, v3_add(v3_scale(of_a, a->def.normal), v3_scale(of_b, b->def.normal)));
    line->way = v3_scale(1 / sine, cross);
    line->facet[0] = side->facet, line->facet[1] = side->other;
    return true;
}

typedef struct piece {
    double from, to; /* m, along the line */
    int32_t low, high;
} piece;

static int by_from(const void *left, const void *right) {
    const piece *a = left, *b = right;
    if (a->from != b->from) return a->from < b->from ? -1 : 1;
    return (a->low > b->low) - (a->low < b->low);
}

static piece piece_of(const mesh_sides *m, const border *side, seam_line *line) {
    int32_t end[2] = {side->low, side->high};
    double s[2];
    for (int k = 0; k < 2; k++) {
        vec3 d = v3_sub(m->def->vertex[end[k]], line->start);
        s[k] = v3_dot(d, line->way);
        line->off = fmax(line->off, v3_norm(v3_sub(d, v3_scale(s[k], line->way))));
    }
    return s[0] < s[1] ? (piece){s[0], s[1], end[0], end[1]} : (piece){s[1], s[0], end[1], end[0]};
}

/* Ways into both facets and what angle they make; `inward` is one into the first of them, roughly.
 */
static void open_seam(const mesh_sides *m, seam_line *line, vec3 inward, vec3 other_inward) {
    vec3 about[2] = {inward, other_inward};
    for (int k = 0; k < 2; k++) {
        vec3 in = v3_cross(wall_at(m, line->facet[k])->def.normal, line->way);
        line->inward[k] = v3_scale(v3_dot(in, about[k]) < 0 ? -1 : 1, in);
    }
    double cosine = -v3_dot(line->inward[0], line->inward[1]);
    vec3 n = wall_at(m, line->facet[0])->def.normal;
    double sine = fabs(v3_dot(line->inward[1], n));
    line->tangent = sine / (1 + cosine);
    for (int k = 0; k < 2; k++) {
        vec3 normal = wall_at(m, line->facet[k])->def.normal;
        line->side[k] = v3_dot(line->inward[1 - k], normal) > 0 ? 1 : -1;
    }
}

/* ---- how wide it may be ---------------------------------------------------------------------- */

static void tighten(bound_list *l, double length, bound b) {
    if (l->count == l->room) {
        l->room = 2 * l->room + 16;
        l->item = realloc(l->item, l->room * sizeof *l->item);
        CLAST_ASSERT(l->item);
    }
    bool even = fabs(b.slope) * length < 1e-9 * b.at; /* but for rounding */
    l->item[l->count++] = even ? (bound){fmin(b.at, b.at + b.slope * length), 0} : b;
}

/* m, over which a parabola may rise from zero to the width and stay below a bound that rises from
 * `at` on. */
static double rise_below(double at, double slope, double width) {
    double held = at > 0 ? at / width : 0;
    return held < 1 ? 2 * width / slope * (1 - sqrt(held)) : 0;
}

/* m, the way that a fillet of that width needs to rise and fall below all bounds; infinite where it
 * is too wide. How soon it may be as wide. */
static double way_needed(const bound_list *l, double length, double width, double rise[2]) {
    rise[0] = rise[1] = width / STEEPEST;
    for (size_t i = 0; i < l->count; i++) {
        double at = l->item[i].at, slope = l->item[i].slope;
        if (slope == 0 && at < width) return INFINITY;
        if (slope > 0) rise[0] = fmax(rise[0], rise_below(at, slope, width));
        if (slope < 0) rise[1] = fmax(rise[1], rise_below(at + slope * length, -slope, width));
    }
    return rise[0] + rise[1];
}

/* As wide as it can be. A narrower one needs less way, in proportion at least: so one that does not
 * fit tells of one that does, which mostly is the widest. */
static void choose_width(const bound_list *l, seam_line *line) {
    enum { TRIALS = 50 };
    double low = 0, high = INFINITY, length = line->length, width = 0.5 * STEEPEST * length;
    for (size_t i = 0; i < l->count; i++)
        if (l->item[i].slope == 0) width = fmin(width, l->item[i].at);
    for (int i = 0; i < TRIALS && high > low * (1 + 2e-9); i++) {
        double way = way_needed(l, length, width, line->rise);
        if (way <= length) {
            low = width;
            if (i == 0) break;
        } else {
            high = width, low = fmax(low, (1 - 1e-12) * width * length / way);
        }
        width = i % 2 ? 0.5 * (low + high) : low * (1 + 1e-9);
    }
    line->width = way_needed(l, length, low, line->rise) <= length ? low : 0;
}

/* A side in the plane of a facet: along the seam and from it inwards. */
typedef struct flat_side {
    double s[2], in[2];     /* m, of its ends */
    double into_s, into_in; /* into the facet */
} flat_side;

static flat_side flat_side_of(const mesh_sides *m, const border *e, const seam_line *line, int of) {
    flat_side f;
    int32_t end[2] = {e->low, e->high};
    for (int k = 0; k < 2; k++) {
        vec3 d = v3_sub(m->def->vertex[end[k]], line->start);
        f.s[k] = v3_dot(d, line->way), f.in[k] = v3_dot(d, line->inward[of]);
    }
    f.into_s = v3_dot(e->inward, line->way), f.into_in = v3_dot(e->inward, line->inward[of]);
    return f;
}

static double square_between(const flat_side *f, double s) {
    double a[2] = {f->s[0], f->in[0]}, b[2] = {f->s[1], f->in[1]};
    flat_way way = way_from_segment(a, b, s, 0);
    return way.s * way.s + way.t * way.t;
}

/* m, between a side and the seam: two that do not cross are nearest at an end. */
static double way_between(const flat_side *f, double length) {
    double square = fmin(square_between(f, 0), square_between(f, length));
    for (int k = 0; k < 2; k++) {
        double beyond = f->s[k] < 0 ? -f->s[k] : f->s[k] > length ? f->s[k] - length : 0;
        square = fmin(square, beyond * beyond + f->in[k] * f->in[k]);
    }
    return sqrt(square);
}

/* Places as wide as this are as near to the seam as to the side: to its line where the seam is on
 * the inner side of that, to no part of it where the facet is not convex there. */
static void bound_by(bound_list *l, seam_line *line, const flat_side *f, double size) {
    double small = 1e-6 * size, length = line->length;
    double at = -(f->into_s * f->s[0] + f->into_in * f->in[0]), rate = f->into_s;
    bool beside = fabs(f->in[0]) < small && fabs(f->in[1]) < small && f->into_in > 0;
    if (beside || f->into_in > 1 - 1e-12) return; /* all places are as near to its line */
    if (at >= -small && at + rate * length >= -small) {
        double per = 1 / (1 - f->into_in);
        tighten(l, length, (bound){fmax(at, fmax(0, -rate * length)) * per, rate * per});
        if (fabs(rate) < 1e-6) line->endless = fmin(line->endless, at * per);
        return;
    }
    double way = way_between(f, length);
    if (way > small) tighten(l, length, (bound){0.5 * way, 0});
}

static void widen(const mesh_sides *m, seam_line *line) {
    line->endless = INFINITY;
    m->bounds->count = 0;
    for (int k = 0; k < 2; k++) {
        int own = line->facet[k], other = line->facet[1 - k];
        for (int i = m->first[own]; i < m->first[own + 1]; i++) {
            if (m->sides[i].other == other) continue;
            flat_side f = flat_side_of(m, &m->sides[i], line, k);
            bound_by(m->bounds, line, &f, wall_at(m, own)->bound);
        }
    }
    choose_width(m->bounds, line);
}

/* ---- seams ----------------------------------------------------------------------------------- */

/* Radii of a sphere that the fillet may be wide so that it rises to its limit over the edge. */
static double cap_of(double tangent) {
    return FILLET_RAISE * (1 + sqrt(1 + tangent * tangent)) / tangent;
}

static void keep(clast_world *w, made_list *made, const seam_line *line) {
    if (made->count == made->room) {
        size_t now = 2 * made->room + 64;
        made->seam = memory_grow(w, made->seam, made->room, now, sizeof *made->seam);
        made->room = now;
    }
    made->seam[made->count++] = *line;
}

static void make_seam(clast_world *w, const mesh_sides *m, seam_line line, double from, double to,
                      made_list *made) {
    line.start = v3_add(line.start, v3_scale(from, line.way));
    line.length = to - from;
    widen(m, &line);
    if (line.width > NARROWEST * line.length && line.off <= OFF_LINE * line.width)
        keep(w, made, &line);
}

/* The sides from .. to - 1 of a facet, all towards one other. */
static void make_seams(clast_world *w, const mesh_sides *m, int from, int to, made_list *made) {
    const border *side = &m->sides[from];
    if (side->other < side->facet) return; /* none, or made from there */
    const wall *a = wall_at(m, side->facet), *b = wall_at(m, side->other);
    if (a->smooth < 0 || a->smooth != b->smooth) return;
    seam_line line = {.from = from, .to = to};
    if (!meet(m, side, &line)) return;
    border key = {.facet = side->other, .other = side->facet, .low = side->low, .high = side->high};
    const border *back = bsearch(&key, m->sides, (size_t)m->count, sizeof *m->sides, by_facets);
    if (!back) return;
    open_seam(m, &line, side->inward, back->inward);
    double cosine = -v3_dot(line.inward[0], line.inward[1]), cap = cap_of(line.tangent);
    if (!(cosine > a->smooth_cosine && cap > line.tangent)) return; /* no sphere gets into it */
    int count = to - from;
    piece *pieces = malloc((size_t)count * sizeof *pieces);
    CLAST_ASSERT(pieces);
    for (int i = 0; i < count; i++) pieces[i] = piece_of(m, side + i, &line);
    qsort(pieces, (size_t)count, sizeof *pieces, by_from);
    for (int i = 0, next; i < count; i = next) {
        for (next = i + 1; next < count && pieces[next].low == pieces[next - 1].high;) next++;
        make_seam(w, m, line, pieces[i].from, pieces[next - 1].to, made);
    }
    free(pieces);
}

/* ---- into the walls -------------------------------------------------------------------------- */

static void add_fillet(wall *l, const seam_line *line, int of) {
    fillet_list *to = &l->fillets;
    fillet *f = &to->item[to->count];
    vec3 d = v3_sub(line->start, l->def.point);
    double way[2] = {v3_dot(line->way, l->u), v3_dot(line->way, l->v)};
    double in[2] = {v3_dot(line->inward[of], l->u), v3_dot(line->inward[of], l->v)};
    *f = (fillet){.from = {v3_dot(d, l->u), v3_dot(d, l->v)},
                  .way = {way[0], way[1]},
                  .inward = way[0] * in[1] - way[1] * in[0] > 0 ? 1 : -1,
                  .side = line->side[of],
                  .tangent = line->tangent,
                  .cap = cap_of(line->tangent),
                  .length = line->length,
                  .width = line->width,
                  .rise = {line->rise[0], line->rise[1]},
                  .endless = line->endless};
    to->count++;
    to->width = fmax(to->width, line->width), to->cap = fmax(to->cap, f->cap);
}

/* Seams of a facet come in the order of its neighbours. */
static void put_into_walls(clast_world *w, int first_wall, int facets, const made_list *made) {
    int *count = calloc((size_t)facets, sizeof *count);
    CLAST_ASSERT(count);
    for (size_t i = 0; i < made->count; i++)
        for (int of = 0; of < 2; of++) count[made->seam[i].facet[of]]++;
    for (int i = 0; i < facets; i++) {
        fillet_list *to = &w->walls[first_wall + i].fillets;
        if (count[i] > 0) to->item = memory_grow(w, NULL, 0, (size_t)count[i], sizeof *to->item);
    }
    for (size_t i = 0; i < made->count; i++)
        for (int of = 0; of < 2; of++)
            add_fillet(&w->walls[first_wall + made->seam[i].facet[of]], &made->seam[i], of);
    free(count);
}

/* The walls from `first_wall` on are the facets of a mesh. */
void fillets_make(clast_world *w, int first_wall, const clast_mesh_def *d, border *borders,
                  int count) {
    int facets = w->wall_count - first_wall;
    qsort(borders, (size_t)count, sizeof *borders, by_facets);
    bound_list bounds = {0};
    mesh_sides m = {
        w, d, first_wall, borders, count, calloc((size_t)facets + 1, sizeof *m.first), &bounds};
    CLAST_ASSERT(m.first);
    for (int i = 0; i < count; i++) m.first[borders[i].facet + 1]++;
    for (int i = 0; i < facets; i++) m.first[i + 1] += m.first[i];
    made_list made = {0};
    for (int from = 0, to; from < count; from = to) {
        const border *a = &borders[from];
        for (to = from + 1;
             to < count && borders[to].facet == a->facet && borders[to].other == a->other;)
            to++;
        make_seams(w, &m, from, to, &made);
    }
    put_into_walls(w, first_wall, facets, &made);
    memory_return(w, made.room * sizeof *made.seam);
    memory_release(made.seam);
    free(m.first), free(bounds.item);
}

/* Across a periodic face a surface goes on, though its facets end: fillets along it do not. */
void fillets_unend(wall *l, vec3 along) {
    for (int k = 0; k < l->fillets.count; k++) {
        fillet *f = &l->fillets.item[k];
        vec3 way = v3_add(v3_scale(f->way[0], l->u), v3_scale(f->way[1], l->v));
        if (!(v3_norm(v3_cross(way, along)) < 1e-6) || !isfinite(f->endless)) continue;
        f->length = WALL_ENDLESS, f->width = f->endless;
        l->fillets.width = fmax(l->fillets.width, f->endless);
    }
}
