/* unit_test.c - values with units against their SI numbers, to the last bit; what is refused. */
#include "tests/scene/testing.h"

#include "experiments/scene/unit.h"

static bool find(void *context, const char *name, unit_value *value, char why[UNIT_TEXT]) {
    (void)context;
    *value = (unit_value){.value = 0.15, .dimension = {1, 0, 0}};
    if (!strcmp(name, "width")) return true;
    *value = (unit_value){.value = 0.37, .bare = true};
    if (!strcmp(name, "mu_2")) return true;
    snprintf(why, UNIT_TEXT, "unknown parameter '%s'", name);
    return false;
}

static bool knows(void *context, const char *name) {
    (void)context;
    return !strcmp(name, "width") || !strcmp(name, "mu_2");
}

static const unit_scope SCOPE = {.find = find, .knows = knows};

typedef struct good_row {
    const char *text;
    double value;
    int metre, kilogram, second;
} good_row;

static const double PI = 3.141592653589793;

static void check_good(const good_row *rows, size_t count) {
    for (size_t i = 0; i < count; i++) {
        unit_value v;
        char why[UNIT_TEXT];
        if (!unit_parse(rows[i].text, &SCOPE, &v, why)) fail_msg("%s: %s", rows[i].text, why);
        bool same = unit_same(v.dimension,
                              (unit_dimension){rows[i].metre, rows[i].kilogram, rows[i].second});
        if (v.value != rows[i].value || !same)
            fail_msg("%s: got %.17g m^%d kg^%d s^%d, expected %.17g", rows[i].text, v.value,
                     v.dimension.metre, v.dimension.kilogram, v.dimension.second, rows[i].value);
    }
}
#define CHECK_GOOD(rows) check_good(rows, sizeof(rows) / sizeof *(rows))

/* The numbers are such that scaling the rounded decimal would often miss the last bit. */
static void every_unit_has_its_si_value(void **state) {
    (void)state;
    static const good_row ROWS[] = {
        {"6.9 m", 6.9, 1, 0, 0},         {"6.9 dm", 0.69, 1, 0, 0},
        {"6.9 cm", 0.069, 1, 0, 0},      {"6.9 mm", 0.0069, 1, 0, 0},
        {"6.9 um", 6.9e-6, 1, 0, 0},     {"6.9 nm", 6.9e-9, 1, 0, 0},
        {"6.9 pm", 6.9e-12, 1, 0, 0},    {"6.9 km", 6900, 1, 0, 0},
        {"10 in", 0.254, 1, 0, 0},       {"10 ft", 3.048, 1, 0, 0},
        {"0.332 g", 0.000332, 0, 1, 0},  {"0.332 kg", 0.332, 0, 1, 0},
        {"0.332 mg", 3.32e-7, 0, 1, 0},  {"0.332 t", 332, 0, 1, 0},
        {"0.332 ug", 3.32e-10, 0, 1, 0}, {"1 lb", 0.45359237, 0, 1, 0},
        {"4.7 s", 4.7, 0, 0, 1},         {"4.7 ms", 0.0047, 0, 0, 1},
        {"4.7 us", 4.7e-6, 0, 0, 1},     {"4.7 ns", 4.7e-9, 0, 0, 1},
        {"3 min", 180, 0, 0, 1},         {"3 h", 10800, 0, 0, 1},
        {"2 d", 172800, 0, 0, 1},        {"13 Hz", 13, 0, 0, -1},
        {"1.3 kHz", 1300, 0, 0, -1},     {"1.3 MHz", 1.3e6, 0, 0, -1},
        {"0.7 rad", 0.7, 0, 0, 0},       {"0.7 mrad", 0.0007, 0, 0, 0},
        {"180 deg", PI, 0, 0, 0},        {"90 \u00b0", PI / 2, 0, 0, 0},
        {"60 rpm", 2 * PI, 0, 0, -1},    {"7 N", 7, 1, 1, -2},
        {"7.3 kN", 7300, 1, 1, -2},      {"7.3 mN", 0.0073, 1, 1, -2},
        {"7.3 uN", 7.3e-6, 1, 1, -2},    {"7.3 MN", 7.3e6, 1, 1, -2},
        {"1.7 Nm", 1.7, 2, 1, -2},       {"1.7 N m", 1.7, 2, 1, -2},
        {"3.3 Pa", 3.3, -1, 1, -2},      {"3.3 kPa", 3300, -1, 1, -2},
        {"3.3 MPa", 3.3e6, -1, 1, -2},   {"3.3 GPa", 3.3e9, -1, 1, -2},
        {"3.3 hPa", 330, -1, 1, -2},     {"1.1 bar", 110000, -1, 1, -2},
        {"1.1 mbar", 110, -1, 1, -2},    {"2.3 J", 2.3, 2, 1, -2},
        {"2.3 mJ", 0.0023, 2, 1, -2},    {"2.3 uJ", 2.3e-6, 2, 1, -2},
        {"2.3 W", 2.3, 2, 1, -3},        {"2.3 kW", 2300, 2, 1, -3},
        {"2.3 L", 0.0023, 3, 0, 0},      {"2.3 ml", 2.3e-6, 3, 0, 0},
        {"37 %", 0.37, 0, 0, 0},         {"2 pi", 2 * PI, 0, 0, 0},
    };
    CHECK_GOOD(ROWS);
}

static void units_combine(void **state) {
    (void)state;
    static const good_row ROWS[] = {
        {"-9.81 m/s2", -9.81, 1, 0, -2},
        {"9.81 m / s^2", 9.81, 1, 0, -2},
        {"9.81 m s^-2", 9.81, 1, 0, -2},
        {"1.256 g/cm3", 1256, -3, 1, 0},
        {"1.149 cm2", 1.149e-4, 2, 0, 0},
        {"1.149 cm\u00b2", 1.149e-4, 2, 0, 0},
        {"20 kg/h", 20.0 / 3600, 0, 1, -1},
        {"20 kg/min", 20.0 / 60, 0, 1, -1},
        {"90 km/h", 90000.0 / 3600, 1, 0, -1},
        {"1.7e-9 kg m2", 1.7e-9, 2, 1, 0},
        {"1.7 g*mm2", 1.7e-9, 2, 1, 0},
        {"3 kg\u00b7m\u00b2", 3, 2, 1, 0},
        {"25 /s", 25, 0, 0, -1},
        {"25/s", 25, 0, 0, -1},
        {"25 1/s", 25, 0, 0, -1},
        {"1/s", 1, 0, 0, -1},
        {"11.5 kN/m", 11500, 0, 1, -2},
        {"2 kg/(m s)", 2, -1, 1, -1},
        {"2 kg/m/s", 2, -1, 1, -1},
        {"3 \u00b5m", 3e-6, 1, 0, 0},
        {"\u2212"
         "3 \u03bcm",
         -3e-6, 1, 0, 0},
        {"1e3 mm", 1, 1, 0, 0},
        {"1.5E-2cm", 1.5e-4, 1, 0, 0},
        {"5cm", 0.05, 1, 0, 0},
    };
    CHECK_GOOD(ROWS);
}

static void expressions_are_worked_out(void **state) {
    (void)state;
    static const good_row ROWS[] = {
        {"1 + 2*3", 7, 0, 0, 0},
        {"(1 + 2)*3", 9, 0, 0, 0},
        {"2^3 mm", 0.008, 1, 0, 0},
        {"-2^2", -4, 0, 0, 0},
        {"2^-1", 0.5, 0, 0, 0},
        {"7 - 2 - 1", 4, 0, 0, 0},
        {"8/2/2", 2, 0, 0, 0},
        {"--3", 3, 0, 0, 0},
        {"+.5", 0.5, 0, 0, 0},
        {"5.", 5, 0, 0, 0},
        {"10 mm + 2 cm", 0.01 + 0.02, 1, 0, 0},
        {"10 cm/4", 0.1 / 4, 1, 0, 0},
        {"(15 cm - 10 cm)/4", (0.15 - 0.1) / 4, 1, 0, 0},
        {"(1 + 1) cm", 0.02, 1, 0, 0},
        {"$width/2", 0.075, 1, 0, 0},
        {"${width}/2", 0.075, 1, 0, 0},
        {"$width-1cm", 0.15 - 0.01, 1, 0, 0},
        {"$mu_2 mm", 0.37 / 1000, 1, 0, 0},
        {"2*$mu_2", 0.74, 0, 0, 0},
        {"$width*$width", 0.15 * 0.15, 2, 0, 0},
        {"$width^2", 0.15 * 0.15, 2, 0, 0},
        {"10 cm/(4 mm)", 0.1 / 0.004, 0, 0, 0},
        {"3 m * 2 m", 6, 2, 0, 0},
        {"sqrt(9 m2)", 3, 1, 0, 0},
        {"sqrt(2)", 1.4142135623730951, 0, 0, 0},
        {"abs(-3 s)", 3, 0, 0, 1},
        {"min(2 cm, 1 m)", 0.02, 1, 0, 0},
        {"max(2 cm, 1 m)", 1, 1, 0, 0},
        {"3 m/max(1, 2)", 1.5, 1, 0, 0},
        {"sin(0)", 0, 0, 0, 0},
        {"cos(0 deg)", 1, 0, 0, 0},
        {"pi/2", PI / 2, 0, 0, 0},
    };
    CHECK_GOOD(ROWS);
    unit_value v;
    char why[UNIT_TEXT];
    assert_true(unit_parse("sin(30 deg) + tan(45 deg)", NULL, &v, why));
    assert_true(fabs(v.value - 1.5) < 1e-15);
}

static void a_bare_number_is_told_from_one_with_a_unit(void **state) {
    (void)state;
    static const struct {
        const char *text;
        bool bare;
    } ROWS[] = {{"3", true},
                {"2*3 + 1", true},
                {"3 mm", false},
                {"30 deg", false},
                {"10 cm/(4 mm)", false},
                {"$mu_2*2", true},
                {"5 %", false},
                {"pi", true}};
    for (size_t i = 0; i < sizeof ROWS / sizeof *ROWS; i++) {
        unit_value v;
        char why[UNIT_TEXT];
        assert_true(unit_parse(ROWS[i].text, &SCOPE, &v, why));
        if (v.bare != ROWS[i].bare) fail_msg("%s", ROWS[i].text);
    }
}

static void what_makes_no_sense_is_refused(void **state) {
    (void)state;
    static const struct {
        const char *text, *why;
    } ROWS[] = {
        {"", "no number where one should be"},
        {"mm", "no number before the unit 'mm'"},
        {"soft", "'soft' is no number"},
        {"width", "the parameter is written $width"},
        {"3 cmm", "unknown unit 'cmm', did you mean 'mm'?"},
        {"3 Kpa", "unknown unit 'Kpa', did you mean 'kPa'?"},
        {"3 width", "unknown unit 'width'; the parameter is written $width"},
        {"3 mm + 2 s", "a sum of length and time"},
        {"3 mm + 2", "a sum of length and number"},
        {"3 mm - 2 mm2", "a sum of length and area"},
        {"1/4 m", "a division by a value with a unit can be read in two ways: "
                  "write a/(4 m) or (a/4) m"},
        {"2 kg/m s", "'/... s' can be read in two ways: put the units below the line in brackets"},
        {"2 3", "'3' where the value should have ended"},
        {"2 1/4", "'1/4' where the value should have ended"},
        {"3 mm)", "')' where the value should have ended"},
        {"(3 mm", "( without )"},
        {"3 +", "no number where one should be"},
        {"3 * / 2", "'/' where a number should be"},
        {"$", "$ without the name of a parameter"},
        {"${width", "$ without the name of a parameter"},
        {"$height", "unknown parameter 'height'"},
        {"1/0", "the value is not finite"},
        {"9e307*100", "the value is not finite"},
        {"1e999", "a number that is too long or has no digits"},
        {".", "a number that is too long or has no digits"},
        {"2^1.5", "a power that is no whole number"},
        {"2^x", "no whole number after ^"},
        {"2 m^12", "a power above 9"},
        {"sqrt(2 m)", "sqrt of something that is no square"},
        {"sqrt(-2)", "sqrt of a negative number"},
        {"sin(2 m)", "sin of something that is no angle"},
        {"cos(1e6)", "cos of more than 1e5 rad"},
        {"min(1 m, 1 s)", "min of different things"},
        {"min(1 m)", "no second value of min"},
        {"exp(1)", "unknown function 'exp', expected sqrt, abs, min, max, sin, cos or tan"},
        {"0x10", "unknown unit 'x'"},
        {"1,5 m", "',5 m' where the value should have ended"},
        {"nan", "'nan' is no number"},
        {"inf", "'inf' is no number"},
        {"\xff", "byte 255 where a number should be"},
    };
    for (size_t i = 0; i < sizeof ROWS / sizeof *ROWS; i++) {
        unit_value v;
        char why[UNIT_TEXT];
        if (unit_parse(ROWS[i].text, &SCOPE, &v, why)) fail_msg("%s: was accepted", ROWS[i].text);
        if (strcmp(why, ROWS[i].why))
            fail_msg("%s: '%s', not '%s'", ROWS[i].text, why, ROWS[i].why);
    }
}

static void depth_and_length_are_bounded(void **state) {
    (void)state;
    static char text[200000];
    unit_value v;
    char why[UNIT_TEXT];
    for (int c = 0; c < 3; c++) {
        memset(text, "(-$"[c], sizeof text - 1);
        assert_false(unit_parse(text, &SCOPE, &v, why));
        text[900] = '\0';
        assert_false(unit_parse(text, &SCOPE, &v, why));
        text[900] = 'x';
    }
    memset(text, '9', 600);
    text[600] = '\0';
    assert_false(unit_parse(text, &SCOPE, &v, why));
}

static void dimensions_have_names(void **state) {
    (void)state;
    char text[UNIT_TEXT];
    unit_describe((unit_dimension){-1, 1, -2}, text);
    assert_string_equal(text, "pressure");
    unit_describe((unit_dimension){1, 1, -3}, text);
    assert_string_equal(text, "m kg s^-3");
}

/* Random strings of the parser's own alphabet: they end, with a value or a reason, never both. */
static void nonsense_ends_in_a_value_or_a_reason(void **state) {
    (void)state;
    static const char ALPHABET[] = "0123456789.eE+-*/^()$ mskgNPau%,{}minpirpdegsqrt\xc2\xb5";
    uint64_t seed = 20170823, x = seed;
    print_message("seed %llu\n", (unsigned long long)seed);
    int accepted = 0;
    for (int n = 0; n < 200000; n++) {
        char text[40], why[UNIT_TEXT];
        x = x * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        int length = (int)(x >> 60);
        for (int i = 0; i < length; i++) {
            x = x * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
            text[i] = ALPHABET[(x >> 33) % (sizeof ALPHABET - 1)];
        }
        text[length] = '\0';
        unit_value v;
        bool good = unit_parse(text, &SCOPE, &v, why);
        if (good != (why[0] == '\0')) fail_msg("'%s': %d '%s'", text, good, why);
        if (good && !isfinite(v.value)) fail_msg("'%s'", text);
        accepted += good;
    }
    assert_true(accepted > 1000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_unit_has_its_si_value),
        cmocka_unit_test(units_combine),
        cmocka_unit_test(expressions_are_worked_out),
        cmocka_unit_test(a_bare_number_is_told_from_one_with_a_unit),
        cmocka_unit_test(what_makes_no_sense_is_refused),
        cmocka_unit_test(depth_and_length_are_bounded),
        cmocka_unit_test(dimensions_have_names),
        cmocka_unit_test(nonsense_ends_in_a_value_or_a_reason),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
