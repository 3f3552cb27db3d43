#include "shapes/quality.h"

#include <stdlib.h>

#include "shapes/check.h"
#include "shapes/deviation.h"
#include "shapes/numbers.h"

enum { POINTS = 4000, MEETINGS = 256 };

bool shape_row_deviation(double r1, double r2, double l, double rs, double deviation[2]) {
    SHAPE_ASSERT(r1 > 0 && r2 >= r1 && l > 0 && rs > 0 && deviation);
    double a = r1 + rs, b = r2 + rs;
    if (r2 - r1 >= l || a + b <= l) return false;
    double theta = shape_asin((r2 - r1) / l);                         /* 3.16 */
    double alpha = shape_acos((a * a + l * l - b * b) / (2 * l * a)); /* 3.18 */
    double gamma = shape_acos((a * a + b * b - l * l) / (2 * a * b));
    deviation[0] = SHAPE_PI / 2 + theta - alpha; /* 3.19 */
    deviation[1] = gamma - deviation[0];
    return true;
}

/* ---- surface
 * --------------------------------------------------------------------------------------- */

static double distance_to(const shape_sphere *spheres, int count, shape_vec p) {
    double nearest = HUGE_VAL;
    for (int i = 0; i < count; i++)
        nearest = fmin(nearest, sv_distance(p, spheres[i].centre) - spheres[i].radius);
    return nearest > 0 ? nearest : 0;
}

/* Angle between the normal of the target and the contact of a sphere of radius `probe` that comes
 * down along it; negative when it meets nothing. */
static double contact_angle(const shape_sphere *spheres, int count, shape_vec p, shape_vec normal,
                            double probe) {
    double highest = -HUGE_VAL;
    int touched = -1;
    for (int i = 0; i < count; i++) {
        shape_vec arm = sv_sub(p, spheres[i].centre);
        double along = sv_dot(arm, normal), r = spheres[i].radius + probe;
        double gap = r * r - (sv_dot(arm, arm) - along * along);
        if (gap <= 0 || sqrt(gap) - along <= highest) continue;
        highest = sqrt(gap) - along;
        touched = i;
    }
    if (touched < 0) return -1;
    shape_vec at = sv_along(p, highest, normal);
    shape_vec contact = sv_unit(sv_sub(at, spheres[touched].centre));
    return shape_atan2(sv_norm(sv_cross(contact, normal)), sv_dot(contact, normal));
}

static int compare(const void *a, const void *b) {
    const double *p = a, *q = b;
    return *p < *q ? -1 : *p > *q ? 1 : 0;
}

static double smallest_radius(const shape_sphere *spheres, int count) {
    double smallest = HUGE_VAL;
    for (int i = 0; i < count; i++) smallest = fmin(smallest, spheres[i].radius);
    return smallest;
}

static void measure_surface(shape_quality *q, const shape_target *t, const shape_sphere *spheres,
                            int count) {
    shape_vec *point = malloc(POINTS * sizeof *point), *normal = malloc(POINTS * sizeof *normal);
    double *angle = malloc(POINTS * sizeof *angle), probe = smallest_radius(spheres, count);
    SHAPE_ASSERT(point && normal && angle);
    shape_target_samples(t, POINTS, point, normal);
    int met = 0;
    for (int i = 0; i < POINTS; i++) {
        double d = distance_to(spheres, count, point[i]);
        q->deviation_mean += d / POINTS;
        double a = contact_angle(spheres, count, point[i], normal[i], probe);
        if (a >= 0) angle[met++] = a;
    }
    qsort(angle, (size_t)met, sizeof *angle, compare);
    if (met > 0) q->normal_max = angle[met - 1], q->normal_95 = angle[(int)(0.95 * (met - 1))];
    double half_s, half_c;
    shape_sincos(0.5 * q->normal_95, &half_s, &half_c);
    q->friction = half_s / half_c;
    free(point), free(normal), free(angle);
}

/* ---- cost
 * -------------------------------------------------------------------------------------------- */

/* A rotation, uniform over all of them (Shoemake 1992), from an even sequence. */
static void any_rotation(uint64_t i, double m[3][3]) {
    double u = shape_even(3, 0, i), s1, c1, s2, c2;
    shape_sincos(2 * SHAPE_PI * shape_even(3, 1, i), &s1, &c1);
    shape_sincos(2 * SHAPE_PI * shape_even(3, 2, i), &s2, &c2);
    double a = sqrt(1 - u), b = sqrt(u), x = a * s1, y = a * c1, z = b * s2, w = b * c2;
    const double rows[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                               {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                               {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
    for (int k = 0; k < 9; k++) m[k / 3][k % 3] = rows[k / 3][k % 3];
}

/* Moves `other` against `one` along x from afar until they touch; counts pairs closer than each of
 * two gaps. */
static void meet(const shape_sphere *one, const shape_sphere *other, int count, const double gap[2],
                 double pairs[2]) {
    double touch = -HUGE_VAL;
    for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j++) {
            shape_vec arm = sv_sub(other[j].centre, one[i].centre);
            double r = one[i].radius + other[j].radius;
            double side = r * r - arm.y * arm.y - arm.z * arm.z;
            if (side > 0) touch = fmax(touch, sqrt(side) - arm.x);
        }
    for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j++) {
            shape_vec arm = sv_sub(other[j].centre, one[i].centre);
            arm.x += touch;
            double r = one[i].radius + other[j].radius, square = sv_dot(arm, arm);
            for (int k = 0; k < 2; k++) pairs[k] += square <= (r + gap[k]) * (r + gap[k]);
        }
}

/* Contacts: pairs that touch once the first contact has an overlap of 1 % (and of 10 %) of `equal`,
 * the radius of the sphere of the same volume. */
static void count_pairs(shape_quality *q, const shape_sphere *spheres, int count, shape_vec middle,
                        double equal) {
    shape_sphere *one = malloc((size_t)count * sizeof *one),
                 *other = malloc((size_t)count * sizeof *one);
    SHAPE_ASSERT(one && other);
    double gap[2] = {0.01 * equal, 0.1 * equal};
    double pairs[2] = {0, 0};
    int meetings = count <= 100 ? MEETINGS : MEETINGS / 8;
    for (int n = 0; n < meetings; n++) {
        double a[3][3], b[3][3];
        any_rotation(2 * (uint64_t)n, a), any_rotation(2 * (uint64_t)n + 1, b);
        for (int i = 0; i < count; i++) {
            shape_vec c = sv_sub(spheres[i].centre, middle);
            one[i] = other[i] = spheres[i];
            one[i].centre = sv(a[0][0] * c.x + a[0][1] * c.y + a[0][2] * c.z,
                               a[1][0] * c.x + a[1][1] * c.y + a[1][2] * c.z,
                               a[2][0] * c.x + a[2][1] * c.y + a[2][2] * c.z);
            other[i].centre = sv(b[0][0] * c.x + b[0][1] * c.y + b[0][2] * c.z,
                                 b[1][0] * c.x + b[1][1] * c.y + b[1][2] * c.z,
                                 b[2][0] * c.x + b[2][1] * c.y + b[2][2] * c.z);
        }
        meet(one, other, count, gap, pairs);
    }
    q->contacts = pairs[0] / meetings, q->pairs = pairs[1] / meetings;
    free(one), free(other);
}

shape_quality shape_quality_of(const shape_target *t, const shape_sphere *spheres, int count) {
    SHAPE_ASSERT(t && spheres && count >= 1);
    shape_quality q = {0};
    measure_surface(&q, t, spheres, count);
    q.deviation_max = shape_deviation_max(t, spheres, count);
    for (int i = 0; i < count; i++) {
        double inside = -shape_target_distance(t, spheres[i].centre, NULL, NULL);
        q.protrusion = fmax(q.protrusion, spheres[i].radius - inside);
    }
    /* a printed number alone: cbrt may differ in its last bit */
    double equal = cbrt(t->mass.volume / (4 * SHAPE_PI / 3));
    count_pairs(&q, spheres, count, t->mass.centre, equal);
    q.step = smallest_radius(spheres, count) / equal;
    q.cost = q.contacts / q.step;
    return q;
}
