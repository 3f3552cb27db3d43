/* shape_report.c - levels of a clump as lines for people, as a template for scenes, as a table. */
#include "experiments/clast/shape_level.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "engine/check.h"
#include "experiments/scene/arena.h"

static const double DEGREE = 0.01745329251994329577;

static double smallest_radius(const shape_level *l) {
    double smallest = HUGE_VAL;
    for (int i = 0; i < l->clump.count; i++) smallest = fmin(smallest, l->clump.sphere[i].radius);
    return smallest;
}

/* Largest difference of a moment from that of the solid, both in the frame of the target, over the
 * largest moment. */
static double inertia_error(const shape_mass *a, const shape_mass *b) {
    double largest = 0, error = 0;
    for (int i = 0; i < 3; i++) {
        largest = fmax(largest, b->inertia[i][i]);
        for (int j = 0; j < 3; j++) error = fmax(error, fabs(a->inertia[i][j] - b->inertia[i][j]));
    }
    return error / largest;
}

/* ---- for people
 * ---------------------------------------------------------------------------------- */

static void print_mass(const char *what, const shape_mass *m, double density) {
    printf("  %-7s volume %.7g m3 (within %.1e), mass %.7g g, centre [%.4g, %.4g, %.4g] m\n", what,
           m->volume, m->volume_bound, 1e3 * density * m->volume, m->centre.x, m->centre.y,
           m->centre.z);
    printf("          inertia [%.7g, %.7g, %.7g] kg m2 (within %.1e)\n", density * m->inertia[0][0],
           density * m->inertia[1][1], density * m->inertia[2][2], m->inertia_bound);
}

static void print_level(const shape_sheet *s, const shape_level *l) {
    const shape_quality *q = &l->quality;
    const shape_clump *c = &l->clump;
    printf("%d spheres, radius %.4g mm and more: packing density %.3g%s\n", c->count,
           1e3 * smallest_radius(l), l->filling.density,
           l->filling.met ? "" : " (not what was asked for: no spheres left to place)");
    print_mass("union", &c->as_union, s->density);
    printf("          of the solid: volume %.2f %%, inertia off by %.2f %%\n",
           100 * c->as_union.volume / c->as_solid.volume,
           100 * inertia_error(&c->as_union, &c->as_solid));
    printf("  surface deviation %.4g mm in the mean, %.4g mm at most; sticks out %.3g mm at most\n",
           1e3 * q->deviation_mean, 1e3 * q->deviation_max, 1e3 * q->protrusion);
    printf("  contact normal off by %.2f deg on 95 %% of the surface, %.2f deg at most (A00 3.8)\n",
           q->normal_95 / DEGREE, q->normal_max / DEGREE);
    printf("  expected pseudo-friction %.3f (A00 3.7; tan of half the 95 %% angle)\n", q->friction);
    printf(
        "  cost: %.2f contacts of two that touch, %.1f pairs in the list, step %.3g of that of a "
        "sphere: %.3g\n",
        q->contacts, q->pairs, q->step, q->cost);
    printf("  placed in %.2f s, mass of the union in %.2g s\n", l->fill_s, l->mass_s);
}

void shape_print(const shape_sheet *s) {
    CLAST_ASSERT(s && s->count > 0);
    printf("%s\n", s->title);
    print_mass("solid", &s->target->mass, s->density);
    for (int i = 0; i < s->count; i++) print_level(s, &s->levels[i]);
    const shape_frame *f = &s->levels[s->count - 1].clump.frame;
    printf("mass, origin and axes from the %s; axes of the body in the frame of the target:\n",
           s->from == SHAPE_MASS_SOLID ? "solid" : "union");
    for (int k = 0; k < 3; k++)
        printf("  %c [%.6f, %.6f, %.6f]\n", "xyz"[k], f -> axis[k][0], f -> axis[k][1],
               f -> axis[k][2]);
}

/* ---- for scenes
 * ---------------------------------------------------------------------------------- */

static void append_level(scene_buffer *out, const shape_sheet *s, const shape_level *l) {
    const shape_clump *c = &l->clump;
    const double *moment = c->frame.moment, rho = s->density;
    scene_append(out, "  %s-%d:\n", s->name, c->count);
    scene_append(out,
                 "    # packing density %.4g, surface deviation %.3g mm in the mean and %.3g "
                 "mm at most\n",
                 l->filling.density, 1e3 * l->quality.deviation_mean,
                 1e3 * l->quality.deviation_max);
    scene_append(out,
                 "    # volume: union %.7g m3 (within %.1e), solid %.7g m3; mass from the %s\n",
                 c->as_union.volume, c->as_union.volume_bound, c->as_solid.volume,
                 s->from == SHAPE_MASS_SOLID ? "solid" : "union");
    scene_append(out, "    # moments about the principal axes within %.1e of the largest\n",
                 c->frame.bound);
    scene_append(out, "    material: %s\n", s->material);
    scene_append(out, "    mass: %.17g kg\n", rho * c->volume);
    scene_append(out, "    inertia: [%.17g kg m2, %.17g kg m2, %.17g kg m2]\n", rho * moment[0],
                 rho * moment[1], rho * moment[2]);
    scene_append(out, "    spheres:\n");
    for (int i = 0; i < c->count; i++) {
        const shape_sphere *one = &c->sphere[i];
        scene_append(out, "      - {centre: [%.17g, %.17g, %.17g], radius: %.17g}\n", one->centre.x,
                     one->centre.y, one->centre.z, one->radius);
    }
}

/* Whole rings may leave two levels with as many spheres: the same clump, and one key of a scene. */
static bool is_repeated(const shape_sheet *s, int level) {
    for (int i = 0; i < level; i++)
        if (s->levels[i].clump.count == s->levels[level].clump.count) return true;
    return false;
}

char *shape_yaml(const shape_sheet *s) {
    CLAST_ASSERT(s && s->count > 0);
    scene_buffer out = {0};
    scene_append(&out, "# %s\n# written by: %s\n", s->title, s->command);
    scene_append(&out,
                 "# Levels of detail, in m; mass for a density of %g kg/m3. Paste what you "
                 "need into the section\n# shapes of a scene.\n",
                 s->density);
    scene_append(&out, "shapes:\n");
    for (int i = 0; i < s->count; i++)
        if (!is_repeated(s, i)) append_level(&out, s, &s->levels[i]);
    return out.text;
}

/* ---- for figures
 * --------------------------------------------------------------------------------- */

char *shape_csv(const shape_sheet *s) {
    CLAST_ASSERT(s && s->count > 0);
    scene_buffer out = {0};
    scene_append(&out, "name,spheres,density,smallest_m,inscribed_m,solid_m3,union_m3,volume_bound,"
                       "inertia_error,inertia_bound,deviation_mean_m,deviation_max_m,protrusion_m,"
                       "normal_95_deg,normal_max_deg,friction,contacts,pairs,step,cost,fill_s,"
                       "mass_s\n");
    for (int i = 0; i < s->count; i++) {
        const shape_level *l = &s->levels[i];
        const shape_clump *c = &l->clump;
        const shape_quality *q = &l->quality;
        scene_append(&out, "%s,%d,%.6g,%.9g,%.9g,%.12g,%.12g,%.3g,%.6g,%.3g,", s->name, c->count,
                     l->filling.density, smallest_radius(l), l->filling.inscribed,
                     c->as_solid.volume, c->as_union.volume, c->as_union.volume_bound,
                     inertia_error(&c->as_union, &c->as_solid), c->as_union.inertia_bound);
        scene_append(&out, "%.6g,%.6g,%.6g,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%.3g,%.3g\n",
                     q->deviation_mean, q->deviation_max, q->protrusion, q->normal_95 / DEGREE,
                     q->normal_max / DEGREE, q->friction, q->contacts, q->pairs, q->step, q->cost,
                     l->fill_s, l->mass_s);
    }
    return out.text;
}
