/* unit.h - values as people write them: "3.5 GPa", "($width - 2 cm)/4", "sin(30 deg)".
 *
 * A value is a number of SI units and its dimension. "6.9 mm" has exactly the bits of "0.0069": the
 * power of ten of the unit goes into the decimal text before it is converted, so the choice of unit
 * never changes a run. Nothing here calls libm for anything but sqrt, which is correctly rounded.
 *
 *     value  = term { (+|-) term }
 *     term   = factor { (*|/) factor }
 *     factor = (+|-) factor | atom [^ integer] [units]
 *     atom   = number | pi | $parameter | ( value ) | function ( value [, value] )
 *     units  = [/] unit [power] { [*|/] unit [power] }       e.g. kg m2, m/s2, /s, kg/(m s)
 *
 * What can be read in two ways, such as 1/4 m or kg/m s, is refused.
 */
#ifndef CLAST_SCENE_UNIT_H
#define CLAST_SCENE_UNIT_H

#include <stdbool.h>
#include <stddef.h>

typedef struct unit_dimension {
    int metre, kilogram, second; /* powers; angles have none */
} unit_dimension;

typedef struct unit_value {
    double value; /* SI */
    unit_dimension dimension;
    bool bare; /* no unit was written anywhere: may stand for any dimension, in SI */
} unit_value;

/* What a key may ask for. */
typedef enum unit_kind {
    UNIT_NUMBER,
    UNIT_ANGLE,
    UNIT_LENGTH,
    UNIT_MASS,
    UNIT_TIME,
    UNIT_SPEED,
    UNIT_ACCELERATION,
    UNIT_RATE,
    UNIT_SPIN,
    UNIT_FORCE,
    UNIT_PRESSURE,
    UNIT_DENSITY,
    UNIT_AREA,
    UNIT_INERTIA,
    UNIT_STIFFNESS,
    UNIT_MASS_RATE,
    UNIT_KINDS
} unit_kind;

const char *unit_kind_name(unit_kind kind); /* "pressure" */
const char *unit_kind_si(unit_kind kind);   /* "Pa"; "" for a pure number */
unit_dimension unit_kind_dimension(unit_kind kind);
bool unit_same(unit_dimension a, unit_dimension b);

enum { UNIT_TEXT = 200 }; /* room for a message */

/* "length", "force", or "kg m/s3" for a dimension without a name of its own. */
void unit_describe(unit_dimension dimension, char text[UNIT_TEXT]);

/* Where $names come from. `find` fills *value, or fills why and returns false; an empty why means
 * that the reason has been reported already. */
typedef struct unit_scope {
    bool (*find)(void *context, const char *name, unit_value *value, char why[UNIT_TEXT]);
    bool (*knows)(void *context, const char *name);
    void *context;
} unit_scope;

/* False with a reason in `why` when the text is no value. scope may be NULL: no parameters. */
bool unit_parse(const char *text, const unit_scope *scope, unit_value *value, char why[UNIT_TEXT]);

/* One unit by its symbol: its SI value is factor x 10^decimal. False with a hint when unknown. */
typedef struct unit_symbol {
    unit_dimension dimension;
    int decimal;
    double factor;
} unit_symbol;

bool unit_find(const char *symbol, unit_symbol *unit);
const char *unit_suggest(const char *symbol, char text[UNIT_TEXT]); /* NULL when nothing is near */

/* All symbols without prefix, for the reference: index 0, 1, ... until NULL. */
const char *unit_listed(int index, bool *takes_prefix);

#endif
