#include "experiments/run/run.h"

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "engine/check.h"
#include "engine/hdf5_io.h"
#include "experiments/run/archive.h"
#include "experiments/run/folder.h"
#include "experiments/run/passage.h"
#include "experiments/run/progress.h"
#include "experiments/run/recorder.h"
#include "experiments/run/schedule.h"

enum { REST_SAMPLES = 20 }; /* looks at the speeds so many times within rest_for */
#define NEVER_QUIET UINT64_MAX

typedef struct run {
    scene *scene;
    const run_options *options;
    clast_world *world;
    recorder recorder;
    progress progress;
    schedule frames, rows, checkpoints, rest;
    uint64_t last_step, rest_steps;
    uint64_t quiet_from;           /* step since when nothing has been fast */
    long next_frame;               /* number of the next frame */
    uint64_t loaded_step;          /* of the checkpoint that was resumed */
    bool extra_row, extra_frame;   /* at the last step: the end of the run, not due */
    bool loaded_row, loaded_frame; /* the same of the checkpoint that was resumed */
    bool stop;                     /* that several processes have agreed on ... */
    uint64_t agreed_at, agree_at;  /* ... in this step, and will next */
    double agreed_when;            /* s, on the clock */
    int held;                      /* descriptor of the folder, or -1 */
    run_report report;
} run;

/* ---- signals --------------------------------------------------------------------------------- */

static volatile sig_atomic_t stop_asked;

static void ask_to_stop(int signal_number) {
    (void)signal_number;
    stop_asked = 1;
}

typedef struct signals {
    struct sigaction interrupt, terminate, file_size;
} signals;

/* A second signal kills (SA_RESETHAND). Who started us with signals ignored keeps them so. */
static void catch_one(int number, struct sigaction *old) {
    struct sigaction ours = {.sa_handler = ask_to_stop, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&ours.sa_mask);
    sigaction(number, NULL, old);
    if (old->sa_handler != SIG_IGN) sigaction(number, &ours, NULL);
}

static void signals_catch(signals *old) {
    stop_asked = 0;
    catch_one(SIGINT, &old->interrupt);
    catch_one(SIGTERM, &old->terminate);
    struct sigaction ignore = {.sa_handler = SIG_IGN}; /* a file too large is an error to report */
    sigemptyset(&ignore.sa_mask);
    sigaction(SIGXFSZ, &ignore, &old->file_size);
}

static void signals_restore(const signals *old) {
    sigaction(SIGINT, &old->interrupt, NULL);
    sigaction(SIGTERM, &old->terminate, NULL);
    sigaction(SIGXFSZ, &old->file_size, NULL);
}

/* ---- failures -------------------------------------------------------------------------------- */

/* Keeps the first failure; always false, for returning. */
static bool ends(run *r, run_end end, const char *format, ...) {
    if (r->report.end != RUN_DONE) return false;
    r->report.end = end;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(r->report.message, sizeof r->report.message, format, arguments);
    va_end(arguments);
    return false;
}

/* ---- several processes -------------------------------------------------------------------------
 * All do the same in the same order; the first one has the files. What it meets there all know. */

static bool speaks(void) {
    return clast_ranks_number() == 0;
}

static bool agreed(run *r, bool good) {
    if (clast_ranks_count() == 1) return good;
    clast_ranks_tell(&good, sizeof good);
    clast_ranks_tell(&r->report, sizeof r->report);
    return good;
}

/* s: so often the processes ask each other whether to stop, and the first one whether it is time to
 * speak. Who asks mpirun to end them has a second. */
static const double AGREE_EVERY = 0.1;
enum { AGREE_MOST = 1000 }; /* steps */

static bool is_time_to_agree(const run *r) {
    return clast_ranks_count() > 1 && clast_world_steps(r->world) >= r->agree_at;
}

/* By the clock of the first one, which says in how many steps. */
static void plan_to_agree(run *r) {
    double now = clock_seconds(), spent = now - r->agreed_when;
    uint64_t step = clast_world_steps(r->world);
    double steps = (double)(step - r->agreed_at) * AGREE_EVERY / fmax(spent, 1e-9);
    steps = r->agreed_when > 0 ? fmax(1, fmin(steps, AGREE_MOST)) : 1; /* nothing was timed yet */
    clast_ranks_tell(&steps, sizeof steps);
    r->agreed_when = now, r->agreed_at = step;
    r->agree_at = step + (uint64_t)steps;
}

static bool has_to_stop(run *r) {
    if (clast_ranks_count() == 1) return stop_asked;
    if (is_time_to_agree(r)) {
        r->stop = clast_ranks_most(stop_asked) > 0;
        plan_to_agree(r);
    }
    return r->stop;
}

static void tell_progress(run *r) {
    bool due = progress_is_due(&r->progress, r->world);
    if (clast_ranks_count() > 1) {
        if (!is_time_to_agree(r)) return;
        clast_ranks_tell(&due, sizeof due);
    }
    if (due) progress_show(&r->progress, r->world);
}

static bool cannot_write(run *r, const char *file, int failure) {
    return ends(r, RUN_WRITE_FAILED, "%s/%s: cannot be written: %s", r->options->out, file,
                strerror(failure));
}

/* ---- the note in the checkpoint: what the run layer must remember ---------------------------- */

static char *note_text(const run *r) {
    char *text;
    size_t length;
    FILE *to = open_memstream(&text, &length);
    CLAST_ASSERT(to);
    fprintf(to, "clast run 1\nextra_row %d\nextra_frame %d\n", r->extra_row, r->extra_frame);
    if (r->quiet_from != NEVER_QUIET)
        fprintf(to, "quiet_from %llu\n", (unsigned long long)r->quiet_from);
    recorder_write_memory(&r->recorder, to);
    CLAST_ASSERT(fclose(to) == 0);
    return text;
}

static void note_read(run *r, const char *note) {
    const char *quiet = strstr(note, "\nquiet_from ");
    if (quiet) r->quiet_from = strtoull(quiet + strlen("\nquiet_from "), NULL, 10);
    r->loaded_row = strstr(note, "\nextra_row 1") != NULL;
    r->loaded_frame = strstr(note, "\nextra_frame 1") != NULL;
    recorder_read_memory(&r->recorder, note);
}

/* ---- what is written ------------------------------------------------------------------------- */

/* Who came and went is read from the world, so it must be in the tables before the world is saved
 * without it. */
static bool write_passages(run *r) {
    int failure = recorder_passages(&r->recorder);
    return agreed(r, !failure || cannot_write(r, FILE_FEEDS " or " FILE_OUTLETS, failure));
}

static bool write_checkpoint(run *r) {
    if (!write_passages(r)) return false;
    int failure = recorder_sync(&r->recorder); /* a checkpoint must not be newer than the rows */
    if (!agreed(r, !failure || cannot_write(r, FILE_SERIES, failure))) return false;
    char *path = path_in(r->options->out, FILE_CHECKPOINT), *note = note_text(r);
    clast_status status = clast_checkpoint_save(r->world, path, note);
    free(note);
    free(path);
    return status == CLAST_OK || ends(r, RUN_WRITE_FAILED, "%s", clast_world_error(r->world));
}

static bool write_row(run *r) {
    int failure = recorder_row(&r->recorder);
    if (!agreed(r, !failure || cannot_write(r, FILE_SERIES, failure))) return false;
    return write_passages(r);
}

static bool write_frame(run *r) {
    char *path = folder_part(r->options->out, r->next_frame);
    clast_status status = clast_frame_write(r->world, path, r->scene->output.contacts);
    free(path);
    if (status != CLAST_OK) return ends(r, RUN_WRITE_FAILED, "%s", clast_world_error(r->world));
    r->next_frame++;
    return true;
}

/* What is kept on resuming: all up to the checkpoint, but not what was written for being the last.
 */
static bool keep_row(uint64_t step, const void *context) {
    const run *r = context;
    return step < r->loaded_step || (step == r->loaded_step && !r->loaded_row);
}

/* Bodies that came or went in the step of the checkpoint stand in the tables already. */
static bool keep_passage(uint64_t step, const void *context) {
    const run *r = context;
    return step <= r->loaded_step;
}

static bool keep_frame_of(const run *r, uint64_t step) {
    return step < r->loaded_step || (step == r->loaded_step && !r->loaded_frame);
}

static bool keep_frame(const frame_place *place, const void *context) {
    return keep_frame_of(context, place->step);
}

static bool assemble_here(run *r, const archive_facts *facts) {
    char error[H5_ERROR_MAX];
    clast_status status = archive_assemble(r->options->out, facts, error);
    if (status == CLAST_OK) return true;
    return ends(r, status == CLAST_ERR_WRITE ? RUN_WRITE_FAILED : RUN_UNREADABLE, "%s", error);
}

static bool assemble(run *r, const char *end, bool drop_later) {
    archive_facts facts = {.scene = r->scene,
                           .end = end,
                           .hash = clast_world_hash(r->world),
                           .steps = clast_world_steps(r->world),
                           .time = clast_world_time(r->world),
                           .keep_frame = drop_later ? keep_frame : NULL,
                           .context = r};
    return agreed(r, !speaks() || assemble_here(r, &facts));
}

/* ---- beginning ------------------------------------------------------------------------------- */

static bool make_folders_here(run *r) {
    int failure = folder_make(r->options->out);
    if (failure)
        return ends(r, RUN_WRITE_FAILED, "%s: cannot be made: %s", r->options->out,
                    strerror(failure));
    char *frames = path_in(r->options->out, FOLDER_FRAMES);
    failure = folder_make(frames);
    free(frames);
    return !failure || cannot_write(r, FOLDER_FRAMES, failure);
}

static bool make_folders(run *r) {
    return agreed(r, !speaks() || make_folders_here(r));
}

static bool write_scene_here(run *r) {
    char *path = path_in(r->options->out, FILE_SCENE);
    int failure = file_write_text(path, r->scene->text ? r->scene->text : "");
    free(path);
    return !failure || cannot_write(r, FILE_SCENE, failure);
}

static bool write_scene(run *r) {
    return agreed(r, !speaks() || write_scene_here(r));
}

/* What falls on the step where the world is now. */
static bool write_due(run *r) {
    uint64_t now = clast_world_steps(r->world);
    if (schedule_is_due(&r->rows, now) && !write_row(r)) return false;
    if (schedule_is_due(&r->frames, now) && !write_frame(r)) return false;
    return !schedule_is_due(&r->checkpoints, now) || write_checkpoint(r);
}

/* An archive without frames and a checkpoint at once: they prove that the folder takes files, say
 * whose folder it is, and hold the walls and the view for who looks at the run while it goes on. */
static bool begin_fresh(run *r) {
    int failure = speaks() ? folder_clear_run(r->options->out) : 0;
    if (!agreed(r, !failure || cannot_write(r, "", failure))) return false;
    if (!make_folders(r) || !write_scene(r)) return false;
    failure = recorder_create(&r->recorder, r->options->out);
    if (!agreed(r, !failure || cannot_write(r, FILE_SERIES, failure))) return false;
    if (!assemble(r, "running", false) || !make_folders(r)) return false;
    return write_due(r) && write_checkpoint(r);
}

static bool load_checkpoint(run *r, const char *path) {
    char *note = NULL;
    clast_status status = clast_checkpoint_load(r->world, path, &note);
    if (status == CLAST_ERR_MISMATCH)
        return ends(r, RUN_MISMATCH, "%s", clast_world_error(r->world));
    if (status != CLAST_OK) return ends(r, RUN_UNREADABLE, "%s", clast_world_error(r->world));
    r->loaded_step = clast_world_steps(r->world);
    note_read(r, note);
    free(note);
    return true;
}

static bool drop_later_part(const char *part, void *context) {
    h5_file *f = h5_open(part);
    uint64_t step = h5_u64_attribute(f, "/", "step");
    bool drop = h5_status(f) != CLAST_OK || !keep_frame_of(context, step);
    h5_free(f);
    return drop;
}

static void count_frames(run *r) {
    if (!speaks()) return;
    char *path = path_in(r->options->out, FILE_RUN);
    h5_file *archive = path_exists(path) ? h5_open(path) : NULL;
    frame_list l = frames_find(r->options->out, archive);
    r->next_frame = l.count > 0 ? l.items[l.count - 1].number + 1 : 0;
    h5_free(archive);
    free(l.items);
    free(path);
}

static bool begin_resumed(run *r, const char *checkpoint) {
    if (!load_checkpoint(r, checkpoint)) return false;
    int failure = recorder_continue(&r->recorder, r->options->out, keep_row, keep_passage, r);
    if (failure == EINVAL)
        ends(r, RUN_MISMATCH, "%s/" FILE_SERIES ": has other columns than this scene measures",
             r->options->out);
    else if (failure)
        cannot_write(r, FILE_SERIES, failure);
    if (!agreed(r, !failure)) return false;
    if (speaks()) folder_drop_parts(r->options->out, drop_later_part, r);
    if (!assemble(r, "running", true)) return false;
    count_frames(r);
    clast_ranks_tell(&r->next_frame, sizeof r->next_frame);
    if (r->options->talk == RUN_TALK)
        printf("resumed at t = %.6g s, step %llu\n", clast_world_time(r->world),
               (unsigned long long)r->loaded_step);
    return make_folders(r) && write_scene(r);
}

static bool hold_folder(run *r) {
    int held = folder_hold(r->options->out);
    if (held == -EWOULDBLOCK)
        return ends(r, RUN_REFUSED, "%s: another run is writing into this folder", r->options->out);
    if (held < 0) return cannot_write(r, "", -held);
    r->held = held;
    return true;
}

static bool folder_is_ours(run *r) {
    const run_options *o = r->options;
    if (o->resume || o->force || folder_is_empty(o->out)) return true;
    return ends(r, RUN_REFUSED,
                "%s: is not empty; --resume goes on with the run in it, --force throws that run "
                "away",
                o->out);
}

static bool begin(run *r) {
    const run_options *o = r->options;
    if (!agreed(r, !speaks() || (hold_folder(r) && folder_is_ours(r)))) return false;
    char *checkpoint = path_in(o->out, FILE_CHECKPOINT);
    bool resumed = o->resume && path_exists(checkpoint);
    clast_ranks_tell(&resumed, sizeof resumed);
    bool good = resumed ? begin_resumed(r, checkpoint) : begin_fresh(r);
    if (o->resume && !resumed && good && o->talk == RUN_TALK)
        printf("no checkpoint in %s: starting from the beginning\n", o->out);
    free(checkpoint);
    return good;
}

/* ---- running --------------------------------------------------------------------------------- */

static double fastest(clast_world *w) {
    clast_bodies b = clast_world_bodies(w);
    double most = 0;
    for (size_t i = 0; i < b.count; i++) {
        double v2 = b.vx[i] * b.vx[i] + b.vy[i] * b.vy[i] + b.vz[i] * b.vz[i];
        if (v2 > most) most = v2;
    }
    return sqrt(most);
}

/* True when nothing has been fast for long enough. Turning on the spot does not count as motion:
 * round bodies without friction would never stop. */
static bool has_come_to_rest(run *r) {
    uint64_t now = clast_world_steps(r->world);
    if (r->rest_steps == 0) return false;
    if (schedule_is_due(&r->rest, now)) {
        bool quiet = fastest(r->world) <= r->scene->ending.rest_speed;
        if (!quiet)
            r->quiet_from = NEVER_QUIET;
        else if (r->quiet_from == NEVER_QUIET)
            r->quiet_from = now;
    }
    return r->quiet_from != NEVER_QUIET && now - r->quiet_from >= r->rest_steps;
}

static uint64_t next_event(const run *r) {
    uint64_t now = clast_world_steps(r->world), next = r->last_step;
    const schedule *all[] = {&r->frames, &r->rows, &r->checkpoints, &r->rest};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        uint64_t due = schedule_next(all[i], now);
        if (due < next) next = due;
    }
    return next;
}

static bool step_until(run *r, uint64_t target) {
    while (clast_world_steps(r->world) < target && !has_to_stop(r)) {
        if (clast_world_step(r->world) != CLAST_OK)
            return ends(r, RUN_GUARD, "%s", clast_world_error(r->world));
        tell_progress(r);
    }
    return true;
}

/* The last state is always written, due or not, so that what a run came to can be seen. */
static bool write_last(run *r) {
    uint64_t now = clast_world_steps(r->world);
    r->extra_row = r->rows.every > 0 && !schedule_is_due(&r->rows, now);
    r->extra_frame = r->frames.every > 0 && !schedule_is_due(&r->frames, now);
    if (r->extra_row && !write_row(r)) return false;
    if (r->extra_frame && !write_frame(r)) return false;
    return write_checkpoint(r);
}

/* Steps from event to event. A stop that comes between two events leaves nothing but a checkpoint,
 * so that going on gives the very files of a run that was never stopped. */
static bool go(run *r) {
    while (clast_world_steps(r->world) < r->last_step) {
        if (has_come_to_rest(r)) {
            r->report.at_rest = true;
            break;
        }
        uint64_t target = next_event(r);
        if (!step_until(r, target)) return false;
        if (clast_world_steps(r->world) == target && !write_due(r)) return false;
        if (has_to_stop(r)) {
            ends(r, RUN_INTERRUPTED,
                 "interrupted at t = %.6g s; everything is saved, --resume goes on",
                 clast_world_time(r->world));
            return false;
        }
    }
    return write_last(r);
}

/* ---- ending ---------------------------------------------------------------------------------- */

static void save_failed_state(run *r) {
    char *path = path_in(r->options->out, FILE_FAILED);
    if (clast_checkpoint_save(r->world, path, "state at the failure") != CLAST_OK) remove(path);
    free(path);
}

/* Saves what can be saved; a failure on the way does not hide what ended the run. */
static void wind_up(run *r) {
    switch (r->report.end) {
    case RUN_DONE:
        assemble(r, r->report.at_rest ? "at rest" : "finished", false);
        break;
    case RUN_INTERRUPTED:
        r->report.end = RUN_DONE; /* so that a failure to save is told */
        if (write_checkpoint(r) && assemble(r, "interrupted", false))
            r->report.end = RUN_INTERRUPTED;
        break;
    case RUN_GUARD:
        recorder_passages(&r->recorder);
        save_failed_state(r);
        assemble(r, "failed", false);
        break;
    default:
        break;
    }
}

static void set_schedules(run *r) {
    const scene *s = r->scene;
    double dt = clast_world_time_step(r->world);
    double rest_every = s->ending.rest_for > 0 ? fmax(s->ending.rest_for / REST_SAMPLES, dt) : 0;
    r->frames = (schedule){s->output.frame_every, dt};
    r->rows = (schedule){s->output.series_every, dt};
    r->checkpoints = (schedule){s->output.checkpoint_every, dt};
    r->rest = (schedule){rest_every, dt};
    r->rest_steps = (uint64_t)llround(s->ending.rest_for / dt);
    r->last_step = (uint64_t)llround(s->ending.latest / dt);
    r->quiet_from = NEVER_QUIET;
}

static void run_between(run *r) {
    const run_options *o = r->options;
    if (o->talk == RUN_TALK) report_plan(r->scene, o);
    double started = clock_seconds();
    if (!begin(r)) return;
    uint64_t first = clast_world_steps(r->world);
    progress_start(&r->progress, o->talk, first, r->last_step);
    go(r);
    progress_stop(&r->progress);
    wind_up(r);
    r->report.seconds = clock_seconds() - started;
    r->report.time = clast_world_time(r->world);
    r->report.steps = clast_world_steps(r->world);
    r->report.hash = clast_world_hash(r->world);
    clast_energy e = clast_world_energy(r->world);
    r->report.residual = e.input > 0 ? fabs(e.residual) / e.input : 0;
    if (o->talk == RUN_TALK) report_costs(r->scene, r->report.seconds, r->report.steps - first);
    if (o->talk == RUN_TALK) passage_report(r->scene);
    if (o->talk != RUN_SILENT) printf("hash: 0x%016llx\n", (unsigned long long)r->report.hash);
    fflush(stdout);
}

run_report run_scene(scene *s, const run_options *options) {
    CLAST_ASSERT(s && s->world && options && options->out && options->out[0]);
    if (options->until > 0) s->ending.latest = options->until;
    run r = {.scene = s, .options = options, .world = s->world, .held = -1};
    if (clast_world_prepare(r.world) != CLAST_OK) {
        ends(&r, RUN_GUARD, "%s", clast_world_error(r.world));
        return r.report;
    }
    set_schedules(&r);
    recorder_start(&r.recorder, s);
    signals old;
    signals_catch(&old);
    run_between(&r);
    signals_restore(&old);
    recorder_stop(&r.recorder);
    if (r.held >= 0) close(r.held);
    return r.report;
}

bool run_is_finished(const char *folder, uint64_t *hash) {
    CLAST_ASSERT(folder && hash);
    char *path = path_in(folder, FILE_RUN);
    h5_file *f = path_exists(path) ? h5_open(path) : NULL;
    free(path);
    if (!f) return false;
    char *end = h5_text_attribute(f, "/", "end"), *text = h5_text_attribute(f, "/", "hash");
    *hash = strtoull(text, NULL, 16);
    bool finished =
        h5_status(f) == CLAST_OK && (strcmp(end, "finished") == 0 || strcmp(end, "at rest") == 0);
    free(end);
    free(text);
    h5_free(f);
    return finished;
}
