#include "experiments/tune/setting.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MIXED_COST    0.9 /* of double: 3 to 22 % are saved (engine/README.md) */
#define LEAPFROG_COST 0.5 /* of any other scheme, at least */

static const double STEPS[STEP_LEVELS] = {1, 1.5, 2, 3, 4, 6, 8, 12, 16, 24, 32};
static const double SOFT[SOFT_LEVELS] = {1, 3, 10, 30, 100, 300, 1e3, 3e3, 1e4};

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
    return space->step * step_ratio(space, s);
}

bool setting_is_possible(const setting_space *space, setting s) {
    SCENE_ASSERT(space && s.soft >= 0 && s.soft < SOFT_LEVELS);
    if ((s.mixed && !space->can_mix) || (s.leapfrog && !space->can_leap)) return false;
    if (s.step == 0 && s.soft == 0) return true;
    return space->critical[s.soft] > 0 &&
           setting_time_step(space, s) <= 0.99 * space->critical[s.soft];
}

double setting_cost(const setting_space *space, setting s) {
    double cost = 1 / step_ratio(space, s);
    return cost * (s.mixed ? MIXED_COST : 1) * (s.leapfrog ? LEAPFROG_COST : 1);
}

static void write_knobs(setting s, const char *step, const char *soft, const char *between,
                        char text[SETTING_LABEL]) {
    char factor[2][40] = {"", ""};
    if (s.step) snprintf(factor[0], sizeof factor[0], "%s%g", step, STEPS[s.step]);
    if (s.soft) snprintf(factor[1], sizeof factor[1], "%s%g", soft, SOFT[s.soft]);
    const char *words[] = {factor[0], factor[1], s.mixed ? "mixed" : "",
                           s.leapfrog ? "leapfrog" : ""};
    text[0] = '\0';
    for (int i = 0; i < 4; i++) {
        size_t used = strlen(text);
        if (words[i][0])
            snprintf(text + used, SETTING_LABEL - used, "%s%s", used ? between : "", words[i]);
    }
}

void setting_describe(setting s, char text[SETTING_LABEL]) {
    write_knobs(s, "step x ", "stiffness / ", ", ", text);
    if (!text[0]) snprintf(text, SETTING_LABEL, "as it stands");
}

void setting_name(setting s, char text[SETTING_LABEL]) {
    write_knobs(s, "step", "soft", "-", text);
    if (!text[0]) snprintf(text, SETTING_LABEL, "reference");
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
    bool good = change_step(e, space, s);
    if (s.mixed) good &= scene_edit_put(e, NULL, "precision", "mixed");
    if (s.leapfrog) good &= scene_edit_put(e, "time", "scheme", "leapfrog");
    return good;
}
