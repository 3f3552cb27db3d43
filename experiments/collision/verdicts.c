/* verdicts.c - what theory and the source say, ours beside it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "experiments/collision/collision.h"
#include "experiments/study/published.h"
#include "experiments/study/verdict.h"

typedef struct court {
    published_table *published;
    verdict_table *table;
} court;

static void say(const court *c, const char *quantity, double value) {
    verdict_named(c->table, c->published, quantity, value);
}

/* ---- impact models --------------------------------------------------------------------------- */

static impact_case case_of(clast_law law, double restitution, double young, double speed) {
    impact_case c = {.trial = {.law = law,
                               .restitution = restitution,
                               .young = young,
                               .speed = speed,
                               .stiffness = LINEAR_STIFF}};
    if (law == CLAST_LAW_HERTZ_BRILLIANTOV)
        c.trial.dissipation = clast_dissipation(restitution, IMPACT_SPEED, trial_mass(),
                                                BALL_RADIUS, trial_modulus(young));
    impact_case_run(&c, NULL, NULL);
    return c;
}

static void judge_laws(const court *c) {
    static const clast_law LAW[7] = {CLAST_LAW_LINEAR,      CLAST_LAW_MAW,
                                     CLAST_LAW_HOOKE,       CLAST_LAW_HERTZ_MINDLIN,
                                     CLAST_LAW_HERTZ_A00,   CLAST_LAW_HERTZ_BRILLIANTOV,
                                     CLAST_LAW_WALTON_BRAUN};
    for (int i = 0; i < 7; i++) {
        char name[100];
        const char *law = clast_law_info_of(LAW[i])->name;
        impact_case k = case_of(LAW[i], 0.7, BALL_YOUNG, IMPACT_SPEED);
        snprintf(name, sizeof name, "%s: largest difference of the overlap", law);
        say(c, name, k.worst_overlap);
        snprintf(name, sizeof name, "%s: duration over theory", law);
        say(c, name, k.measured.duration / k.theory.duration);
        snprintf(name, sizeof name, "%s: rebound over theory", law);
        say(c, name, k.measured.rebound / k.theory.rebound);
    }
}

/* Exponent of a power law from its ends. */
static double exponent(double low, double high, double ratio) {
    return log(high / low) / log(ratio);
}

static void judge_power_laws(const court *c) {
    static const clast_law LAW[2] = {CLAST_LAW_HOOKE, CLAST_LAW_HERTZ_MINDLIN};
    for (int i = 0; i < 2; i++) {
        char name[100];
        const char *law = clast_law_info_of(LAW[i])->name;
        impact slow = case_of(LAW[i], 1, BALL_YOUNG, 0.1).measured;
        impact fast = case_of(LAW[i], 1, BALL_YOUNG, 1).measured;
        impact soft = case_of(LAW[i], 1, 0.1 * BALL_YOUNG, 1).measured;
        snprintf(name, sizeof name, "%s: exponent of the overlap in the speed", law);
        say(c, name, exponent(slow.overlap_max, fast.overlap_max, 10));
        snprintf(name, sizeof name, "%s: exponent of the duration in the speed", law);
        say(c, name, exponent(slow.duration, fast.duration, 10));
        snprintf(name, sizeof name, "%s: exponent of the overlap in the modulus", law);
        say(c, name, exponent(soft.overlap_max, fast.overlap_max, 10));
        snprintf(name, sizeof name, "%s: exponent of the duration in the modulus", law);
        say(c, name, exponent(soft.duration, fast.duration, 10));
    }
}

static void judge_models(const court *c) {
    impact hertz = case_of(CLAST_LAW_HERTZ_MINDLIN, 1, BALL_YOUNG, IMPACT_SPEED).measured;
    impact hooke = case_of(CLAST_LAW_HOOKE, 1, BALL_YOUNG, IMPACT_SPEED).measured;
    double k = hertz_stiffness(trial_modulus(BALL_YOUNG), BALL_RADIUS);
    double unit = pow(trial_mass() / k, 0.4) * pow(IMPACT_SPEED, 0.8);
    say(c, "Hertz: constant of the largest overlap", hertz.overlap_max / unit);
    say(c, "Hertz: constant of the duration", hertz.duration * IMPACT_SPEED / unit);
    say(c, "Hooke over Hertz: largest overlap", hooke.overlap_max / hertz.overlap_max);
    impact elastic = case_of(CLAST_LAW_LINEAR, 1, BALL_YOUNG, IMPACT_SPEED).measured;
    impact damped = case_of(CLAST_LAW_LINEAR, 0.2, BALL_YOUNG, IMPACT_SPEED).measured;
    impact fast = case_of(CLAST_LAW_LINEAR, 1, BALL_YOUNG, 2 * IMPACT_SPEED).measured;
    say(c, "linear: largest overlap at e = 0.2 over e = 1",
        damped.overlap_max / elastic.overlap_max);
    say(c, "linear: time of loading at e = 0.2 over e = 1", damped.time_max / elastic.time_max);
    say(c, "linear: duration at twice the speed over once", fast.duration / elastic.duration);
    say(c, "linear: largest overlap at twice the speed over once",
        fast.overlap_max / elastic.overlap_max);
    impact yields = case_of(CLAST_LAW_WALTON_BRAUN, 0.5, BALL_YOUNG, IMPACT_SPEED).measured;
    say(c, "walton-braun: overlap left over the largest at e = 0.5",
        yields.overlap_end / yields.overlap_max);
    impact_case slow = case_of(CLAST_LAW_HERTZ_BRILLIANTOV, 0.7, BALL_YOUNG, 0.05);
    impact_case quick = case_of(CLAST_LAW_HERTZ_BRILLIANTOV, 0.7, BALL_YOUNG, 5);
    say(c, "hertz-brilliantov: restitution at 5 m/s over 0.05 m/s",
        quick.measured.rebound / slow.measured.rebound * 0.05 / 5);
}

/* ---- schemes --------------------------------------------------------------------------------- */

static double worst_map_difference(const scheme_set *s) {
    double worst = 0;
    for (int r = 0; r < 2; r++)
        for (int e = 0; e < 2; e++)
            for (int k = 0; k < CLAST_SCHEMES; k++)
                worst = fmax(worst, s->run[r][e][k].map_difference); /* NAN stands back */
    return worst;
}

static void judge_schemes(const court *c, const scheme_set *s) {
    say(c, "schemes: largest difference of the overlap from the amplification matrices",
        worst_map_difference(s));
    for (int i = 0; i < STATEMENT_COUNT; i++)
        say(c, STATEMENTS[i].quantity, STATEMENTS[i].value(s));
}

/* The same statements under every other way to set the collision up. */
static void print_sensitivity(const court *c, const scheme_set *sets) {
    printf("what the set-up does to the statements on schemes (* where the verdict is another):\n");
    for (int k = 0; k < SCHEME_SETUP_COUNT; k++)
        printf("%s%s", k ? ", " : "", SCHEME_SETUPS[k].name);
    printf("\n");
    for (int i = 0; i < STATEMENT_COUNT; i++) {
        const published *p = published_find(c->published, STATEMENTS[i].quantity);
        verdict first = VERDICT_NOT_COMPARABLE;
        printf("%-75s", STATEMENTS[i].quantity);
        for (int k = 0; k < SCHEME_SETUP_COUNT; k++) {
            double value = STATEMENTS[i].value(&sets[k]);
            verdict now =
                verdict_of(published_target(p), interval_exact(value), p->tolerance, true);
            if (k == 0) first = now;
            printf(" %9.3g%s", value, now == first ? " " : "*");
        }
        printf("\n");
    }
}

int collision_verdicts(const char *csv) {
    scheme_set *sets = scheme_sets_run();
    char why[PUBLISHED_ERROR_MAX];
    court c = {published_read(SCENES "/published.csv", why), verdict_new("collision")};
    if (!c.published) {
        fprintf(stderr, "%s\n", why);
        return 4;
    }
    judge_laws(&c);
    judge_power_laws(&c);
    judge_models(&c);
    judge_schemes(&c, &sets[0]);
    print_sensitivity(&c, sets);
    free(sets);
    int code = verdict_finish(c.table, csv, stdout);
    verdict_free(c.table);
    published_free(c.published);
    return code;
}
