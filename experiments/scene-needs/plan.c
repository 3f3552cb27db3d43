/* plan.c - the scenes, what is left out of them, and the files that say so. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/run/folder.h"
#include "experiments/scene-needs/study.h"
#include "experiments/study/output.h"
#include "experiments/tune/edit.h"
#include "experiments/tune/pilot.h"

/* ---- what is left out ------------------------------------------------------------------------ */

#define HISTORY                                                                                    \
    { NEED_HISTORY, "history", "contact.tangent: viscous", "", "contact.tangent=viscous", 0 }
#define PRECISION                                                                                  \
    { NEED_PRECISION, "mixed", "precision: mixed", "", "precision=mixed", 0 }
/* Maw's stiffness is that of a Hertz contact at this impact speed. */
#define LINEAR                                                                                     \
    { NEED_HERTZ, "linear", "contact.law: maw", "", "contact.law=maw;time.impact_speed=1 m/s", 0 }
#define ELASTIC                                                                                    \
    { NEED_DAMPING, "elastic", "restitution: 1", "restitution=1", "", 0 }

static const needs_switch BUTTON_SWITCHES[] = {
    HISTORY,
    {NEED_ROTATION, "still", "moments of inertia times a million", "inertia_divisor=4e-6", "", 0},
    {NEED_FRICTION, "smooth", "friction: 0", "friction=0;wall_friction=0", "", 0},
    ELASTIC,
    LINEAR,
    {NEED_SPHERES, "spheres-15", "15 spheres per body in place of 7", "spheres=15", "", 0},
    {NEED_SPHERES, "spheres-3", "3 spheres per body in place of 7", "spheres=3", "", 0},
    {NEED_SPHERES, "spheres-1", "1 sphere per body in place of 7", "spheres=1", "", 0},
    PRECISION,
};

static const needs_switch SPHERE_SWITCHES[] = {
    HISTORY,
    {NEED_ROTATION, "still", "moments of inertia times a million", "turn=1e6", "", 0},
    {NEED_FRICTION, "smooth", "friction and rolling_friction: 0", "friction=0;rolling=0", "", 0},
    {NEED_ROLLING, "rolling", "rolling_friction: 0", "rolling=0", "", 0},
    ELASTIC,
    {NEED_DEPTH, "layer", "one layer: motion in-plane y", "layers=1;half_depth=0 mm;sheet=0",
     "motion=in-plane y", 4},
    LINEAR,
    PRECISION,
};

#define COUNT(list) ((int)(sizeof(list) / sizeof *(list)))

const needs_scene NEEDS_SCENES[SCENES_COUNT] = {
    {.name = "heap",
     .legs = 1,
     .leg = {{"scene-needs/heap.yaml", "",
              "count=12;half_box=30 mm;young=10 MPa;step=40 us;"
              "fill=20 cm;settle=0.4 s;pile=0.8 s",
              "", "frames=500 ms"}},
     .observables = 1,
     .observable = {{"angle of repose", "deg", 0, needs_heap_slope, false}},
     .switches = COUNT(SPHERE_SWITCHES),
     .without = SPHERE_SWITCHES},
    {.name = "silo",
     .legs = 1,
     .leg = {{"scene-needs/silo.yaml", "",
              "count=12;half_width=60 mm;young=10 MPa;step=40 us;"
              "fill=15 cm;settle=0.3 s;flow=0.4 s",
              "", "frames=200 ms"}},
     .observables = 1,
     .observable = {{"discharge rate", "kg/s", 0, needs_flow_rate, true}},
     .switches = COUNT(SPHERE_SWITCHES),
     .without = SPHERE_SWITCHES},
    {.name = "button hopper",
     .legs = 2,
     .leg = {{"button-hopper/fill.yaml",
              "friction=0.2;wall_friction=0.2;columns=10;step=4.5 us;settle=1 s",
              "young=175 MPa;step=30 us;settle=0.4 s", "output.frames=none", NULL},
             {"button-hopper/discharge.yaml", "orifice=10 cm;step=4.5 us;latest=0.6 s",
              "young=175 MPa;step=30 us;latest=0.3 s", "output.frames=none", NULL}},
     .observables = 2,
     .observable = {{"solid fraction at rest", "-", 0, needs_solid_fraction, false},
                    {"flow rate at 10 cm", "kg/s", 1, needs_flow_rate, false}},
     .switches = COUNT(BUTTON_SWITCHES),
     .without = BUTTON_SWITCHES},
};

/* ---- scene files ----------------------------------------------------------------------------- */

/* Calls for every "name=value" of a list. */
static void each(const char *list, void *context,
                 void (*use)(void *context, char *name, const char *value)) {
    char copy[JOB_TEXT], *rest = NULL;
    CLAST_ASSERT(strlen(list) < sizeof copy);
    strcpy(copy, list);
    for (char *one = strtok_r(copy, ";", &rest); one; one = strtok_r(NULL, ";", &rest)) {
        char *equals = strchr(one, '=');
        CLAST_ASSERT(equals);
        *equals = '\0';
        use(context, one, equals + 1);
    }
}

static void put_key(void *context, char *name, const char *value) {
    scene_edit *e = context;
    char *dot = strchr(name, '.');
    if (dot) *dot = '\0';
    const char *section = dot ? scene_copy(e->arena, name, strlen(name)) : NULL;
    const char *key = dot ? dot + 1 : name;
    bool found = scene_edit_put(e, section, scene_copy(e->arena, key, strlen(key)),
                                scene_copy(e->arena, value, strlen(value)));
    CLAST_ASSERT(found);
}

/* The scene of a leg with the keys of a variant put in. */
static void write_scene(const needs_leg *of, const char *put, const char *path) {
    char *from = text_format("%s/%s", EXPERIMENTS, of->file);
    char *source = tune_source(from, NULL, 0);
    if (!source) {
        fprintf(stderr, "%s: cannot be opened\n", from);
        exit(4);
    }
    scene_arena arena = {0};
    scene_edit e = scene_edit_start(&arena, source);
    CLAST_ASSERT(e.root);
    each(of->put, &e, put_key);
    each(put, &e, put_key);
    char *text = scene_edit_finish(&e);
    int failure = text ? file_write_text(path, text) : 0;
    if (!text || failure) {
        fprintf(stderr, "%s: cannot be written: %s\n", path, strerror(failure));
        exit(4);
    }
    free(text);
    scene_arena_free(&arena);
    free(source);
    free(from);
}

/* ---- jobs ------------------------------------------------------------------------------------ */

static const needs_switch *switch_of(const needs_runs *r, int variant) {
    static const needs_switch NONE = {.key = "reference", .set = "", .put = ""};
    return variant > 0 ? &r->scene->without[variant - 1] : &NONE;
}

int needs_variant(const needs_runs *r, const char *key) {
    int v = 0;
    while (v < r->variants && strcmp(switch_of(r, v)->key, key)) v++;
    CLAST_ASSERT(v < r->variants);
    return v;
}

/* The last of two settings of one name wins. */
static void set_parameter(void *context, char *name, const char *value) {
    job *j = context;
    size_t length = strlen(name);
    int i = 0;
    while (i < j->set_count && (strncmp(j->set[i], name, length) || j->set[i][length] != '=')) i++;
    if (i == j->set_count)
        job_set(j, "%s=%s", name, value);
    else
        snprintf(j->set[i], JOB_TEXT, "%s=%s", name, value);
}

static void plan_job(const needs_study *s, const needs_runs *r, int leg, int variant, int k) {
    const needs_leg *of = &r->scene->leg[leg];
    int index = k * r->variants + variant;
    job *j = &r->jobs[leg][index];
    *j = (job){.scene = r->path[leg][variant]};
    snprintf(j->label, sizeof j->label, "%s-%d-%s-%02d", r->scene->name, leg + 1,
             switch_of(r, variant)->key, k + 1);
    for (char *at = j->label; *at; at++)
        if (*at == ' ') *at = '-';
    each(of->set, j, set_parameter);
    if (s->size.quick) each(of->quick, j, set_parameter);
    each(switch_of(r, variant)->set, j, set_parameter);
    if (k == 0 && of->drawn) each(of->drawn, j, set_parameter);
    if (leg == 0)
        job_set(j, "seed=%d", k + 1);
    else
        job_set(j, "bed=%s", r->jobs[leg - 1][index].folder);
    jobs_name(j, s->root);
}

static void plan_scene(needs_study *s, int which) {
    needs_runs *r = &s->runs[which];
    *r = (needs_runs){.scene = &NEEDS_SCENES[which],
                      .variants = NEEDS_SCENES[which].switches + 1,
                      .replicates = s->size.replicates[which]};
    CLAST_ASSERT(r->variants <= VARIANTS_MAX && r->replicates <= REPLICATES_MAX);
    size_t jobs = (size_t)(r->variants * r->replicates);
    for (int leg = 0; leg < r->scene->legs; leg++) {
        r->jobs[leg] = calloc(jobs + 1, sizeof *r->jobs[leg]);
        r->path[leg] = calloc((size_t)r->variants, sizeof *r->path[leg]);
        CLAST_ASSERT(r->jobs[leg] && r->path[leg]);
        for (int v = 0; v < r->variants; v++) {
            snprintf(r->path[leg][v], sizeof *r->path[leg], "%s/scenes/%d-%d-%s.yaml", s->root,
                     which, leg + 1, switch_of(r, v)->key);
            write_scene(&r->scene->leg[leg], switch_of(r, v)->put, r->path[leg][v]);
        }
        for (size_t i = 0; i < jobs; i++)
            plan_job(s, r, leg, (int)i % r->variants, (int)i / r->variants);
    }
}

void needs_plan(needs_study *s) {
    char folder[JOB_FOLDER];
    snprintf(folder, sizeof folder, "%s/scenes", s->root);
    output_folder(folder);
    for (int i = 0; i < SCENES_COUNT; i++) plan_scene(s, i);
}

/* ---- running --------------------------------------------------------------------------------- */

static bool can_run(const needs_runs *r, int leg, int index) {
    return leg < r->scene->legs && (leg == 0 || r->jobs[leg - 1][index].done);
}

/* The runs of one leg of all scenes, side by side: copied together, run, and copied back. */
static void run_leg(needs_study *s, int leg) {
    job *all = calloc(SCENES_COUNT * VARIANTS_MAX * REPLICATES_MAX, sizeof *all);
    job **home = calloc(SCENES_COUNT * VARIANTS_MAX * REPLICATES_MAX, sizeof *home);
    CLAST_ASSERT(all && home);
    int count = 0;
    for (int k = 0; k < VARIANTS_MAX * REPLICATES_MAX; k++)
        for (int i = 0; i < SCENES_COUNT; i++) {
            const needs_runs *r = &s->runs[i];
            if (k >= r->variants * r->replicates || !can_run(r, leg, k)) continue;
            home[count] = &r->jobs[leg][k];
            all[count] = *home[count];
            count++;
        }
    jobs_run(all, count, s->processes, leg ? "second leg" : "first leg");
    for (int i = 0; i < count; i++) *home[i] = all[i];
    free(home);
    free(all);
}

static int failed_references(const needs_study *s) {
    int failed = 0;
    for (int i = 0; i < SCENES_COUNT; i++)
        for (int leg = 0; leg < s->runs[i].scene->legs; leg++)
            for (int k = 0; k < s->runs[i].replicates; k++)
                failed += !s->runs[i].jobs[leg][k * s->runs[i].variants].done;
    return failed;
}

int needs_run(needs_study *s) {
    for (int leg = 0; leg < LEGS; leg++) run_leg(s, leg);
    return failed_references(s);
}
