#include "experiments/scene/fault.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { SHOWN_MAX = 500 }; /* a wrong word in 20 000 bodies need not be read 20 000 times */

/* The same mistake reached twice (through a YAML alias, say) is one fault. */
static bool known(const scene_faults *faults, const scene_fault *fault) {
    for (int i = 0; i < faults->count; i++) {
        const scene_fault *other = &faults->items[i];
        if (other->line == fault->line && !strcmp(other->key, fault->key) &&
            !strcmp(other->text, fault->text) && !strcmp(other->file, fault->file))
            return true;
    }
    return false;
}

static void add(scene_faults *faults, scene_fault fault) {
    SCENE_ASSERT(fault.file && fault.key && fault.text && fault.line >= 0);
    if (known(faults, &fault)) return;
    if (faults->count == faults->room) {
        int room = faults->room ? 2 * faults->room : 16;
        scene_fault *items = scene_alloc(faults->arena, (size_t)room * sizeof *items);
        if (faults->count) memcpy(items, faults->items, (size_t)faults->count * sizeof *items);
        faults->items = items;
        faults->room = room;
    }
    fault.order = faults->count;
    faults->items[faults->count++] = fault;
    if (!fault.warning) faults->errors++;
}

#define ADD(where, is_warning, is_foreign)                                                         \
    va_list arguments;                                                                             \
    va_start(arguments, format);                                                                   \
    const char *text = scene_vprint(faults->arena, format, arguments);                             \
    va_end(arguments);                                                                             \
    add(faults, (scene_fault){.file = (where),                                                     \
                              .line = line,                                                        \
                              .warning = (is_warning),                                             \
                              .key = scene_copy(faults->arena, key, strlen(key)),                  \
                              .text = text})

void scene_report(scene_faults *faults, int line, const char *key, const char *format, ...) {
    ADD(faults->file, false, false);
}

void scene_warn(scene_faults *faults, int line, const char *key, const char *format, ...) {
    ADD(faults->file, true, false);
}

void scene_report_in(scene_faults *faults, const char *file, int line, const char *key,
                     const char *format, ...) {
    ADD(scene_copy(faults->arena, file, strlen(file)), false, true);
}

static int compare(const void *left, const void *right) {
    const scene_fault *a = left, *b = right;
    int by_file = (a->foreign - b->foreign) ? a->foreign - b->foreign : strcmp(a->file, b->file);
    if (by_file) return by_file;
    if (a->line != b->line) return a->line < b->line ? -1 : 1;
    return (a->order > b->order) - (a->order < b->order);
}

char *scene_faults_text(const scene_faults *faults) {
    SCENE_ASSERT(faults);
    if (faults->count == 0) return NULL;
    qsort(faults->items, (size_t)faults->count, sizeof *faults->items, compare);
    scene_buffer out = {0};
    int shown = faults->count < SHOWN_MAX ? faults->count : SHOWN_MAX;
    for (int i = 0; i < shown; i++) {
        const scene_fault *fault = &faults->items[i];
        scene_append(&out, "%s:", fault->file);
        if (fault->line > 0) scene_append(&out, "%d:", fault->line);
        if (fault->warning) scene_append(&out, " warning:");
        if (fault->key[0]) scene_append(&out, " %s:", fault->key);
        scene_append(&out, " %s\n", fault->text);
    }
    if (shown < faults->count)
        scene_append(&out, "%s: ... and %d more\n", faults->file, faults->count - shown);
    return out.text;
}

enum { WORD_MAX = 40 }; /* longer words are not typing errors of ours */

static int smallest(int a, int b, int c) {
    int least = a < b ? a : b;
    return least < c ? least : c;
}

int scene_distance(const char *a, const char *b, int limit) {
    SCENE_ASSERT(a && b && limit > 0);
    int length_a = (int)strnlen(a, WORD_MAX + 1), length_b = (int)strnlen(b, WORD_MAX + 1);
    if (length_a > WORD_MAX || length_b > WORD_MAX || abs(length_a - length_b) >= limit)
        return limit;
    int rows[3][WORD_MAX + 1]; /* of the table of distances between the heads of the two words */
    for (int j = 0; j <= length_b; j++) rows[0][j] = j;
    for (int i = 1; i <= length_a; i++) {
        int *now = rows[i % 3], *before = rows[(i + 2) % 3], *earlier = rows[(i + 1) % 3];
        now[0] = i;
        for (int j = 1; j <= length_b; j++) {
            int replace = before[j - 1] + (a[i - 1] != b[j - 1]);
            now[j] = smallest(before[j] + 1, now[j - 1] + 1, replace);
            bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped && earlier[j - 2] + 1 < now[j]) now[j] = earlier[j - 2] + 1;
        }
    }
    int distance = rows[length_a % 3][length_b];
    return distance < limit ? distance : limit;
}

const char *scene_suggest(const char *word, const char *const *candidates, int count) {
    SCENE_ASSERT(word && (candidates || count == 0));
    const char *best = NULL;
    for (int i = 0; i < count; i++)
        if (!strcasecmp(word, candidates[i])) return candidates[i];
    /* A short word turns into any other in two changes, a single letter in one. */
    int limit = strlen(word) < 2 ? 1 : strlen(word) < 4 ? 2 : 3;
    for (int i = 0; i < count; i++) {
        int distance = scene_distance(word, candidates[i], limit);
        if (distance < limit) {
            limit = distance > 0 ? distance : 1;
            best = candidates[i];
        }
    }
    return best;
}
