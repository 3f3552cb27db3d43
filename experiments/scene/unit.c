#include "experiments/scene/unit.h"
#include "experiments/scene/fault.h"

#include <stdio.h>
#include <string.h>

typedef struct row {
    const char *symbol;
    unit_symbol unit;
    bool prefix; /* takes n, u, m, c, ... */
} row;

static const double PI = 3.141592653589793; /* literals: libm's acos may differ in the last bit */
static const double DEGREE = 0.017453292519943295;
static const double TURN = 6.283185307179586;

#define DIM(m, kg, s)                                                                              \
    { (m), (kg), (s) }

/* symbol, {dimension, power of ten, factor}, prefix; the factor is for what is not decimal. */
static const row UNITS[] = {
    {"m", {DIM(1, 0, 0), 0, 1}, true},         {"in", {DIM(1, 0, 0), -4, 254}, false},
    {"ft", {DIM(1, 0, 0), -4, 3048}, false},   {"g", {DIM(0, 1, 0), -3, 1}, true},
    {"t", {DIM(0, 1, 0), 3, 1}, true},         {"lb", {DIM(0, 1, 0), -8, 45359237}, false},
    {"s", {DIM(0, 0, 1), 0, 1}, true},         {"min", {DIM(0, 0, 1), 0, 60}, false},
    {"h", {DIM(0, 0, 1), 0, 3600}, false},     {"d", {DIM(0, 0, 1), 0, 86400}, false},
    {"Hz", {DIM(0, 0, -1), 0, 1}, true},       {"rad", {DIM(0, 0, 0), 0, 1}, true},
    {"deg", {DIM(0, 0, 0), 0, DEGREE}, false}, {"rpm", {DIM(0, 0, -1), 0, TURN / 60}, false},
    {"N", {DIM(1, 1, -2), 0, 1}, true},        {"Nm", {DIM(2, 1, -2), 0, 1}, false},
    {"Pa", {DIM(-1, 1, -2), 0, 1}, true},      {"bar", {DIM(-1, 1, -2), 5, 1}, true},
    {"J", {DIM(2, 1, -2), 0, 1}, true},        {"W", {DIM(2, 1, -3), 0, 1}, true},
    {"L", {DIM(3, 0, 0), -3, 1}, true},        {"l", {DIM(3, 0, 0), -3, 1}, true},
    {"%", {DIM(0, 0, 0), -2, 1}, false},       {"pi", {DIM(0, 0, 0), 0, PI}, false},
};

static const struct {
    char letter;
    int decimal;
} PREFIXES[] = {{'p', -12}, {'n', -9}, {'u', -6}, {'m', -3}, {'c', -2}, {'d', -1},
                {'h', 2},   {'k', 3},  {'M', 6},  {'G', 9},  {'T', 12}};

enum {
    UNIT_COUNT = sizeof UNITS / sizeof *UNITS,
    PREFIX_COUNT = sizeof PREFIXES / sizeof *PREFIXES
};

static const struct {
    const char *name, *si;
    unit_dimension dimension;
} KINDS[UNIT_KINDS] = {
    [UNIT_NUMBER] = {"number", "", DIM(0, 0, 0)},
    [UNIT_ANGLE] = {"angle", "rad", DIM(0, 0, 0)},
    [UNIT_LENGTH] = {"length", "m", DIM(1, 0, 0)},
    [UNIT_MASS] = {"mass", "kg", DIM(0, 1, 0)},
    [UNIT_TIME] = {"time", "s", DIM(0, 0, 1)},
    [UNIT_SPEED] = {"velocity", "m/s", DIM(1, 0, -1)},
    [UNIT_ACCELERATION] = {"acceleration", "m/s2", DIM(1, 0, -2)},
    [UNIT_RATE] = {"rate", "/s", DIM(0, 0, -1)},
    [UNIT_SPIN] = {"spin", "rad/s", DIM(0, 0, -1)},
    [UNIT_FORCE] = {"force", "N", DIM(1, 1, -2)},
    [UNIT_PRESSURE] = {"pressure", "Pa", DIM(-1, 1, -2)},
    [UNIT_DENSITY] = {"density", "kg/m3", DIM(-3, 1, 0)},
    [UNIT_AREA] = {"area", "m2", DIM(2, 0, 0)},
    [UNIT_INERTIA] = {"moment of inertia", "kg m2", DIM(2, 1, 0)},
    [UNIT_STIFFNESS] = {"stiffness", "N/m", DIM(0, 1, -2)},
    [UNIT_MASS_RATE] = {"mass per time", "kg/s", DIM(0, 1, -1)},
};

const char *unit_kind_name(unit_kind kind) {
    SCENE_ASSERT(kind < UNIT_KINDS);
    return KINDS[kind].name;
}

const char *unit_kind_si(unit_kind kind) {
    SCENE_ASSERT(kind < UNIT_KINDS);
    return KINDS[kind].si;
}

unit_dimension unit_kind_dimension(unit_kind kind) {
    SCENE_ASSERT(kind < UNIT_KINDS);
    return KINDS[kind].dimension;
}

bool unit_same(unit_dimension a, unit_dimension b) {
    return a.metre == b.metre && a.kilogram == b.kilogram && a.second == b.second;
}

static void power(char *text, const char *symbol, int exponent) {
    if (exponent == 0) return;
    size_t length = strlen(text);
    const char *space = length ? " " : "";
    if (exponent == 1)
        snprintf(text + length, UNIT_TEXT - length, "%s%s", space, symbol);
    else
        snprintf(text + length, UNIT_TEXT - length, "%s%s^%d", space, symbol, exponent);
}

void unit_describe(unit_dimension dimension, char text[UNIT_TEXT]) {
    text[0] = '\0';
    for (int kind = 0; kind < UNIT_KINDS && !text[0]; kind++)
        if (unit_same(dimension, KINDS[kind].dimension))
            snprintf(text, UNIT_TEXT, "%s", KINDS[kind].name);
    if (text[0]) return;
    power(text, "m", dimension.metre);
    power(text, "kg", dimension.kilogram);
    power(text, "s", dimension.second);
}

static const row *find_row(const char *symbol) {
    for (int i = 0; i < UNIT_COUNT; i++)
        if (!strcmp(UNITS[i].symbol, symbol)) return &UNITS[i];
    return NULL;
}

bool unit_find(const char *symbol, unit_symbol *unit) {
    SCENE_ASSERT(symbol && unit);
    const row *found = find_row(symbol); /* min is a minute before it is a milli-inch */
    if (found) {
        *unit = found->unit;
        return true;
    }
    if (!symbol[0]) return false;
    found = find_row(symbol + 1);
    if (!found || !found->prefix) return false;
    for (int i = 0; i < PREFIX_COUNT; i++) {
        if (PREFIXES[i].letter != symbol[0]) continue;
        *unit = found->unit;
        unit->decimal += PREFIXES[i].decimal;
        return true;
    }
    return false;
}

const char *unit_suggest(const char *symbol, char text[UNIT_TEXT]) {
    SCENE_ASSERT(symbol && text);
    static const char *const USUAL[] = {"mm",  "cm",  "m",   "um",  "km",  "s",  "ms", "us",
                                        "min", "h",   "kg",  "g",   "mg",  "t",  "Pa", "kPa",
                                        "MPa", "GPa", "N",   "kN",  "mN",  "J",  "mJ", "W",
                                        "kW",  "Hz",  "rad", "deg", "rpm", "in", "ft", "nm"};
    const char *best = scene_suggest(symbol, USUAL, (int)(sizeof USUAL / sizeof *USUAL));
    if (best) snprintf(text, UNIT_TEXT, "%s", best);
    return best ? text : NULL;
}

const char *unit_listed(int index, bool *takes_prefix) {
    SCENE_ASSERT(index >= 0 && takes_prefix);
    if (index >= UNIT_COUNT) return NULL;
    *takes_prefix = UNITS[index].prefix;
    return UNITS[index].symbol;
}
