#include "experiments/run/folder.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/check.h"

char *text_format(const char *format, ...) {
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    CLAST_ASSERT(length >= 0);
    char *text = malloc((size_t)length + 1);
    CLAST_ASSERT(text);
    vsnprintf(text, (size_t)length + 1, format, again);
    va_end(again);
    return text;
}

char *path_in(const char *folder, const char *name) {
    CLAST_ASSERT(folder && name);
    return text_format("%s/%s", folder, name);
}

bool path_exists(const char *path) {
    return access(path, F_OK) == 0;
}

int folder_make(const char *path) {
    CLAST_ASSERT(path && path[0]);
    char *part = text_format("%s", path);
    int failure = 0;
    for (char *p = part + 1; !failure; p++) {
        if (*p != '/' && *p != '\0') continue;
        char kept = *p;
        *p = '\0';
        if (mkdir(part, 0777) != 0 && errno != EEXIST) failure = errno;
        *p = kept;
        if (kept == '\0') break;
    }
    struct stat about;
    if (!failure && stat(path, &about) == 0 && !S_ISDIR(about.st_mode)) failure = ENOTDIR;
    free(part);
    return failure;
}

bool folder_is_empty(const char *path) {
    DIR *folder = opendir(path);
    if (!folder) return true;
    bool empty = true;
    for (struct dirent *e; empty && (e = readdir(folder));)
        empty = strcmp(e->d_name, ".") == 0 || strcmp(e->d_name, "..") == 0;
    closedir(folder);
    return empty;
}

int folder_hold(const char *path) {
    int failure = folder_make(path);
    if (failure) return -failure;
    int held = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (held < 0) return -errno;
    if (flock(held, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return held;
    close(held);
    return -EWOULDBLOCK;
}

/* The number in NNNNNN.h5, or -1. */
static long number_of(const char *name) {
    char *end;
    if (name[0] < '0' || name[0] > '9') return -1;
    long number = strtol(name, &end, 10);
    return strcmp(end, ".h5") == 0 ? number : -1;
}

static int ascending(const void *a, const void *b) {
    long x = *(const long *)a, y = *(const long *)b;
    return (x > y) - (x < y);
}

long *folder_parts(const char *folder, size_t *count) {
    char *path = path_in(folder, FOLDER_FRAMES);
    DIR *d = opendir(path);
    size_t n = 0, room = 64;
    long *numbers = malloc(room * sizeof *numbers);
    CLAST_ASSERT(numbers);
    for (struct dirent *e; d && (e = readdir(d));) {
        long number = number_of(e->d_name);
        if (number < 0) continue;
        if (n == room) {
            room *= 2;
            numbers = realloc(numbers, room * sizeof *numbers);
            CLAST_ASSERT(numbers);
        }
        numbers[n++] = number;
    }
    if (d) closedir(d);
    free(path);
    qsort(numbers, n, sizeof *numbers, ascending);
    *count = n;
    return numbers;
}

char *folder_part(const char *folder, long number) {
    CLAST_ASSERT(number >= 0);
    return text_format("%s/" FOLDER_FRAMES "/%06ld.h5", folder, number);
}

static bool always(const char *part, void *context) {
    (void)part, (void)context;
    return true;
}

/* Files of a folder that end with `ending`. */
static void remove_ending(const char *path, const char *ending) {
    DIR *d = opendir(path);
    for (struct dirent *e; d && (e = readdir(d));) {
        size_t length = strlen(e->d_name), tail = strlen(ending);
        if (length <= tail || strcmp(e->d_name + length - tail, ending) != 0) continue;
        char *file = path_in(path, e->d_name);
        remove(file);
        free(file);
    }
    if (d) closedir(d);
}

void folder_drop_parts(const char *path, bool drop(const char *part, void *context),
                       void *context) {
    size_t count;
    long *numbers = folder_parts(path, &count);
    for (size_t i = 0; i < count; i++) {
        char *part = folder_part(path, numbers[i]);
        if (drop(part, context)) remove(part);
        free(part);
    }
    free(numbers);
    char *frames = path_in(path, FOLDER_FRAMES);
    remove_ending(frames, ".h5.tmp");
    free(frames);
}

int folder_clear_run(const char *path) {
    static const char *const OURS[] = {FILE_RUN,   FILE_XDMF,    FILE_SERIES,     FILE_FEEDS,
                                       FILE_SCENE, FILE_OUTLETS, FILE_CHECKPOINT, FILE_FAILED};
    int failure = 0;
    folder_drop_parts(path, always, NULL);
    char *frames = path_in(path, FOLDER_FRAMES);
    rmdir(frames);
    free(frames);
    remove_ending(path, ".samples.csv");
    remove_ending(path, ".h5.tmp");
    for (size_t i = 0; i < sizeof OURS / sizeof *OURS; i++) {
        char *file = path_in(path, OURS[i]);
        if (remove(file) != 0 && errno != ENOENT && !failure) failure = errno;
        free(file);
    }
    return failure;
}

int file_write_text(const char *path, const char *text) {
    CLAST_ASSERT(path && text);
    char *temporary = text_format("%s.tmp", path);
    FILE *f = fopen(temporary, "w");
    int failure = f ? 0 : errno;
    if (f && (fputs(text, f) == EOF || fflush(f) == EOF || fsync(fileno(f)) != 0)) failure = errno;
    if (f && fclose(f) != 0 && !failure) failure = errno;
    if (!failure && rename(temporary, path) != 0) failure = errno;
    if (failure) remove(temporary);
    free(temporary);
    return failure;
}
