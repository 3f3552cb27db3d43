/* Two of the engine's laws, written as laws of the user's own: to the last digits the same. Beside
 * them, an entry of a version that does not exist.
 *
 * Parameters: k_n (N/m), k_t (N/m), damping ratio, hidden friction and cohesion (N); Walton-Braun
 * k_1 and k_2 (N/m). */
#include <math.h>

#include "engine/clast_law.h"

static double length(const double a[3]) {
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

static void clip(double a[3], double limit) {
    double size = length(a), keep = size > limit ? limit / size : 1;
    for (int k = 0; k < 3; k++) a[k] *= keep;
}

static void linear(const clast_law_pair *pair, const clast_law_touch *touch,
                   clast_law_history *history, clast_law_force *force) {
    double k_n = pair->parameter[0], k_t = pair->parameter[1], ratio = pair->parameter[2];
    double c_n = 2 * ratio * sqrt(k_n * pair->mass), c_t = 2 * ratio * sqrt(k_t * pair->mass);
    force->elastic = k_n * touch->overlap;
    force->normal = fmax(0, force->elastic + c_n * touch->rate);
    force->normal_energy = 0.5 * k_n * touch->overlap * touch->overlap;
    double limit = pair->friction * force->normal + pair->cohesion;
    if (touch->dt > 0) {
        for (int k = 0; k < 3; k++) history->spring[k] -= k_t * touch->dt * touch->slip[k];
        clip(history->spring, limit);
    }
    for (int k = 0; k < 3; k++) force->tangential[k] = history->spring[k] - c_t * touch->slip[k];
    clip(force->tangential, limit);
    double stretch = length(history->spring);
    force->tangential_energy = 0.5 * stretch * stretch / k_t;
}

/* The same with a friction that only the law knows of: the fourth parameter. */
static void hidden_friction(const clast_law_pair *pair, const clast_law_touch *touch,
                            clast_law_history *history, clast_law_force *force) {
    clast_law_pair own = *pair;
    own.friction = pair->parameter[3];
    own.cohesion = pair->parameter[4];
    linear(&own, touch, history, force);
}

/* F = k_2 (d - p), p at least (1 - k_1 / k_2) d: the overlap p at which unloading ends is what the
 * contact remembers. */
static void plastic(const clast_law_pair *pair, const clast_law_touch *touch,
                    clast_law_history *history, clast_law_force *force) {
    double k_1 = pair->parameter[0], k_2 = pair->parameter[1];
    double left = fmax(history->memory, (1 - k_1 / k_2) * touch->overlap);
    double rest = fmax(0, touch->overlap - left);
    force->normal = force->elastic = k_2 * rest;
    force->normal_energy = 0.5 * k_2 * rest * rest;
    if (touch->dt > 0) history->memory = left;
}

const clast_law_entry linear_again = {CLAST_LAW_VERSION, linear};
const clast_law_entry hidden_again = {CLAST_LAW_VERSION, hidden_friction};
const clast_law_entry plastic_again = {CLAST_LAW_VERSION, plastic};
const clast_law_entry of_tomorrow = {CLAST_LAW_VERSION + 1, linear};
