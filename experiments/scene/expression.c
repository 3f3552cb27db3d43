/* expression.c - the recursive-descent parser behind unit_parse(); its grammar stands in unit.h. */
#include "experiments/scene/unit.h"
#include "engine/clast.h"
#include "experiments/scene/arena.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    LENGTH_MAX = 1000, /* bytes of one value */
    NUMBER_MAX = 100,  /* characters of one number */
    WORD_MAX = 40,     /* of a unit, parameter or function */
    DEPTH_MAX = 50,    /* of brackets and signs: the parser must not run out of stack */
    POWER_MAX = 9
};

typedef struct parser {
    const char *at; /* the rest of the text */
    const unit_scope *scope;
    char *why; /* filled by the first complaint */
    bool failed;
    int depth;
} parser;

/* A factor, and whether units stand behind it: 1/4 m is refused, 1/(4 m) is not. */
typedef struct factor {
    unit_value value;
    bool has_units;
} factor;

static const unit_value NOTHING = {.value = 0, .bare = true};

__attribute__((format(printf, 2, 3))) static void complain(parser *p, const char *format, ...) {
    if (!p->failed) {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(p->why, UNIT_TEXT, format, arguments);
        va_end(arguments);
    }
    p->failed = true;
    p->at = ""; /* nothing more is read: every loop ends */
}

static bool is_digit(char c) {
    return c >= '0' && c <= '9'; /* isdigit() asks the locale */
}

static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

static const char *skip_spaces(const char *at) {
    while (*at == ' ' || *at == '\t' || *at == '\n') at++;
    return at;
}

static bool take(parser *p, char c) {
    const char *at = skip_spaces(p->at);
    if (*at != c) return false;
    p->at = at + 1;
    return true;
}

/* Reads letters, and digits and _ too where `name` is set. */
static const char *read_word(const char *at, bool name, char word[WORD_MAX + 1]) {
    int length = 0;
    if (*at == '%' && !name)
        word[length++] = *at++;
    else
        while (is_letter(*at) || (name && (is_digit(*at) || *at == '_'))) {
            if (length < WORD_MAX) word[length++] = *at;
            at++;
        }
    word[length] = '\0';
    return at;
}

/* ---- units ---------------------------------------------------------------------------------- */

typedef struct chain {
    unit_dimension dimension;
    int decimal;        /* power of ten */
    double over, under; /* product of the factors that are not decimal, above and below the line */
    int count;
    bool divided; /* a / has been read outside brackets */
} chain;

/* The unit word that starts here, or "" when a function, a parameter or no word does. */
static const char *peek_unit(const char *at, char word[WORD_MAX + 1]) {
    const char *end = read_word(at, false, word);
    if (*skip_spaces(end) == '(') word[0] = '\0';
    return end;
}

static int read_power(parser *p) {
    bool caret = *p->at == '^';
    if (caret) p->at++;
    bool minus = caret && *p->at == '-';
    if (minus) p->at++;
    if (!is_digit(*p->at)) {
        if (caret) complain(p, "no whole number after ^");
        return 1;
    }
    int exponent = 0;
    while (is_digit(*p->at) && exponent <= POWER_MAX) exponent = 10 * exponent + (*p->at++ - '0');
    if (exponent > POWER_MAX) complain(p, "a power above %d", POWER_MAX);
    if (*p->at == '.') complain(p, "a power that is no whole number");
    return minus ? -exponent : exponent;
}

static void multiply_units(chain *c, const unit_symbol *unit, int exponent) {
    c->dimension.metre += exponent * unit->dimension.metre;
    c->dimension.kilogram += exponent * unit->dimension.kilogram;
    c->dimension.second += exponent * unit->dimension.second;
    c->decimal += exponent * unit->decimal;
    for (int i = 0; i < abs(exponent); i++) {
        if (exponent > 0)
            c->over *= unit->factor;
        else
            c->under *= unit->factor;
    }
    c->count++;
}

static void explain_unknown(parser *p, const char *word) {
    char near[UNIT_TEXT];
    if (p->scope && p->scope->knows && p->scope->knows(p->scope->context, word))
        complain(p, "unknown unit '%s'; the parameter is written $%s", word, word);
    else if (unit_suggest(word, near))
        complain(p, "unknown unit '%s', did you mean '%s'?", word, near);
    else
        complain(p, "unknown unit '%s'", word);
}

static void read_unit(parser *p, chain *c, const char *start, bool below) {
    char word[WORD_MAX + 1];
    p->at = peek_unit(start, word);
    unit_symbol unit;
    if (!unit_find(word, &unit)) {
        explain_unknown(p, word);
        return;
    }
    int exponent = read_power(p);
    if (!p->failed) multiply_units(c, &unit, below ? -exponent : exponent);
    if (c->count > 20) complain(p, "too many units");
}

/* The (m s) of kg/(m s). False, and nothing read, when the bracket holds something else. */
static bool read_unit_group(parser *p, chain *c, const char *bracket) {
    char word[WORD_MAX + 1];
    unit_symbol unit;
    const char *at = skip_spaces(bracket + 1);
    peek_unit(at, word);
    if (!word[0] || !strcmp(word, "pi") || !unit_find(word, &unit)) return false;
    while (word[0] && !p->failed) {
        read_unit(p, c, at, true);
        at = skip_spaces(p->at);
        if (*at == '*') at = skip_spaces(at + 1);
        peek_unit(at, word);
    }
    if (!p->failed && !take(p, ')')) complain(p, "no ) after the units");
    return true;
}

/* One more unit of the chain; false when none follows. */
static bool continue_chain(parser *p, chain *c) {
    char word[WORD_MAX + 1];
    const char *at = skip_spaces(p->at);
    bool divide = *at == '/', times = *at == '*';
    const char *start = divide || times ? skip_spaces(at + 1) : at;
    if (times && c->count == 0) return false; /* 2 * m is no unit of 2 */
    if (divide && *start == '(') {
        c->divided = true;
        if (read_unit_group(p, c, start)) return true;
        c->divided = false;
        return false;
    }
    peek_unit(start, word);
    if (!word[0]) return false;
    if (c->divided && !divide) {
        complain(p, "'/... %s' can be read in two ways: put the units below the line in brackets",
                 word);
        return false;
    }
    c->divided = c->divided || divide;
    read_unit(p, c, start, divide);
    return !p->failed;
}

static chain read_units(parser *p) {
    chain c = {.over = 1, .under = 1};
    while (!p->failed && continue_chain(p, &c)) {
    }
    return c;
}

static double times_power_of_ten(double value, int decimal) {
    for (; decimal > 0; decimal--) value *= 10;
    double divisor = 1; /* exact up to 10^22, so one rounding in all */
    for (; decimal < 0; decimal++) divisor *= 10;
    return value / divisor;
}

static unit_value with_units(unit_value value, const chain *c) {
    if (c->count == 0) return value;
    value.dimension.metre += c->dimension.metre;
    value.dimension.kilogram += c->dimension.kilogram;
    value.dimension.second += c->dimension.second;
    value.value = times_power_of_ten(value.value, c->decimal) * c->over / c->under;
    value.bare = false;
    return value;
}

/* ---- atoms ---------------------------------------------------------------------------------- */

static unit_value read_sum(parser *p);

static const char *end_of_digits(const char *at) {
    while (is_digit(*at)) at++;
    return at;
}

/* "25 1/s" is 25 /s to everybody. */
static void skip_one(parser *p) {
    const char *one = skip_spaces(p->at);
    if (*one != '1' || one == p->at) return;
    const char *slash = skip_spaces(one + 1);
    if (*slash == '/' && is_letter(*skip_spaces(slash + 1))) p->at = one + 1;
}

/* The decimal exponent of the units joins that of the number: 6.9 mm is read as 6.9e-3. */
static unit_value read_number(parser *p, bool *has_units) {
    const char *start = p->at, *end = end_of_digits(start);
    if (*end == '.') end = end_of_digits(end + 1);
    const char *mantissa_end = end;
    long exponent = 0;
    const char *sign = *end == 'e' || *end == 'E' ? end + 1 : NULL;
    if (sign && is_digit(sign[*sign == '-' || *sign == '+'])) {
        exponent = strtol(sign, NULL, 10);
        end = end_of_digits(sign + 1);
    }
    if (mantissa_end - start > NUMBER_MAX || labs(exponent) > 400 ||
        (mantissa_end - start == 1 && *start == '.')) {
        complain(p, "a number that is too long or has no digits");
        return NOTHING;
    }
    p->at = end;
    skip_one(p);
    chain c = read_units(p);
    char text[NUMBER_MAX + 20];
    snprintf(text, sizeof text, "%.*se%ld", (int)(mantissa_end - start), start,
             exponent + c.decimal);
    unit_value value = {.value = strtod(text, NULL), .bare = true};
    c.decimal = 0;
    *has_units = c.count > 0;
    return with_units(value, &c);
}

static unit_value read_parameter(parser *p) {
    char name[WORD_MAX + 1];
    unit_value value = NOTHING;
    bool braces = *p->at == '{';
    p->at = read_word(p->at + braces, true, name);
    if (!name[0] || (braces && *p->at != '}')) {
        complain(p, "$ without the name of a parameter");
        return value;
    }
    p->at += braces;
    char why[UNIT_TEXT] = "";
    if (!p->scope || !p->scope->find)
        complain(p, "$%s where no parameter is known", name);
    else if (!p->scope->find(p->scope->context, name, &value, why))
        complain(p, "%s", why);
    return value;
}

static unit_value square_root(parser *p, unit_value x) {
    unit_dimension *d = &x.dimension;
    if (d->metre % 2 || d->kilogram % 2 || d->second % 2)
        complain(p, "sqrt of something that is no square");
    else if (x.value < 0)
        complain(p, "sqrt of a negative number");
    else
        x.value = sqrt(x.value);
    *d = (unit_dimension){d->metre / 2, d->kilogram / 2, d->second / 2};
    return x;
}

static unit_value trigonometry(parser *p, const char *name, unit_value x) {
    double sine = 0, cosine = 1;
    if (!unit_same(x.dimension, NOTHING.dimension))
        complain(p, "%s of something that is no angle", name);
    else if (!(fabs(x.value) <= 1e5)) /* what clast_sincos promises */
        complain(p, "%s of more than 1e5 rad", name);
    else
        clast_sincos(x.value, &sine, &cosine);
    x.value = !strcmp(name, "sin") ? sine : !strcmp(name, "cos") ? cosine : sine / cosine;
    return x;
}

static unit_value extremum(parser *p, const char *name, unit_value a, unit_value b) {
    if (!unit_same(a.dimension, b.dimension)) complain(p, "%s of different things", name);
    bool first = !strcmp(name, "min") ? a.value <= b.value : a.value >= b.value;
    unit_value result = first ? a : b;
    result.bare = a.bare && b.bare;
    return result;
}

static unit_value read_function(parser *p, const char *name) {
    unit_value x = read_sum(p), result = x;
    if (!strcmp(name, "sqrt")) {
        result = square_root(p, x);
    } else if (!strcmp(name, "abs")) {
        result.value = fabs(x.value);
    } else if (!strcmp(name, "sin") || !strcmp(name, "cos") || !strcmp(name, "tan")) {
        result = trigonometry(p, name, x);
    } else if (!strcmp(name, "min") || !strcmp(name, "max")) {
        if (!p->failed && !take(p, ',')) complain(p, "no second value of %s", name);
        result = p->failed ? x : extremum(p, name, x, read_sum(p));
    } else {
        complain(p, "unknown function '%s', expected sqrt, abs, min, max, sin, cos or tan", name);
    }
    if (!p->failed && !take(p, ')')) complain(p, "no ) after %s(", name);
    return result;
}

static unit_value read_word_atom(parser *p) {
    char word[WORD_MAX + 1];
    const char *end = read_word(p->at, false, word);
    if (*skip_spaces(end) == '(') {
        p->at = skip_spaces(end) + 1;
        return read_function(p, word);
    }
    unit_symbol unit;
    if (!strcmp(word, "pi")) {
        p->at = end;
        unit_find(word, &unit);
        return (unit_value){.value = unit.factor, .bare = true};
    }
    if (unit_find(word, &unit))
        complain(p, "no number before the unit '%s'", word);
    else if (p->scope && p->scope->knows && p->scope->knows(p->scope->context, word))
        complain(p, "the parameter is written $%s", word);
    else
        complain(p, "'%s' is no number", word);
    return NOTHING;
}

static unit_value read_atom(parser *p, bool *has_units) {
    p->at = skip_spaces(p->at);
    char c = *p->at;
    if (is_digit(c) || c == '.') return read_number(p, has_units);
    if (is_letter(c) || c == '%') return read_word_atom(p);
    if (c == '$') {
        p->at++;
        return read_parameter(p);
    }
    if (take(p, '(')) {
        unit_value inner = read_sum(p);
        if (!p->failed && !take(p, ')')) complain(p, "( without )");
        return inner;
    }
    if (c == '\0')
        complain(p, "no number where one should be");
    else
        complain(p,
                 c > ' ' && c < 127 ? "'%c' where a number should be"
                                    : "byte %d where a number should be",
                 c > ' ' && c < 127 ? c : (unsigned char)c);
    return NOTHING;
}

/* ---- operators ------------------------------------------------------------------------------ */

static unit_value raise(unit_value base, int exponent) {
    double result = 1;
    for (int i = 0; i < abs(exponent); i++) result *= base.value;
    base.value = exponent < 0 ? 1 / result : result;
    base.dimension.metre *= exponent;
    base.dimension.kilogram *= exponent;
    base.dimension.second *= exponent;
    return base;
}

static factor read_factor(parser *p) {
    factor f = {.value = NOTHING};
    if (++p->depth > DEPTH_MAX) complain(p, "brackets or signs nested too deeply");
    if (p->failed) return f;
    if (take(p, '-')) {
        f = read_factor(p);
        f.value.value = -f.value.value;
    } else if (take(p, '+')) {
        f = read_factor(p);
    } else {
        f.value = read_atom(p, &f.has_units);
        p->at = skip_spaces(p->at);
        if (*p->at == '^') f.value = raise(f.value, read_power(p));
        if (!f.has_units) {
            chain c = read_units(p);
            f.has_units = c.count > 0;
            f.value = with_units(f.value, &c);
        }
    }
    p->depth--;
    return f;
}

static unit_value combine(unit_value a, unit_value b, int sign) {
    a.value = sign > 0 ? a.value * b.value : a.value / b.value;
    a.dimension.metre += sign * b.dimension.metre;
    a.dimension.kilogram += sign * b.dimension.kilogram;
    a.dimension.second += sign * b.dimension.second;
    a.bare = a.bare && b.bare;
    return a;
}

static bool too_large(unit_dimension d) {
    return abs(d.metre) > 100 || abs(d.kilogram) > 100 || abs(d.second) > 100;
}

static unit_value read_product(parser *p) {
    unit_value product = read_factor(p).value;
    while (!p->failed) {
        bool times = take(p, '*');
        if (!times && !take(p, '/')) break;
        factor next = read_factor(p);
        if (!times && next.has_units)
            complain(p, "a division by a value with a unit can be read in two ways: "
                        "write a/(4 m) or (a/4) m");
        product = combine(product, next.value, times ? 1 : -1);
        if (too_large(product.dimension)) complain(p, "too high a power of a unit");
    }
    return product;
}

static unit_value read_sum(parser *p) {
    unit_value sum = read_product(p);
    while (!p->failed) {
        bool plus = take(p, '+');
        if (!plus && !take(p, '-')) break;
        unit_value next = read_product(p);
        if (!p->failed && !unit_same(sum.dimension, next.dimension)) {
            char left[UNIT_TEXT], right[UNIT_TEXT];
            unit_describe(sum.dimension, left);
            unit_describe(next.dimension, right);
            complain(p, "a sum of %.60s and %.60s", left, right);
        }
        sum.value = plus ? sum.value + next.value : sum.value - next.value;
        sum.bare = sum.bare && next.bare;
    }
    return sum;
}

/* ---- the whole text ------------------------------------------------------------------------- */

/* What people copy from papers, in the letters that the parser knows. */
static const struct {
    const char *from, *to;
} SIGNS[] = {{"\u00b5", "u"}, {"\u03bc", "u"},    {"\u00b2", "^2"}, {"\u00b3", "^3"},
             {"\u00b7", " "}, {"\u00b0", " deg"}, {"\u00d7", "*"},  {"\u2212", "-"}};

static bool simplify(const char *text, char plain[LENGTH_MAX + 8]) {
    size_t length = 0;
    while (*text) {
        if (length >= LENGTH_MAX) return false;
        size_t sign = 0, count = sizeof SIGNS / sizeof *SIGNS;
        while (sign < count && strncmp(text, SIGNS[sign].from, strlen(SIGNS[sign].from))) sign++;
        if (sign < count) {
            length += (size_t)sprintf(plain + length, "%s", SIGNS[sign].to);
            text += strlen(SIGNS[sign].from);
        } else {
            plain[length++] = *text++;
        }
    }
    plain[length] = '\0';
    return true;
}

bool unit_parse(const char *text, const unit_scope *scope, unit_value *value, char why[UNIT_TEXT]) {
    SCENE_ASSERT(text && value && why);
    char plain[LENGTH_MAX + 8];
    why[0] = '\0';
    if (!simplify(text, plain)) {
        snprintf(why, UNIT_TEXT, "found more than %d characters", LENGTH_MAX);
        return false;
    }
    parser p = {.at = plain, .scope = scope, .why = why};
    *value = read_sum(&p);
    p.at = skip_spaces(p.at);
    if (!p.failed && *p.at) complain(&p, "'%.30s' where the value should have ended", p.at);
    if (!p.failed && !isfinite(value->value)) complain(&p, "the value is not finite");
    return !p.failed;
}
