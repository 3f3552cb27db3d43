#include "shapes/profile.h"

#include <stdlib.h>
#include <string.h>

#include "shapes/check.h"
#include "shapes/lathe.h"
#include "shapes/numbers.h"

static const double SMOOTH = 0.86602540378443864676; /* cos 30 degrees */

const char *shape_profile_fault(double (*at)[2], int count, int *which) {
    *which = 0;
    if (count < 3) return "fewer than three points";
    if (count > SHAPE_PROFILE_MAX) return "more than 20000 points";
    double widest = 0;
    for (int i = 0; i < count; i++) {
        *which = i;
        if (!isfinite(at[i][0]) || !isfinite(at[i][1])) return "a point that is not finite";
        if (at[i][1] < 0) return "a point below the axis";
        if (i > 0 && !(at[i][0] > at[i - 1][0])) return "an x that is not above the one before";
        if (i > 0 && i + 1 < count && !(at[i][1] > 0)) return "an inner point on the axis";
        widest = fmax(widest, at[i][1]);
    }
    return widest > 0 ? NULL : "no point off the axis";
}

/* ---- normals
 * ------------------------------------------------------------------------------------- */

static void own_normal(const shape_profile *p, int piece, double n[2]) {
    double dx = p->at[piece + 1][0] - p->at[piece][0], dr = p->at[piece + 1][1] - p->at[piece][1];
    double length = sqrt(dx * dx + dr * dr);
    n[0] = -dr / length, n[1] = dx / length;
}

static double piece_length(const shape_profile *p, int piece) {
    double dx = p->at[piece + 1][0] - p->at[piece][0], dr = p->at[piece + 1][1] - p->at[piece][1];
    return sqrt(dx * dx + dr * dr);
}

/* The shorter piece tells more of the direction at the point between: weights 1 / length. */
static void smooth(shape_profile *p, int left, int right) {
    double a[2], b[2];
    own_normal(p, left, a), own_normal(p, right, b);
    if (a[0] * b[0] + a[1] * b[1] < SMOOTH) return;
    double u = 1 / piece_length(p, left), v = 1 / piece_length(p, right);
    double n[2] = {u * a[0] + v * b[0], u * a[1] + v * b[1]};
    double length = sqrt(n[0] * n[0] + n[1] * n[1]);
    for (int k = 0; k < 2; k++) p->normal[left][2 + k] = p->normal[right][k] = n[k] / length;
}

/* On the axis the outline goes on as its mirror image: a steep tip is round. */
static void smooth_tip(double normal[2], double side) {
    double turn = normal[0] * normal[0] - normal[1] * normal[1]; /* cosine across the axis */
    if (turn >= SMOOTH) normal[0] = side, normal[1] = 0;
}

static void find_normals(shape_profile *p) {
    int pieces = p->count - 1;
    for (int i = 0; i < pieces; i++) {
        own_normal(p, i, p->normal[i]);
        memcpy(p->normal[i] + 2, p->normal[i], 2 * sizeof(double));
    }
    for (int i = 0; i + 1 < pieces; i++) smooth(p, i, i + 1);
    smooth_tip(p->normal[0], -1);
    smooth_tip(p->normal[pieces - 1] + 2, 1);
}

/* ---- making one
 * ---------------------------------------------------------------------------------- */

shape_profile shape_profile_new(double (*at)[2], int count) {
    int which;
    SHAPE_ASSERT(at && !shape_profile_fault(at, count, &which));
    bool left = at[0][1] > 0, right = at[count - 1][1] > 0;
    shape_profile p = {.count = count + left + right};
    p.at = malloc((size_t)p.count * sizeof *p.at);
    p.normal = malloc((size_t)p.count * sizeof *p.normal);
    SHAPE_ASSERT(p.at && p.normal);
    memcpy(p.at + left, at, (size_t)count * sizeof *at);
    if (left) p.at[0][0] = at[0][0], p.at[0][1] = 0;
    if (right) p.at[p.count - 1][0] = at[count - 1][0], p.at[p.count - 1][1] = 0;
    find_normals(&p);
    return p;
}

shape_profile shape_profile_of(double height(const void *context, double x), const void *context,
                               double from, double to, int points) {
    SHAPE_ASSERT(height && from < to && points >= 3 && points <= SHAPE_PROFILE_MAX);
    double(*at)[2] = malloc((size_t)points * sizeof *at);
    SHAPE_ASSERT(at);
    for (int i = 0; i < points; i++) {
        double s, c;
        shape_sincos(SHAPE_PI * i / (points - 1), &s, &c);
        double x = i == 0 ? from : i == points - 1 ? to : 0.5 * (from + to) - 0.5 * (to - from) * c;
        at[i][0] = x, at[i][1] = height(context, x);
    }
    shape_profile p = shape_profile_new(at, points);
    free(at);
    return p;
}

void shape_profile_free(shape_profile *p) {
    free(p->at), free(p->normal);
    *p = (shape_profile){0};
}

/* ---- mass
 * ---------------------------------------------------------------------------------------- */

/* Frusta; three Gauss points integrate x^2 rho^2 and rho^4 of a straight piece exactly. */
shape_mass shape_profile_mass(const shape_profile *p) {
    static const double POINT[3] = {-0.77459666924148337704, 0, 0.77459666924148337704};
    static const double WEIGHT[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
    double middle = 0.5 * (p->at[0][0] + p->at[p->count - 1][0]), reach = 0;
    shape_moments m = {.about = sv(middle, 0, 0)};
    for (int i = 0; i + 1 < p->count; i++) {
        double half = 0.5 * (p->at[i + 1][0] - p->at[i][0]);
        for (int g = 0; g < 3; g++) {
            double t = 0.5 * (1 + POINT[g]), w = SHAPE_PI * half * WEIGHT[g];
            double x = p->at[i][0] + 2 * half * t - middle;
            double r = p->at[i][1] + (p->at[i + 1][1] - p->at[i][1]) * t, r2 = r * r;
            m.volume += w * r2;
            m.first.x += w * r2 * x;
            m.second[0][0] += w * r2 * x * x;
            m.second[1][1] += w * r2 * r2 / 4;
        }
        reach = fmax(reach, fabs(p->at[i][0] - middle) + p->at[i][1]);
    }
    m.second[2][2] = m.second[1][1];
    return shape_mass_of(&m, 16 * 0x1p-52 * m.volume * p->count, reach);
}

/* ---- distance
 * -------------------------------------------------------------------------------------- */

static void normal_at(const shape_profile *p, int piece, double t, double n[2]) {
    const double *of = p->normal[piece];
    n[0] = of[0] + t * (of[2] - of[0]), n[1] = of[1] + t * (of[3] - of[1]);
    double length = sqrt(n[0] * n[0] + n[1] * n[1]);
    n[0] /= length, n[1] /= length;
}

/* Above the outline or beside it, when counted along a line away from the axis. */
static bool is_inside(const shape_profile *p, double x, double rho) {
    if (!(x > p->at[0][0]) || !(x < p->at[p->count - 1][0])) return false;
    int low = 0, high = p->count - 1;
    while (high - low > 1) {
        int half = (low + high) / 2;
        *(p->at[half][0] <= x ? &low : &high) = half;
    }
    double width = p->at[low + 1][0] - p->at[low][0];
    double t = width > 0 ? (x - p->at[low][0]) / width : 0;
    return rho < p->at[low][1] + t * (p->at[low + 1][1] - p->at[low][1]);
}

double shape_profile_distance(const shape_profile *p, shape_vec point, shape_vec *nearest,
                              shape_vec *normal) {
    double rho = sqrt(point.y * point.y + point.z * point.z), closest = HUGE_VAL, best_t = 0;
    int piece = 0;
    for (int i = 0; i + 1 < p->count; i++) {
        double dx = p->at[i + 1][0] - p->at[i][0], dr = p->at[i + 1][1] - p->at[i][1];
        double x = point.x - p->at[i][0], r = rho - p->at[i][1];
        double t = (x * dx + r * dr) / (dx * dx + dr * dr);
        t = t < 0 ? 0 : t > 1 ? 1 : t;
        double d = (x - t * dx) * (x - t * dx) + (r - t * dr) * (r - t * dr);
        if (d < closest) closest = d, piece = i, best_t = t;
    }
    double n[2], c = rho > 0 ? point.y / rho : 1, s = rho > 0 ? point.z / rho : 0;
    double x = p->at[piece][0] + best_t * (p->at[piece + 1][0] - p->at[piece][0]);
    double r = p->at[piece][1] + best_t * (p->at[piece + 1][1] - p->at[piece][1]);
    normal_at(p, piece, best_t, n);
    if (nearest) *nearest = sv(x, r * c, r * s);
    if (normal) *normal = sv(n[0], n[1] * c, n[1] * s);
    return is_inside(p, point.x, rho) ? -sqrt(closest) : sqrt(closest);
}

shape_mesh shape_profile_mesh(const shape_profile *p) {
    return shape_lathe(p->at, p->count, 64);
}

/* ---- spheres on the profile
 * ------------------------------------------------------------------------ */

typedef struct step {
    int piece;
    double t, x, rho;
} step;

/* The first place along the outline whose distance from `at` is `chord`; false past the end. */
static bool walk(const shape_profile *p, double chord, step *at) {
    for (int i = at->piece; i + 1 < p->count; i++) {
        double ex = p->at[i + 1][0] - at->x, er = p->at[i + 1][1] - at->rho;
        if (ex * ex + er * er < chord * chord) continue;
        double dx = p->at[i + 1][0] - p->at[i][0], dr = p->at[i + 1][1] - p->at[i][1];
        double ax = p->at[i][0] - at->x, ar = p->at[i][1] - at->rho;
        double square = dx * dx + dr * dr, along = (ax * dx + ar * dr) / square;
        double off = (ax * ax + ar * ar - chord * chord) / square;
        double root = along * along - off;
        double t = -along + sqrt(root > 0 ? root : 0);
        t = t < 0 ? 0 : t > 1 ? 1 : t;
        *at = (step){i, t, p->at[i][0] + t * dx, p->at[i][1] + t * dr};
        return true;
    }
    return false;
}

/* True when `count` chords and one more would pass the right end. */
static bool overshoots(const shape_profile *p, double chord, int count, step *steps) {
    step at = {0, 0, p->at[0][0], p->at[0][1]};
    for (int i = 0; i < count; i++) {
        if (!walk(p, chord, &at)) return true;
        steps[i] = at;
    }
    double x = p->at[p->count - 1][0] - at.x, r = p->at[p->count - 1][1] - at.rho;
    return x * x + r * r < chord * chord;
}

int shape_profile_fit(const shape_profile *p, int count, shape_sphere *spheres) {
    SHAPE_ASSERT(p && spheres && count >= 1);
    step *steps = malloc((size_t)count * sizeof *steps);
    SHAPE_ASSERT(steps);
    double low = 0, high = 0;
    for (int i = 0; i + 1 < p->count; i++) high += piece_length(p, i);
    for (int i = 0; i < 80; i++) {
        double chord = 0.5 * (low + high);
        *(overshoots(p, chord, count, steps) ? &high : &low) = chord;
    }
    overshoots(p, low, count, steps);
    int kept = 0;
    for (int i = 0; i < count; i++) {
        double n[2];
        normal_at(p, steps[i].piece, steps[i].t, n);
        if (n[1] < 0.02 || !(steps[i].rho > 0)) continue;
        /* r = y / cos(theta), x_c = x + y tan(theta), A00 2.3 */
        double x = steps[i].x - steps[i].rho * n[0] / n[1];
        spheres[kept++] = (shape_sphere){sv(x, 0, 0), steps[i].rho / n[1]};
    }
    free(steps);
    return kept;
}
