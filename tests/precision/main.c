/* clast_precision - speed against error for double and mixed precision.
 *
 *     clast_precision OUT.csv [PART]...      PART: speed, rebound, discharge, drift; default: all
 *
 * Takes some minutes of one core. README.md says what the rows mean and what they showed. */
#include "tests/precision/precision.h"

#include <stdlib.h>
#include <string.h>

const char *const PRECISION_NAMES[2] = {"double", "mixed"};

void precision_row(const precision_table *t, const char *quantity, const char *of,
                   const char *precision, double x, double value, double half) {
    fprintf(t->file, "%s,%s,%s,%.10g,%.8g,%.4g\n", quantity, of, precision, x, value, half);
    fflush(t->file);
}

void precision_demand(bool fine, const clast_world *w) {
    if (fine) return;
    fprintf(stderr, "clast_precision: %s\n", w ? clast_world_error(w) : clast_world_new_error());
    exit(1);
}

static const struct {
    const char *name;
    void (*measure)(const precision_table *t);
} PARTS[] = {{"speed", measure_speed},
             {"rebound", measure_rebound},
             {"discharge", measure_discharge},
             {"drift", measure_drift}};
enum { PART_COUNT = sizeof PARTS / sizeof *PARTS };

static bool is_asked(const char *name, int argc, char **argv) {
    for (int i = 2; i < argc; i++)
        if (strcmp(argv[i], name) == 0) return true;
    return argc == 2;
}

static char *folder_of(const char *path) {
    char *folder = strdup(path), *slash = folder ? strrchr(folder, '/') : NULL;
    if (slash) *slash = '\0';
    return slash ? folder : strcpy(folder, ".");
}

int main(int argc, char **argv) {
    if (argc < 2 || argv[1][0] == '-') {
        fprintf(stderr, "usage: clast_precision OUT.csv [speed|rebound|discharge|drift]...\n");
        return 2;
    }
    char part[4096], *scratch = folder_of(argv[1]);
    snprintf(part, sizeof part, "%s.part", argv[1]);
    precision_table t = {fopen(part, "w"), scratch, .seeds = 48, .steps = 1e6};
    if (!t.file) {
        perror(part);
        return 1;
    }
    fprintf(t.file, "quantity,case,precision,x,value,half\n");
    for (int i = 0; i < PART_COUNT; i++) {
        if (!is_asked(PARTS[i].name, argc, argv)) continue;
        fprintf(stderr, "clast_precision: %s ...\n", PARTS[i].name);
        PARTS[i].measure(&t);
    }
    free(scratch);
    if (fclose(t.file) || rename(part, argv[1])) {
        perror(argv[1]);
        return 1;
    }
    return 0;
}
