/* Runs ffmpeg as a program, without a shell, so that no character of a path has a meaning. */
#include "render/status.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MAGIC = 0x6d6f7669, PATH_ROOM = 4096, LOG_ROOM = 600 };

extern char **environ; /* POSIX leaves its declaration to us */

render_movie_def render_movie_default(void) {
    return (render_movie_def){
        .stem = "frame", .first = 0, .frames_per_s = 25, .quality = 18, .magic = MAGIC};
}

static render_status check_def(const render_movie_def *d) {
    RENDER_ASSERT(d->magic == MAGIC);
    if (!d->folder || !d->stem || !d->path)
        return render_fail(RENDER_ERR_ARGUMENT, "movie: folder, stem and path expected");
    if (!(d->frames_per_s > 0 && d->frames_per_s <= 1000) || d->first < 0 || d->quality < 0 ||
        d->quality > 51)
        return render_fail(
            RENDER_ERR_ARGUMENT,
            "movie: %g frames/s from picture %d at quality %d (expected more than 0, "
            "at least 0, 0 to 51)",
            d->frames_per_s, d->first, d->quality);
    return RENDER_OK;
}

/* ffmpeg reads `%06d` as the picture's number, so other percent signs are doubled. */
static bool print_pattern(const render_movie_def *d, char *out, size_t size) {
    char plain[PATH_ROOM];
    int length = snprintf(plain, sizeof plain, "%s/%s", d->folder, d->stem);
    if (length < 0 || (size_t)length >= sizeof plain) return false;
    size_t used = 0;
    for (const char *c = plain; *c; c++) {
        if (used + 12 > size) return false;
        if (*c == '%') out[used++] = '%';
        out[used++] = *c;
    }
    snprintf(out + used, size - used, "-%%06d.png");
    return true;
}

/* Keeps the end of what ffmpeg says, which is where the reason stands. */
static void read_log(int from, char *log) {
    size_t used = 0;
    log[0] = '\0';
    for (;;) {
        char chunk[256];
        ssize_t got = read(from, chunk, sizeof chunk);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        if (used + (size_t)got >= LOG_ROOM) {
            size_t keep = LOG_ROOM - 1 - (size_t)got;
            if (keep > used) keep = used;
            memmove(log, log + used - keep, keep);
            used = keep;
        }
        memcpy(log + used, chunk, (size_t)got);
        used += (size_t)got;
        log[used] = '\0';
    }
    while (used > 0 && (log[used - 1] == '\n' || log[used - 1] == ' ')) log[--used] = '\0';
}

static int spawn(char *const arguments[], int log, pid_t *child) {
    posix_spawn_file_actions_t actions;
    int error = posix_spawn_file_actions_init(&actions);
    if (error != 0) return error;
    error = posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    if (error == 0) error = posix_spawn_file_actions_adddup2(&actions, log, STDOUT_FILENO);
    if (error == 0) error = posix_spawn_file_actions_adddup2(&actions, log, STDERR_FILENO);
    if (error == 0) error = posix_spawnp(child, arguments[0], &actions, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

static int wait_for(pid_t child) {
    int state = 0;
    while (waitpid(child, &state, 0) < 0)
        if (errno != EINTR) return -1;
    return WIFEXITED(state) ? WEXITSTATUS(state) : -1;
}

static render_status run(char *const arguments[]) {
    int ends[2];
    if (pipe(ends) != 0)
        return render_fail(RENDER_ERR_PROCESS, "%s: no pipe: %s", arguments[0], strerror(errno));
    /* Neither end may outlive the exec: a stray copy of the writing end would never let us finish.
     */
    fcntl(ends[0], F_SETFD, FD_CLOEXEC);
    fcntl(ends[1], F_SETFD, FD_CLOEXEC);
    pid_t child = 0;
    int error = spawn(arguments, ends[1], &child);
    close(ends[1]);
    char log[LOG_ROOM] = "";
    if (error == 0) read_log(ends[0], log);
    close(ends[0]);
    if (error == ENOENT)
        return render_fail(RENDER_ERR_UNAVAILABLE,
                           "animation not made: %s is not on PATH (install ffmpeg); the pictures "
                           "are complete",
                           arguments[0]);
    if (error != 0)
        return render_fail(RENDER_ERR_PROCESS, "%s does not start: %s", arguments[0],
                           strerror(error));
    int code = wait_for(child);
    if (code == 127) /* older C libraries report a missing program this way */
        return render_fail(RENDER_ERR_UNAVAILABLE, "animation not made: %s is not on PATH",
                           arguments[0]);
    if (code != 0)
        return render_fail(RENDER_ERR_PROCESS, "%s failed (exit code %d): %s", arguments[0], code,
                           log);
    return RENDER_OK;
}

render_status render_movie_make(const render_movie_def *def) {
    RENDER_ASSERT(def);
    render_status status = check_def(def);
    if (status != RENDER_OK) return status;
    char pattern[2 * PATH_ROOM], part[PATH_ROOM], rate[32], first[16], quality[16];
    int length = snprintf(part, sizeof part, "%s.part.mp4", def->path);
    if (!print_pattern(def, pattern, sizeof pattern) || (size_t)length >= sizeof part)
        return render_fail(RENDER_ERR_ARGUMENT, "movie: a path is too long");
    snprintf(rate, sizeof rate, "%.9g", def->frames_per_s);
    snprintf(first, sizeof first, "%d", def->first);
    snprintf(quality, sizeof quality, "%d", def->quality);
    /* yuv420p needs even sides: a row and a column are added where a side is odd. */
    char even[] = "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white";
    char program[] = "ffmpeg", crf[] = "-crf", log[] = "-v", level[] = "error", yes[] = "-y",
         framerate[] = "-framerate", start[] = "-start_number", input[] = "-i", filter[] = "-vf",
         codec[] = "-c:v", x264[] = "libx264", format[] = "-pix_fmt", yuv[] = "yuv420p",
         flags[] = "-movflags", faststart[] = "+faststart";
    char *const arguments[] = {program, log,     level,  yes,       framerate, rate, start, first,
                               input,   pattern, filter, even,      codec,     x264, crf,   quality,
                               format,  yuv,     flags,  faststart, part,      NULL};
    status = run(arguments);
    if (status == RENDER_OK && rename(part, def->path) != 0)
        status = render_fail(RENDER_ERR_FILE, "%s: cannot rename: %s", def->path, strerror(errno));
    if (status != RENDER_OK) remove(part);
    return status;
}
