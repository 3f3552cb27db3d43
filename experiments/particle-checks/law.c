/* law.c - the contact of A00 1.8 to 1.21 with the tangential dashpot that its Fig. 3.8 and 3.11
 * need: it comes on top of friction, which limits the spring alone. (The engine's own laws limit
 * spring and dashpot together, so that no contact resists with more than mu F_n.)
 *
 *     F_n = 4/3 E* sqrt(R d) d + 2 beta_n sqrt(k_n m) d'       k_n = 2 E* sqrt(R d)
 *     F_t = S - 2 beta_t sqrt(k_t m) v_t                        k_t = 8 G* sqrt(R d)
 *     dS = -k_t v_t dt, |S| <= mu F_n
 *
 * Parameters: beta_n, beta_t. */
#include <math.h>

#include "engine/clast_law.h"

static void printed(const clast_law_pair *pair, const clast_law_touch *touch,
                    clast_law_history *history, clast_law_force *force) {
    double a = sqrt(pair->radius * touch->overlap), *kept = history->spring;
    double k_n = 2 * pair->e_star * a, k_t = 8 * pair->g_star * a;
    double c_n = 2 * pair->parameter[0] * sqrt(k_n * pair->mass);
    double c_t = 2 * pair->parameter[1] * sqrt(k_t * pair->mass);
    force->elastic = 2.0 / 3 * k_n * touch->overlap;
    force->normal = fmax(0, force->elastic + c_n * touch->rate);
    force->normal_energy = 4.0 / 15 * k_n * touch->overlap * touch->overlap;
    double spring[3], square = 0, limit = pair->friction * force->normal;
    for (int i = 0; i < 3; i++) {
        spring[i] = kept[i] - k_t * touch->dt * touch->slip[i];
        square += spring[i] * spring[i];
    }
    double clip = square > limit * limit ? limit / sqrt(square) : 1;
    for (int i = 0; i < 3; i++) {
        spring[i] *= clip;
        if (touch->dt > 0) kept[i] = spring[i];
        force->tangential[i] = spring[i] - c_t * touch->slip[i];
    }
    force->tangential_energy = 0.5 * clip * clip * square / k_t;
}

const clast_law_entry printed_law = {CLAST_LAW_VERSION, printed};
