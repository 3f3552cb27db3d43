#include "experiments/tune/pilot.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "engine/check.h"
#include "engine/fnv.h"
#include "experiments/run/folder.h"
#include "experiments/study/jobs.h"

enum { PATH_ROOM = 4096 };

static bool fail(tune *t, int code, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(t->failure, sizeof t->failure, format, arguments);
    va_end(arguments);
    t->failure_code = code;
    return false;
}

/* ---- texts ----------------------------------------------------------------------------------- */

static char *read_whole(const char *path) {
    FILE *f = fopen(path, "rb");
    if (!f) return NULL;
    char *text;
    size_t length;
    FILE *to = open_memstream(&text, &length);
    CLAST_ASSERT(to);
    for (int c; (c = getc(f)) != EOF;) putc(c, to);
    CLAST_ASSERT(fclose(to) == 0);
    fclose(f);
    return text;
}

char *tune_source(const char *path, const char *const *set, int set_count) {
    char *text = read_whole(path);
    if (!text || set_count == 0) return text;
    scene_arena arena = {0};
    scene_faults faults = {.arena = &arena, .file = path};
    const tree_node *root = scene_tree_load(&arena, &faults, text, strlen(text));
    char *changed = strdup(scene_parameters_set(&arena, &faults, root, text, set, set_count));
    CLAST_ASSERT(changed);
    scene_arena_free(&arena);
    free(text);
    return changed;
}

char *tune_text(const tune *t, setting s) {
    scene_arena arena = {0};
    scene_edit e = scene_edit_start(&arena, t->text);
    CLAST_ASSERT(e.root);
    char *text = setting_apply(&e, &t->space, s) ? scene_edit_finish(&e) : NULL;
    scene_arena_free(&arena);
    return text;
}

/* Pilots lie elsewhere, so files that the scene names get their full path. What is in them is named
 * by its hash in a comment: another start, or another law, is another run. */
static void name_file(scene_edit *e, scene_parameters *parameters, const char *scene_path,
                      const tree_node *node, scene_buffer *notes) {
    const char *text = scene_parameters_word(parameters, node->text);
    const char *slash = strrchr(scene_path, '/');
    int folder = slash ? (int)(slash - scene_path) + 1 : 0;
    const char *beside =
        text[0] == '/' ? text : scene_print(e->arena, "%.*s%s", folder, scene_path, text);
    const char *found = path_exists(beside) ? beside : text;
    char here[PATH_ROOM];
    if (!path_exists(found) || !getcwd(here, sizeof here)) return; /* the reader will say so */
    const char *full = found[0] == '/' ? found : scene_print(e->arena, "%s/%s", here, found);
    scene_edit_replace(e, node, scene_print(e->arena, "'%s'", full));
    char *checkpoint = path_in(full, FILE_CHECKPOINT);
    uint64_t hash = FNV_START;
    fnv_file(&hash, path_exists(checkpoint) ? checkpoint : full);
    scene_append(notes, "# %s holds %016" PRIx64 "\n", text, hash);
    free(checkpoint);
}

static void name_files(scene_edit *e, const char *scene_path, scene_buffer *notes) {
    scene_parameters parameters = scene_parameters_read(e->arena, &e->faults, e->root);
    const tree_node *bodies = tree_get(e->root, "bodies");
    for (const tree_node *one = bodies ? bodies->first : NULL; one; one = one->next) {
        const tree_node *files[] = {tree_get(one, "from"), tree_get(one, "csv")};
        for (int i = 0; i < 2; i++)
            if (files[i] && files[i]->kind == TREE_SCALAR)
                name_file(e, &parameters, scene_path, files[i], notes);
    }
    const tree_node *library = tree_get(tree_get(e->root, "contact"), "library");
    if (library && library->kind == TREE_SCALAR)
        name_file(e, &parameters, scene_path, library, notes);
}

/* The scene of replicate `k` under a setting, without frames; NULL when the text cannot be edited.
 */
static char *pilot_text(const tune *t, setting s, int k) {
    scene_arena arena = {0};
    scene_faults faults = {.arena = &arena, .file = t->path};
    const char *text = s.other ? t->other : t->text;
    if (t->vary) {
        const char *set = scene_print(&arena, "%s=%s", t->vary, t->values[k]);
        const tree_node *root = scene_tree_load(&arena, &faults, text, strlen(text));
        text = scene_parameters_set(&arena, &faults, root, text, &set, 1);
    }
    scene_edit e = scene_edit_start(&arena, text);
    scene_buffer notes = {0};
    scene_append(&notes, "\n");
    bool good = e.root && faults.errors == 0 && setting_apply(&e, &t->space, s);
    if (good && !t->vary)
        good = scene_edit_put(&e, NULL, "seed",
                              scene_print(&arena, "%" PRIu64, t->seed + (uint64_t)k));
    if (good) good = scene_edit_put(&e, "output", "frames", "none");
    if (good) name_files(&e, t->path, &notes);
    char *edited = good ? scene_edit_finish(&e) : NULL;
    char *whole = edited ? text_format("%s%s", edited, notes.text) : NULL;
    free(edited);
    free(notes.text);
    scene_arena_free(&arena);
    return whole;
}

/* Path of the scene file of a pilot, written; malloc'ed. NULL with t->failure. */
static char *write_pilot(tune *t, setting s, int k) {
    char *folder = path_in(t->out, "scenes"), name[SETTING_LABEL];
    setting_name(s, name);
    char *path = text_format("%s/%s-%03d.yaml", folder, name, k);
    char *text = pilot_text(t, s, k);
    int failure = text ? folder_make(folder) : 0;
    if (text && !failure) failure = file_write_text(path, text);
    bool good = text && !failure;
    if (!text)
        fail(t, 3, "%s: found no place to put '%s' into; braces around the whole scene?", t->path,
             name);
    else if (failure)
        fail(t, 4, "%s: cannot be written: %s", path, strerror(failure));
    free(text);
    free(folder);
    if (!good) free(path), path = NULL;
    return path;
}

/* ---- looking --------------------------------------------------------------------------------- */

/* Step and limits under one stiffness. */
static bool look_at(tune *t, int soft, double contact_time[SOFT_LEVELS]) {
    setting_space *space = &t->space;
    char *path = write_pilot(t, (setting){.soft = soft}, 0), *faults = NULL;
    if (!path) return false;
    scene *s = scene_load(path, &(scene_options){.threads = 1}, &faults);
    free(path);
    if (!s && soft == 0) fail(t, 3, "%s", faults ? faults : "the scene cannot be read");
    free(faults);
    if (!s) return soft > 0; /* that stiffness is left out */
    clast_plan plan = clast_world_plan(s->world);
    if (soft == 0) {
        space->step = plan.time_step;
        space->step_given = s->step_given;
        const clast_world_def *def = clast_world_definition(s->world);
        space->can_mix = def->precision == CLAST_PRECISION_DOUBLE && def->law != CLAST_LAW_USER;
    }
    contact_time[soft] = plan.contact_time;
    space->critical[soft] = plan.critical_step;
    space->follow[soft] = space->step_given ? fmin(plan.contact_time / contact_time[0],
                                                   plan.critical_step / space->critical[0])
                                            : plan.time_step / space->step;
    scene_free(s);
    return true;
}

/* What the text itself tells of the knobs. */
static void look_at_text(tune *t) {
    scene_arena arena = {0};
    scene_edit e = scene_edit_start(&arena, t->text);
    const tree_node *scheme = tree_get(tree_get(e.root, "time"), "scheme");
    t->space.can_leap =
        scheme && scheme->kind == TREE_SCALAR && strcmp(scheme->text, "leapfrog") != 0;
    t->space.fit_spheres = setting_fit_spheres(&e);
    scene_arena_free(&arena);
}

bool tune_look(tune *t) {
    double contact_time[SOFT_LEVELS];
    t->space = (setting_space){.follow = {1}};
    for (int soft = 0; soft < SOFT_LEVELS; soft++) {
        t->space.follow[soft] = 1; /* the text is that of the softened scene at the old step */
        if (!look_at(t, soft, contact_time)) return false;
    }
    look_at_text(t);
    return true;
}

/* ---- running --------------------------------------------------------------------------------- */

static char *beside(const job *j, const char *suffix) {
    return text_format("%s.%s", j->folder, suffix);
}

/* What the job left to say when it failed, "" without anything. */
static void read_reason(const job *j, char why[TUNE_MESSAGE]) {
    char *path = beside(j, "log");
    FILE *f = fopen(path, "r");
    size_t length = f ? fread(why, 1, TUNE_MESSAGE - 1, f) : 0;
    why[length] = '\0';
    while (length > 0 && why[length - 1] == '\n') why[--length] = '\0';
    if (f) fclose(f);
    free(path);
}

/* A guard that stopped a pilot would stop it again. */
static bool has_stopped(const job *j) {
    char *state = path_in(j->folder, FILE_FAILED), *log = beside(j, "log");
    bool stopped = path_exists(state) && path_exists(log);
    free(state);
    free(log);
    return stopped;
}

static bool read_value(tune *t, candidate *c, int k, const job *j) {
    char *path = path_in(j->folder, FILE_SERIES), why[RESULTS_ERROR_MAX];
    csv *series = csv_read(path, why);
    free(path);
    if (!series) return fail(t, 4, "%s", why);
    const double *time = csv_column(series, "time_s");
    size_t n = series->rows;
    c->value[k] = observable_reduce(&t->what, series);
    c->cost[k] = time && n > 1 ? jobs_processor_time(j) / (time[n - 1] - time[0]) : (double)NAN;
    c->hash[k] = j->hash;
    c->known[k] = true;
    csv_free(series);
    return true;
}

/* What is not the setting's fault must not count against it. */
static bool take_failure(tune *t, candidate *c, const job *j) {
    char why[TUNE_MESSAGE];
    read_reason(j, why);
    if (strncmp(why, "interrupted", 11) == 0)
        return fail(t, 130, "interrupted; what was run is kept in %s", t->out);
    if (strstr(why, "cannot be written") || strstr(why, "cannot be made"))
        return fail(t, 4, "%s", why);
    if (!why[0]) return fail(t, 1, "%s: a pilot was killed", j->label);
    if (!c->stopped[0]) snprintf(c->stopped, sizeof c->stopped, "%s", why); /* the first says it */
    return true;
}

static bool plan_job(tune *t, const candidate *c, int k, job *j) {
    char name[SETTING_LABEL];
    setting_name(c->setting, name);
    *j = (job){.scene = write_pilot(t, c->setting, k), .quiet = true};
    if (!j->scene) return false;
    snprintf(j->label, sizeof j->label, "%.60s-%03d", name, k);
    char *root = path_in(t->out, "runs");
    jobs_name(j, root);
    free(root);
    return true;
}

static bool take_results(tune *t, candidate *c, const job *jobs, const int *which, int count) {
    for (int i = 0; i < count; i++) {
        bool good =
            jobs[i].done ? read_value(t, c, which[i], &jobs[i]) : take_failure(t, c, &jobs[i]);
        if (!good) return false;
    }
    return true;
}

bool pilots_run(tune *t, candidate *c, int first, int count) {
    CLAST_ASSERT(t && c && first >= 0 && count >= 0 && first + count <= PILOTS_MAX);
    job *jobs = calloc((size_t)count + 1, sizeof *jobs);
    bool good = true;
    int which[PILOTS_MAX], n = 0;
    CLAST_ASSERT(jobs);
    for (int k = first; k < first + count && good && !c->stopped[0]; k++) {
        if (c->known[k]) continue;
        good = plan_job(t, c, k, &jobs[n]);
        if (!good) break;
        which[n] = k;
        if (has_stopped(&jobs[n])) good = take_failure(t, c, &jobs[n]);
        n++;
    }
    if (good && n > 0 && !c->stopped[0]) {
        char what[SETTING_LABEL];
        setting_describe(c->setting, what);
        jobs_run(jobs, n, t->processes, what);
        good = take_results(t, c, jobs, which, n);
    }
    for (int i = 0; i < n; i++) free((char *)(uintptr_t)jobs[i].scene);
    free(jobs);
    return good;
}

double candidate_ratio(const candidate *a, const candidate *b) {
    double over = 0, under = 0;
    for (int k = 0; k < PILOTS_MAX; k++)
        if (a->known[k] && b->known[k] && isfinite(a->cost[k]) && isfinite(b->cost[k]))
            over += a->cost[k], under += b->cost[k];
    return under > 0 ? over / under : (double)NAN;
}

double candidate_cost(const candidate *c) {
    double sum = 0;
    int count = 0;
    for (int k = 0; k < PILOTS_MAX; k++)
        if (c->known[k] && isfinite(c->cost[k])) sum += c->cost[k], count++;
    return count > 0 ? sum / count : (double)NAN;
}
