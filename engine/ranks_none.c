/* ranks_none.c - in the place of ranks_mpi.c, for a build without MPI and Zoltan. */
#include <stdio.h>
#include <stdlib.h>

#include "engine/clast.h"

/* Each of several would run the whole scene and write the same files. */
clast_status clast_ranks_begin(void) {
    const char *count = getenv("OMPI_COMM_WORLD_SIZE");
    if (!count) count = getenv("PMI_SIZE");
    if (!count || atoi(count) < 2) return CLAST_OK;
    fprintf(stderr,
            "clast: one of %s processes, but built without MPI and Zoltan: every one would run "
            "the whole scene. Install libopenmpi-dev and libtrilinos-zoltan-dev and build again\n",
            count);
    return CLAST_ERR_ARGUMENT;
}

void clast_ranks_end(void) {}
