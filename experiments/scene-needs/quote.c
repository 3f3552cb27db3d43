/* quote.c - the table in words, for `clast plan`. */
#include <string.h>

#include "engine/check.h"
#include "experiments/scene-needs/needs.h"
#include "experiments/study/verdict.h"

static void quote_row(const need *n, FILE *to) {
    fprintf(to, "      %s, %s: ", n->study, n->observable);
    if (n->lost > 0) {
        fprintf(to, "none in %d of %d runs", n->lost, n->lost + n->replicates);
    } else {
        interval change = {.mean = 100 * n->error,
                           .half = 50 * (n->error_high - n->error_low),
                           .n = n->replicates};
        char text[NEED_TEXT];
        interval_text(&change, text, sizeof text);
        bool lost_in_scatter = !(n->error_low > 0) && !(n->error_high < 0);
        fprintf(to, "%s%s %% (%d pairs%s)", n->error > 0 ? "+" : "", text, n->replicates,
                lost_in_scatter ? ", not told from 0" : "");
    }
    fprintf(to, ", at %.2f of the cost\n", n->cost);
}

/* Rows of one way to leave a feature out stand below each other. */
static void quote_feature(const need_table *t, need_feature feature, FILE *to) {
    fprintf(to, "  %s\n", need_feature_name(feature));
    for (int i = 0; i < t->count; i++) {
        const need *n = &t->rows[i];
        if (n->feature != feature) continue;
        bool first = true;
        for (int k = 0; k < i; k++)
            first = first &&
                    !(t->rows[k].feature == feature && strcmp(t->rows[k].without, n->without) == 0);
        if (!first) continue;
        fprintf(to, "    with %s:\n", n->without);
        for (int k = i; k < t->count; k++)
            if (t->rows[k].feature == feature && strcmp(t->rows[k].without, n->without) == 0)
                quote_row(&t->rows[k], to);
    }
}

static bool is_measured(const need_table *t, need_feature feature) {
    for (int i = 0; i < t->count; i++)
        if (t->rows[i].feature == feature) return true;
    return false;
}

void needs_quote(const need_table *t, const bool uses[NEED_FEATURES], FILE *to) {
    CLAST_ASSERT(t && uses && to);
    int quoted = 0;
    for (int i = 0; i < NEED_FEATURES; i++) {
        if (!uses[i] || !is_measured(t, (need_feature)i)) continue;
        if (quoted++ == 0)
            fprintf(to, "what its features were worth in the scenes of the study scene-needs "
                        "(mean change with its 95 %%\n"
                        "interval; measured there, on these observables: nothing of it is carried "
                        "over to this scene):\n");
        quote_feature(t, (need_feature)i, to);
    }
}
