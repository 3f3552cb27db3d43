#include <stdio.h>

#include "experiments/clast/commands.h"

int cmd_render(int argc, char **argv) {
    (void)argc, (void)argv;
    fputs("clast render: not built yet\n", stderr);
    return CLAST_EXIT_USAGE;
}
