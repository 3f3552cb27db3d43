#include "experiments/tune/setting.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MIXED_COST    0.9 /* of double: 3 to 22 % are saved (engine/README.md) */
#define LEAPFROG_COST 0.5 /* of any other scheme, at least */

static const double STEPS[STEP_LEVELS] = {1, 1.5, 2, 3, 4, 6, 8, 12, 16, 24, 32};
static const double SOFT[SOFT_LEVELS] = {1, 3, 10, 30, 100, 300, 1e3, 3e3, 1e4};
static const int FIT[FIT_LEVELS] = {0, 5, 3, 1};

double setting_step_factor(int level) {
    SCENE_ASSERT(level >= 0 && level < STEP_LEVELS);
    return STEPS[level];
}

double setting_soft_factor(int level) {
    SCENE_ASSERT(level >= 0 && level < SOFT_LEVELS);
    return SOFT[level];
}

/* As it is written into the scene: four digits. */
static double rounded(double value) {
    char text[40];
    snprintf(text, sizeof text, "%.4g", value);
    return strtod(text, NULL);
}

static double step_ratio(const setting_space *space, setting s) {
    return rounded(space->follow[s.soft] * setting_step_factor(s.step));
}

double setting_time_step(const setting_space *space, setting s) {
    return s.other ? (double)NAN : space->step * step_ratio(space, s);
}

bool setting_is_possible(const setting_space *space, setting s) {
    SCENE_ASSERT(space && s.soft >= 0 && s.soft < SOFT_LEVELS);
    if ((s.mixed && !space->can_mix) || (s.leapfrog && !space->can_leap)) return false;
    if (s.fit && FIT[s.fit] >= space->fit_spheres) return false;
    if (s.step == 0 && s.soft == 0) return true;
    return space->critical[s.soft] > 0 &&
           setting_time_step(space, s) <= 0.99 * space->critical[s.soft];
}

double setting_cost(const setting_space *space, setting s) {
    double cost = 1 / step_ratio(space, s);
    if (s.fit) cost *= (double)FIT[s.fit] / space->fit_spheres;
    return cost * (s.mixed ? MIXED_COST : 1) * (s.leapfrog ? LEAPFROG_COST : 1);
}

/* What the words of a description begin with; numbers come behind them. */
typedef struct knob_words {
    const char *step, *soft, *fit, *between;
} knob_words;

static void write_knobs(setting s, const knob_words *words, char text[SETTING_LABEL]) {
    char knob[5][40] = {"", "", "", "", ""};
    if (s.step) snprintf(knob[0], sizeof knob[0], "%s%g", words->step, STEPS[s.step]);
    if (s.soft) snprintf(knob[1], sizeof knob[1], "%s%g", words->soft, SOFT[s.soft]);
    if (s.fit) snprintf(knob[2], sizeof knob[2], "%s%d", words->fit, FIT[s.fit]);
    if (s.mixed) snprintf(knob[3], sizeof knob[3], "mixed");
    if (s.leapfrog) snprintf(knob[4], sizeof knob[4], "leapfrog");
    text[0] = '\0';
    for (int i = 0; i < 5; i++) {
        size_t used = strlen(text);
        const char *between = used && knob[i][0] ? words->between : "";
        snprintf(text + used, SETTING_LABEL - used, "%s%s", between, knob[i]);
    }
}

void setting_describe(setting s, char text[SETTING_LABEL]) {
    write_knobs(s, &(knob_words){"step x ", "stiffness / ", "spheres ", ", "}, text);
    if (!text[0]) snprintf(text, SETTING_LABEL, s.other ? "the other scene" : "as it stands");
}

void setting_name(setting s, char text[SETTING_LABEL]) {
    write_knobs(s, &(knob_words){"step", "soft", "fit", "-"}, text);
    if (!text[0]) snprintf(text, SETTING_LABEL, s.other ? "other" : "reference");
}

/* ---- into the text --------------------------------------------------------------------------- */

/* Divides `key` of every entry of a map or list of maps. */
static void soften(scene_edit *e, const char *section, const char *key, double factor) {
    const tree_node *all = tree_get(e->root, section);
    const char *operation = scene_print(e->arena, "/ %g", factor);
    for (const tree_node *one = all ? all->first : NULL; one; one = one->next) {
        const tree_node *value = tree_get(one, key);
        if (value && value->kind == TREE_SCALAR) scene_edit_scale(e, value, operation);
    }
}

/* Where a shape says how many spheres are fitted to it; NULL when none are. */
static const tree_node *fit_of(const tree_node *shape) {
    const tree_node *spheres = tree_get(tree_get(shape, "fit"), "spheres");
    return spheres && spheres->kind == TREE_SCALAR ? spheres : NULL;
}

static int count_of(scene_edit *e, const tree_node *spheres) {
    scene_parameters parameters = scene_parameters_read(e->arena, &e->faults, e->root);
    return atoi(scene_parameters_word(&parameters, spheres->text));
}

static void fit_fewer(scene_edit *e, int count) {
    const tree_node *shapes = tree_get(e->root, "shapes");
    for (const tree_node *one = shapes ? shapes->first : NULL; one; one = one->next) {
        const tree_node *spheres = fit_of(one);
        if (spheres && count_of(e, spheres) > count)
            scene_edit_replace(e, spheres, scene_print(e->arena, "%d", count));
    }
}

int setting_fit_spheres(scene_edit *e) {
    SCENE_ASSERT(e);
    int most = 0;
    const tree_node *shapes = tree_get(e->root, "shapes");
    for (const tree_node *one = shapes ? shapes->first : NULL; one; one = one->next) {
        const tree_node *spheres = fit_of(one);
        int count = spheres ? count_of(e, spheres) : 0;
        if (count > most) most = count;
    }
    return most;
}

static bool change_step(scene_edit *e, const setting_space *space, setting s) {
    const tree_node *there = tree_get(tree_get(e->root, "time"), "step");
    double ratio = step_ratio(space, s);
    if (ratio == 1) return true;
    if (!space->step_given && s.step == 0) return true; /* it follows by itself */
    if (space->step_given && there && there->kind == TREE_SCALAR) {
        scene_edit_scale(e, there, scene_print(e->arena, "* %.4g", ratio));
        return true;
    }
    const char *value = scene_print(e->arena, "%.4g s", setting_time_step(space, s));
    return scene_edit_put(e, "time", "step", value);
}

bool setting_apply(scene_edit *e, const setting_space *space, setting s) {
    SCENE_ASSERT(e && e->root && space);
    if (s.soft) {
        soften(e, "materials", "young", setting_soft_factor(s.soft));
        soften(e, "pairs", "stiffness", setting_soft_factor(s.soft));
    }
    if (s.fit) fit_fewer(e, FIT[s.fit]);
    bool good = change_step(e, space, s);
    if (s.mixed) good &= scene_edit_put(e, NULL, "precision", "mixed");
    if (s.leapfrog) good &= scene_edit_put(e, "time", "scheme", "leapfrog");
    return good;
}
