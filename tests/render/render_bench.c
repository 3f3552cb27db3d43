/* How long a frame of 20 000 spheres at 1280 x 720 takes, PNG on disk included. Prints a table; the
 * best of several rounds counts, because other programs on the machine only ever make it slower.
 *
 *     render_bench [frames per round = 20] [rounds = 3] [folder = a temporary one]
 */
#include "render/render.h"
#include "tests/render/bed.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* What a row of the table needs, seconds per frame. */
typedef struct result {
    double frame, cpu, prepare, draw, read, resolve, label, png;
    size_t drawn;
} result;

typedef struct bench {
    int frames, rounds;
    const char *folder;
    bed spheres;
    bool failed;
} bench;

static double seconds(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static bool ok(render_status status) {
    if (status != RENDER_OK) fprintf(stderr, "render_bench: %s\n", render_error_text());
    return status == RENDER_OK;
}

static void add(result *sum, render_timing t, int frames) {
    sum->prepare += t.prepare_s / frames;
    sum->draw += t.draw_s / frames;
    sum->read += t.read_s / frames;
    sum->resolve += t.resolve_s / frames;
    sum->drawn = t.spheres_drawn;
}

static void remove_frames(const bench *b) {
    for (int i = 0; i < b->frames; i++) {
        char path[4096];
        snprintf(path, sizeof path, "%s/frame-%06d.png", b->folder, i);
        remove(path);
    }
}

/* One round: draw, label and write all frames; the clock runs until the last is on disk. */
static bool run_round(bench *b, render_canvas *canvas, const render_camera *camera,
                      const render_overlay *overlay, result *out) {
    render_encoder_def def = render_encoder_default();
    def.folder = b->folder;
    render_encoder *encoder = NULL;
    if (!ok(render_encoder_new(&def, &encoder))) return false;
    render_image image = {0};
    *out = (result){0};
    bool good = true;
    double start = seconds(CLOCK_MONOTONIC), cpu = seconds(CLOCK_PROCESS_CPUTIME_ID);
    for (int i = 0; i < b->frames && good; i++) {
        bed_move(&b->spheres, i);
        render_colour_map(RENDER_VIRIDIS, b->spheres.speed, b->spheres.count, 0, 0.15,
                          b->spheres.colour);
        render_scene scene = bed_scene(&b->spheres);
        render_overlay label = *overlay;
        label.time_s = 0.01 * i;
        good = ok(render_canvas_draw(canvas, &scene, camera, &image)) &&
               ok(render_encoder_push(encoder, &image, &label, NULL, 0));
        add(out, render_canvas_timing(canvas), b->frames);
    }
    while (good && render_encoder_times(encoder).written < b->frames)
        nanosleep(&(struct timespec){.tv_nsec = 200000}, NULL);
    out->frame = (seconds(CLOCK_MONOTONIC) - start) / b->frames;
    out->cpu = (seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu) / b->frames;
    render_encoder_timing times = render_encoder_times(encoder);
    out->label = times.label_s / b->frames;
    out->png = times.png_s / b->frames;
    render_image_free(&image);
    return ok(render_encoder_finish(encoder)) && good;
}

static bool set_up(bench *b, const render_canvas_def *def, render_projection projection,
                   render_camera *camera, render_overlay *overlay) {
    render_font *font = NULL;
    render_view view = render_view_default();
    view.projection = projection;
    if (projection == RENDER_PERSPECTIVE) {
        view.direction[0] = -0.4;
        view.direction[2] = -0.35;
    }
    *overlay = (render_overlay){.title = "Bench bed, 20 000 spheres",
                                .time_shown = true,
                                .time_decimals = 2,
                                .bar_shown = true,
                                .bar_high = 0.15,
                                .bar_title = "speed",
                                .bar_unit = "m/s"};
    render_scene scene = bed_scene(&b->spheres);
    bool good = ok(render_font_open(NULL, &font)) &&
                ok(render_overlay_margins(font, overlay, def->width, def->height, &view.margins)) &&
                ok(render_camera_fit_scene(camera, &view, &scene, def->width, def->height));
    if (good && projection == RENDER_ORTHOGRAPHIC)
        overlay->scale_px_per_m = render_camera_scale(camera, def->height);
    render_font_close(font);
    return good;
}

static void print_row(const char *preset, const char *view, const char *backend, const result *r) {
    printf("| %s | %s | %s | %zu | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f | %.0f | **%.1f** |\n",
           preset, view, backend, r->drawn, 1e3 * r->prepare, 1e3 * r->draw, 1e3 * r->read,
           1e3 * r->resolve, 1e3 * r->label, 1e3 * r->png, 1e3 * r->cpu, 1 / r->frame);
    fflush(stdout);
}

static void run_case(bench *b, render_preset preset, render_projection projection,
                     const char *backend) {
    render_canvas_def def = render_canvas_default(preset);
    def.backend = backend;
    render_canvas *canvas = NULL;
    render_camera camera;
    render_overlay overlay;
    result best = {.frame = 1e9}, each;
    bool good = set_up(b, &def, projection, &camera, &overlay);
    render_status status = good ? render_canvas_new(&def, &canvas) : RENDER_ERR_ARGUMENT;
    if (status == RENDER_ERR_UNAVAILABLE) {
        printf("| | | %s | not available: %s |\n", backend, render_error_text());
        return;
    }
    good = good && ok(status);
    for (int i = 0; i < b->rounds && good; i++) {
        good = run_round(b, canvas, &camera, &overlay, &each);
        if (good && each.frame < best.frame) best = each;
    }
    if (good)
        print_row(preset == RENDER_DRAFT ? "draft" : "final",
                  projection == RENDER_ORTHOGRAPHIC ? "front" : "perspective", backend, &best);
    b->failed = b->failed || !good;
    render_canvas_free(canvas);
}

int main(int argc, char **argv) {
    char folder[64];
    snprintf(folder, sizeof folder, "render-bench-%ld", (long)getpid());
    bench b = {.frames = argc > 1 ? atoi(argv[1]) : 20, .rounds = argc > 2 ? atoi(argv[2]) : 3};
    b.folder = argc > 3 ? argv[3] : mkdir(folder, 0777) == 0 ? folder : NULL;
    if (b.frames < 1 || b.rounds < 1 || !b.folder) {
        fprintf(stderr, "usage: render_bench [frames] [rounds] [folder]\n");
        return 2;
    }
    b.spheres = bed_new(40, 19, 27, 2);
    printf("%zu spheres in pairs, 1280 x 720, %d frames, best of %d rounds; ms per frame\n\n",
           b.spheres.count, b.frames, b.rounds);
    printf("| preset | view | backend | drawn | prepare | draw | read | resolve | label | PNG | "
           "CPU | frames/s |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    static const char *const BACKENDS[] = {"osmesa", "egl"};
    for (int k = 0; k < 2; k++)
        for (int projection = 0; projection < 2; projection++)
            for (int preset = 0; preset < 2; preset++)
                run_case(&b, preset ? RENDER_FINAL : RENDER_DRAFT,
                         projection ? RENDER_PERSPECTIVE : RENDER_ORTHOGRAPHIC, BACKENDS[k]);
    if (argc <= 3) {
        remove_frames(&b);
        rmdir(b.folder);
    }
    bed_free(&b.spheres);
    return b.failed;
}
