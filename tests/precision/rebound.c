/* rebound.c - error of a normal and of an oblique collision against a double run of very fine step.
 */
#include "tests/precision/precision.h"

#include <math.h>

static const double RADIUS = 0.005, SPEED = 1; /* m, m/s */
enum { FINE = 200000, PHASES = 5 };

static clast_world *two_spheres(const rebound_wish *wish, double dt) {
    clast_world_def d = clast_world_def_default();
    d.gravity = (clast_vec3){0, 0, 0};
    d.precision = wish->precision;
    d.time_step = dt;
    d.impact_speed = SPEED * cos(wish->angle);
    d.threads = 1;
    d.max_overlap = 0.5, d.max_displacement = 0.5, d.max_residual = 1;
    clast_world *w = clast_world_new(&d);
    precision_demand(w, w);
    clast_material_add(w, &(clast_material_def){"grain", 2500, 5e7, 0.3});
    clast_pair_def pair = {.restitution = 0.8, .friction = 0.3};
    precision_demand(clast_pair_set(w, 0, 0, &pair) == CLAST_OK, w);
    clast_shape_add_sphere(w, "sphere", RADIUS, 0);
    double vn = SPEED * cos(wish->angle), vt = SPEED * sin(wish->angle);
    double gap = vn * dt * (1 + wish->phase);
    clast_vec3 at = {0.3713, -0.2097, 0.5311}, above = at;
    above.z += 2 * RADIUS + gap;
    clast_body_def lower = {.position = at, .velocity = {-vt / 2, 0, vn / 2}};
    clast_body_def upper = {.position = above, .velocity = {vt / 2, 0, -vn / 2}};
    precision_demand(clast_body_add(w, &lower) == 0 && clast_body_add(w, &upper) == 1, w);
    precision_demand(clast_world_prepare(w) == CLAST_OK, w);
    return w;
}

static double contact_time(const rebound_wish *wish) {
    clast_world *w = two_spheres(wish, 1e-7);
    double time = clast_world_plan(w).contact_time;
    clast_world_free(w);
    return time;
}

static rebound_state state_of(clast_world *w) {
    clast_bodies b = clast_world_bodies(w);
    size_t lower = b.id[0] == 0 ? 0 : 1, upper = 1 - lower;
    const double *v[3] = {b.vx, b.vy, b.vz}, *spin[3] = {b.wx, b.wy, b.wz};
    rebound_state s;
    for (int k = 0; k < 3; k++) {
        s.v[k] = (v[k][upper] - v[k][lower]) / SPEED;
        s.spin[k] = spin[k][upper] * RADIUS / SPEED;
    }
    return s;
}

rebound_state rebound_of(const rebound_wish *wish) {
    double dt = contact_time(wish) / wish->resolution;
    clast_world *w = two_spheres(wish, dt);
    for (long i = 0; i < (long)(2 * wish->resolution) + 10; i++)
        precision_demand(clast_world_step(w) == CLAST_OK, w);
    rebound_state s = state_of(w);
    precision_demand(clast_world_contacts(w, NULL, 0) == 0 && s.v[2] > 0, w);
    clast_world_free(w);
    return s;
}

double rebound_distance(const rebound_state *a, const rebound_state *b) {
    double sum = 0;
    for (int k = 0; k < 3; k++)
        sum += (a->v[k] - b->v[k]) * (a->v[k] - b->v[k]) +
               (a->spin[k] - b->spin[k]) * (a->spin[k] - b->spin[k]);
    return sqrt(sum);
}

/* Root of the mean square over where in the step the contact begins. */
static void measure(const precision_table *t, const char *of, double angle, double resolution,
                    const rebound_state *reference) {
    double square[2] = {0, 0}, rounding = 0;
    for (int phase = 0; phase < PHASES; phase++) {
        rebound_state s[2];
        for (int p = 0; p < 2; p++) {
            s[p] = rebound_of(
                &(rebound_wish){(clast_precision)p, angle, resolution, (phase + 0.5) / PHASES});
            double off = rebound_distance(&s[p], reference);
            square[p] += off * off / PHASES;
        }
        double apart = rebound_distance(&s[0], &s[1]);
        rounding += apart * apart / PHASES;
    }
    for (int p = 0; p < 2; p++)
        precision_row(t, "rebound", of, PRECISION_NAMES[p], resolution, sqrt(square[p]), NAN);
    precision_row(t, "rounding", of, "mixed", resolution, sqrt(rounding), NAN);
}

void measure_rebound(const precision_table *t) {
    static const double ANGLES[2] = {0, 0.6}, /* rad */
        RESOLUTIONS[] = {10, 20, 30, 50, 100, 200, 500, 1000, 3000, 10000};
    static const char *const NAMES[2] = {"normal", "oblique"};
    for (int i = 0; i < 2; i++) {
        rebound_state reference =
            rebound_of(&(rebound_wish){CLAST_PRECISION_DOUBLE, ANGLES[i], FINE, 0.5});
        for (size_t k = 0; k < sizeof RESOLUTIONS / sizeof *RESOLUTIONS; k++)
            measure(t, NAMES[i], ANGLES[i], RESOLUTIONS[k], &reference);
    }
}
