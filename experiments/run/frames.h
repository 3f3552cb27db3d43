/* frames.h - where the frames of a run are: gathered in run.h5, or still parts in frames/. */
#ifndef CLAST_RUN_FRAMES_H
#define CLAST_RUN_FRAMES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "engine/hdf5_io.h"

typedef struct frame_place {
    long number;
    bool is_part; /* else in run.h5 */
    uint64_t step;
    double time;
} frame_place;

typedef struct frame_list {
    size_t count;
    frame_place *items; /* by number; malloc'ed */
} frame_list;

/* `archive` is run.h5 open for reading, or NULL. A part takes the place of a frame of the same
 * number in the archive (a run that was killed while tidying up); damaged parts are left out. */
frame_list frames_find(const char *folder, h5_file *archive);

/* Name of a frame's group inside the archive: "/frames/000123". */
char *frame_group(long number);

#endif
