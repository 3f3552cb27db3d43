/* tables.c - the data folder: plain CSV that the figures are drawn from (README.md has the
 * columns). */
#include <math.h>
#include <stdlib.h>

#include "experiments/particle-checks/checks.h"
#include "experiments/study/output.h"
#include "experiments/study/published.h"

typedef struct folder {
    const char *path;
    const published_table *numbers;
    const checks_size *size;
} folder;

/* What the source prints, so that figures have it from one place; NAN: nothing. */
static double thesis_of(const folder *d, const char *quantity) {
    const published *p = published_find(d->numbers, quantity);
    return p ? p->thesis : NAN;
}

/* ---- the particles themselves ---------------------------------------------------------------- */

static void write_spheres(FILE *f, const char *figure, double label, const capsule *p, double x,
                          double z) {
    for (int i = 0; i < p->spheres; i++)
        fprintf(f, "%s,%g,%.6g,%.6g,%.6g\n", figure, label,
                x + (i - 0.5 * (p->spheres - 1)) * p->spacing, z, p->radius);
}

/* Figs 3.10 and 3.16: capsules of one shape; a particle in the first nest of the row below. */
static int write_particles(const folder *d) {
    static const double Q[3] = {1, 2, 4};
    const double r = PSEUDO_RADIUS, length = 10 * r;
    FILE *f = output_table(d->path, "particles.csv", "figure,label,x_m,z_m,radius_m");
    if (!f) return 4;
    for (int n = 3; n <= 9; n += 2) {
        capsule p = sliding_particle(n);
        write_spheres(f, "slide", n, &p, 0, p.radius);
    }
    for (int k = 0; k < 3; k++) {
        capsule p = capsule_of((int)(4 * Q[k]) + 1, r, length - 2 * r, 1);
        for (int i = 0; i < 3; i++) write_spheres(f, "row", Q[k], &p, (i + 0.5) * length, r);
        double half = 0.5 * p.spacing;
        write_spheres(f, "upper", Q[k], &p, 0.5 * length + half, r + sqrt(4 * r * r - half * half));
    }
    return output_close(f);
}

/* ---- A00 3.2 --------------------------------------------------------------------------------- */

static int write_weight(const folder *d) {
    FILE *f = output_table(d->path, "weight.csv",
                           "orientation,damping,step_s,time_s,velocity_m_s,elastic_n,dashpot_n,"
                           "force_n");
    if (!f) return 4;
    FILE *errors = output_table(d->path, "weight_error.csv",
                                "orientation,damping,step_s,error_percent,thesis_percent,"
                                "overlap_m,thesis_overlap_m");
    if (!errors) return 4 | output_close(f);
    for (int i = 0; i < REST_CASES; i++) {
        const rest_case *c = &REST_CASE[i];
        char off[REST_NAME], deep[REST_NAME];
        rest_name(c, "force off the weight", off);
        rest_name(c, "deformation", deep);
        rest r = rest_run(c, f);
        fprintf(errors, "%s,%g,%g,%.4g,%.4g,%.4g,%.4g\n", c->horizontal ? "horizontal" : "vertical",
                c->damping, c->step, 100 * r.error / PAIR_WEIGHT,
                100 * thesis_of(d, off) / PAIR_WEIGHT, r.overlap, thesis_of(d, deep));
    }
    return output_close(f) | output_close(errors);
}

/* ---- A00 3.3 --------------------------------------------------------------------------------- */

static int write_collision(const folder *d) {
    FILE *f = output_table(d->path, "collision.csv",
                           "orientation,time_s,rise_m,force_n,force_per_contact_n,collisions");
    if (!f) return 4;
    for (int i = 0; i < 3; i++) {
        drop_case c = {.horizontal = i > 0,
                       .damping = DROP_DAMPING,
                       .step = DROP_STEP,
                       .height = DROP_HEIGHT,
                       .shared = i == 2};
        drop_run(&c, f);
    }
    return output_close(f);
}

static const double FRACTIONS[] = {5, 2.5, 1, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01};
enum { FRACTION_COUNT = sizeof FRACTIONS / sizeof *FRACTIONS };

static int write_impulse_curves(const folder *d) {
    FILE *f = output_table(d->path, "impulse_curves.csv", "fraction,time_s,force_n");
    if (!f) return 4;
    for (int i = 0; i < FRACTION_COUNT; i++)
        elastic_impulse_error(&(elastic_case){.fraction = FRACTIONS[i], .height = DROP_HEIGHT}, f);
    return output_close(f);
}

/* Error where the touch falls on a step, as in the source, and the worst of eight places. */
static void write_impulse_row(FILE *f, const folder *d, double fraction, double height) {
    char name[80];
    snprintf(name, sizeof name, "elastic collision, %g of the critical step: error of the impulse",
             fraction);
    double on_step = 0, worst = 0;
    for (int i = 0; i < 8; i++) {
        elastic_case c = {.fraction = fraction, .height = height, .late = i / 8.0};
        double error = elastic_impulse_error(&c, NULL);
        if (i == 0) on_step = error;
        worst = fmax(worst, error);
    }
    fprintf(f, "%g,%g,%.4g,%.4g,%g\n", fraction, height, 100 * on_step, 100 * worst,
            height == DROP_HEIGHT ? thesis_of(d, name) : NAN);
}

static int write_impulse(const folder *d) {
    FILE *f = output_table(d->path, "impulse.csv",
                           "fraction,height_m,error_percent,worst_percent,thesis_percent");
    if (!f) return 4;
    for (double height = 0.001; height < 1.5; height *= 10)
        for (int i = 0; i < FRACTION_COUNT; i++) write_impulse_row(f, d, FRACTIONS[i], height);
    return output_close(f);
}

/* ---- A00 3.4 --------------------------------------------------------------------------------- */

enum { SLIDE_POINTS = 100 };

static void write_slide(FILE *f, const char *figure, const char *series, const slide_case *c) {
    double way[SLIDE_POINTS];
    slide_run(c, SLIDE_POINTS, way);
    for (int i = 0; i < SLIDE_POINTS; i++) {
        double t = SLIDE_TIME * (i + 1) / SLIDE_POINTS;
        fprintf(f, "%s,%s,%d,%g,%g,%g,%.6g,%.8g,%.8g\n", figure, series, c->spheres, c->friction,
                c->slip_damping, c->fraction, t, way[i], slide_exact(c->friction, t));
    }
}

static slide_case slide_of(int spheres, double friction) {
    return (slide_case){.spheres = spheres, .friction = friction, .damping = 0.21, .fraction = 0.5};
}

/* The frictions of Figs 3.7 and 3.11 and the dampings of 3.8 stand in the figures alone. */
static int write_slides(const folder *d) {
    static const double SLIP[] = {0, 1e-4, 1e-3, 1e-2, 0.21}, STEPS[] = {1, 0.5, 0.1};
    FILE *f = output_table(d->path, "slide.csv",
                           "figure,series,spheres,friction,slip_damping,fraction,time_s,way_m,"
                           "exact_m");
    if (!f) return 4;
    for (int i = 1; i <= 5; i++) {
        slide_case c = slide_of(5, 0.1 * i);
        write_slide(f, "friction", "each", &c);
    }
    for (int i = 0; i < 5; i++) {
        slide_case c = slide_of(5, 0.3);
        c.slip_damping = SLIP[i], c.printed = true;
        write_slide(f, "damping", "printed", &c);
    }
    for (int i = 0; i < 3; i++) {
        slide_case c = slide_of(9, 0.3);
        c.fraction = STEPS[i];
        write_slide(f, "step", "each", &c);
    }
    for (int n = 3; n <= 9; n += 2) {
        slide_case c = slide_of(n, 0.3);
        c.slip_damping = 0.21;
        write_slide(f, "spheres", "each", &c);
        c.shared = true;
        write_slide(f, "spheres", "shared", &c);
        c.shared = false, c.printed = true;
        write_slide(f, "spheres", "printed", &c);
        c.damping *= 0.5, c.slip_damping *= 0.5;
        write_slide(f, "spheres", "printed-half", &c);
    }
    return output_close(f);
}

static int write_landing(const folder *d) {
    FILE *f = output_table(d->path, "landing.csv", "mode,spheres,rebound");
    if (!f) return 4;
    for (int shared = 0; shared < 2; shared++)
        for (int n = 1; n <= 9; n++)
            fprintf(f, "%s,%d,%.6g\n", shared ? "shared" : "each", n,
                    landing_rebound(n, 0.21, shared));
    return output_close(f);
}

/* ---- A00 3.5 and 3.6 ------------------------------------------------------------------------- */

static void write_belt(FILE *f, FILE *settled, double fraction, double damping, double friction) {
    belt_case c = BELT_BASE;
    c.fraction = fraction, c.damping = damping, c.friction = friction;
    belt b = belt_run(&c, f);
    fprintf(settled, "%g,%g,%g,%.4g,%.6g\n", fraction, damping, friction, b.settled, b.speed);
}

static int write_belts(const folder *d) {
    const belt_case *b = &BELT_BASE;
    FILE *f = output_table(d->path, "belt.csv", "fraction,damping,friction,time_s,speed_m_s");
    if (!f) return 4;
    FILE *settled =
        output_table(d->path, "belt_settled.csv", "fraction,damping,friction,settled_s,speed_m_s");
    if (!settled) return 4 | output_close(f);
    write_belt(f, settled, b->fraction, b->damping, b->friction);
    write_belt(f, settled, 1, b->damping, b->friction);
    write_belt(f, settled, 0.5, b->damping, b->friction);
    write_belt(f, settled, b->fraction, 0.1, b->friction);
    write_belt(f, settled, b->fraction, 0.5, b->friction);
    write_belt(f, settled, b->fraction, b->damping, 0.1);
    write_belt(f, settled, b->fraction, b->damping, 0.5);
    return output_close(f) | output_close(settled);
}

static int write_blows(const folder *d) {
    static const double DAMPING[3] = {0, 0.1, 0.21};
    FILE *f = output_table(d->path, "blow.csv", "damping,time_s,height_m,angle_rad");
    if (!f) return 4;
    for (int i = 0; i < 3; i++) blow_run(DAMPING[i], f);
    return output_close(f);
}

/* ---- A00 3.7 --------------------------------------------------------------------------------- */

/* One start for all three densities; a table is written where it has a name. */
static int write_start(const folder *d, double start, const char *path_name,
                       const char *force_name) {
    static const double Q[3] = {1, 2, 4};
    FILE *path = NULL, *forces = NULL;
    if (path_name) path = output_table(d->path, path_name, "q,way_m,time2_s2");
    if (force_name)
        forces = output_table(d->path, force_name, "q,time_s,way,angle_degrees,along_n,into_n");
    if ((path_name && !path) || (force_name && !forces)) return 4;
    for (int k = 0; k < 3; k++) {
        pseudo_case c = {
            .q = Q[k], .start = start, .damping = PSEUDO_DAMPING, .fraction = 0.5, .softer = 1};
        pseudo_run(&c, path, forces);
    }
    return (path ? output_close(path) : 0) | (forces ? output_close(forces) : 0);
}

/* From the nest, as in the source; a hundredth of a spacing out of it, for at q = 1 a nest is as
 * steep as the slope; from a crest. */
static int write_pseudo_paths(const folder *d) {
    int bad = write_start(d, 0, "pseudo_path.csv", "pseudo_force.csv");
    bad |= write_start(d, 0.01, NULL, "pseudo_force_off.csv");
    bad |= write_start(d, 0.5, "pseudo_path_crest.csv", NULL);
    return bad;
}

static void write_range(FILE *f, const folder *d, const pseudo_range *r) {
    char name[80];
    snprintf(name, sizeof name, "pseudo-friction, q = %g", r->q);
    fprintf(f, "%g,%d,%.5g,%d,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%g\n", r->q,
            (int)lround(4 * r->q) + 1, pseudo_normal_off(r->q), r->n, r->mean, r->sd, r->least,
            r->most, r->end_mean, r->end_least, r->end_most, r->contacts, r->candidates,
            1e6 * r->seconds, thesis_of(d, name));
}

static int write_pseudo(const folder *d) {
    int starts = d->size->starts;
    pseudo_range *ranges = calloc((size_t)PSEUDO_QS, sizeof *ranges);
    pseudo *all = calloc((size_t)(PSEUDO_QS * starts), sizeof *all);
    if (!ranges || !all) abort();
    pseudo_case base = {.damping = PSEUDO_DAMPING, .fraction = 0.5, .softer = 1};
    int qs = pseudo_scan(starts, d->size->densest, &base, ranges, all);
    FILE *f = output_table(d->path, "pseudo.csv",
                           "q,spheres,off_degrees,n,mean,sd,least,most,end_mean,end_least,"
                           "end_most,contacts,candidates,us_per_step,thesis");
    FILE *each = output_table(d->path, "pseudo_starts.csv",
                              "q,start,friction,friction_end,friction_by_force,time_s");
    FILE *ways = output_table(d->path, "pseudo_ways.csv", "q,start,way_m,friction");
    if (!f || !each || !ways) return 4;
    for (int i = 0; i < qs; i++) {
        write_range(f, d, &ranges[i]);
        for (int j = 0; j < starts; j++) {
            const pseudo *p = &all[i * starts + j];
            fprintf(each, "%g,%.5g,%.5g,%.5g,%.5g,%.5g\n", PSEUDO_Q[i], (double)j / starts,
                    p->friction, p->friction_end, pseudo_friction_by_force(p), p->time);
            for (int k = 0; k < PSEUDO_WAYS; k++)
                fprintf(ways, "%g,%.5g,%g,%.5g\n", PSEUDO_Q[i], (double)j / starts,
                        PSEUDO_WAY_TO[k], p->by_way[k]);
        }
    }
    free(ranges), free(all);
    return output_close(f) | output_close(each) | output_close(ways);
}

/* ---- A00 3.10 -------------------------------------------------------------------------------- */

static int write_beds(const folder *d) {
    bed beds[BED_CASES];
    bed_run_all(d->size->bed_steps, beds);
    FILE *f = output_table(d->path, "runtime.csv",
                           "particles,spheres,us_per_sphere,us_per_particle,contacts,candidates,"
                           "overlap,height_m,thesis_us_per_sphere");
    if (!f) return 4;
    for (int i = 0; i < BED_CASES; i++) {
        const bed_case *c = &BED_CASE[i];
        char name[80];
        int total = c->particles * c->spheres;
        snprintf(name, sizeof name, "%d particles of %d: time per step and sphere", c->particles,
                 c->spheres);
        fprintf(f, "%d,%d,%.5g,%.5g,%g,%g,%.3g,%.4g,%g\n", c->particles, c->spheres,
                1e6 * beds[i].seconds / total, 1e6 * beds[i].seconds / c->particles,
                beds[i].contacts, beds[i].candidates, beds[i].overlap, beds[i].sunk,
                1e6 * thesis_of(d, name));
    }
    return output_close(f);
}

/* ---- what is assumed ------------------------------------------------------------------------- */

static void vary(FILE *f, const char *check, const char *variant, const char *quantity,
                 double value) {
    fprintf(f, "%s,%s,%s,%.5g\n", check, variant, quantity, value);
}

static void vary_rest(FILE *f) {
    static const char *const NAME[6] = {
        "baseline",       "floor of the matter",        "radius 1 cm",
        "radius 1.25 cm", "single precision of forces", "shared dashpot"};
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < REST_CASES; k += 3) {
            rest_case c = REST_CASE[k];
            char what[REST_NAME];
            c.soft_floor = i == 1, c.mixed = i == 4, c.shared = i == 5;
            c.radius = i == 2 ? 0.01 : i == 3 ? 0.0125 : 0;
            snprintf(what, sizeof what, "%s damping %g: error (N)",
                     c.horizontal ? "horizontal" : "vertical", c.damping);
            rest found = rest_run(&c, NULL);
            vary(f, "weight", NAME[i], what, found.error);
            snprintf(what, sizeof what, "%s damping %g: deformation (m)",
                     c.horizontal ? "horizontal" : "vertical", c.damping);
            vary(f, "weight", NAME[i], what, found.overlap);
        }
}

static void vary_impulse(FILE *f) {
    static const double FRACTION[3] = {2.5, 1, 0.5};
    static const char *const NAME[3] = {"baseline", "gravity acts", "floor of the matter"};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            char what[80];
            elastic_case c = {.fraction = FRACTION[i], .height = DROP_HEIGHT};
            c.weight = k == 1, c.soft_floor = k == 2;
            snprintf(what, sizeof what, "error of the impulse at %g steps (%%)", FRACTION[i]);
            vary(f, "impulse", NAME[k], what, 100 * elastic_impulse_error(&c, NULL));
        }
}

static void vary_pseudo(FILE *f, const folder *d) {
    static const struct {
        const char *name;
        pseudo_case base;
    } VARIANT[] = {
        {"damping 0.1", {.damping = 0.1, .fraction = 0.5, .softer = 1}},
        {"damping 0.21", {.damping = 0.21, .fraction = 0.5, .softer = 1}},
        {"damping 0.5 (baseline)", {.damping = 0.5, .fraction = 0.5, .softer = 1}},
        {"damping 0.9", {.damping = 0.9, .fraction = 0.5, .softer = 1}},
        {"half the step", {.damping = 0.5, .fraction = 0.25, .softer = 1}},
        {"100 times softer", {.damping = 0.5, .fraction = 0.5, .softer = 100}},
        {"shared dashpot", {.damping = 0.5, .fraction = 0.5, .softer = 1, .shared = true}},
    };
    pseudo_range *ranges = calloc((size_t)PSEUDO_QS, sizeof *ranges);
    if (!ranges) abort();
    for (int i = 0; i < 7; i++) {
        int qs = pseudo_scan(d->size->variant_starts, 4, &VARIANT[i].base, ranges, NULL);
        for (int k = 0; k < qs; k++) {
            char what[80];
            snprintf(what, sizeof what, "friction at q = %g", ranges[k].q);
            vary(f, "pseudo-friction", VARIANT[i].name, what, ranges[k].mean);
            snprintf(what, sizeof what, "friction at q = %g by the whole way", ranges[k].q);
            vary(f, "pseudo-friction", VARIANT[i].name, what, ranges[k].end_mean);
        }
    }
    free(ranges);
}

static void vary_belt(FILE *f) {
    static const double HEIGHT[3] = {1e-4, BELT_HEIGHT, 5e-3};
    for (int i = 0; i < 3; i++) {
        char name[40];
        belt_case c = BELT_BASE;
        c.height = HEIGHT[i];
        snprintf(name, sizeof name, "dropped from %g mm", 1e3 * HEIGHT[i]);
        vary(f, "belt", name, "settled after (s)", belt_run(&c, NULL).settled);
    }
}

static int write_sensitivity(const folder *d) {
    FILE *f = output_table(d->path, "sensitivity.csv", "check,variant,quantity,value");
    if (!f) return 4;
    vary_rest(f);
    vary_impulse(f);
    vary_belt(f);
    vary_pseudo(f, d);
    return output_close(f);
}

/* ---- all ------------------------------------------------------------------------------------- */

static int write_about(const folder *d, const char *name) {
    FILE *f = output_table(d->path, "about.txt", "study=particle-checks");
    if (!f) return 4;
    fprintf(f, "size=%s\nreplicates=%d start positions\nhash=0x%016llx\nengine=%s\n", name,
            d->size->starts, (unsigned long long)checks_hash(), CLAST_VERSION);
    fprintf(f, "starts=%d\nbed_steps=%d\n", d->size->starts, d->size->bed_steps);
    return output_close(f);
}

int checks_write_tables(const checks_size *size, const char *name, const char *path) {
    char why[PUBLISHED_ERROR_MAX];
    published_table *numbers = published_read(SCENES "/published.csv", why);
    if (!numbers) {
        fprintf(stderr, "%s\n", why);
        return 4;
    }
    folder d = {path, numbers, size};
    static int (*const WRITE[])(const folder *) = {
        write_particles, write_weight,  write_collision,  write_impulse_curves, write_impulse,
        write_slides,    write_landing, write_belts,      write_blows,          write_pseudo_paths,
        write_pseudo,    write_beds,    write_sensitivity};
    int bad = 0;
    for (size_t i = 0; i < sizeof WRITE / sizeof *WRITE; i++) bad |= WRITE[i](&d);
    bad |= write_about(&d, name);
    published_free(numbers);
    return bad ? 4 : 0;
}
