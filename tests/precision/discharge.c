/* discharge.c - rate of a small hopper of one layer, over replicates. A third variant is the
 * control: double, with one sphere moved by a billionth of a metre, shows how far a disturbance
 * that means nothing drives two runs apart. */
#include "tests/precision/precision.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>

static const double RADIUS = 0.005, WIDTH = 0.2, ORIFICE = 0.08; /* m */
static const double OPENS = 0.4, LATEST = 4;                     /* s */
enum { SPHERES = 600, COLUMNS = 18, DOUBLE = 0, MIXED, NUDGED, VARIANTS };
static const char *const VARIANT_NAMES[VARIANTS] = {"double", "mixed", "nudged"};

static void add_plate(clast_world *w, const char *name, double from, double to, double removed) {
    int part = clast_part_add(w, &(clast_part_def){.name = name, .removed_at = removed});
    clast_wall_def plate = {name,
                            CLAST_WALL_PLATE,
                            0,
                            .point = {0.5 * (from + to), 0, 0},
                            .normal = {0, 0, 1},
                            .side = {1, 0, 0},
                            .half_side = {0.5 * (to - from), 0.1}};
    precision_demand(clast_wall_add(w, part, &plate) >= 0, w);
}

static void add_side(clast_world *w, int part, double x, double normal) {
    clast_wall_def plane = {"side", CLAST_WALL_PLANE, 0, .point = {x, 0, 0},
                            .normal = {normal, 0, 0}};
    precision_demand(clast_wall_add(w, part, &plane) >= 0, w);
}

static clast_world *hopper(int variant) {
    clast_world_def d = clast_world_def_default();
    d.precision = variant == MIXED ? CLAST_PRECISION_MIXED : CLAST_PRECISION_DOUBLE;
    d.motion = CLAST_MOTION_IN_PLANE, d.plane_axis = 1;
    d.time_step = 4e-5, d.impact_speed = 2, d.threads = 1;
    d.max_overlap = 0.4;
    d.domain_min = (clast_vec3){-1, -1, -0.05}, d.domain_max = (clast_vec3){1, 1, 2};
    d.outside = CLAST_OUTSIDE_REMOVE;
    clast_world *w = clast_world_new(&d);
    precision_demand(w, w);
    clast_material_add(w, &(clast_material_def){"grain", 2500, 5e6, 0.3});
    clast_pair_def pair = {.restitution = 0.5, .friction = 0.4};
    precision_demand(clast_pair_set(w, 0, 0, &pair) == CLAST_OK, w);
    clast_shape_add_sphere(w, "sphere", RADIUS, 0);
    int sides = clast_part_add(w, &(clast_part_def){.name = "sides"});
    add_side(w, sides, -0.5 * WIDTH, 1);
    add_side(w, sides, 0.5 * WIDTH, -1);
    add_plate(w, "left", -0.5 * WIDTH, -0.5 * ORIFICE, 0);
    add_plate(w, "right", 0.5 * ORIFICE, 0.5 * WIDTH, 0);
    add_plate(w, "gate", -0.5 * ORIFICE, 0.5 * ORIFICE, OPENS);
    return w;
}

static void fill(clast_world *w, int seed, int variant) {
    double pitch = WIDTH / COLUMNS, play = 0.45 * (pitch - 2 * RADIUS);
    for (int i = 0; i < SPHERES; i++) {
        uint64_t n = (uint64_t)i, stream = (uint64_t)seed;
        double shift = play * (2 * clast_random(stream, 1, n) - 1);
        double rise = play * (2 * clast_random(stream, 2, n) - 1);
        clast_body_def b = {.position = {pitch * (i % COLUMNS - 0.5 * (COLUMNS - 1)) + shift, 0,
                                         pitch * (0.6 + i / COLUMNS) + rise},
                            .velocity = {0.4 * clast_random(stream, 3, n) - 0.2, 0, 0}};
        if (variant == NUDGED && i == 0) b.position.x += 1e-9;
        precision_demand(clast_body_add(w, &b) == i, w);
    }
}

/* Spheres per second between 15 and 55 % discharged; NAN when the orifice blocks. */
static double rate_of(int seed, int variant) {
    clast_world *w = hopper(variant);
    fill(w, seed, variant);
    size_t low = SPHERES * 15 / 100, high = SPHERES * 55 / 100, out = 0;
    double from = NAN, to = NAN;
    while (out < high && clast_world_time(w) < LATEST) {
        precision_demand(clast_world_step(w) == CLAST_OK, w);
        out = clast_world_counters(w).removed;
        if (isnan(from) && out >= low) from = clast_world_time(w);
        if (out >= high) to = clast_world_time(w);
    }
    clast_world_free(w);
    return (double)(high - low) / (to - from);
}

typedef struct interval {
    double mean, half;
} interval;

/* 95 % of Student's t; NAN are left out. */
static interval interval_of(const double *x, int count) {
    double sum = 0, square = 0;
    int n = 0;
    for (int i = 0; i < count; i++)
        if (!isnan(x[i])) sum += x[i], n++;
    double mean = sum / n;
    for (int i = 0; i < count; i++)
        if (!isnan(x[i])) square += (x[i] - mean) * (x[i] - mean);
    if (n < 2) return (interval){mean, NAN};
    return (interval){mean, gsl_cdf_tdist_Pinv(0.975, n - 1) * sqrt(square / (n - 1) / n)};
}

void measure_discharge(const precision_table *t) {
    double *rate[VARIANTS], *difference = calloc((size_t)t->seeds, sizeof *difference);
    precision_demand(difference, NULL);
    for (int v = 0; v < VARIANTS; v++) {
        rate[v] = calloc((size_t)t->seeds, sizeof *rate[v]);
        precision_demand(rate[v], NULL);
        for (int s = 0; s < t->seeds; s++) {
            rate[v][s] = rate_of(s + 1, v);
            precision_row(t, "rate", "hopper", VARIANT_NAMES[v], s + 1, rate[v][s], NAN);
        }
        interval i = interval_of(rate[v], t->seeds);
        precision_row(t, "mean-rate", "hopper", VARIANT_NAMES[v], t->seeds, i.mean, i.half);
    }
    double mean = interval_of(rate[DOUBLE], t->seeds).mean;
    for (int v = MIXED; v < VARIANTS; v++) {
        for (int s = 0; s < t->seeds; s++) difference[s] = (rate[v][s] - rate[DOUBLE][s]) / mean;
        interval i = interval_of(difference, t->seeds);
        precision_row(t, "rate-change", "hopper", VARIANT_NAMES[v], t->seeds, i.mean, i.half);
    }
    for (int v = 0; v < VARIANTS; v++) free(rate[v]);
    free(difference);
}
