/* solid_distance.c - nearest point of the surface of a solid. Solids of revolution are looked at in
 * the half plane (x, rho) through the axis and the point. */
#include "shapes/solid.h"

#include "shapes/check.h"
#include "shapes/solid_outline.h"

/* A place on the outline: nearest so far. */
typedef struct place {
    double x, rho, normal_x, normal_rho;
    double square; /* m2, distance from the point asked about */
} place;

static void take(place *best, const place *other) {
    if (other->square < best->square) *best = *other;
}

static void try_line(place *best, double x, double rho, const double from[2], const double to[2]) {
    double dx = to[0] - from[0], dr = to[1] - from[1], square = dx * dx + dr * dr;
    double t = ((x - from[0]) * dx + (rho - from[1]) * dr) / square;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    double length = sqrt(square), px = from[0] + t * dx, pr = from[1] + t * dr;
    take(best, &(place){px, pr, -dr / length, dx / length,
                        (px - x) * (px - x) + (pr - rho) * (pr - rho)});
}

/* Half the change of the squared distance along the curve: zero at the nearest point. */
static double change(const shape_solid *s, double at, double x, double rho) {
    double slope, height = shape_curve_height(s, at, &slope);
    return at - x + (height - rho) * slope;
}

/* The nearest of 33 points brackets the nearest place; 60 halvings find it. */
static void try_curve(place *best, const shape_solid *s, double x, double rho) {
    enum { POINTS = 33, HALVINGS = 60 };
    double half = 0.5 * s->size[2], slope, nearest = HUGE_VAL;
    int at = 0;
    for (int i = 0; i < POINTS; i++) {
        double px = half * (2.0 * i / (POINTS - 1) - 1);
        double dr = shape_curve_height(s, px, &slope) - rho, d = (px - x) * (px - x) + dr * dr;
        if (d < nearest) nearest = d, at = i;
    }
    double low = half * (2.0 * (at > 0 ? at - 1 : 0) / (POINTS - 1) - 1);
    double high = half * (2.0 * (at < POINTS - 1 ? at + 1 : at) / (POINTS - 1) - 1);
    for (int i = 0; i < HALVINGS; i++) {
        double middle = 0.5 * (low + high);
        *(change(s, middle, x, rho) < 0 ? &low : &high) = middle;
    }
    double px = 0.5 * (low + high), pr = shape_curve_height(s, px, &slope);
    double length = sqrt(1 + slope * slope);
    take(best, &(place){px, pr, -slope / length, 1 / length,
                        (px - x) * (px - x) + (pr - rho) * (pr - rho)});
}

static place nearest_on_outline(const shape_solid *s, double x, double rho) {
    place best = {.square = HUGE_VAL};
    shape_outline o = shape_outline_of(s);
    for (int i = 0; i < o.pieces; i++) {
        if (i == o.curve)
            try_curve(&best, s, x, rho);
        else
            try_line(&best, x, rho, o.at[i], o.at[i + 1]);
    }
    return best;
}

static bool is_inside_turned(const shape_solid *s, double x, double rho) {
    double slope;
    switch (s->kind) {
    case SHAPE_CYLINDER:
        return fabs(x) < 0.5 * s->size[1] && rho < s->size[0];
    case SHAPE_CONE:
        return x > -0.25 * s->size[1] && rho * s->size[1] < s->size[0] * (0.75 * s->size[1] - x);
    case SHAPE_DOUBLE_CONE:
        return rho * s->size[1] < s->size[0] * (s->size[1] - 2 * fabs(x));
    case SHAPE_DISC:
        return fabs(x) < 0.5 * s->size[2] && rho < s->size[0] &&
               rho > s->size[1] - (s->size[1] == 0);
    default:
        return fabs(x) < 0.5 * s->size[2] && rho < shape_curve_height(s, x, &slope);
    }
}

static double turned_distance(const shape_solid *s, shape_vec p, shape_vec *nearest,
                              shape_vec *normal) {
    double rho = sqrt(p.y * p.y + p.z * p.z);
    double c = rho > 0 ? p.y / rho : 1, e = rho > 0 ? p.z / rho : 0;
    place at = nearest_on_outline(s, p.x, rho);
    *nearest = sv(at.x, at.rho * c, at.rho * e);
    *normal = sv(at.normal_x, at.normal_rho * c, at.normal_rho * e);
    return is_inside_turned(s, p.x, rho) ? -sqrt(at.square) : sqrt(at.square);
}

static double torus_distance(const shape_solid *s, shape_vec p, shape_vec *nearest,
                             shape_vec *normal) {
    double tube = s->size[0], ring = s->size[1], rho = sqrt(p.x * p.x + p.y * p.y);
    shape_vec out = rho > 0 ? sv(p.x / rho, p.y / rho, 0) : sv(1, 0, 0);
    shape_vec core = sv_scale(ring, out), arm = sv_sub(p, core);
    double d = sv_norm(arm);
    *normal = d > 0 ? sv_scale(1 / d, arm) : out;
    *nearest = sv_along(core, tube, *normal);
    return d - tube;
}

static double sphere_distance(double radius, shape_vec p, shape_vec *nearest, shape_vec *normal) {
    double d = sv_norm(p);
    *normal = d > 0 ? sv_scale(1 / d, p) : sv(1, 0, 0);
    *nearest = sv_scale(radius, *normal);
    return d - radius;
}

/* ---- blocks
 * -------------------------------------------------------------------------------------- */

static double block_distance(const double half[3], shape_vec p, shape_vec *nearest,
                             shape_vec *normal) {
    double at[3] = {p.x, p.y, p.z}, face[3] = {0, 0, 0}, square = 0;
    int out = 0;
    for (int k = 1; k < 3; k++)
        if (fabs(at[k]) - half[k] > fabs(at[out]) - half[out]) out = k;
    double over = fabs(at[out]) - half[out];
    face[out] = at[out] < 0 ? -1 : 1;
    if (over <= 0) at[out] = face[out] * half[out];
    for (int k = 0; k < 3; k++) {
        double d = fabs(at[k]) - half[k];
        if (d <= 0) continue;
        at[k] = at[k] < 0 ? -half[k] : half[k];
        square += d * d;
    }
    *nearest = sv(at[0], at[1], at[2]);
    *normal = sv(face[0], face[1], face[2]);
    return over <= 0 ? over : sqrt(square);
}

static double tetrahedron_distance(double edge, shape_vec p, shape_vec *nearest,
                                   shape_vec *normal) {
    shape_vec corner[4], face[3];
    shape_tetrahedron_corners(edge, corner);
    bool inside = true;
    double best = HUGE_VAL;
    for (int f = 0; f < 4; f++) {
        for (int k = 0; k < 3; k++) face[k] = corner[SHAPE_TETRAHEDRON_FACES[f][k]];
        shape_vec out = sv_unit(sv_cross(sv_sub(face[1], face[0]), sv_sub(face[2], face[0])));
        inside = inside && sv_dot(sv_sub(p, face[0]), out) < 0;
        shape_vec q = shape_triangle_nearest(face, p);
        double d = sv_distance(p, q);
        if (d < best) best = d, *nearest = q, *normal = out;
    }
    return inside ? -best : best;
}

/* ---- ellipsoid
 * ----------------------------------------------------------------------------------- */

/* The nearest point is q_k = e_k^2 p_k / (e_k^2 + t) with sum (q_k / e_k)^2 = 1 (Eberly, Distance
 * from a point to an ellipse, an ellipsoid, or a hyperellipsoid, 2013). e falls, p >= 0. */
static double excess(const double e[3], const double p[3], double t) {
    double sum = -1;
    for (int k = 0; k < 3; k++) {
        double q = p[k] > 0 ? e[k] * p[k] / (e[k] * e[k] + t) : 0;
        sum += q * q;
    }
    return sum;
}

static void nearest_in_octant(const double e[3], const double p[3], double q[3]) {
    double low = -e[2] * e[2] + e[2] * p[2], high = -e[2] * e[2], reach = 0;
    for (int k = 0; k < 3; k++) reach += e[k] * e[k] * p[k] * p[k];
    high += sqrt(reach);
    if (!(p[2] > 0) && !(excess(e, p, low) > 0)) { /* on the disc inside: straight to the side */
        double rest = 1;
        for (int k = 0; k < 2; k++) {
            double below = e[k] * e[k] + low;
            q[k] = p[k] > 0 && below > 0 ? e[k] * e[k] * p[k] / below : 0;
            rest -= (q[k] / e[k]) * (q[k] / e[k]);
        }
        q[2] = e[2] * sqrt(rest > 0 ? rest : 0);
        return;
    }
    for (int i = 0; i < 110 && low < high; i++) {
        double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) break;
        *(excess(e, p, middle) > 0 ? &low : &high) = middle;
    }
    for (int k = 0; k < 3; k++)
        q[k] = p[k] > 0 ? e[k] * e[k] * p[k] / (e[k] * e[k] + 0.5 * (low + high)) : 0;
}

static double ellipsoid_distance(const double half[3], shape_vec point, shape_vec *nearest,
                                 shape_vec *normal) {
    const double at[3] = {point.x, point.y, point.z};
    int order[3] = {0, 1, 2};
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            if (half[order[j]] < half[order[j + 1]]) {
                int swap = order[j];
                order[j] = order[j + 1], order[j + 1] = swap;
            }
    double e[3], p[3], q[3], found[3], inside = -1;
    for (int k = 0; k < 3; k++) e[k] = half[order[k]], p[k] = fabs(at[order[k]]);
    nearest_in_octant(e, p, q);
    for (int k = 0; k < 3; k++) {
        found[order[k]] = at[order[k]] < 0 ? -q[k] : q[k];
        inside += p[k] / e[k] * (p[k] / e[k]);
    }
    *nearest = sv(found[0], found[1], found[2]);
    *normal = sv_unit(sv(found[0] / (half[0] * half[0]), found[1] / (half[1] * half[1]),
                         found[2] / (half[2] * half[2])));
    double d = sv_distance(point, *nearest);
    return inside < 0 ? -d : d;
}

double shape_solid_distance(const shape_solid *s, shape_vec p, shape_vec *nearest,
                            shape_vec *normal) {
    SHAPE_ASSERT(s);
    shape_vec q, n;
    if (!nearest) nearest = &q;
    if (!normal) normal = &n;
    const double *z = s->size;
    switch (s->kind) {
    case SHAPE_SPHERE:
        return sphere_distance(z[0], p, nearest, normal);
    case SHAPE_ELLIPSOID:
        return ellipsoid_distance(z, p, nearest, normal);
    case SHAPE_CUBE:
        return block_distance((double[3]){z[0] / 2, z[0] / 2, z[0] / 2}, p, nearest, normal);
    case SHAPE_BLOCK:
        return block_distance((double[3]){z[0] / 2, z[1] / 2, z[2] / 2}, p, nearest, normal);
    case SHAPE_PARALLELEPIPED:
        return block_distance((double[3]){z[0] / 2, z[1] / 2, z[1] / 2}, p, nearest, normal);
    case SHAPE_TETRAHEDRON:
        return tetrahedron_distance(z[0], p, nearest, normal);
    case SHAPE_TORUS:
        return torus_distance(s, p, nearest, normal);
    default:
        return turned_distance(s, p, nearest, normal);
    }
}
