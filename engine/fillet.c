/* fillet.c - what a sphere feels at a hollow seam of a smooth patch: not the edge in which two
 * facets meet, but a fillet that is tangent to both. So force and direction go over a seam without
 * a jump, as over the curved surface that the facets stand for.
 *
 * The air over a seam is what balls fill that touch both facets: each stands over a place of the
 * seam and touches the facets as far from it as the fillet is wide there. The distance of a place
 * from the surface is the largest over all balls of radius - way to its centre: exact, and with a
 * unit gradient wherever the sphere goes, so its force has a potential, as that of the facets has.
 * Which places a fillet holds is told by their foot on the facet: those nearer to the seam than it
 * is wide there, on the facet's own side of the plane between the two. Beyond that plane the other
 * facet says the same of the same balls.
 *
 * Along its middle a fillet is a cylinder. Towards its ends its width falls to nothing as a
 * parabola does, without a bend: where it bent, the fillet would have a ridge. The way to a ball
 * less its radius has one least value, since the width changes by less than itself over its rise.
 *
 * A sphere too large to get into the fillet touches both facets at once or neither, and its foot is
 * never on the fillet. */
#include "engine/geometry.h"
#include "engine/world.h"

/* A place over a facet, or a way: along a seam, from it into the facet, above. m */
typedef struct over_seam {
    double s, in, up;
} over_seam;

/* One end of a fillet, as wide as the sphere lets it be: s goes from the end. m */
typedef struct tapering {
    double width, rise, per_tangent;
} tapering;

static double width_at(const tapering *t, double s) {
    double y = s < t->rise ? s / t->rise : 1;
    return t->width * (y * (2 - y));
}

static double slope_at(const tapering *t, double s) {
    return s < t->rise ? 2 * t->width / t->rise * (1 - s / t->rise) : 0;
}

static over_seam way_to_ball(const tapering *t, over_seam x, double s) {
    double width = width_at(t, s);
    return (over_seam){s - x.s, width - x.in, width * t->per_tangent - x.up};
}

static double norm_of(over_seam a) {
    return sqrt(a.s * a.s + a.in * a.in + a.up * a.up);
}

/* How the way to a ball less its radius changes with s, and how that does. */
typedef struct rates {
    double first, second;
} rates;

static rates rates_at(const tapering *t, over_seam x, double s) {
    over_seam way = way_to_ball(t, x, s);
    double size = norm_of(way), slope = slope_at(t, s), round = slope * t->per_tangent;
    double bend = -2 * t->width / (t->rise * t->rise);
    double along = (way.s + way.in * slope + way.up * round) / size;
    double across = 1 + slope * slope + round * round - along * along;
    double turned = (way.in + way.up * t->per_tangent) / size - t->per_tangent;
    return (rates){along - round, across / size + bend * turned};
}

/* m, where the nearest ball stands, of x whose foot is on the rise: Newton's method within a
 * bracket. It stands between the end and the ball over x. */
static double nearest_on_rise(const tapering *t, over_seam x) {
    enum { MOST = 60 };
    double low = 0, high = x.s, s = x.s;
    for (int i = 0; i < MOST; i++) {
        rates f = rates_at(t, x, s);
        if (f.first > 0)
            high = s;
        else
            low = s;
        double next = f.second > 0 ? s - f.first / f.second : low;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        if (fabs(next - s) <= 1e-14 * t->rise) return next;
        s = next;
    }
    return s;
}

static vec3 out_of_seam(const wall *l, const fillet *f, over_seam a) {
    double u = f->way[0] * a.s - f->inward * f->way[1] * a.in;
    double v = f->way[1] * a.s + f->inward * f->way[0] * a.in;
    return v3_add(v3_scale(f->side * a.up, l->n), v3_add(v3_scale(u, l->u), v3_scale(v, l->v)));
}

/* The way from x to the centre of the ball that comes nearest to it; false where the foot of x is
 * not on the fillet. */
static bool way_to_nearest(const fillet *f, double radius, over_seam x, over_seam *way) {
    double cap = f->cap * radius, narrow = f->width > cap ? cap / f->width : 1;
    bool endless = f->length >= WALL_ENDLESS, late = x.s > f->length - narrow * f->rise[1];
    tapering t = {narrow * f->width, narrow * f->rise[late], 1 / f->tangent};
    over_seam from_end = {late ? f->length - x.s : x.s, x.in, x.up};
    if (endless || from_end.s >= t.rise) {
        *way = (over_seam){0, t.width - x.in, t.width * t.per_tangent - x.up};
        return x.in < t.width && way->up > 0;
    }
    if (!(from_end.s > 0 && x.in < width_at(&t, from_end.s))) return false;
    *way = way_to_ball(&t, from_end, nearest_on_rise(&t, from_end));
    if (late) way->s = -way->s;
    return way->up > 0;
}

/* The fillet of a facet that the foot of a sphere is on, if any. */
bool fillet_at(const wall *l, vec3 centre, double radius, fillet_touch *touch) {
    vec3 d = v3_sub(centre, l->point);
    double height = v3_dot(d, l->n), u = v3_dot(d, l->u), v = v3_dot(d, l->v);
    double side = height < 0 ? -1 : 1, up = fabs(height);
    bool found = false;
    for (int k = 0; k < l->fillets.count; k++) {
        const fillet *f = &l->fillets.item[k];
        double du = u - f->from[0], dv = v - f->from[1];
        double in = f->inward * (f->way[0] * dv - f->way[1] * du);
        if (f->side != side || !(in > 0 && in < f->width)) continue;
        if (up * f->tangent > (1 + 1e-9) * in) continue; /* the other facet's */
        over_seam way, x = {f->way[0] * du + f->way[1] * dv, in, up};
        if (!way_to_nearest(f, radius, x, &way)) continue;
        /* a form that loses nothing where the ball is large */
        double flat = way.s * way.s + way.in * way.in, size = norm_of(way);
        double overlap = radius - (up - flat / (size + way.up));
        if (found && overlap <= touch->overlap) continue;
        *touch = (fillet_touch){v3_scale(1 / size, out_of_seam(l, f, way)), height, overlap};
        found = true;
    }
    return found;
}
