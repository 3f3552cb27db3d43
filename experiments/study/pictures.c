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

/* Bodies in black as arguments of the command; what is beyond PICTURE_MARKS is left out. */
typedef struct marks {
    char text[PICTURE_MARKS][16];
} marks;

static int add_marks(const char **arguments, int n, marks *m, const uint32_t *id, int count) {
    for (int i = 0; i < count && i < PICTURE_MARKS; i++) {
        snprintf(m->text[i], sizeof m->text[i], "%u", (unsigned)id[i]);
        arguments[n++] = "--mark", arguments[n++] = m->text[i];
    }
    return n;
}

/* speed_max: NULL for none. */
static int still(const char *clast, const char *run, double time, const char *folder,
                 const char *name, const char *colour, const char *speed_max, const uint32_t *id,
                 int count) {
    char out[PATH_ROOM], frames[48], from[PATH_ROOM + 32], to[PATH_ROOM + 32];
    marks room;
    size_t nearest = frame_at(run, time);
    snprintf(out, sizeof out, "%s/%s", folder, name);
    snprintf(frames, sizeof frames, "%zu:%zu", nearest, nearest);
    const char *arguments[12 + 2 * PICTURE_MARKS] = {clast,      "render", run,        "--out", out,
                                                     "--frames", frames,   "--colour", colour};
    int n = 9;
    if (speed_max) arguments[n++] = "--speed-max", arguments[n++] = speed_max;
    add_marks(arguments, n, &room, id, count);
    int bad = command(arguments);
    if (bad) return bad;
    snprintf(from, sizeof from, "%s/frame-000000.png", out);
    snprintf(to, sizeof to, "%s.png", out);
    return rename(from, to) == 0 && rmdir(out) == 0 ? 0 : 4;
}

int picture_still(const char *clast, const char *run, double time, const char *folder,
                  const char *name, const char *colour) {
    return still(clast, run, time, folder, name, colour, NULL, NULL, 0);
}

int picture_marked(const char *clast, const char *run, double time, const char *folder,
                   const char *name, const char *colour, const char *speed_max, const uint32_t *id,
                   int count) {
    return still(clast, run, time, folder, name, colour, speed_max, id, count);
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
    return picture_movie_marked(clast, run, folder, name, colour, speed_max, 0, NULL, 0);
}

int picture_movie_marked(const char *clast, const char *run, const char *folder, const char *name,
                         const char *colour, const char *speed_max, size_t first,
                         const uint32_t *id, int count) {
    char out[PATH_ROOM], movie[PATH_ROOM + 8], frames[32];
    marks room;
    snprintf(out, sizeof out, "%s/%s", folder, name);
    snprintf(movie, sizeof movie, "%s.mp4", out);
    snprintf(frames, sizeof frames, "%zu:", first);
    const char *arguments[14 + 2 * PICTURE_MARKS] = {clast,      "render", run,        "--out", out,
                                                     "--frames", frames,   "--colour", colour};
    int n = 9;
    if (speed_max) arguments[n++] = "--speed-max", arguments[n++] = speed_max;
    if (has_ffmpeg()) arguments[n++] = "--animation", arguments[n++] = movie;
    add_marks(arguments, n, &room, id, count);
    return command(arguments);
}
