/* cmd_mesh.c - reads a mesh, says what is wrong with it and what was done, draws it, writes it out
 * mended. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "experiments/clast/commands.h"
#include "experiments/clast/mesh_picture.h"
#include "experiments/clast/options.h"

static const char HELP[] =
    "usage: clast mesh FILE [OPTIONS]\n"
    "\n"
    "Reads a triangle mesh (STL, OBJ, PLY, OFF, glTF, ...) as a scene would, and prints its size, "
    "area\n"
    "and volume, what is wrong with it and what was done about that. Looks for triangles that "
    "pass\n"
    "through each other too, which a scene does not. Crossings, open edges and pieces that face\n"
    "inwards are left as they are: all of these are walls.\n"
    "\n"
    "  --unit U         of the file: mm, cm, m, inch or a number of metres (default: m)\n"
    "  --axes 'X Y Z'   our x, y and z as axes of the file; 'x -z y' stands a file upright whose\n"
    "                   y is up (default: x y z)\n"
    "  --weld SHARE     vertices closer than this share of the diagonal become one (default: "
    "1e-6)\n"
    "  --draw FILE.png  draws it, edges that do not join two triangles in red\n"
    "  --from 'X Y Z'   draws it as seen from this direction (default: 0.45 -0.8 0.5)\n"
    "  --size WxH       of the picture in pixels (default: 960x640)\n"
    "  --out FILE.stl   writes it in metres as a scene would take it: welded, cleaned, turned\n"
    "  --strict         asks for a closed mesh without crossings, exit code 3 for any other\n"
    "\n"
    "example: clast mesh bar.stl --unit mm --draw bar.png\n"
    "exit code: 0 read, 2 usage, 3 --strict and something is wrong, 4 the file cannot be read, is "
    "no\n"
    "mesh or is damaged, or a file cannot be written\n";

typedef struct arguments {
    const char *path, *unit, *axes, *draw, *from, *size, *out;
    double weld;
    bool strict;
} arguments;

static bool usage(const char *what, const char *value) {
    fprintf(stderr, "clast mesh: %s%s\n`clast mesh --help` has an example\n", what, value);
    return false;
}

static bool read_arguments(int argc, char **argv, arguments *a) {
    const option options[] = {
        {"--unit", OPTION_TEXT, &a->unit, NULL},   {"--axes", OPTION_TEXT, &a->axes, NULL},
        {"--weld", OPTION_NUMBER, &a->weld, NULL}, {"--draw", OPTION_TEXT, &a->draw, NULL},
        {"--from", OPTION_TEXT, &a->from, NULL},   {"--size", OPTION_TEXT, &a->size, NULL},
        {"--out", OPTION_TEXT, &a->out, NULL},     {"--strict", OPTION_FLAG, &a->strict, NULL},
    };
    int n =
        options_read("mesh", argc, argv, options, sizeof options / sizeof *options, &a->path, 1);
    return n == 1 || (n == 0 && usage("which file?", ""));
}

static bool read_options(const arguments *a, mesh_options *o) {
    *o = mesh_options_default();
    o->find_crossings = true;
    if (a->weld > 0) o->weld = a->weld;
    if (a->unit && mesh_unit_parse(a->unit, &o->unit) != MESH_OK)
        return usage(mesh_error_text(), "");
    if (a->axes && mesh_axes_parse(a->axes, o->axis) != MESH_OK)
        return usage(mesh_error_text(), "");
    return true;
}

static bool read_view(const arguments *a, mesh_picture *p) {
    *p = (mesh_picture){.title = a->path, .from = {0.45, -0.8, 0.5}, .width = 960, .height = 640};
    char rest;
    if (a->size && (sscanf(a->size, "%dx%d%c", &p->width, &p->height, &rest) != 2 ||
                    p->width < 64 || p->height < 64 || p->width > 8192 || p->height > 8192))
        return usage("--size: expected WxH such as 960x640, found ", a->size);
    double *d = p->from;
    if (a->from && (sscanf(a->from, "%lf %lf %lf %c", &d[0], &d[1], &d[2], &rest) != 3 ||
                    !(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] > 0)))
        return usage("--from: expected a direction such as '1 -1 0.5', found ", a->from);
    return true;
}

/* What --strict does not let pass. */
static bool is_sound(const mesh_report *r) {
    return r->closed && r->inward == 0 && r->crossings.count == 0 && !r->crossings_given_up &&
           r->loader_warnings == 0;
}

static int show(const arguments *a, const mesh_picture *picture, const mesh_surface *surface,
                const mesh_report *report) {
    mesh_report_write(report, a->path, stdout);
    if (a->out && mesh_write_stl(surface, a->out) != MESH_OK) {
        fprintf(stderr, "clast mesh: %s\n", mesh_error_text());
        return CLAST_EXIT_FILE;
    }
    if (a->draw && !mesh_draw(picture, surface, report, a->draw)) return CLAST_EXIT_FILE;
    return a->strict && !is_sound(report) ? CLAST_EXIT_BAD_SCENE : CLAST_EXIT_OK;
}

int cmd_mesh(int argc, char **argv) {
    if (options_ask_help(argc, argv)) {
        fputs(HELP, stdout);
        return CLAST_EXIT_OK;
    }
    arguments a = {0};
    mesh_options options;
    mesh_picture picture;
    if (!read_arguments(argc, argv, &a) || !read_options(&a, &options) || !read_view(&a, &picture))
        return CLAST_EXIT_USAGE;
    mesh_surface surface;
    mesh_report report;
    mesh_status status = mesh_load(a.path, &options, &surface, &report);
    if (status != MESH_OK) {
        fprintf(stderr, "clast mesh: %s\n", mesh_error_text());
        return status == MESH_ERR_ARGUMENT ? CLAST_EXIT_USAGE : CLAST_EXIT_FILE;
    }
    int code = show(&a, &picture, &surface, &report);
    mesh_free(&surface);
    return code;
}
