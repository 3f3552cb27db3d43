#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "experiments/clast/commands.h"
#include "experiments/clast/options.h"
#include "experiments/clast/picture.h"
#include "experiments/run/folder.h"

static const char HELP[] =
    "usage: clast render RUN --out FOLDER [OPTIONS]\n\n"
    "Draws the frames of a run (finished, interrupted or still going) into a folder, as\n"
    "frame-000000.png and so on. What is not said here is taken from `view` in the scene.\n\n"
    "  --out FOLDER      where the pictures go; made when missing\n"
    "  --preset WHICH    draft (fast) or final (smooth)\n"
    "  --frames A:B:N    frames A to B, every N-th; each part may be left out\n"
    "  --size WxH        pixels\n"
    "  --colour WHICH    speed, speed-bands, initial-height, body or process (of several)\n"
    "  --map WHICH       viridis or cividis\n"
    "  --forces          an arrow for every contact, for runs with `output.contacts`\n"
    "  --mark ID         draws this body in black; may come several times\n"
    "  --speed-max V     top of the speed scale, m/s (default: the fastest of each frame)\n"
    "  --backend WHICH   auto, osmesa or egl\n"
    "  --animation FILE  also an .mp4 of the pictures (needs ffmpeg)\n"
    "  --fps N           of the animation\n\n"
    "example: clast render build/hopper --out build/pictures --frames 0::5 --map cividis\n"
    "         clast render build/hopper --out build/pictures --animation hopper.mp4\n";

typedef struct arguments {
    const char *run, *out, *frames, *size, *animation;
    int preset, colour, map, backend; /* -1: as the scene says */
    double speed_max, fps;
    size_t from, to, step;
    option_list mark;
    bool forces;
    uint32_t marked[OPTION_LIST_MAX];
} arguments;

static bool usage(const char *what, const char *value) {
    fprintf(stderr, "clast render: %s%s\n`clast render --help` has an example\n", what, value);
    return false;
}

static bool read_arguments(int argc, char **argv, arguments *a) {
    static const char *const PRESETS[] = {"draft", "final", NULL};
    static const char *const COLOURS[] = {"speed", "speed-bands", "initial-height",
                                          "body",  "process",     NULL};
    static const char *const MAPS[] = {"viridis", "cividis", NULL};
    static const char *const BACKENDS[] = {"auto", "osmesa", "egl", NULL};
    const option options[] = {
        {"--out", OPTION_TEXT, &a->out, NULL},
        {"--preset", OPTION_CHOICE, &a->preset, PRESETS},
        {"--frames", OPTION_TEXT, &a->frames, NULL},
        {"--size", OPTION_TEXT, &a->size, NULL},
        {"--colour", OPTION_CHOICE, &a->colour, COLOURS},
        {"--map", OPTION_CHOICE, &a->map, MAPS},
        {"--forces", OPTION_FLAG, &a->forces, NULL},
        {"--mark", OPTION_LIST, &a->mark, NULL},
        {"--speed-max", OPTION_NUMBER, &a->speed_max, NULL},
        {"--backend", OPTION_CHOICE, &a->backend, BACKENDS},
        {"--animation", OPTION_TEXT, &a->animation, NULL},
        {"--fps", OPTION_NUMBER, &a->fps, NULL},
    };
    int n =
        options_read("render", argc, argv, options, sizeof options / sizeof *options, &a->run, 1);
    if (n < 0) return false;
    if (n < 1) return usage("which run?", "");
    if (!a->out || !a->out[0]) return usage("--out FOLDER is missing", "");
    return true;
}

/* "a:b:n", each part optional; b is included. */
static bool read_range(arguments *a, size_t count) {
    size_t numbers[3] = {0, count - 1, 1};
    const char *at = a->frames ? a->frames : "";
    for (int i = 0; i < 3 && *at; i++) {
        char *end;
        unsigned long number = strtoul(at, &end, 10);
        if (end != at) numbers[i] = number;
        if (*end != ':' && *end != '\0')
            return usage("--frames: expected A:B:N, found ", a->frames);
        at = *end == ':' ? end + 1 : end;
        if (i == 0 && *end == '\0') numbers[1] = numbers[0]; /* one number: that frame alone */
    }
    if (*at || numbers[2] < 1 || numbers[0] > numbers[1])
        return usage("--frames: expected A:B:N, found ", a->frames);
    a->from = numbers[0];
    a->to = numbers[1] < count ? numbers[1] : count - 1;
    a->step = numbers[2];
    return a->from < count || usage("--frames: the run has not so many frames: ", a->frames);
}

static bool read_marks(arguments *a) {
    for (int i = 0; i < a->mark.count; i++) {
        char *end;
        unsigned long id = strtoul(a->mark.items[i], &end, 10);
        if (end == a->mark.items[i] || *end || id > UINT32_MAX)
            return usage("--mark: expected the id of a body, found ", a->mark.items[i]);
        a->marked[i] = (uint32_t)id;
    }
    return true;
}

static bool read_size(const arguments *a, picture_options *o) {
    if (!a->size) return true;
    char *end;
    long width = strtol(a->size, &end, 10), height = *end == 'x' ? strtol(end + 1, &end, 10) : 0;
    if (*end || width < 16 || height < 16 || width > 8192 || height > 8192)
        return usage("--size: expected WxH such as 1280x720, found ", a->size);
    o->width = (int)width;
    o->height = (int)height;
    return true;
}

/* The command line before the scene's view. */
static picture_options options_of(const arguments *a, const view *v) {
    static const char *const BACKENDS[] = {"auto", "osmesa", "egl"};
    bool final = v->preset && strcmp(v->preset, "final") == 0;
    bool cividis = v->map && strcmp(v->map, "cividis") == 0;
    return (picture_options){.preset = a->preset >= 0 ? (render_preset)a->preset
                                       : final        ? RENDER_FINAL
                                                      : RENDER_DRAFT,
                             .backend = BACKENDS[a->backend],
                             .width = v->width > 0 ? v->width : 1280,
                             .height = v->height > 0 ? v->height : 720,
                             .colour = a->colour >= 0 ? (colour_by)a->colour : v->colour,
                             .map = a->map >= 0 ? (render_map)a->map
                                    : cividis   ? RENDER_CIVIDIS
                                                : RENDER_VIRIDIS,
                             .speed_max = a->speed_max > 0 ? a->speed_max : v->speed_max,
                             .marked = a->marked,
                             .marked_count = a->mark.count,
                             .forces = a->forces};
}

static bool draw_all(const arguments *a, painter *p, render_encoder *encoder) {
    bool terminal = isatty(STDOUT_FILENO) == 1;
    for (size_t i = a->from; i <= a->to; i += a->step) {
        if (!painter_draw(p, i, encoder)) return false;
        if (terminal) printf("\rframe %zu of %zu", i, a->to);
        fflush(stdout);
    }
    if (terminal) printf("\r\033[K");
    return true;
}

static int animate(const arguments *a, const view *v) {
    if (!a->animation) return CLAST_EXIT_OK;
    render_movie_def def = render_movie_default();
    def.folder = a->out;
    def.path = a->animation;
    if (v->frames_per_second > 0) def.frames_per_s = v->frames_per_second;
    if (a->fps > 0) def.frames_per_s = a->fps;
    if (render_movie_make(&def) == RENDER_OK) return CLAST_EXIT_OK;
    fprintf(stderr, "clast render: %s\n", render_error_text());
    return CLAST_EXIT_FILE;
}

static int paint(const arguments *a, results *r, const picture_options *o) {
    painter *p = painter_new(r, o);
    if (!p) return CLAST_EXIT_FILE;
    render_encoder_def def = render_encoder_default();
    def.folder = a->out;
    render_encoder *encoder = NULL;
    bool good = render_encoder_new(&def, &encoder) == RENDER_OK;
    if (!good) fprintf(stderr, "clast render: %s\n", render_error_text());
    if (good) {
        good = draw_all(a, p, encoder);
        if (render_encoder_finish(encoder) != RENDER_OK && good) {
            fprintf(stderr, "clast render: %s\n", render_error_text());
            good = false;
        }
    }
    if (good)
        printf("%zu pictures in %s (%s)\n", (a->to - a->from) / a->step + 1, a->out,
               painter_backend(p));
    painter_free(p);
    return good ? animate(a, &results_stage(r)->view) : CLAST_EXIT_FILE;
}

static int render_run(arguments *a, results *r) {
    if (results_frames(r) == 0) {
        fprintf(stderr, "clast render: %s: the run has no frames\n", a->run);
        return CLAST_EXIT_FILE;
    }
    if (!read_marks(a)) return CLAST_EXIT_USAGE;
    picture_options o = options_of(a, &results_stage(r)->view);
    if (!read_range(a, results_frames(r)) || !read_size(a, &o)) return CLAST_EXIT_USAGE;
    int failure = folder_make(a->out);
    if (!failure) return paint(a, r, &o);
    fprintf(stderr, "clast render: %s: cannot be made: %s\n", a->out, strerror(failure));
    return CLAST_EXIT_FILE;
}

int cmd_render(int argc, char **argv) {
    if (options_ask_help(argc, argv)) {
        fputs(HELP, stdout);
        return CLAST_EXIT_OK;
    }
    arguments a = {.preset = -1, .colour = -1, .map = -1};
    if (!read_arguments(argc, argv, &a)) return CLAST_EXIT_USAGE;
    char why[RESULTS_ERROR_MAX];
    results *r = results_open(a.run, why);
    if (!r) {
        fprintf(stderr, "clast render: %s\n", why);
        return CLAST_EXIT_FILE;
    }
    int code = render_run(&a, r);
    results_free(r);
    return code;
}
