/* setting.h - the knobs of `clast tune`: what a candidate changes in a scene. */
#ifndef CLAST_TUNE_SETTING_H
#define CLAST_TUNE_SETTING_H

#include "experiments/tune/edit.h"

enum { STEP_LEVELS = 11, SOFT_LEVELS = 9, FIT_LEVELS = 4, SETTING_LABEL = 80 };

/* Levels; {0} is the scene as it stands. */
typedef struct setting {
    int step;      /* the time step times 1, 1.5, 2, 3, ... 32 */
    int soft;      /* every young and stiffness divided by 1, 3, 10, ... 10^4; the step follows */
    int fit;       /* spheres of fitted shapes: as stated, 5, 3, 1 */
    bool mixed;    /* precision: mixed */
    bool leapfrog; /* scheme: leapfrog, where the scene names another */
    bool other;    /* another scene, with knobs that are not known here; the rest is 0 */
} setting;

/* What the scene leaves to choose from. */
typedef struct setting_space {
    double step;                  /* s, of the scene as it stands */
    bool step_given;              /* the scene states it */
    double follow[SOFT_LEVELS];   /* step of the softened scene over that of the scene */
    double critical[SOFT_LEVELS]; /* s, where explicit schemes become unstable; 0: not usable */
    int fit_spheres;              /* most that a fitted shape has; 0: there is none */
    bool can_mix, can_leap;
} setting_space;

double setting_step_factor(int level);
double setting_soft_factor(int level);

/* s; NAN of another scene. */
double setting_time_step(const setting_space *space, setting s);

/* False where the step is above the critical one, or where the scene has no such knob. */
bool setting_is_possible(const setting_space *space, setting s);

/* Predicted cost per simulated second over that of the scene as it stands. Steps and spheres count;
 * what mixed precision and another scheme save is a guess that decides the order of trials alone.
 */
double setting_cost(const setting_space *space, setting s);

/* "step x 4, stiffness / 100, spheres 3, mixed", and "step4-soft100-fit3-mixed" for names of files.
 */
void setting_describe(setting s, char text[SETTING_LABEL]);
void setting_name(setting s, char text[SETTING_LABEL]);

/* Most spheres that are fitted to a shape of the scene; 0: none are. */
int setting_fit_spheres(scene_edit *e);

/* Puts the setting into a scene. False when a place for it cannot be found. */
bool setting_apply(scene_edit *e, const setting_space *space, setting s);

#endif
