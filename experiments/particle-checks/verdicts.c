/* verdicts.c - what theory and the source say, ours beside it. */
#include <math.h>
#include <stdlib.h>

#include "experiments/particle-checks/checks.h"
#include "experiments/study/published.h"
#include "experiments/study/verdict.h"

typedef struct court {
    published_table *published;
    verdict_table *table;
    const checks_size *size;
} court;

static void say(const court *c, const char *quantity, double value) {
    verdict_named(c->table, c->published, quantity, value);
}

/* Of what this size did not run, or what cannot be told, there is no verdict. */
static void say_if_run(const court *c, const char *quantity, double value) {
    verdict_published(c->table, published_need(c->published, quantity), interval_exact(value),
                      isfinite(value));
}

static void report(const court *c, const char *quantity, interval value) {
    verdict_published(c->table, published_need(c->published, quantity), value, false);
}

/* ---- A00 3.2 --------------------------------------------------------------------------------- */

static void judge_rest(const court *c) {
    const double equal = 1e-9 * PAIR_WEIGHT;
    double error[REST_CASES], worst = NAN;
    for (int i = 0; i < REST_CASES; i++) {
        char name[REST_NAME];
        rest r = rest_run(&REST_CASE[i], NULL);
        error[i] = r.error;
        rest_name(&REST_CASE[i], "force off the weight", name);
        say(c, name, r.error);
        rest_name(&REST_CASE[i], "error", name);
        report(c, name, interval_exact(100 * r.error / PAIR_WEIGHT));
        rest_name(&REST_CASE[i], "deformation", name);
        say(c, name, r.overlap);
    }
    for (int i = 0; i < 3; i++) /* two that rounding makes say nothing of each other */
        if (fmax(error[6 + i], error[i]) > equal)
            worst = fmax(worst, fmax(error[6 + i], equal) / fmax(error[i], equal));
    say_if_run(c, "weight: largest error over the steps, horizontal over vertical", worst);
}

/* ---- A00 3.3 --------------------------------------------------------------------------------- */

static void judge_impulse(const court *c) {
    static const double PRINTED[3] = {2.5, 1, 0.5}, SMALLER[5] = {0.2, 0.1, 0.05, 0.02, 0.01};
    for (int i = 0; i < 3; i++) {
        char name[96];
        snprintf(name, sizeof name,
                 "elastic collision, %g of the critical step: error of the impulse", PRINTED[i]);
        elastic_case e = {.fraction = PRINTED[i], .height = DROP_HEIGHT};
        say(c, name, 100 * elastic_impulse_error(&e, NULL));
    }
    double worst = 0;
    for (int i = 0; i < 5; i++) {
        elastic_case e = {.fraction = SMALLER[i], .height = DROP_HEIGHT};
        worst = fmax(worst, 100 * elastic_impulse_error(&e, NULL));
    }
    say(c, "elastic collision, smaller steps down to 0.01: largest error of the impulse", worst);
}

static void judge_drops(const court *c) {
    drop_case base = {.damping = DROP_DAMPING, .step = DROP_STEP, .height = DROP_HEIGHT};
    drop upright_one = drop_run(&base, NULL);
    base.horizontal = true;
    drop lying = drop_run(&base, NULL);
    say(c, "impulse of the first collision, horizontal over vertical",
        lying.impulse / upright_one.impulse);
    say(c, "largest force of a contact, horizontal over vertical",
        lying.force_most / upright_one.force_most);
    say(c, "height of the first bounce, horizontal over vertical",
        lying.bounce / upright_one.bounce);
    base.shared = true;
    say(c, "shared: height of the first bounce, horizontal over vertical",
        drop_run(&base, NULL).bounce / upright_one.bounce);
}

/* ---- A00 3.4 --------------------------------------------------------------------------------- */

enum { POINTS = 20 };

static slide_case slide_of(int spheres, double friction) {
    return (slide_case){.spheres = spheres, .friction = friction, .damping = 0.21, .fraction = 0.5};
}

/* At the end, and during the second half. */
static double way_of(const slide_case *s, double *late) {
    double way[POINTS];
    slide_run(s, POINTS, way);
    if (late) *late = way[POINTS - 1] - way[POINTS / 2 - 1];
    return way[POINTS - 1];
}

static double worst_off_theory(const slide_case *s) {
    double way[POINTS], worst = 0;
    slide_run(s, POINTS, way);
    for (int i = POINTS / 2; i < POINTS; i++) {
        double exact = slide_exact(s->friction, SLIDE_TIME * (i + 1) / POINTS);
        worst = fmax(worst, fabs(way[i] / exact - 1));
    }
    return worst;
}

static void judge_paths(const court *c) {
    static const double STEPS[3] = {1, 0.5, 0.1};
    double worst = 0;
    for (int i = 1; i <= 5; i++) {
        slide_case s = slide_of(5, 0.1 * i);
        worst = fmax(worst, worst_off_theory(&s));
    }
    say(c, "slides without a tangential dashpot: largest error of the way", worst);
    worst = 0;
    for (int i = 0; i < 3; i++) {
        slide_case s = slide_of(9, 0.3);
        s.fraction = STEPS[i];
        worst = fmax(worst, worst_off_theory(&s));
    }
    say(c, "slides at 1, 0.5 and 0.1 of the critical step: largest error of the way", worst);
}

static slide_case printed_of(int spheres, double damping) {
    slide_case s = slide_of(spheres, 0.3);
    s.printed = true, s.damping = s.slip_damping = damping;
    return s;
}

static void judge_printed_law(const court *c) {
    slide_case three = printed_of(3, 0.21), five = printed_of(5, 0.21), nine = printed_of(9, 0.21);
    slide_case half = printed_of(9, 0.105), free_one = printed_of(5, 0.21);
    free_one.slip_damping = 0;
    double late3, late9;
    double way3 = way_of(&three, &late3), way5 = way_of(&five, NULL), way9 = way_of(&nine, &late9);
    say(c, "dashpot on top of friction, 0.21: way over that without",
        way5 / way_of(&free_one, NULL));
    say(c, "dashpot on top of friction: way of 5 spheres over 9", way5 / way9);
    say(c, "dashpot on top of friction: terminal speed of 3 spheres over 9, off theory",
        fabs(late3 / late9 / pow(3, 5.0 / 6) - 1));
    say(c,
        "dashpot on top of friction: way of 9 spheres off that of 3, with half the damping over "
        "with all of it",
        fabs(way_of(&half, NULL) - way3) / fabs(way9 - way3));
}

static void judge_mode(const court *c, bool shared) {
    const char *mode = shared ? "shared" : "each";
    char way[80], rebound[96];
    snprintf(way, sizeof way, "%s: way of 9 spheres over 3", mode);
    snprintf(rebound, sizeof rebound, "%s: rebound of a flat landing, 9 spheres over 3", mode);
    slide_case three = slide_of(3, 0.3), nine = slide_of(9, 0.3);
    three.slip_damping = nine.slip_damping = 0.21;
    three.shared = nine.shared = shared;
    say(c, way, way_of(&nine, NULL) / way_of(&three, NULL));
    say(c, rebound, landing_rebound(9, 0.21, shared) / landing_rebound(3, 0.21, shared));
}

/* ---- A00 3.5 --------------------------------------------------------------------------------- */

static double settled_with(double fraction, double damping, double friction) {
    belt_case b = BELT_BASE;
    b.fraction = fraction, b.damping = damping, b.friction = friction;
    return belt_run(&b, NULL).settled;
}

static void judge_belt(const court *c) {
    const belt_case *b = &BELT_BASE;
    say(c, "belt: speed of the particle once it rides", belt_run(b, NULL).speed);
    say(c, "belt: settling time, damping 0.1 over 0.5",
        settled_with(b->fraction, 0.1, b->friction) / settled_with(b->fraction, 0.5, b->friction));
    say(c, "belt: settling time, friction 0.1 over 0.5",
        settled_with(b->fraction, b->damping, 0.1) / settled_with(b->fraction, b->damping, 0.5));
    say(c, "belt: settling time at the critical step over a tenth of it",
        settled_with(1, b->damping, b->friction) / settled_with(0.1, b->damping, b->friction));
}

/* ---- A00 3.6 --------------------------------------------------------------------------------- */

static void judge_blow(const court *c) {
    blow b = blow_run(0, NULL), damped = blow_run(0.21, NULL);
    say(c, "blow: acceleration", b.acceleration);
    say(c, "blow: angular acceleration", b.turning);
    say(c, "blow: speed, theory", b.speed);
    say(c, "blow: speed, the source's run", b.speed);
    say(c, "blow: spin, theory", b.spin);
    say(c, "blow: spin, the source's run", b.spin);
    say(c, "blow: speed after the surface, damping 0 over 0.21",
        fabs(b.speed_after / damped.speed_after));
}

/* ---- A00 3.7 --------------------------------------------------------------------------------- */

typedef struct span {
    double mean, least, most;
} span;

static span span_of(const pseudo_range *r) {
    return (span){r->mean, r->least, r->most};
}

/* How far a number lies outside; 0 within. */
static double outside(double number, double least, double most) {
    return fmax(0, fmax(least - number, number - most));
}

/* Between the neighbours in degrees off the normal; NAN beyond. */
static span span_at(const pseudo_range *ranges, int count, double off) {
    for (int i = 0; i + 1 < count; i++) {
        double before = pseudo_normal_off(ranges[i].q), after = pseudo_normal_off(ranges[i + 1].q);
        if (off > before || off < after) continue;
        double t = (before - off) / (before - after);
        span a = span_of(&ranges[i]), b = span_of(&ranges[i + 1]);
        return (span){a.mean + t * (b.mean - a.mean), a.least + t * (b.least - a.least),
                      a.most + t * (b.most - a.most)};
    }
    return (span){NAN, NAN, NAN};
}

static double good_density(const pseudo_range *ranges, int count) {
    double good = NAN;
    for (int i = count - 1; i >= 0 && ranges[i].mean <= PSEUDO_GOOD; i--) good = ranges[i].q;
    return good;
}

static void judge_density(const court *c, const pseudo_range *r, const pseudo *runs) {
    char name[96];
    double *friction = malloc((size_t)r->n * sizeof *friction);
    if (!friction) abort();
    for (int i = 0; i < r->n; i++) friction[i] = runs[i].friction;
    snprintf(name, sizeof name, "pseudo-friction, q = %g", r->q);
    double printed = published_need(c->published, name)->thesis;
    report(c, name, mean_interval(friction, r->n));
    snprintf(name, sizeof name,
             "pseudo-friction, q = %g: published number outside the range of start positions",
             r->q);
    say(c, name, outside(printed, r->least, r->most));
    free(friction);
}

static void judge_nest(const court *c) {
    static const double Q[3] = {1, 2, 4};
    for (int i = 0; i < 3; i++) {
        char name[80];
        pseudo_case p = {.q = Q[i], .damping = PSEUDO_DAMPING, .fraction = 0.5, .softer = 1};
        pseudo found = pseudo_run(&p, NULL, NULL);
        snprintf(name, sizeof name, "deviation of the contact normal, q = %g", Q[i]);
        say(c, name, found.deviation);
        if (i > 0) continue;
        report(c, "first sphere passed, q = 1: mean force against the way",
               interval_exact(found.force));
        say(c, "first sphere passed, q = 1: friction by forces", pseudo_friction_by_force(&found));
    }
}

static void print_range(const pseudo_range *r) {
    printf("q = %4g: %5.2f degrees off, friction %.4f (%.4f to %.4f over %d starts; whole way "
           "%.4f), %5.1f contacts, %6.2f us per step\n",
           r->q, pseudo_normal_off(r->q), r->mean, r->least, r->most, r->n, r->end_mean,
           r->contacts, 1e6 * r->seconds);
}

static void judge_pseudo(const court *c) {
    int starts = c->size->starts;
    pseudo_range *ranges = calloc((size_t)PSEUDO_QS, sizeof *ranges);
    pseudo *all = calloc((size_t)(PSEUDO_QS * starts), sizeof *all);
    if (!ranges || !all) abort();
    pseudo_case base = {.damping = PSEUDO_DAMPING, .fraction = 0.5, .softer = 1};
    int count = pseudo_scan(starts, c->size->densest, &base, ranges, all);
    for (int i = 0; i < count; i++) {
        double q = ranges[i].q;
        print_range(&ranges[i]);
        if (q == 1 || q == 2 || q == 4) judge_density(c, &ranges[i], &all[i * starts]);
    }
    judge_nest(c);
    say_if_run(c, "smallest sphere density that is good enough", good_density(ranges, count));
    span seven = span_at(ranges, count, 7), button = span_at(ranges, count, 2.31);
    say_if_run(c, "pseudo-friction at 7 degrees off the normal", seven.mean);
    report(c, "pseudo-friction at 2.31 degrees", interval_exact(button.mean));
    double printed = published_need(c->published, "pseudo-friction at 2.31 degrees")->thesis;
    double off = outside(printed, button.least, button.most);
    say_if_run(c,
               "pseudo-friction at 2.31 degrees: published number outside the range of start "
               "positions",
               isnan(button.mean) ? NAN : off);
    free(ranges), free(all);
}

/* ---- A00 3.8 and Appendix E ------------------------------------------------------------------ */

static void judge_button(const court *c) {
    direction printed = direction_of(0.433, 0.481, 0.433, 0.07); /* cm, Appendix E */
    say(c, "button, printed data: alpha", printed.alpha);
    say(c, "button, printed data: beta", printed.beta);
    say(c, "button, printed data: gamma", printed.gamma);
    say(c, "button, printed data: gamma_1", printed.gamma1);
    say(c, "button, printed data: gamma_2", printed.gamma2);
    button_end e = button_end_of();
    direction fitted = direction_of(e.r1, e.r2, e.r1, e.distance);
    double gamma1, gamma2;
    direction_measured(&gamma1, &gamma2);
    say(c, "button, fitted: largest deviation of the contact normal",
        fmax(fitted.gamma1, fitted.gamma2));
    say(c, "button, fitted: contact forces of the engine off 3.19",
        fmax(fabs(gamma1 - fitted.gamma1), fabs(gamma2 - fitted.gamma2)));
}

static void judge_equal_spheres(const court *c) {
    direction touching = direction_of(0.5, 0.5, 0.5, 1), dense = direction_of(0.5, 0.5, 0.5, 0.25);
    say(c, "equal spheres that touch: deviation", touching.gamma1);
    say(c, "equal spheres that touch: displacement across", touching.dx);
    say(c, "equal spheres that touch: displacement inwards", touching.dy);
    say(c, "equal spheres, q = 4: deviation", dense.gamma1);
    say(c, "equal spheres, q = 4: displacement across", dense.dx);
    say(c, "equal spheres, q = 4: displacement inwards", dense.dy);
}

/* ---- A00 3.10 -------------------------------------------------------------------------------- */

/* Another processor, and another code: never judged. */
static void report_beds(const court *c) {
    bed beds[BED_CASES];
    bed_run_all(c->size->bed_steps, beds);
    for (int i = 0; i < BED_PRINTED; i++) {
        const bed_case *b = &BED_CASE[i];
        char name[96];
        snprintf(name, sizeof name, "%d particles of %d: time per step and sphere", b->particles,
                 b->spheres);
        report(c, name, interval_exact(beds[i].seconds / (b->particles * b->spheres)));
        if (b->spheres == 1) continue;
        snprintf(name, sizeof name, "%d particles of %d: time per step and particle", b->particles,
                 b->spheres);
        report(c, name, interval_exact(beds[i].seconds / b->particles));
    }
}

/* ---- all ------------------------------------------------------------------------------------- */

int checks_verdicts(const checks_size *size, const char *csv) {
    char why[PUBLISHED_ERROR_MAX];
    court c = {published_read(SCENES "/published.csv", why), verdict_new("particle-checks"), size};
    if (!c.published) {
        fprintf(stderr, "%s\n", why);
        return 4;
    }
    judge_rest(&c);
    judge_impulse(&c);
    judge_drops(&c);
    judge_paths(&c);
    judge_printed_law(&c);
    judge_mode(&c, false);
    judge_mode(&c, true);
    judge_belt(&c);
    judge_blow(&c);
    judge_pseudo(&c);
    judge_button(&c);
    judge_equal_spheres(&c);
    report_beds(&c);
    int code = verdict_finish(c.table, csv, stdout);
    verdict_free(c.table);
    published_free(c.published);
    return code;
}
