/* steps.c - the program whose instructions are counted:
 *     counts_steps settle FOLDER      makes FOLDER/NAME.h5 of every bed
 *     counts_steps run FOLDER ISA...  steps every bed with every instruction set; a line for each
 * counted_steps() holds what counts; counted_end() is called once after each. */
#include "tests/counts/grains.h"
#include "tests/counts/marks.h"

#include <stdio.h>
#include <string.h>

enum { WARM = 10, STEPS = 100 };

static const char *path_of(const char *folder, const grains *g) {
    static char path[4096];
    snprintf(path, sizeof path, "%s/%s.h5", folder, g->name);
    return path;
}

static void count(const grains *g, const char *folder, const char *lanes, grains_wish wish) {
    clast_world *w = grains_open(g, &wish, path_of(folder, g));
    const char *in_use = clast_world_plan(w).isa;
    if (strcmp(in_use, lanes) == 0) {
        grains_steps(w, WARM);
        clast_counters before = clast_world_counters(w);
        counted_steps(w, STEPS);
        clast_counters c = clast_world_counters(w);
        counted_end();
        printf("%s %s %s %zu %llu %zu\n", g->name, lanes,
               wish.precision == CLAST_PRECISION_MIXED ? "mixed" : "double", STEPS * c.spheres,
               (unsigned long long)(c.rebuilds - before.rebuilds), c.contacts);
    }
    clast_world_free(w);
}

static int run(const char *folder, int argc, char **argv) {
    for (int k = 0; k < argc; k++) {
        bool wide = strcmp(argv[k], "avx2") == 0;
        grains_wish wish = {.isa = wide ? CLAST_ISA_AVX2 : CLAST_ISA_BASELINE};
        for (int i = 0; i < GRAINS_COUNT; i++) count(&grains_small[i], folder, argv[k], wish);
        wish.precision = CLAST_PRECISION_MIXED;
        count(&grains_small[0], folder, argv[k], wish);
    }
    return 0;
}

int main(int argc, char **argv) {
    if (argc == 3 && strcmp(argv[1], "settle") == 0) {
        for (int i = 0; i < GRAINS_COUNT; i++)
            grains_settle(&grains_small[i], path_of(argv[2], &grains_small[i]));
        return 0;
    }
    if (argc > 3 && strcmp(argv[1], "run") == 0) return run(argv[2], argc - 3, argv + 3);
    fprintf(stderr, "usage: counts_steps settle FOLDER | run FOLDER ISA...\n");
    return 2;
}
