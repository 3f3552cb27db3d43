#include "shapes/numbers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "shapes/check.h"

void shape_panic(const char *file, int line, const char *what) {
    fprintf(stderr, "%s:%d: broken promise: %s\n", file, line, what);
    abort();
}

/* atan of t in [0, 1]: three times the half angle brings it below tan(pi / 32), where the first
 * term left out, t^19 / 19, is below 1e-20. */
static double arc(double t) {
    for (int i = 0; i < 3; i++) t = t / (1 + sqrt(1 + t * t));
    double square = t * t, sum = 0;
    for (int k = 17; k >= 3; k -= 2) sum = ((k & 2) ? -1.0 / k : 1.0 / k) + square * sum;
    return 8 * (t + t * (square * sum));
}

double shape_atan2(double y, double x) {
    double a = fabs(x), b = fabs(y);
    if (!(a > 0 || b > 0)) return 0;
    double angle = b <= a ? arc(b / a) : SHAPE_PI / 2 - arc(a / b);
    if (x < 0) angle = SHAPE_PI - angle;
    return y < 0 ? -angle : angle;
}

double shape_acos(double x) {
    x = x > 1 ? 1 : x < -1 ? -1 : x;
    return shape_atan2(sqrt((1 - x) * (1 + x)), x);
}

double shape_asin(double x) {
    x = x > 1 ? 1 : x < -1 ? -1 : x;
    return shape_atan2(x, sqrt((1 - x) * (1 + x)));
}

/* Taylor series to the 19th power on |angle| <= pi/4. */
void shape_sincos(double angle, double *sine, double *cosine) {
    SHAPE_ASSERT(fabs(angle) <= 1e4);
    double quarter = floor(angle * (2 / SHAPE_PI) + 0.5);
    /* pi/2 in two parts: the product with the first is exact */
    double rest =
        (angle - quarter * 1.57079632673412561417e+00) - quarter * 6.07710050650619224932e-11;
    double s = 0, c = 0, term = 1;
    for (int n = 0; n < 20; n++) {
        *(n % 2 ? &s : &c) += n % 4 < 2 ? term : -term;
        term *= rest / (n + 1);
    }
    static const int SIGN_S[4] = {1, 1, -1, -1}, SIGN_C[4] = {1, -1, -1, 1};
    int q = (int)((long)quarter & 3);
    *sine = SIGN_S[q] * (q % 2 ? c : s);
    *cosine = SIGN_C[q] * (q % 2 ? s : c);
}

/* splitmix64 (Steele, Lea, Flood 2014) of both numbers. */
double shape_random(uint64_t stream, uint64_t place) {
    uint64_t z = (stream + 1) * 0x9e3779b97f4a7c15u + place * 0xd1342543de82ef95u;
    for (int i = 0; i < 2; i++) {
        z += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        z ^= z >> 31;
    }
    return (double)(z >> 11) * 0x1p-53;
}

double shape_even(int dimensions, int k, uint64_t i) {
    /* powers of 1/x with x^(d+1) = x + 1 */
    static const double STEP[3][3] = {
        {0.61803398874989484820, 0, 0},
        {0.75487766624669276005, 0.56984029099805326591, 0},
        {0.81917251339616443970, 0.67104360670378920842, 0.54970047790197026694}};
    SHAPE_ASSERT(dimensions >= 1 && dimensions <= 3 && k >= 0 && k < dimensions);
    double at = 0.5 + (double)i * STEP[dimensions - 1][k];
    return at - floor(at);
}
