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

study_folders study_folders_below(const char *build, const char *name, study_size size) {
    study_folders to;
    const char *size_name = study_size_name(size);
    snprintf(to.runs, sizeof to.runs, "%s/studies/%s/runs", build, name);
    snprintf(to.data, sizeof to.data, "%s/studies/%s/%s/data", build, name, size_name);
    snprintf(to.frames, sizeof to.frames, "%s/studies/%s/%s/frames", build, name, size_name);
    snprintf(to.verdicts, sizeof to.verdicts, "%s/validate", build);
    const char *const all[] = {to.runs, to.data, to.frames, to.verdicts};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) output_folder(all[i]);
    snprintf(to.verdicts, sizeof to.verdicts, "%s/validate/%s.csv", build, name);
    return to;
}

int study_end(const char *name, int failed_runs, int bad) {
    if (failed_runs > 0) fprintf(stderr, "%s: %d runs failed\n", name, failed_runs);
    return bad ? bad : failed_runs > 0;
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
