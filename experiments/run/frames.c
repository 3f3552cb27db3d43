#include "experiments/run/frames.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/run/folder.h"

char *frame_group(long number) {
    return text_format("/frames/%06ld", number);
}

static void push(frame_list *l, const frame_place *p) {
    l->items = realloc(l->items, (l->count + 1) * sizeof *l->items);
    CLAST_ASSERT(l->items);
    l->items[l->count++] = *p;
}

static void find_in_archive(frame_list *l, h5_file *archive) {
    char *name;
    for (size_t i = 0; (name = h5_member(archive, "/frames", i)); i++) {
        frame_place p = {.number = strtol(name, NULL, 10)};
        char *group = text_format("/frames/%s", name);
        p.step = h5_u64_attribute(archive, group, "step");
        p.time = h5_double_attribute(archive, group, "time");
        if (h5_status(archive) == CLAST_OK) push(l, &p);
        free(group);
        free(name);
    }
}

static void find_parts(frame_list *l, const char *folder) {
    size_t count;
    long *numbers = folder_parts(folder, &count);
    for (size_t i = 0; i < count; i++) {
        char *path = folder_part(folder, numbers[i]);
        h5_file *part = h5_open(path);
        frame_place p = {.number = numbers[i], .is_part = true};
        p.step = h5_u64_attribute(part, "/", "step");
        p.time = h5_double_attribute(part, "/", "time");
        if (h5_status(part) == CLAST_OK) push(l, &p);
        h5_free(part);
        free(path);
    }
    free(numbers);
}

static int by_number(const void *a, const void *b) {
    const frame_place *x = a, *y = b;
    if (x->number != y->number) return x->number < y->number ? -1 : 1;
    return (int)y->is_part - (int)x->is_part;
}

frame_list frames_find(const char *folder, h5_file *archive) {
    CLAST_ASSERT(folder);
    frame_list l = {0};
    if (archive) find_in_archive(&l, archive);
    find_parts(&l, folder);
    if (l.count > 0) qsort(l.items, l.count, sizeof *l.items, by_number);
    size_t kept = 0;
    for (size_t i = 0; i < l.count; i++)
        if (kept == 0 || l.items[kept - 1].number != l.items[i].number)
            l.items[kept++] = l.items[i];
    l.count = kept;
    return l;
}
