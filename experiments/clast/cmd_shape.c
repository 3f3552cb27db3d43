/* cmd_shape.c - a solid, a profile or a mesh as clumps of spheres. */
#include "experiments/clast/commands.h"
#include "experiments/clast/options.h"
#include "experiments/clast/shape_level.h"
#include "experiments/run/folder.h"
#include "experiments/scene/clump.h"
#include "experiments/scene/unit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "engine/check.h"

static const char HELP[] =
    "usage: clast shape SOLID MEASURE=LENGTH... [OPTIONS]\n"
    "       clast shape PROFILE.csv [OPTIONS]     outline x,radius of a body of revolution\n"
    "       clast shape MESH.stl [OPTIONS]        closed mesh: STL, OBJ, PLY, ...\n"
    "\n"
    "Fills a body with spheres; prints volume and inertia, how far the surface and the contact\n"
    "normal are off, the expected pseudo-friction and the cost; writes a template for scenes.\n"
    "\n"
    "  --density Q[,Q..]  sub-shape packing density, 1 and more: as near as a row of equal "
    "spheres\n"
    "                     with Q centres to a diameter is to its cylinder (default 2)\n"
    "  --spheres N        that many spheres (fewer where whole rings do not come out even)\n"
    "  --levels N,N,..    levels of detail: as --spheres, several in one file\n"
    "  --deviation L      until no place of the surface is farther than L from the clump\n"
    "  --smallest L       no sphere with a smaller radius\n"
    "  --fill             a profile is filled like a solid (default: A00 2.2.2, on its axis)\n"
    "  --mass WORD        of the solid (default) or of the union of the spheres\n"
    "  --unit U           of the lengths in a file: mm, cm, m (default m)\n"
    "  --rho R            density of the material, such as 2650 kg/m3 (default 1000 kg/m3)\n"
    "  --material NAME    of the template (default grain)\n"
    "  --name NAME        of the template (default: the solid, or the file)\n"
    "  --out FILE.yaml    the template, all levels\n"
    "  --draw FILE.png    the body and every clump in it; --height N pixels (default 420); --bare\n"
    "  --csv FILE.csv     the numbers as a table\n"
    "\n"
    "solids and their measures:\n";

static const char HELP_END[] =
    "\n"
    "example: clast shape cylinder radius=5mm length=2cm --density 1,2,3 --draw cylinder.png\n"
    "example: clast shape stone.stl --unit mm --levels 3,7,15,31 --rho \"2650 kg/m3\" --out "
    "stone.yaml\n"
    "exit code: 0, 1 --deviation is not met by as many spheres as fit or are allowed (all is\n"
    "written nevertheless), 2 usage, 3 faults in a file, 4 a file cannot be written\n";

enum { WORDS = 8, LEVELS = 16, TEXT = 400 };

typedef struct arguments {
    const char *word[WORDS];
    int words;
    const char *density, *levels, *deviation, *smallest, *unit, *rho, *material, *name;
    const char *out, *draw, *csv;
    int spheres, mass, height;
    bool fill, bare;
} arguments;

static int usage(const char *what, const char *found) {
    fprintf(stderr, "clast shape: %s%s\n`clast shape --help` has an example\n", what, found);
    return CLAST_EXIT_USAGE;
}

static void print_help(void) {
    fputs(HELP, stdout);
    for (int kind = 0; kind < SHAPE_KINDS; kind++) {
        const shape_solid_info *info = shape_solid_info_of((shape_kind)kind);
        printf("  %-15s", info->name);
        for (int k = 0; k < SHAPE_SIZES && info->sizes[k]; k++) printf(" %s", info->sizes[k]);
        printf("\n");
    }
    fputs(HELP_END, stdout);
}

static bool read_arguments(int argc, char **argv, arguments *a) {
    static const char *const MASSES[] = {"union", "solid", NULL};
    const option options[] = {
        {"--density", OPTION_TEXT, &a->density, NULL},
        {"--spheres", OPTION_COUNT, &a->spheres, NULL},
        {"--levels", OPTION_TEXT, &a->levels, NULL},
        {"--deviation", OPTION_TEXT, &a->deviation, NULL},
        {"--smallest", OPTION_TEXT, &a->smallest, NULL},
        {"--fill", OPTION_FLAG, &a->fill, NULL},
        {"--mass", OPTION_CHOICE, &a->mass, MASSES},
        {"--unit", OPTION_TEXT, &a->unit, NULL},
        {"--rho", OPTION_TEXT, &a->rho, NULL},
        {"--material", OPTION_TEXT, &a->material, NULL},
        {"--name", OPTION_TEXT, &a->name, NULL},
        {"--out", OPTION_TEXT, &a->out, NULL},
        {"--draw", OPTION_TEXT, &a->draw, NULL},
        {"--height", OPTION_COUNT, &a->height, NULL},
        {"--bare", OPTION_FLAG, &a->bare, NULL},
        {"--csv", OPTION_TEXT, &a->csv, NULL},
    };
    a->words = options_read("shape", argc, argv, options, sizeof options / sizeof *options, a->word,
                            WORDS);
    if (a->words == 0) usage("which body?", "");
    return a->words > 0;
}

/* ---- values
 * -------------------------------------------------------------------------------------- */

/* A value above zero (or 0 if `zero`) with its unit; false with a message. */
static bool read_value(const char *what, const char *text, unit_kind kind, bool zero,
                       double *value) {
    unit_value v;
    char why[UNIT_TEXT] = "";
    bool good = unit_parse(text, NULL, &v, why);
    if (good && !v.bare && !unit_same(v.dimension, unit_kind_dimension(kind))) {
        char dimension[UNIT_TEXT];
        unit_describe(v.dimension, dimension);
        fprintf(stderr, "clast shape: %s: found '%s' (%s), expected a %s in %s\n", what, text,
                dimension, unit_kind_name(kind), unit_kind_si(kind));
        return false;
    }
    if (good && isfinite(v.value) && (v.value > 0 || (zero && v.value == 0))) {
        *value = v.value;
        return true;
    }
    fprintf(stderr, "clast shape: %s: found '%s'%s%s, expected a %s in %s above zero\n", what, text,
            why[0] ? ": " : "", why, unit_kind_name(kind), unit_kind_si(kind));
    return false;
}

/* Numbers between commas, each in [low, high]; their count, or 0 with a message. */
static int read_list(const char *name, const char *text, double low, double high, bool whole,
                     double *values) {
    int count = 0;
    for (const char *at = text; count < LEVELS;) {
        char *end;
        double v = strtod(at, &end);
        bool good = end != at && v >= low && v <= high && (!whole || v == floor(v));
        if (!good || (*end != ',' && *end != '\0')) break;
        values[count++] = v;
        if (*end == '\0') return count;
        at = end + 1;
    }
    fprintf(stderr,
            "clast shape: %s: found '%s', expected up to %d %snumbers from %g to %g with commas "
            "between\n",
            name, text, LEVELS, whole ? "whole " : "", low, high);
    return 0;
}

/* ---- the body
 * -------------------------------------------------------------------------------------- */

/* "length=2cm" into the solid; 0 or the exit code. */
static int read_measure(shape_solid *solid, const char *word, bool given[SHAPE_SIZES]) {
    const shape_solid_info *info = shape_solid_info_of(solid->kind);
    const char *equals = strchr(word, '=');
    size_t length = equals ? (size_t)(equals - word) : 0;
    for (int k = 0; k < SHAPE_SIZES && info->sizes[k] && equals; k++) {
        if (strlen(info->sizes[k]) != length || strncmp(word, info->sizes[k], length)) continue;
        given[k] = true;
        bool good =
            read_value(info->sizes[k], equals + 1, UNIT_LENGTH, info->zero[k], &solid->size[k]);
        return good ? 0 : CLAST_EXIT_USAGE;
    }
    fprintf(stderr, "clast shape: found '%s', expected measures of a %s:", word, info->name);
    for (int k = 0; k < SHAPE_SIZES && info->sizes[k]; k++)
        fprintf(stderr, " %s=LENGTH", info->sizes[k]);
    fputc('\n', stderr);
    return CLAST_EXIT_USAGE;
}

static int read_solid(const arguments *a, shape_kind kind, shape_target **target, char *title) {
    shape_solid solid = {.kind = kind};
    const shape_solid_info *info = shape_solid_info_of(kind);
    bool given[SHAPE_SIZES] = {false};
    for (int i = 1; i < a->words; i++) {
        int code = read_measure(&solid, a->word[i], given);
        if (code) return code;
    }
    int used = snprintf(title, TEXT, "%s:", info->name);
    for (int k = 0; k < SHAPE_SIZES && info->sizes[k]; k++) {
        if (!given[k]) return usage("missing: ", info->sizes[k]);
        used += snprintf(title + used, TEXT - (size_t)used, "%s %s %g mm", k ? "," : "",
                         info->sizes[k], 1e3 * solid.size[k]);
    }
    for (char *c = title; *c; c++)
        if (*c == '_') *c = ' ';
    const char *fault = shape_solid_fault(&solid);
    if (fault) return usage("found ", fault);
    *target = shape_target_of_solid(&solid);
    return 0;
}

static bool ends_with(const char *text, const char *end) {
    size_t n = strlen(text), m = strlen(end);
    return n >= m && !strcmp(text + n - m, end);
}

static int read_file(const arguments *a, shape_target **target, char *title) {
    double unit = 1;
    char one[64];
    snprintf(one, sizeof one, "1 %s", a->unit ? a->unit : "m");
    if (a->words > 1) return usage("one argument too many: ", a->word[1]);
    if (!read_value("--unit", one, UNIT_LENGTH, false, &unit)) return CLAST_EXIT_USAGE;
    scene_arena arena = {0};
    scene_faults faults = {.arena = &arena, .file = a->word[0]};
    *target = ends_with(a->word[0], ".csv") ? scene_profile_target(&faults, a->word[0], unit)
                                            : scene_mesh_target(&faults, a->word[0], unit);
    char *text = scene_faults_text(&faults);
    if (text) fputs(text, stderr);
    free(text);
    scene_arena_free(&arena);
    snprintf(title, TEXT, "%s", a->word[0]);
    return *target ? 0 : CLAST_EXIT_BAD_SCENE;
}

static int read_body(const arguments *a, shape_target **target, char *title) {
    shape_kind kind = shape_kind_of(a->word[0]);
    if (kind != SHAPE_KINDS) return read_solid(a, kind, target, title);
    if (strchr(a->word[0], '.')) return read_file(a, target, title);
    return usage("found no solid and no file: ", a->word[0]);
}

/* ---- levels
 * ---------------------------------------------------------------------------------------- */

/* Stops of all levels; their number, or 0 with a message. */
static int read_stops(const arguments *a, shape_stops *stops) {
    shape_stops base = {0};
    double list[LEVELS];
    int count = 1, named = (a->density != NULL) + (a->levels != NULL);
    if (a->smallest && !read_value("--smallest", a->smallest, UNIT_LENGTH, false, &base.smallest))
        return 0;
    if (a->deviation &&
        !read_value("--deviation", a->deviation, UNIT_LENGTH, false, &base.deviation))
        return 0;
    if (named == 2) return usage("--levels and --density: one of the two", ""), 0;
    if (a->spheres > SHAPE_SPHERES_MAX) return usage("--spheres: at most 1000", ""), 0;
    base.spheres = a->spheres;
    if (named == 0 && !base.spheres && !(base.deviation > 0)) base.density = 2;
    if (a->density) count = read_list("--density", a->density, 1, 100, false, list);
    if (a->levels) count = read_list("--levels", a->levels, 1, SHAPE_SPHERES_MAX, true, list);
    for (int i = 0; i < count; i++) {
        stops[i] = base;
        if (a->density) stops[i].density = list[i];
        if (a->levels) stops[i].spheres = (int)list[i];
    }
    return count;
}

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static bool make_level(const arguments *a, const shape_target *target, shape_level *l) {
    l->placed = calloc(SHAPE_SPHERES_MAX, sizeof *l->placed);
    CLAST_ASSERT(l->placed);
    double start = now();
    bool row = target->source == SHAPE_FROM_PROFILE && !a->fill;
    l->filling = row ? shape_fill_row(target, &l->stops, l->placed)
                     : shape_fill(target, &l->stops, l->placed, NULL);
    l->fill_s = now() - start;
    if (l->filling.count == 0) {
        usage("no sphere fits: --smallest is too large, or --spheres less than a whole ring", "");
        return false;
    }
    start = now();
    l->clump = shape_clump_of(l->placed, l->filling.count, &target->mass, (shape_mass_from)a->mass);
    l->mass_s = now() - start;
    l->quality = shape_quality_of(target, l->placed, l->filling.count);
    return true;
}

/* ---- output
 * ---------------------------------------------------------------------------------------- */

static bool write_text(const char *path, char *text) {
    int failure = file_write_text(path, text);
    free(text);
    if (failure)
        fprintf(stderr, "clast shape: %s: cannot be written: %s\n", path, strerror(failure));
    return !failure;
}

/* The levels that miss the deviation that was asked for, on stderr; the exit code that it gives. */
static int missed(const shape_sheet *sheet) {
    int code = CLAST_EXIT_OK;
    for (int i = 0; i < sheet->count; i++) {
        const shape_level *l = &sheet->levels[i];
        if (l->filling.met || !(l->stops.deviation > 0)) continue;
        fprintf(stderr,
                "clast shape: --deviation %g mm is not met: %d spheres leave a place %.4g mm off; "
                "a bound can be held from a ten-thousandth of the body's size on, and to a "
                "thousandth of itself\n",
                1e3 * l->stops.deviation, l->filling.count, 1e3 * l->quality.deviation_max);
        code = CLAST_EXIT_RUN_FAILED;
    }
    return code;
}

static int show(const arguments *a, const shape_sheet *sheet) {
    shape_print(sheet);
    bool good = (!a->out || write_text(a->out, shape_yaml(sheet))) &&
                (!a->csv || write_text(a->csv, shape_csv(sheet))) &&
                (!a->draw || shape_draw(sheet, a->draw, a->height, a->bare));
    return good ? missed(sheet) : CLAST_EXIT_FILE;
}

/* The name of the file without folders and ending. */
static void name_of(const arguments *a, char *name) {
    const char *from = a->name ? a->name : a->word[0], *slash = strrchr(from, '/');
    snprintf(name, TEXT, "%s", a->name || !slash ? from : slash + 1);
    char *dot = strrchr(name, '.');
    if (!a->name && dot) *dot = '\0';
}

static void join(int argc, char **argv, char *text) {
    int used = snprintf(text, TEXT, "clast");
    for (int i = 0; i < argc && used < TEXT; i++)
        used += snprintf(text + used, TEXT - (size_t)used, " %s", argv[i]);
}

static int make_sheet(const arguments *a, shape_sheet *sheet) {
    shape_stops stops[LEVELS];
    shape_level levels[LEVELS] = {0};
    int count = read_stops(a, stops), code = count > 0 ? 0 : CLAST_EXIT_USAGE;
    sheet->levels = levels;
    sheet->count = count;
    for (int i = 0; i < count && !code; i++) {
        levels[i].stops = stops[i];
        if (!make_level(a, sheet->target, &levels[i])) code = CLAST_EXIT_USAGE;
    }
    if (!code) code = show(a, sheet);
    for (int i = 0; i < count; i++) {
        shape_clump_free(&levels[i].clump);
        free(levels[i].placed);
    }
    return code;
}

int cmd_shape(int argc, char **argv) {
    if (options_ask_help(argc, argv)) {
        print_help();
        return CLAST_EXIT_OK;
    }
    arguments a = {.mass = SHAPE_MASS_SOLID, .height = 420};
    char title[TEXT], name[TEXT], command[TEXT];
    if (!read_arguments(argc, argv, &a)) return CLAST_EXIT_USAGE;
    double rho = 1000;
    if (a.rho && !read_value("--rho", a.rho, UNIT_DENSITY, false, &rho)) return CLAST_EXIT_USAGE;
    shape_target *target = NULL;
    int code = read_body(&a, &target, title);
    if (code) return code;
    name_of(&a, name);
    join(argc, argv, command);
    shape_sheet sheet = {.target = target,
                         .title = title,
                         .command = command,
                         .name = name,
                         .material = a.material ? a.material : "grain",
                         .density = rho,
                         .from = (shape_mass_from)a.mass};
    code = make_sheet(&a, &sheet);
    shape_target_free(target);
    return code;
}
