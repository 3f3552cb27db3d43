#include "experiments/study/pictures.h"

#include <spawn.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "experiments/run/results.h"

extern char **environ;

enum { PATH_ROOM = 1000 };

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

static size_t frame_at(const char *run, double time) {
    char why[RESULTS_ERROR_MAX];
    results *r = results_open(run, why);
    size_t nearest = r && results_frames(r) ? results_frame_at(r, time) : 0;
    results_free(r);
    return nearest;
}

/* speed_max, marked: NULL for neither. */
static int still(const char *clast, const char *run, double time, const char *folder,
                 const char *name, const char *colour, const char *speed_max, const char *marked) {
    char out[PATH_ROOM], frames[48], from[PATH_ROOM + 32], to[PATH_ROOM + 32];
    size_t nearest = frame_at(run, time);
    snprintf(out, sizeof out, "%s/%s", folder, name);
    snprintf(frames, sizeof frames, "%zu:%zu", nearest, nearest);
    const char *arguments[16] = {clast,      "render", run,        "--out", out,
                                 "--frames", frames,   "--colour", colour};
    int n = 9;
    if (speed_max) arguments[n++] = "--speed-max", arguments[n++] = speed_max;
    if (marked) arguments[n++] = "--mark", arguments[n++] = marked;
    int bad = command(arguments);
    if (bad) return bad;
    snprintf(from, sizeof from, "%s/frame-000000.png", out);
    snprintf(to, sizeof to, "%s.png", out);
    return rename(from, to) == 0 && rmdir(out) == 0 ? 0 : 4;
}

int picture_still(const char *clast, const char *run, double time, const char *folder,
                  const char *name, const char *colour) {
    return still(clast, run, time, folder, name, colour, NULL, NULL);
}

int picture_marked(const char *clast, const char *run, double time, const char *folder,
                   const char *name, const char *colour, const char *speed_max, uint32_t id) {
    char marked[16];
    snprintf(marked, sizeof marked, "%u", (unsigned)id);
    return still(clast, run, time, folder, name, colour, speed_max, marked);
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

int picture_movie(const char *clast, const char *run, const char *folder, const char *name,
                  const char *colour, const char *speed_max) {
    return picture_movie_marked(clast, run, folder, name, colour, speed_max, NULL, 0);
}

int picture_movie_marked(const char *clast, const char *run, const char *folder, const char *name,
                         const char *colour, const char *speed_max, const uint32_t *id, int count) {
    if (count > PICTURE_MARKS) count = PICTURE_MARKS;
    char out[PATH_ROOM], movie[PATH_ROOM + 8], marked[PICTURE_MARKS][16];
    snprintf(out, sizeof out, "%s/%s", folder, name);
    snprintf(movie, sizeof movie, "%s.mp4", out);
    const char *arguments[12 + 2 * PICTURE_MARKS] = {clast, "render",   run,   "--out",
                                                     out,   "--colour", colour};
    int n = 7;
    if (speed_max) arguments[n++] = "--speed-max", arguments[n++] = speed_max;
    if (has_ffmpeg()) arguments[n++] = "--animation", arguments[n++] = movie;
    for (int i = 0; i < count; i++) {
        snprintf(marked[i], sizeof marked[i], "%u", (unsigned)id[i]);
        arguments[n++] = "--mark", arguments[n++] = marked[i];
    }
    return command(arguments);
}
