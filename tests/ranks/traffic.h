/* traffic.h - how many ghosts a bed that processes share should have: the model of MPI.md. */
#ifndef CLAST_TESTS_TRAFFIC_H
#define CLAST_TESTS_TRAFFIC_H

#include "engine/clast.h"

/* Of all processes together, for spheres of one size in a bed that is a box, cut along its longest
 * side again and again; `work`: counted, of a step; `steps` since the world was divided first. All
 * processes have to ask. */
double traffic_ghosts(clast_world *w, double work, double steps);

#endif
