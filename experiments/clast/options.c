#include "experiments/clast/options.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"

bool options_ask_help(int argc, char **argv) {
    for (int i = 1; i < argc; i++)
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) return true;
    return false;
}

static const option *find(const option *options, int count, const char *name, size_t length) {
    for (int i = 0; i < count; i++)
        if (strlen(options[i].name) == length && strncmp(options[i].name, name, length) == 0)
            return &options[i];
    return NULL;
}

static bool refuse(const char *command, const option *o, const char *value, const char *expected) {
    fprintf(stderr, "clast %s: %s %s: expected %s\n", command, o->name, value, expected);
    return false;
}

static bool store_number(const char *command, const option *o, const char *value) {
    char *end;
    double number = strtod(value, &end);
    if (end == value || *end || !isfinite(number) || !(number > 0))
        return refuse(command, o, value, "a number above zero");
    *(double *)o->value = number;
    return true;
}

static bool store_count(const char *command, const option *o, const char *value) {
    char *end;
    long number = strtol(value, &end, 10);
    if (end == value || *end || number < 1 || number > 1000000)
        return refuse(command, o, value, "a whole number above zero");
    *(int *)o->value = (int)number;
    return true;
}

static bool store_choice(const char *command, const option *o, const char *value) {
    char all[256] = "one of";
    for (int i = 0; o->words[i]; i++) {
        if (strcmp(o->words[i], value) == 0) {
            *(int *)o->value = i;
            return true;
        }
        size_t used = strlen(all);
        snprintf(all + used, sizeof all - used, " %s", o->words[i]);
    }
    return refuse(command, o, value, all);
}

static bool store(const char *command, const option *o, const char *value) {
    switch (o->kind) {
    case OPTION_FLAG:
        *(bool *)o->value = true;
        return true;
    case OPTION_TEXT:
        *(const char **)o->value = value;
        return true;
    case OPTION_NUMBER:
        return store_number(command, o, value);
    case OPTION_COUNT:
        return store_count(command, o, value);
    case OPTION_CHOICE:
        return store_choice(command, o, value);
    case OPTION_LIST:
        break;
    }
    option_list *list = o->value;
    if (list->count == OPTION_LIST_MAX) return refuse(command, o, value, "not so many of them");
    list->items[list->count++] = value;
    return true;
}

/* Reads the option at argv[*i] and moves on to its last word. */
static bool read_one(const char *command, int argc, char **argv, int *i, const option *options,
                     int count) {
    const char *word = argv[*i], *equals = strchr(word, '=');
    size_t length = equals ? (size_t)(equals - word) : strlen(word);
    const option *o = find(options, count, word, length);
    if (!o) {
        fprintf(stderr, "clast %s: unknown option %.*s\n`clast %s --help` lists them\n", command,
                (int)length, word, command);
        return false;
    }
    if (o->kind == OPTION_FLAG) {
        if (equals) return refuse(command, o, equals + 1, "no value");
        return store(command, o, NULL);
    }
    if (equals) return store(command, o, equals + 1);
    if (*i + 1 >= argc) {
        fprintf(stderr, "clast %s: %s needs a value\n", command, o->name);
        return false;
    }
    return store(command, o, argv[++*i]);
}

int options_read(const char *command, int argc, char **argv, const option *options, int count,
                 const char **arguments, int room) {
    CLAST_ASSERT(command && argv && arguments && room >= 0);
    int found = 0;
    for (int i = 1; i < argc; i++) {
        if (argv[i][0] == '-' && argv[i][1] != '\0') {
            if (!read_one(command, argc, argv, &i, options, count)) return -1;
        } else if (found < room) {
            arguments[found++] = argv[i];
        } else {
            fprintf(stderr, "clast %s: one argument too many: %s\n", command, argv[i]);
            return -1;
        }
    }
    return found;
}
