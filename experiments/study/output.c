#include "experiments/study/output.h"

#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { PATH_ROOM = 1000 };

void output_folder(const char *path) {
    char copy[PATH_ROOM];
    snprintf(copy, sizeof copy, "%s", path);
    for (char *at = copy + 1; *at; at++)
        if (*at == '/') {
            *at = '\0';
            mkdir(copy, 0777);
            *at = '/';
        }
    if (mkdir(copy, 0777) && errno != EEXIST) {
        fprintf(stderr, "%s: %s\n", path, strerror(errno));
        exit(4);
    }
}

FILE *output_table(const char *folder, const char *name, const char *header) {
    char path[PATH_ROOM];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, "w");
    if (!f)
        fprintf(stderr, "%s: %s\n", path, strerror(errno));
    else
        fprintf(f, "%s\n", header);
    return f;
}

int output_close(FILE *table) {
    bool bad = ferror(table) != 0; /* an earlier flush may have failed; the last need not */
    bad |= fclose(table) != 0;
    if (bad) fprintf(stderr, "a table cannot be written: %s\n", strerror(errno));
    return bad ? 4 : 0;
}
