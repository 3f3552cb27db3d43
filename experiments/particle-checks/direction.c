/* direction.c - A00 3.8 and Appendix E: by how much a contact between clumps is off the normal of
 * the surface that they stand for. */
#include <math.h>
#include <stdlib.h>

#include "experiments/particle-checks/checks.h"

static double degrees(double radians) {
    return radians * 180 / CHECKS_PI;
}

direction direction_of(double r1, double r2, double smallest, double distance) {
    double a = r2 + smallest, b = r1 + smallest, l = distance;
    double theta = asin((r2 - r1) / l);
    double alpha = acos((b * b + l * l - a * a) / (2 * l * b));
    double beta = acos((a * a + l * l - b * b) / (2 * l * a));
    double gamma = acos((a * a - l * l + b * b) / (2 * a * b));
    double gamma1 = CHECKS_PI / 2 + theta - alpha;
    double depth = smallest + r1 * (1 - 1 / cos(gamma1)); /* o_s k of 3.20 */
    return (direction){.theta = degrees(theta),
                       .alpha = degrees(alpha),
                       .beta = degrees(beta),
                       .gamma = degrees(gamma),
                       .gamma1 = degrees(gamma1),
                       .gamma2 = degrees(gamma - gamma1),
                       .dx = smallest * sin(gamma1),
                       .dy = (smallest - depth) * cos(gamma1)};
}

/* ---- the button ------------------------------------------------------------------------------ */

enum { SPHERES = 7 }; /* half axes 0.69 and 0.53 cm, A00 Table 4.3 and 4.3.1 */

static void fit_button(clast_vec3 *centre, double *radius) {
    if (clast_fit_ellipse(0.0069, 0.0053, SPHERES, centre, radius)) abort();
}

button_end button_end_of(void) {
    clast_vec3 centre[SPHERES];
    double radius[SPHERES];
    fit_button(centre, radius);
    return (button_end){radius[0], radius[1], centre[1].x - centre[0].x};
}

/* ---- in the engine --------------------------------------------------------------------------- */

/* A button and its smallest sphere, pressed into the nest at the button's end by a millionth. */
static clast_world *nest_new(const button_end *e, const direction *d) {
    const double press = 1e-6;
    clast_vec3 centre[SPHERES];
    double radius[SPHERES];
    fit_button(centre, radius);
    clast_world_def def = clast_world_def_default();
    def.gravity = (clast_vec3){0, 0, 0};
    def.threads = 1;
    clast_world *w = clast_world_new(&def);
    int matter =
        clast_material_add(w, &(clast_material_def){"matter", matter_density(), 1e9, POISSON});
    clast_pair_set(w, matter, matter, &(clast_pair_def){.restitution = 1});
    clast_vec3 any = {1e-9, 1e-9, 1e-9};
    clast_shape_def button = {.name = "button",
                              .material = matter,
                              .spheres = SPHERES,
                              .centre = centre,
                              .radius = radius,
                              .mass = 3e-4,
                              .inertia = any};
    clast_body_add(w, &(clast_body_def){.shape = clast_shape_add(w, &button)});
    int probe = clast_shape_add_sphere(w, "probe", e->r1, matter);
    double angle = d->alpha * CHECKS_PI / 180, reach = (1 - press) * 2 * e->r1;
    clast_vec3 at = {centre[0].x + reach * cos(angle), 0, reach * sin(angle)};
    clast_body_add(w, &(clast_body_def){.shape = probe, .position = at});
    return w;
}

void direction_measured(double *gamma1, double *gamma2) {
    button_end e = button_end_of();
    direction d = direction_of(e.r1, e.r2, e.r1, e.distance);
    clast_world *w = nest_new(&e, &d);
    clast_contact contact[8];
    *gamma1 = *gamma2 = NAN;
    if (clast_world_prepare(w)) abort();
    size_t count = clast_world_contacts(w, contact, 8);
    for (size_t i = 0; i < count && i < 8; i++) {
        /* on the button, hence turned round */
        double off = degrees(atan2(-contact[i].force.z, -contact[i].force.x)) - (90 + d.theta);
        if (contact[i].sphere_a == 0) *gamma1 = -off;
        if (contact[i].sphere_a == 1) *gamma2 = off;
    }
    world_end(w);
}
