/* flow_saved.h - feeds, outlets and unread records in a checkpoint. Private to checkpoint.c. */
#ifndef CLAST_ENGINE_FLOW_SAVED_H
#define CLAST_ENGINE_FLOW_SAVED_H

#include <stdio.h>

#include "engine/flow.h"
#include "engine/hdf5_io.h"

/* What a file holds, before it is checked against a world. */
typedef struct saved_flow {
    double *feeds, *outlets, *arrivals, *departures;
    size_t feed_count, outlet_count, arrival_count, departure_count;
} saved_flow;

void flow_save(h5_file *f, const clast_world *w);
void flow_read(h5_file *f, saved_flow *s);
void flow_read_free(saved_flow *s);
const char *flow_fault(const clast_world *w, const saved_flow *s, uint32_t ids);
void flow_install(clast_world *w, const saved_flow *s);
void flow_describe(FILE *t, const clast_world *w);

#endif
