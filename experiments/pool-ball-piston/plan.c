/* plan.c - which runs there are. A group is one way to run the rig: the model itself, from the bed
 * as it settled, and replicates of it that are laid by hand. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "experiments/pool-ball-piston/piston.h"
#include "experiments/scene/scene.h"

const double FRICTION[FRICTIONS] = {0, 0.1, 0.2, 0.35};

#define INPUT                                                                                      \
    { 2.2225, 1.3915, 70, 4.60 }
#define MU(p, w) "friction=" p ",wall_friction=" w

static const group_def GROUPS[] = {
    {SECTION_BASE, "(baseline)", "friction 0.1", "", "", "", "", INPUT, 1},
    {SECTION_RIG, "friction", "static: 0.357 / 0.351", "", "", "", MU("0.357", "0.351"), INPUT, 1},
    {SECTION_FRICTION, "friction", "0", "", "", "", MU("0", "0"), INPUT, 1},
    {SECTION_FRICTION, "friction", "0.2 (input file)", "", "", "", MU("0.2", "0.2"), INPUT, 1},
    {SECTION_FRICTION, "friction", "0.35", "", "", "", MU("0.35", "0.35"), INPUT, 1},
    {SECTION_STEP, "time step", "critical", "", "", "", "fraction=1", INPUT, 1},
    {SECTION_ERRORS, "errors of the placing", "1e-1", "", "", "", "", INPUT, 1e-1},
    {SECTION_ERRORS, "errors of the placing", "1e-2", "", "", "", "", INPUT, 1e-2},
    {SECTION_ERRORS, "errors of the placing", "1e-3", "", "", "", "", INPUT, 1e-3},
    {SECTION_ERRORS, "errors of the placing", "1e-4", "", "", "", "", INPUT, 1e-4},
    {SECTION_ASSUMPTION, "errors of the placing", "half", "", "", "", "", INPUT, 0.5},
    {SECTION_ASSUMPTION, "errors of the placing", "twice", "", "", "", "", INPUT, 2},
    {SECTION_ASSUMPTION, "friction while laid", "0.1 / 0.1", "", "", MU("0.1", "0.1"), "", INPUT,
     1},
    {SECTION_ASSUMPTION, "wall friction", "0.351 (static)", "", "", "", MU("0.1", "0.351"), INPUT,
     1},
    {SECTION_ASSUMPTION, "wall friction", "0", "", "", "", MU("0.1", "0"), INPUT, 1},
    {SECTION_ASSUMPTION,
     "slopes",
     "70 deg (70.0 of CON an angle)",
     "top=92.82 cm",
     "columns=3",
     "",
     "",
     {2.2225, 1.3915, 92.82, 4.60},
     1},
    {SECTION_ASSUMPTION,
     "particle",
     "45 mm, 25 % overlap (text)",
     "radius=22.5 mm,half=16.875 mm",
     "",
     "",
     "",
     {2.25, 1.6875, 70, 4.60},
     1},
    {SECTION_ASSUMPTION, "particle", "150.4 g (DENS 1.8)", "mass=150.4 g", "", "", "", INPUT, 1},
    {SECTION_ASSUMPTION, "arrangement", "seed 1", "", "seed=1", "", "", INPUT, 1},
    {SECTION_ASSUMPTION, "arrangement", "seed 2", "", "seed=2", "", "", INPUT, 1},
    {SECTION_ASSUMPTION, "arrangement", "4 columns", "", "columns=4", "", "", INPUT, 1},
    {SECTION_ASSUMPTION, "restitution while settling", "0.85", "", "restitution=0.85", "", "",
     INPUT, 1},
    {SECTION_ASSUMPTION, "restitution", "0.75", "", "", "", "restitution=0.75", INPUT, 1},
    {SECTION_ASSUMPTION, "restitution", "0.95", "", "", "", "restitution=0.95", INPUT, 1},
    {SECTION_ASSUMPTION, "speed of the piston", "4.6 cm/s (text)", "", "", "", "speed=4.6 cm/s",
     INPUT, 1},
    {SECTION_ASSUMPTION, "sheets", "3-D motion, 4.60 cm apart", "", "", "", "motion=3d", INPUT, 1},
    {SECTION_ASSUMPTION,
     "sheets",
     "3-D motion, 4.50 cm apart",
     "",
     "",
     "",
     "motion=3d,gap=4.5 cm",
     {2.2225, 1.3915, 70, 4.5},
     1},
    {SECTION_ASSUMPTION, "modulus of the walls", "3.2 GPa (acrylic)", "", "", "",
     "wall_young=3.2 GPa", INPUT, 1},
    {SECTION_ASSUMPTION, "modulus", "a tenth", "", "", "", "young=689 MPa,wall_young=689 MPa",
     INPUT, 1},
    {SECTION_ASSUMPTION, "time step", "7.148 us (27980 in 0.2 s)", "", "", "", "fraction=0.11381",
     INPUT, 1},
    {SECTION_ASSUMPTION, "lip of the throat", "column 2 mm lower", "", "", "", "lip=2 mm", INPUT,
     1},
    {SECTION_ASSUMPTION, "dashpots of a clump", "shared", "", "", "", "clump_contact=shared", INPUT,
     1},
    {SECTION_ASSUMPTION, "friction limit", "spring alone (1.73)", "", "", "",
     "friction_limit=spring", INPUT, 1},
    {SECTION_ASSUMPTION, "tangential spring", "as printed (1.14)", "", "", "",
     "unloading=as-printed", INPUT, 1},
};

/* ---- jobs ------------------------------------------------------------------------------------ */

enum { SETTINGS = 80 };

typedef struct settings {
    char text[SETTINGS][120];
    int count;
} settings;

static void set(settings *s, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void set(settings *s, const char *format, ...) {
    if (s->count == SETTINGS) abort();
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(s->text[s->count++], sizeof *s->text, format, arguments);
    va_end(arguments);
}

static void set_all(settings *s, const char *list) {
    char copy[200], *rest = NULL;
    snprintf(copy, sizeof copy, "%s", list);
    for (char *one = strtok_r(copy, ",", &rest); one; one = strtok_r(NULL, ",", &rest))
        set(s, "%s", one);
}

static void set_job(job *j, const settings *s) {
    for (int i = 0; i < s->count; i++) job_set(j, "%s", s->text[i]);
}

static void plan_bed(const piston_study *s, group *g) {
    settings all = {.count = 0};
    set_all(&all, g->def->all);
    set_all(&all, g->def->bed);
    g->bed = (job){.scene = SCENES "/settle.yaml", .label = "bed"};
    set_job(&g->bed, &all);
    jobs_name(&g->bed, s->root);
}

/* What the model and its replicates have in common. */
static settings common(const piston_study *s, const group *g) {
    settings all = {.count = 0};
    if (!strstr(g->def->run, "fraction")) set(&all, "fraction=%s", s->size->fraction);
    set_all(&all, g->def->all);
    set_all(&all, g->def->run);
    return all;
}

static void plan_model(const piston_study *s, group *g) {
    settings all = common(s, g);
    g->model = (job){.scene = SCENES "/piston.yaml", .label = "model"};
    job_set(&g->model, "bed=%s", g->bed.folder);
    set_job(&g->model, &all);
    jobs_name(&g->model, s->root);
}

/* ---- replicates: scenes of their own for each, as `clast run` takes them ----------------------
 */

enum { MM = 1000 };

static void set_sizes(settings *all, const particle bed[PARTICLES]) {
    for (int i = 0; i < PARTICLES; i++) {
        set(all, "r%d=%.9f mm", i + 1, MM * bed[i].radius);
        set(all, "h%d=%.9f mm", i + 1, MM * bed[i].half);
    }
}

static void set_places(settings *all, const particle bed[PARTICLES]) {
    static const double DEGREE = 57.295779513082321;
    for (int i = 0; i < PARTICLES; i++) {
        set(all, "x%d=%.9f mm", i + 1, MM * bed[i].x);
        set(all, "y%d=%.9f mm", i + 1, MM * bed[i].y);
        set(all, "z%d=%.9f mm", i + 1, MM * bed[i].z);
        set(all, "a%d=%.9f deg", i + 1, DEGREE * bed[i].angle);
    }
}

/* A scene file with these settings in it. */
static bool write_scene(const char *from, const char *to, const settings *all) {
    const char *list[SETTINGS];
    char *faults = NULL;
    for (int i = 0; i < all->count; i++) list[i] = all->text[i];
    scene *s = scene_load(
        from,
        &(scene_options){.set = list, .set_count = all->count, .threads = 1, .parse_only = true},
        &faults);
    FILE *f = s ? fopen(to, "w") : NULL;
    bool good = f && fputs(s->text, f) >= 0;
    if (f) good &= fclose(f) == 0;
    if (!good) fprintf(stderr, "%s: %s\n", to, s ? "cannot be written" : faults);
    scene_free(s);
    free(faults);
    return good;
}

/* The file's name says which group and replicate it is, the folder's what is in it. */
static bool plan_scene(const piston_study *s, job *j, const char *what, int which, int replicate,
                       const settings *all) {
    char from[600], to[600];
    snprintf(from, sizeof from, "%s/%s.yaml", SCENES, what);
    snprintf(to, sizeof to, "%s/%s-%s-%02d-%03d.yaml", s->root, s->name, what, which + 1,
             replicate + 1);
    *j = (job){.scene = strdup(to)};
    snprintf(j->label, sizeof j->label, "%s-%03d", what, replicate + 1);
    return write_scene(from, to, all);
}

static bool spoiled_bed(const group *g, int replicate, particle bed[PARTICLES]) {
    if (!bed_read(g->bed.folder, &g->def->rig, bed)) return false;
    bool flat = !strstr(g->def->run, "motion=3d");
    bed_lay_by_hand(&g->def->rig, g->def->errors, flat, replicate + 1, bed);
    return true;
}

static bool plan_lay(const piston_study *s, group *g, int which, int replicate) {
    particle bed[PARTICLES];
    settings all = {.count = 0};
    if (!spoiled_bed(g, replicate, bed)) return false;
    set_all(&all, g->def->all);
    set_all(&all, g->def->lay);
    set_sizes(&all, bed);
    set_places(&all, bed);
    job *j = &g->lay[replicate];
    if (!plan_scene(s, j, "lay", which, replicate, &all)) return false;
    jobs_name(j, s->root);
    return true;
}

static bool plan_laid(const piston_study *s, group *g, int which, int replicate) {
    particle bed[PARTICLES];
    settings all = common(s, g);
    if (!g->lay[replicate].done || !spoiled_bed(g, replicate, bed)) return false;
    /* a bed must be there when a scene is read */
    set(&all, "bed=%s", g->lay[replicate].folder);
    set_sizes(&all, bed);
    job *j = &g->laid[replicate];
    if (!plan_scene(s, j, "replicate", which, replicate, &all)) return false;
    jobs_name(j, s->root);
    return true;
}

/* ---- all of them ----------------------------------------------------------------------------- */

static void *room(size_t count, size_t size) {
    void *p = calloc(count + 1, size);
    if (!p) abort();
    return p;
}

static void plan_groups(piston_study *s) {
    for (size_t i = 0; i < sizeof GROUPS / sizeof *GROUPS; i++) {
        int n = s->size->replicates[GROUPS[i].section];
        if (n == 0) continue;
        group *g = &s->groups[s->count++];
        *g = (group){.def = &GROUPS[i], .replicates = n};
        g->lay = room((size_t)n, sizeof *g->lay);
        g->laid = room((size_t)n, sizeof *g->laid);
        g->tracks = room((size_t)n, sizeof *g->tracks);
        g->list = room((size_t)n, sizeof *g->list);
        for (int k = 0; k < n; k++) g->list[k] = &g->tracks[k];
        plan_bed(s, g);
    }
}

typedef struct batch {
    job *jobs, **from;
    int count, failed;
} batch;

static batch batch_new(const piston_study *s) {
    size_t most = (size_t)s->count * (REPLICATES_MAX + 1);
    return (batch){.jobs = room(most, sizeof(job)), .from = room(most, sizeof(job *))};
}

static void batch_add(batch *b, job *j, bool good) {
    if (good)
        b->from[b->count++] = j;
    else
        b->failed++;
}

static int batch_run(batch *b, int processes, const char *what) {
    for (int i = 0; i < b->count; i++) b->jobs[i] = *b->from[i];
    b->failed += jobs_run(b->jobs, b->count, processes, what);
    for (int i = 0; i < b->count; i++) *b->from[i] = b->jobs[i];
    free(b->jobs);
    free(b->from);
    return b->failed;
}

static int run_beds(piston_study *s, int processes) {
    batch b = batch_new(s);
    for (int i = 0; i < s->count; i++) batch_add(&b, &s->groups[i].bed, true);
    return batch_run(&b, processes, "settling");
}

static int run_lays(piston_study *s, int processes) {
    batch b = batch_new(s);
    for (int i = 0; i < s->count; i++) {
        group *g = &s->groups[i];
        for (int k = 0; k < g->replicates && g->bed.done; k++)
            batch_add(&b, &g->lay[k], plan_lay(s, g, i, k));
    }
    return batch_run(&b, processes, "laying by hand");
}

static int run_pistons(piston_study *s, int processes) {
    batch b = batch_new(s);
    for (int i = 0; i < s->count; i++) {
        group *g = &s->groups[i];
        if (!g->bed.done) continue;
        plan_model(s, g);
        batch_add(&b, &g->model, true);
        for (int k = 0; k < g->replicates; k++) batch_add(&b, &g->laid[k], plan_laid(s, g, i, k));
    }
    return batch_run(&b, processes, "piston");
}

static void read_group(group *g) {
    particle bed[PARTICLES];
    double near[PARTICLES];
    g->complete = g->model.done && bed_read(g->bed.folder, &g->def->rig, bed);
    for (int p = 0; g->complete && p < PARTICLES; p++) near[p] = bed[p].angle;
    g->complete = g->complete && track_read(g->model.folder, near, &g->model_track);
    for (int k = 0; k < g->replicates && g->complete; k++)
        g->complete = g->laid[k].done && track_read(g->laid[k].folder, near, &g->tracks[k]);
}

int piston_run_all(piston_study *s, int processes) {
    plan_groups(s);
    int failed = run_beds(s, processes);
    failed += run_lays(s, processes);
    failed += run_pistons(s, processes);
    for (int i = 0; i < s->count; i++) read_group(&s->groups[i]);
    return failed;
}

const group *piston_group(const piston_study *s, section which, int n) {
    for (int i = 0; i < s->count; i++)
        if (s->groups[i].def->section == which && n-- == 0)
            return s->groups[i].complete ? &s->groups[i] : NULL;
    return NULL;
}

const group *piston_friction(const piston_study *s, int which) {
    if (which == 1) return piston_group(s, SECTION_BASE, 0);
    return piston_group(s, SECTION_FRICTION, which == 0 ? 0 : which - 1);
}
