#include "experiments/tune/search.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"

enum {
    JOINT_MAX = 8,  /* combinations tried in a round ... */
    ROUNDS_MAX = 4, /* ... each of which ends with a confirmation */
    SEEDS_MIN = 3,  /* a spread of fewer says nothing */
};
#define GAIN_MIN 1.02 /* a setting that saves less is not worth its evidence */

static bool fail(search *s, int code, const char *message) {
    snprintf(s->t->failure, sizeof s->t->failure, "%s", message);
    s->t->failure_code = code;
    return false;
}

/* ---- one candidate --------------------------------------------------------------------------- */

double search_confidence(const search *s) {
    int pairs[TUNE_LOOKS];
    return 100 * (1 - 0.05 / paired_looks(s->t->seeds, s->t->most, pairs));
}

/* Looks at replicates from `first` on, more and more of them, until the answer is clear. */
static bool examine(search *s, candidate *c, int first, paired *p, verdict_of_trial *verdict) {
    int pairs[TUNE_LOOKS], looks = paired_looks(s->t->seeds, s->t->most, pairs);
    *verdict = TRIAL_OPEN;
    for (int look = 0; look < looks && *verdict == TRIAL_OPEN; look++) {
        if (!pilots_run(s->t, &s->reference, first, pairs[look])) return false;
        if (s->reference.stopped[0]) return fail(s, 1, s->reference.stopped);
        if (!pilots_run(s->t, c, first, pairs[look])) return false;
        if (c->stopped[0]) {
            *verdict = TRIAL_STOPPED;
            break;
        }
        *p =
            paired_compare(s->reference.value + first, c->value + first, pairs[look], 0.05 / looks);
        paired_answer answer = paired_judge(p, s->t->tolerance);
        if (answer == PAIRED_WITHIN) *verdict = TRIAL_KEPT;
        if (answer == PAIRED_OUTSIDE) *verdict = TRIAL_OUTSIDE;
    }
    double gain = candidate_ratio(&s->reference, c);
    if (*verdict == TRIAL_KEPT && gain < GAIN_MIN) *verdict = TRIAL_NO_GAIN;
    return true;
}

static bool same_setting(setting a, setting b) {
    return a.step == b.step && a.soft == b.soft && a.fit == b.fit && a.mixed == b.mixed &&
           a.leapfrog == b.leapfrog && a.other == b.other;
}

/* NULL with t->failure. */
static trial *try_setting(search *s, setting which) {
    for (int i = 0; i < s->count; i++)
        if (same_setting(s->trials[i]->pilots.setting, which)) return s->trials[i];
    CLAST_ASSERT(s->count < TRIALS_MAX);
    trial *one = calloc(1, sizeof *one);
    CLAST_ASSERT(one);
    s->trials[s->count++] = one;
    one->pilots.setting = which;
    one->found = one->fresh = (paired){NAN, NAN, NAN, 0, 0};
    return examine(s, &one->pilots, 0, &one->found, &one->verdict) ? one : NULL;
}

/* ---- one knob at a time ---------------------------------------------------------------------- */

typedef enum knob { KNOB_SOFT, KNOB_STEP, KNOB_FIT, KNOB_MIXED, KNOB_LEAPFROG, KNOBS } knob;

static const int LEVELS[KNOBS] = {SOFT_LEVELS, STEP_LEVELS, FIT_LEVELS, 2, 2};

static setting with(setting s, knob k, int level) {
    switch (k) {
    case KNOB_SOFT:
        s.soft = level;
        break;
    case KNOB_STEP:
        s.step = level;
        break;
    case KNOB_FIT:
        s.fit = level;
        break;
    case KNOB_MIXED:
        s.mixed = level > 0;
        break;
    case KNOB_LEAPFROG:
        s.leapfrog = level > 0;
        break;
    case KNOBS:
        break;
    }
    return s;
}

/* The cheapest level that is kept, 0 when none is; -1 with t->failure. */
static int best_level(search *s, knob k) {
    for (int level = LEVELS[k] - 1; level > 0; level--) {
        setting which = with((setting){0}, k, level);
        if (!setting_is_possible(&s->t->space, which)) continue;
        const trial *one = try_setting(s, which);
        if (!one) return -1;
        if (one->verdict == TRIAL_KEPT) return level;
        if (one->verdict == TRIAL_NO_GAIN) return 0; /* dearer levels save less still */
    }
    return 0;
}

/* ---- together -------------------------------------------------------------------------------- */

static const setting_space *sort_space; /* qsort has no context */

static int by_cost(const void *a, const void *b) {
    double x = setting_cost(sort_space, *(const setting *)a);
    double y = setting_cost(sort_space, *(const setting *)b);
    return (x > y) - (x < y);
}

enum { COMBINATIONS = SOFT_LEVELS * STEP_LEVELS * FIT_LEVELS * 4 };

/* Every combination of levels up to the best of each knob, cheapest first; returns their number. */
static int combine(const search *s, const int best[KNOBS], setting all[COMBINATIONS]) {
    int count = 0;
    for (int i = 0; i < COMBINATIONS; i++) {
        int rest = i;
        bool within = true;
        setting one = {0};
        for (knob k = 0; k < KNOBS; k++) {
            within = within && rest % LEVELS[k] <= best[k];
            one = with(one, k, rest % LEVELS[k]);
            rest /= LEVELS[k];
        }
        if (within && setting_is_possible(&s->t->space, one)) all[count++] = one;
    }
    sort_space = &s->t->space;
    qsort(all, (size_t)count, sizeof *all, by_cost);
    return count;
}

/* Kept in the search, and not refuted on fresh replicates. */
static bool is_good(const trial *one) {
    return one->verdict == TRIAL_KEPT && (!one->checked || one->fresh_verdict == TRIAL_KEPT);
}

static double cheapest_good(const search *s) {
    double cost = 1;
    for (int i = 0; i < s->count; i++)
        if (is_good(s->trials[i]))
            cost = fmin(cost, setting_cost(&s->t->space, s->trials[i]->pilots.setting));
    return cost;
}

/* Tries what should be cheaper than all that is good so far, until one is kept. */
static bool try_together(search *s, const int best[KNOBS]) {
    setting all[COMBINATIONS];
    int count = combine(s, best, all), before = s->count;
    double bound = cheapest_good(s);
    for (int i = 0; i < count && s->count < before + JOINT_MAX; i++) {
        if (setting_cost(&s->t->space, all[i]) >= bound) break;
        const trial *one = try_setting(s, all[i]);
        if (!one) return false;
        if (is_good(one)) break;
    }
    return true;
}

/* ---- confirmation ---------------------------------------------------------------------------- */

/* The cheapest, as measured, of what is kept and not checked yet. */
static trial *next_best(const search *s) {
    trial *best = NULL;
    double most = 0;
    for (int i = 0; i < s->count; i++) {
        trial *one = s->trials[i];
        if (one->verdict != TRIAL_KEPT || one->checked) continue;
        double gain = candidate_ratio(&s->reference, &one->pilots);
        if (!isfinite(gain)) gain = 1 / setting_cost(&s->t->space, one->pilots.setting);
        if (gain > most) most = gain, best = one;
    }
    return best;
}

static bool confirm(search *s, trial *one) {
    one->checked = true;
    one->fresh_verdict = TRIAL_KEPT;
    if (s->t->confirm && !examine(s, &one->pilots, s->t->most, &one->fresh, &one->fresh_verdict))
        return false;
    if (one->fresh_verdict == TRIAL_KEPT) s->chosen = one;
    return true;
}

/* After a setting that fresh replicates refute come those that are a little dearer. */
static bool choose(search *s, const int best[KNOBS]) {
    for (int round = 0; round < ROUNDS_MAX && !s->chosen; round++) {
        if (!try_together(s, best)) return false;
        trial *one = next_best(s);
        if (!one) break;
        if (!confirm(s, one)) return false;
    }
    return true;
}

/* ---- all of it ------------------------------------------------------------------------------- */

/* Half of the replicates for the search, half for the confirmation, if there are enough. */
static bool share_replicates(search *s) {
    tune *t = s->t;
    int there = t->vary ? t->value_count : PILOTS_MAX, most = (1 << (TUNE_LOOKS - 1)) * t->seeds;
    if (t->seeds < SEEDS_MIN || there < SEEDS_MIN)
        return fail(s, 2,
                    "a spread needs at least 3 replicates: --seeds N, or as many values "
                    "behind --vary");
    if (t->seeds > PILOTS_MAX / 8) return fail(s, 2, "--seeds: expected at most 32");
    t->confirm = there >= 2 * SEEDS_MIN;
    if (t->confirm) there /= 2;
    t->most = most < there ? most : there;
    if (t->seeds > t->most) t->seeds = t->most;
    return true;
}

/* The reference must run, have the observable, and tell its replicates apart. */
static bool look_at_reference(search *s) {
    candidate *r = &s->reference;
    if (!pilots_run(s->t, r, 0, s->t->seeds)) return false;
    if (r->stopped[0]) return fail(s, 1, r->stopped);
    paired p = paired_compare(r->value, r->value, s->t->seeds, 0.05);
    if (p.n < 2)
        return fail(s, 1,
                    "the observable has no value in the scene as it stands: an empty band, "
                    "nothing discharged, or no linear part");
    if (p.reference == 0)
        return fail(s, 1,
                    "the observable is zero in the scene as it stands: a tolerance in per "
                    "cent of it says nothing");
    bool alike = true;
    for (int k = 1; k < s->t->seeds; k++) alike = alike && r->hash[k] == r->hash[0];
    if (alike)
        return fail(s, 1,
                    "all replicates are the same run, so there is no spread to judge by: "
                    "nothing in the scene is random. --vary NAME=A,B,... tells them apart");
    return true;
}

bool search_run(search *s) {
    CLAST_ASSERT(s && s->t);
    if (!share_replicates(s) || !tune_look(s->t) || !look_at_reference(s)) return false;
    int best[KNOBS];
    for (knob k = 0; k < KNOBS; k++)
        if ((best[k] = best_level(s, k)) < 0) return false;
    return choose(s, best);
}

/* ---- another scene --------------------------------------------------------------------------- */

bool search_verify(search *s) {
    CLAST_ASSERT(s && s->t && s->t->other);
    tune *t = s->t;
    if (t->vary) t->seeds = t->value_count;
    if (t->seeds < SEEDS_MIN || t->seeds > PILOTS_MAX)
        return fail(s, 2, "--verify: expected 3 to 256 replicates");
    t->most = t->seeds;
    t->confirm = false;
    return tune_look(t) && look_at_reference(s) && try_setting(s, (setting){.other = true});
}

void search_free(search *s) {
    for (int i = 0; i < s->count; i++) free(s->trials[i]);
    s->count = 0;
}
