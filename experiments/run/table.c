#include "experiments/run/table.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "engine/check.h"
#include "engine/clast.h"
#include "experiments/run/folder.h"

static void note_failure(table *t, int failure) {
    if (!t->failure) t->failure = failure;
}

/* Straight to the system; on failure the file is cut back to what it was. */
static void put(table *t, const char *text, size_t length) {
    size_t done = 0;
    while (!t->failure && done < length) {
        ssize_t n = write(t->descriptor, text + done, length - done);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0)
            note_failure(t, n < 0 ? errno : ENOSPC);
        else
            done += (size_t)n;
    }
    if (!t->failure)
        t->size += (long)length;
    else if (done > 0 && ftruncate(t->descriptor, t->size) != 0)
        note_failure(t, errno);
}

static void table_open(table *t, const char *path, int mode) {
    CLAST_ASSERT(t && path);
    if (clast_ranks_number() > 0) mode = 0, path = "/dev/null";
    *t = (table){.mute = clast_ranks_number() > 0,
                 .descriptor = open(path, O_WRONLY | O_CLOEXEC | mode, 0666)};
    if (t->descriptor < 0) note_failure(t, errno);
}

void table_create(table *t, const char *path, const char *header) {
    table_open(t, path, O_CREAT | O_TRUNC);
    char *line = text_format("%s\n", header);
    put(t, line, strlen(line));
    free(line);
}

/* Step number of a row: its second column. */
static bool step_of_row(const char *line, uint64_t *step) {
    const char *comma = strchr(line, ',');
    if (!comma) return false;
    char *end;
    *step = strtoull(comma + 1, &end, 10);
    return end != comma + 1 && (*end == ',' || *end == '\n');
}

/* Length of the part of the file that is kept; rows stand in the order of steps. */
static long kept_length(FILE *f, const char *header, bool keep(uint64_t, const void *),
                        const void *context) {
    char *line = NULL;
    size_t room = 0;
    long kept = -1;
    for (ssize_t length; (length = getline(&line, &room, f)) > 0;) {
        uint64_t step = 0;
        bool whole = line[length - 1] == '\n';
        if (kept < 0) {
            size_t expected = strlen(header);
            if (!whole || (size_t)length != expected + 1 || strncmp(line, header, expected)) break;
        } else if (!whole || !step_of_row(line, &step) || !keep(step, context)) {
            break;
        }
        kept = ftell(f);
    }
    free(line);
    return kept;
}

void table_continue(table *t, const char *path, const char *header,
                    bool keep(uint64_t step, const void *context), const void *context) {
    CLAST_ASSERT(header && keep);
    if (!path_exists(path) || clast_ranks_number() > 0) {
        table_create(t, path, header);
        return;
    }
    FILE *f = fopen(path, "r");
    long kept = f ? kept_length(f, header, keep, context) : -1;
    if (f) fclose(f);
    table_open(t, path, 0);
    if (kept < 0) note_failure(t, EINVAL);
    if (t->failure) return;
    t->size = kept;
    if (ftruncate(t->descriptor, kept) != 0 || lseek(t->descriptor, kept, SEEK_SET) != kept)
        note_failure(t, errno);
}

static void append(table *t, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    if (t->room < t->length + 64) {
        t->room = 2 * t->room + 256;
        t->row = realloc(t->row, t->room);
        CLAST_ASSERT(t->row);
    }
    t->length += (size_t)vsnprintf(t->row + t->length, t->room - t->length, format, arguments);
    va_end(arguments);
}

void table_begin(table *t, double time, uint64_t step) {
    t->length = 0;
    append(t, "%.17g,%llu", time, (unsigned long long)step);
}

void table_number(table *t, double value) {
    if (isnan(value))
        append(t, ",nan"); /* printf would write -nan for some */
    else
        append(t, ",%.17g", value);
}

void table_word(table *t, const char *word) {
    CLAST_ASSERT(t && word);
    append(t, ",");
    for (const char *c = word; *c; c++) append(t, "%c", *c == ',' || *c == '"' ? ' ' : *c);
}

void table_end(table *t) {
    append(t, "\n");
    put(t, t->row, t->length);
}

void table_sync(table *t) {
    if (!t->failure && !t->mute && fsync(t->descriptor) != 0) note_failure(t, errno);
}

void table_close(table *t) {
    if (t->descriptor >= 0 && close(t->descriptor) != 0) note_failure(t, errno);
    free(t->row);
    *t = (table){.descriptor = -1, .failure = t->failure};
}
