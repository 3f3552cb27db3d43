/* marks.h - functions that callgrind finds by name; in a file of their own so that none is inlined.
 */
#ifndef CLAST_TESTS_MARKS_H
#define CLAST_TESTS_MARKS_H

#include "engine/clast.h"

void counted_steps(clast_world *w, uint64_t count);
void counted_end(void);

#endif
