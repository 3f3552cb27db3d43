/* A contact law of one's own: Kelvin-Voigt with a quadratic dashpot, so that fast impacts lose more
 * than slow ones, and friction without a spring.
 *
 *     F_n = k delta + q |delta'| delta'      never a pull
 *     F_t = the smaller of c |slip| and mu F_n, against the slip
 *
 * Parameters: k (N/m), q (N s2/m2), c (N s/m). */
#include <math.h>

#include "engine/clast_law.h"

static void quadratic(const clast_law_pair *pair, const clast_law_touch *touch,
                      clast_law_history *history, clast_law_force *force) {
    (void)history; /* the force is one of the moment */
    double k = pair->parameter[0], q = pair->parameter[1], c = pair->parameter[2];
    force->elastic = k * touch->overlap;
    force->normal = fmax(0, force->elastic + q * fabs(touch->rate) * touch->rate);
    force->normal_energy = 0.5 * k * touch->overlap * touch->overlap;
    const double *slip = touch->slip;
    double speed = sqrt(slip[0] * slip[0] + slip[1] * slip[1] + slip[2] * slip[2]);
    double limit = pair->friction * force->normal, most = c * speed;
    double share = most > limit ? limit / most : 1;
    for (int k3 = 0; k3 < 3; k3++) force->tangential[k3] = -share * c * slip[k3];
}

const clast_law_entry quadratic_dashpot = {CLAST_LAW_VERSION, quadratic};
