/* archive.h - gathers the parts of a run into run.h5, and describes it to ParaView in run.xdmf. */
#ifndef CLAST_RUN_ARCHIVE_H
#define CLAST_RUN_ARCHIVE_H

#include "engine/hdf5_io.h"
#include "experiments/run/frames.h"
#include "experiments/scene/scene.h"

typedef struct archive_facts {
    const scene *scene;
    const char *end; /* "finished", "interrupted", ... */
    uint64_t hash, steps;
    double time;
    bool (*keep_frame)(const frame_place *place, const void *context); /* NULL keeps all */
    const void *context;
} archive_facts;

/* Writes run.h5 from the frames in the old run.h5 and in frames/, and from the tables; then
 * run.xdmf; then removes the parts. On failure everything that was there stays, and error says why.
 */
clast_status archive_assemble(const char *folder, const archive_facts *facts,
                              char error[H5_ERROR_MAX]);

/* Text of the XDMF file for the frames of an open archive; malloc'ed. */
char *xdmf_text(h5_file *archive, const frame_list *frames, const char *title);

#endif
