/* schema_rows.h - how the rows of the tables of keys are written; for schema*.c alone. */
#ifndef CLAST_SCENE_SCHEMA_ROWS_H
#define CLAST_SCENE_SCHEMA_ROWS_H

#include "experiments/scene/draft.h"
#include "experiments/scene/schema.h"

#include <math.h>

/* clang-format off */
#define TABLE_FOR_ALL(name, title_text, type, rows)                                                \
    const key_section name = {.title = (title_text), .size = sizeof(type), .keys = rows,           \
                              .count = (int)(sizeof(rows) / sizeof *(rows))}
#define TABLE(name, title_text, type, rows) static TABLE_FOR_ALL(name, title_text, type, rows)
#define FIELD(field) .offset = offsetof(TARGET, field)

#define ANY          .range = {-INFINITY, INFINITY, false, false}
#define ABOVE(x)     .range = {(x), INFINITY, true, false}
#define FROM(x)      .range = {(x), INFINITY, false, false}
#define RANGE(x, y)  .range = {(x), (y), false, false}
#define WITHIN(x, y) .range = {(x), (y), true, true}
#define UP_TO(x, y)  .range = {(x), (y), true, false} /* the lower end is outside */
/* clang-format on */

/* schema_walls.c, schema_flow.c, schema.c */
extern const key_section SCHEMA_TURN, SCHEMA_WALL;
extern const key_section SCHEMA_PART, SCHEMA_FEED, SCHEMA_OUTLET;
extern const key_section SCHEMA_MIXTURE;

#endif
