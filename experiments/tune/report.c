#include "experiments/tune/search.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"

static const char *const VERDICTS[] = {"kept", "outside", "not shown", "stopped", "no gain"};

/* ---- the table ------------------------------------------------------------------------------- */

static void print_number(FILE *to, int width, const char *format, double value) {
    char text[40] = "-";
    if (isfinite(value)) snprintf(text, sizeof text, format, value);
    fprintf(to, " %*s", width, text);
}

static void print_difference(FILE *to, const paired *p) {
    char text[60] = "-";
    if (isfinite(p->difference))
        snprintf(text, sizeof text, "%+.2f +- %.2f", 100 * p->difference, 100 * p->half);
    fprintf(to, "  %16s %5d", text, p->n);
}

static void print_row(FILE *to, const search *s, const candidate *c, const paired *p,
                      const char *verdict) {
    char what[SETTING_LABEL];
    setting_describe(c->setting, what);
    fprintf(to, "%-36s", what);
    print_number(to, 9, "%.3g", setting_time_step(&s->t->space, c->setting));
    bool ran = !c->stopped[0];
    print_number(to, 9, "%.3g", ran ? candidate_cost(c) : (double)NAN);
    print_number(to, 8, "%.2f", ran ? candidate_ratio(&s->reference, c) : (double)NAN);
    print_difference(to, p);
    fprintf(to, "  %s\n", verdict);
}

/* The first line that is no warning: what stopped it, not what was said before. */
static void print_reason(FILE *to, const char *why) {
    for (const char *line = why; *line;) {
        int length = (int)strcspn(line, "\n");
        const char *warning = strstr(line, ": warning: ");
        if (!warning || warning > line + length || line[length] == '\0') {
            fprintf(to, "    %.*s\n", length, line);
            return;
        }
        line += length + 1;
    }
}

static void print_trial(FILE *to, const search *s, const trial *one) {
    print_row(to, s, &one->pilots, &one->found, VERDICTS[one->verdict]);
    if (one->pilots.stopped[0]) print_reason(to, one->pilots.stopped);
    if (one->checked && s->t->confirm) {
        fprintf(to, "%-36s %9s %9s %8s", "  the same on fresh replicates", "", "", "");
        print_difference(to, &one->fresh);
        fprintf(to, "  %s\n", VERDICTS[one->fresh_verdict]);
    }
}

static void print_chosen(const search *s, FILE *to) {
    const candidate *c = s->chosen ? &s->chosen->pilots : &s->reference;
    char what[SETTING_LABEL];
    setting_describe(c->setting, what);
    if (!s->chosen) {
        fprintf(to, "chosen: the scene as it stands; nothing cheaper was shown to keep %s\n",
                s->t->what.name);
        return;
    }
    fprintf(to, "chosen: %s\n", what);
    fprintf(to,
            "saving: a factor of %.2f in processor time, measured over the pilots of this "
            "search\n",
            candidate_ratio(&s->reference, c));
    if (!s->t->confirm) fprintf(to, "not confirmed: too few replicates to keep some for that\n");
}

static void print_verified(const search *s, FILE *to) {
    const trial *one = s->trials[0];
    bool kept = one->verdict == TRIAL_KEPT || one->verdict == TRIAL_NO_GAIN;
    const char *const words = kept ? "verified: the interval lies"
                              : one->verdict == TRIAL_OPEN
                                  ? "not shown: not all of the interval lies"
                                  : "refuted: the interval does not lie";
    fprintf(to, "%s within %g %%; a factor of %.2f in processor time\n", words,
            100 * s->t->tolerance, candidate_ratio(&s->reference, &one->pilots));
}

void search_print(const search *s, FILE *to) {
    CLAST_ASSERT(s && to);
    int pairs[TUNE_LOOKS], looks = paired_looks(s->t->seeds, s->t->most, pairs);
    fprintf(to, "\n%s of %s, tolerance %g %%\n", s->t->what.name, s->t->path,
            100 * s->t->tolerance);
    fprintf(to, "differences are paired; their intervals have %.4g %% each, for %d look%s at",
            search_confidence(s), looks, looks == 1 ? "" : "s");
    for (int i = 0; i < looks; i++) fprintf(to, "%s %d", i ? "," : "", pairs[i]);
    fprintf(to, " pairs\n\n%-36s %9s %9s %8s  %16s %5s  %s\n", "setting", "step s", "s/s",
            "speed-up", "difference %", "pairs", "verdict");
    paired none = {NAN, NAN, NAN, s->t->seeds, 0};
    print_row(to, s, &s->reference, &none, "reference");
    for (int i = 0; i < s->count; i++) print_trial(to, s, s->trials[i]);
    fprintf(to, "\n");
    if (s->t->other)
        print_verified(s, to);
    else
        print_chosen(s, to);
}

/* ---- the scene ------------------------------------------------------------------------------- */

static void print_evidence(const search *s, FILE *to) {
    const trial *c = s->chosen;
    char what[SETTING_LABEL];
    setting_describe(c ? c->pilots.setting : (setting){0}, what);
    fprintf(to, "# clast tune: %s of %s within %g %%\n# chosen: %s\n", s->t->what.name, s->t->path,
            100 * s->t->tolerance, what);
    if (!c) {
        fprintf(to, "# nothing cheaper was shown to keep it, of %d settings tried\n", s->count);
        return;
    }
    const paired *p = s->t->confirm ? &c->fresh : &c->found;
    fprintf(to, "# difference %+.2f +- %.2f %% (%.4g %% confidence), %d pairs%s\n",
            100 * p->difference, 100 * p->half, search_confidence(s), p->n,
            s->t->confirm ? " that had no say in the choice" : ", not confirmed on others");
    fprintf(to, "# saves a factor of %.2f in processor time, measured; of %d settings tried\n",
            candidate_ratio(&s->reference, &c->pilots), s->count);
}

char *search_scene(const search *s) {
    CLAST_ASSERT(s);
    char *text = tune_text(s->t, s->chosen ? s->chosen->pilots.setting : (setting){0});
    CLAST_ASSERT(text); /* its pilots were written in the same way */
    char *whole;
    size_t length;
    FILE *to = open_memstream(&whole, &length);
    CLAST_ASSERT(to);
    print_evidence(s, to);
    fputs(text, to);
    CLAST_ASSERT(fclose(to) == 0);
    free(text);
    return whole;
}
