#include "experiments/study/command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const SIZES[] = {"quick", "brief", "published", "full"};

const char *study_size_name(study_size size) {
    return SIZES[size];
}

static study_size size_named(const char *name, const char *usage) {
    for (int i = 0; i <= STUDY_FULL; i++)
        if (!strcmp(SIZES[i], name) && strstr(usage, name)) return (study_size)i;
    fprintf(stderr, "there is no size '%s'\n%s", name, usage);
    exit(2);
}

study_command study_command_of(int argc, char **argv, const char *usage) {
    const char *size = getenv("CLAST_SIZE"), *what = argc > 1 ? argv[1] : "";
    if (!size || !*size) size = SIZES[STUDY_PUBLISHED];
    bool help = !strcmp(what, "--help"), known = !strcmp(what, "figures");
    known |= !strcmp(what, "validate");
    for (int i = 2; i < argc; i++) {
        bool option = !strcmp(argv[i], "--size") && i + 1 < argc;
        known &= option;
        if (option) size = argv[++i];
    }
    if (!known) {
        fputs(usage, help ? stdout : stderr);
        exit(help ? 0 : 2);
    }
    return (study_command){!strcmp(what, "figures"), size_named(size, usage)};
}
