/* pseudo.c - A00 3.7: three particles cover the bottom of a box that is tilted by 30 degrees, and a
 * fourth slides over them without friction. What it loses to their lobes is called
 * pseudo-friction. */
#include <math.h>
#include <stdlib.h>
#include <time.h>

#include "experiments/particle-checks/checks.h"
#include "experiments/study/side.h"
#include "experiments/study/statistics.h"

static const double R = PSEUDO_RADIUS, LENGTH = 10 * PSEUDO_RADIUS; /* aspect ratio 5 */
static const double MOST_TIME = 3;                                  /* s */

enum { UPPER = 3, LOOK = 20, POINTS = 4000 };

const double PSEUDO_Q[] = {1, 1.5, 2, 3, 4, 6, 8, 12, 16};
const int PSEUDO_QS = (int)(sizeof PSEUDO_Q / sizeof *PSEUDO_Q);

const double PSEUDO_WAY_TO[PSEUDO_WAYS] = {0.01, 0.02, 0.04, 0.08, 0.12, PSEUDO_WAY};

static double degrees(double radians) {
    return radians * 180 / CHECKS_PI;
}

static double spacing_of(double q) {
    return 2 * R / q;
}

double pseudo_normal_off(double q) {
    return degrees(asin(0.5 / q));
}

double pseudo_density(double off) {
    return 0.5 / sin(off * CHECKS_PI / 180);
}

/* A00 3.13 turned round; slope in s2/m. */
static double friction_of(double slope) {
    return (sin(SLOPE) - 2 / (slope * GRAVITY)) / cos(SLOPE);
}

/* ---- the box --------------------------------------------------------------------------------- */

static capsule particle_of(double q) {
    return capsule_of((int)lround(4 * q) + 1, R, LENGTH - 2 * R, PSEUDO_WEIGHT / GRAVITY);
}

/* Where every sphere that touches has its dashpot, they add up: beyond q = 4 the step shrinks. */
static double step_of(const pseudo_case *c, double young) {
    return c->fraction * fmin(1, 4 / c->q) * critical_step(R, young);
}

static setting setting_of(const pseudo_case *c) {
    double young = pair_young() / c->softer;
    return (setting){.law = CLAST_LAW_HERTZ_A00,
                     .young = young,
                     .step = step_of(c, young),
                     .damping = c->damping,
                     .slope = SLOPE,
                     .in_plane = true,
                     .shared = c->shared};
}

static void add_ends(clast_world *w) {
    int part = clast_part_add(w, &(clast_part_def){.name = "ends"});
    for (int i = 0; i < 2; i++) {
        clast_wall_def end = {.name = i ? "low end" : "high end",
                              .material = 1,
                              .point = {i * 3 * LENGTH, 0, 0},
                              .normal = {i ? -1 : 1, 0, 0}};
        clast_wall_add(w, part, &end);
    }
}

/* Of the centres above those of the row below, where the particle just touches it. */
static double touching_height(const capsule *p, double x) {
    double most = 0;
    for (int i = 0; i < p->spheres; i++)
        for (int j = 0; j < 3 * p->spheres; j++) {
            double upper = x + (i - 0.5 * (p->spheres - 1)) * p->spacing;
            double lower = (j / p->spheres + 0.5) * LENGTH +
                           (j % p->spheres - 0.5 * (p->spheres - 1)) * p->spacing;
            double across = upper - lower;
            if (fabs(across) < 2 * R) most = fmax(most, sqrt(4 * R * R - across * across));
        }
    return most;
}

static clast_world *box_new(const setting *s, const capsule *p, double x) {
    clast_world *w = matter_new(s, p);
    floor_add(w, s);
    add_ends(w);
    for (int i = 0; i < UPPER; i++)
        body_put(w, &(clast_body_def){.shape = 0, .position = {(i + 0.5) * LENGTH, 0, R}});
    body_put(w, &(clast_body_def){.shape = 0, .position = {x, 0, R + touching_height(p, x)}});
    return w;
}

/* ---- one slide ------------------------------------------------------------------------------- */

typedef struct slider {
    const pseudo_case *c;
    clast_world *w;
    double start;                       /* m */
    double way[POINTS], square[POINTS]; /* m, s2 */
    int points;
    double looks, passing; /* so far; of them while the first sphere is passed */
    pseudo sum;            /* sums in the place of means */
} slider;

static double x_of_upper(clast_world *w) {
    clast_bodies b = clast_world_bodies(w);
    size_t i = 0;
    while (b.id[i] != UPPER) i++;
    return b.x[i];
}

/* Net force on the upper particle, and how far its contacts are off the normal of the slope. */
static void look_at_contacts(slider *k, double way, FILE *forces) {
    enum { ROOM = 512 };
    clast_contact contact[ROOM];
    size_t count = clast_world_contacts(k->w, contact, ROOM);
    if (count > ROOM) abort();
    double along = 0, into = 0, off = 0;
    int touching = 0;
    for (size_t i = 0; i < count; i++) {
        if (contact[i].b != UPPER) continue;
        double fx = -contact[i].force.x, fz = -contact[i].force.z;
        along += fx, into += fz, touching++;
        if (fz > 0) off = fmax(off, degrees(atan2(fabs(fx), fz)));
    }
    k->looks++;
    k->sum.contacts += touching;
    if (way > spacing_of(k->c->q)) return;
    k->passing++;
    k->sum.force -= along;
    k->sum.deviation = fmax(k->sum.deviation, off);
    if (forces)
        fprintf(forces, "%g,%.6g,%.6g,%.6g,%.6g,%.6g\n", k->c->q, clast_world_time(k->w),
                way / spacing_of(k->c->q), touching ? degrees(atan2(into, along)) : NAN, along,
                into);
}

static void note_path(slider *k, double way, double time, FILE *path) {
    if (k->points == POINTS) return;
    k->way[k->points] = way, k->square[k->points] = time * time;
    k->points++;
    if (path) fprintf(path, "%g,%.6g,%.6g\n", k->c->q, way, time * time);
}

static double processor_seconds(void) {
    return (double)clock() / CLOCKS_PER_SEC;
}

static void take_friction(slider *k) {
    for (int i = 0; i < PSEUDO_WAYS; i++) {
        int n = 0;
        while (n < k->points && (i == PSEUDO_WAYS - 1 || k->way[n] <= PSEUDO_WAY_TO[i])) n++;
        k->sum.by_way[i] = friction_of(line_fit(k->way, k->square, n).slope);
    }
    k->sum.friction = k->sum.by_way[PSEUDO_WAYS - 1];
}

static void take_means(slider *k, double way) {
    pseudo *s = &k->sum;
    double time = clast_world_time(k->w);
    s->contacts /= k->looks;
    s->force /= k->passing;
    s->seconds /= (double)clast_world_steps(k->w);
    s->candidates = (double)clast_world_counters(k->w).candidates;
    s->time = time;
    take_friction(k);
    s->friction_end = friction_of(time * time / way);
    s->hash = clast_world_hash(k->w);
}

/* From rest until the way is done, or time is up. */
static double slide_down(slider *k, FILE *path, FILE *forces) {
    double way = 0;
    for (int n = 1; way < PSEUDO_WAY && clast_world_time(k->w) < MOST_TIME; n++) {
        double before = processor_seconds();
        for (int i = 0; i < LOOK; i++) world_step(k->w);
        k->sum.seconds += processor_seconds() - before;
        way = x_of_upper(k->w) - k->start;
        look_at_contacts(k, way, forces);
        if (n % 10 == 0) note_path(k, way, clast_world_time(k->w), path);
    }
    return way;
}

pseudo pseudo_run(const pseudo_case *c, FILE *path, FILE *forces) {
    capsule p = particle_of(c->q);
    setting s = setting_of(c);
    double start = 0.5 * LENGTH + (0.5 + c->start) * p.spacing;
    slider *k = calloc(1, sizeof *k);
    if (!k) abort();
    *k = (slider){.c = c, .w = box_new(&s, &p, start), .start = start};
    double way = slide_down(k, path, forces);
    take_means(k, way);
    pseudo found = k->sum;
    world_end(k->w);
    free(k);
    return found;
}

double pseudo_friction_by_force(const pseudo *p) {
    return p->force / (PSEUDO_WEIGHT * cos(SLOPE));
}

/* ---- over start positions -------------------------------------------------------------------- */

static void run_one(const void *context, int index, void *result) {
    const pseudo_case *cases = context;
    *(pseudo *)result = pseudo_run(&cases[index], NULL, NULL);
}

static pseudo_range range_of(double q, const pseudo *runs, int n) {
    double *friction = malloc((size_t)n * sizeof *friction);
    if (!friction) abort();
    pseudo_range r = {.q = q,
                      .n = n,
                      .least = INFINITY,
                      .most = -INFINITY,
                      .end_least = INFINITY,
                      .end_most = -INFINITY};
    for (int i = 0; i < n; i++) {
        const pseudo *p = &runs[i];
        friction[i] = p->friction;
        r.least = fmin(r.least, p->friction), r.most = fmax(r.most, p->friction);
        r.end_least = fmin(r.end_least, p->friction_end);
        r.end_most = fmax(r.end_most, p->friction_end);
        r.end_mean += p->friction_end / n;
        r.contacts += p->contacts / n, r.candidates += p->candidates / n;
        r.seconds += p->seconds / n;
    }
    interval spread = mean_interval(friction, n);
    r.mean = spread.mean, r.sd = spread.sd;
    free(friction);
    return r;
}

/* At the ends of equal parts of the spacing: in a nest, as the source, and on a crest, too. */
int pseudo_scan(int starts, double densest, const pseudo_case *base, pseudo_range *ranges,
                pseudo *all) {
    int qs = 0;
    while (qs < PSEUDO_QS && PSEUDO_Q[qs] <= densest) qs++;
    pseudo_case *cases = calloc((size_t)(qs * starts), sizeof *cases);
    pseudo *runs = calloc((size_t)(qs * starts), sizeof *runs);
    if (!cases || !runs) abort();
    for (int i = 0; i < qs * starts; i++) {
        int dense_first = qs - 1 - i / starts; /* the longest runs first */
        cases[i] = *base;
        cases[i].q = PSEUDO_Q[dense_first];
        cases[i].start = (double)(i % starts) / starts;
    }
    side_by_side(&(side_task){.work = run_one, .context = cases, .size = sizeof *runs}, qs * starts,
                 runs);
    for (int i = 0; i < qs * starts; i++) checks_hash_add(runs[i].hash);
    for (int i = 0; i < qs; i++) {
        const pseudo *of_q = &runs[(qs - 1 - i) * starts];
        ranges[i] = range_of(PSEUDO_Q[i], of_q, starts);
        for (int j = 0; all && j < starts; j++) all[i * starts + j] = of_q[j];
    }
    free(cases), free(runs);
    return qs;
}
