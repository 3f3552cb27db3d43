/* verdicts.c - what can be said beforehand of a scene without a feature, ours beside it. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/scene-needs/study.h"
#include "experiments/study/published.h"
#include "experiments/study/verdict.h"

typedef struct court {
    const needs_study *study;
    published_table *published;
    verdict_table *table;
} court;

static const needs_runs *runs_of(const court *c, const char *name) {
    for (int i = 0; i < SCENES_COUNT; i++)
        if (!strcmp(c->study->runs[i].scene->name, name)) return &c->study->runs[i];
    clast_panic(__FILE__, __LINE__, name);
}

/* "SCENE: OBSERVABLE WORDS": per cent of the mean of the scene as it stands. */
static void judge(const court *c, const char *name, int observable, const char *key,
                  const char *words) {
    const needs_runs *r = runs_of(c, name);
    char quantity[200];
    snprintf(quantity, sizeof quantity, "%s: %s %s", name, r->scene->observable[observable].name,
             words);
    verdict_measured(c->table, c->published, quantity,
                     needs_difference(r, observable, needs_variant(r, key)));
}

int needs_verdicts(const needs_study *s, const char *path) {
    char why[PUBLISHED_ERROR_MAX];
    court c = {s, published_read(SCENES "/published.csv", why), verdict_new("scene-needs")};
    if (!c.published) {
        fprintf(stderr, "%s\n", why);
        return 4;
    }
    judge(&c, "button hopper", 0, "smooth", "without friction");
    judge(&c, "heap", 0, "history", "without tangential history");
    judge(&c, "heap", 0, "mixed", "with precision mixed");
    judge(&c, "silo", 0, "mixed", "with precision mixed");
    for (int o = 0; o < 2; o++) judge(&c, "button hopper", o, "mixed", "with precision mixed");
    int code = verdict_finish(c.table, path, stdout);
    verdict_free(c.table);
    published_free(c.published);
    return code;
}
