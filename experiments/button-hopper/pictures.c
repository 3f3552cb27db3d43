/* pictures.c - frames of chosen runs and the animation, by the `clast render` command that users
 * have. */
#include <math.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "experiments/button-hopper/hopper.h"
#include "experiments/run/results.h"

extern char **environ;

/* m/s: the free fall out of the picture; one scale for all frames of the animation */
#define FASTEST "2"

/* Runs the command with these arguments (NULL at the end); its exit code. */
static int command(const char *const *arguments) {
    pid_t child;
    if (posix_spawn(&child, arguments[0], NULL, NULL, (char *const *)arguments, environ)) {
        fprintf(stderr, "%s cannot be started\n", arguments[0]);
        return 4;
    }
    int status;
    if (waitpid(child, &status, 0) < 0 || !WIFEXITED(status)) return 4;
    return WEXITSTATUS(status);
}

static size_t frame_at(const char *folder, double time) {
    char why[RESULTS_ERROR_MAX];
    results *r = results_open(folder, why);
    size_t nearest = r && results_frames(r) ? results_frame_at(r, time) : 0;
    results_free(r);
    return nearest;
}

/* One frame of a run as <frames>/<name>.png. */
static int still(const hopper_study *s, const char *folder, double time, const char *name,
                 const char *colour) {
    char out[700], frames[48], from[760], to[760];
    size_t nearest = frame_at(folder, time);
    snprintf(out, sizeof out, "%s/../frames/%s", s->data, name);
    snprintf(frames, sizeof frames, "%zu:%zu", nearest, nearest);
    int bad = command((const char *const[]){CLAST_COMMAND, "render", folder, "--out", out,
                                            "--frames", frames, "--colour", colour, NULL});
    if (bad) return bad;
    snprintf(from, sizeof from, "%s/frame-000000.png", out);
    snprintf(to, sizeof to, "%s.png", out);
    return rename(from, to) == 0 && rmdir(out) == 0 ? 0 : 4;
}

static const hopper_run *run_of(const hopper_study *s, int fill, int orifice, int replicate) {
    for (int i = 0; i < s->flow_count; i++) {
        const hopper_run *r = &s->runs[i];
        if (r->ran && r->fill == fill && r->orifice == orifice && r->replicate == replicate)
            return r;
    }
    return NULL;
}

/* The run at 5 cm with the longest pause while its bed flowed. */
static const hopper_run *longest_pause(const hopper_study *s) {
    const hopper_run *best = NULL;
    for (int i = 0; i < s->flow_count; i++) {
        const hopper_run *r = &s->runs[i];
        if (!r->ran || r->fill != FRICTIONLESS || r->orifice != 0 || r->pause.length == 0) continue;
        if (!best || r->pause.length > best->pause.length) best = r;
    }
    return best;
}

/* ffmpeg is optional: without it there are frames and no film. */
static bool has_ffmpeg(void) {
    const char *path = getenv("PATH");
    char copy[4096], file[4200], *rest = NULL;
    snprintf(copy, sizeof copy, "%s", path ? path : "");
    for (char *folder = strtok_r(copy, ":", &rest); folder; folder = strtok_r(NULL, ":", &rest)) {
        snprintf(file, sizeof file, "%s/ffmpeg", folder);
        if (access(file, X_OK) == 0) return true;
    }
    fputs("no ffmpeg: no animation\n", stderr);
    return false;
}

static int animation(const hopper_study *s, const hopper_run *r) {
    char out[700], movie[720];
    snprintf(out, sizeof out, "%s/../frames/discharge-10cm", s->data);
    snprintf(movie, sizeof movie, "%s/../frames/discharge-10cm.mp4", s->data);
    return command((const char *const[]){CLAST_COMMAND, "render", r->folder, "--out", out,
                                         "--colour", "speed", "--speed-max", FASTEST,
                                         has_ffmpeg() ? "--animation" : NULL, movie, NULL});
}

int hopper_pictures(const hopper_study *s) {
    char folder[700];
    snprintf(folder, sizeof folder, "%s/../frames", s->data);
    mkdir(folder, 0777);
    int bad = 0;
    for (int fill = 0; fill < FILLS; fill++)
        if (s->size->replicates[fill] > 0)
            bad |= still(s, s->beds[fill == 0 ? 0 : s->size->replicates[0]].folder, 1e9,
                         fill == FRICTIONLESS ? "bed-frictionless" : "bed-frictional",
                         "initial-height");
    const hopper_run *wide = run_of(s, FRICTIONLESS, ORIFICES - 1, 0), *arched = longest_pause(s);
    if (wide) bad |= still(s, wide->folder, 0.08, "zones-10cm", "speed-bands");
    if (arched)
        bad |= still(s, arched->folder, arched->pause.start + 0.5 * arched->pause.length,
                     "arch-5cm", "speed");
    if (wide) bad |= animation(s, wide);
    return bad ? 4 : 0;
}
