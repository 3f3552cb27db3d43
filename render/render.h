/* render.h: headless pictures of granular scenes. Plain arrays in, pixels and PNG files out.
 *
 *     double x[] = {0, 0.012}, y[] = {0, 0}, z[] = {0, 0}, radius[] = {0.006, 0.007};
 *     render_scene scene = {.spheres = {.count = 2, .x = x, .y = y, .z = z, .radius = radius}};
 *     render_canvas_def def = render_canvas_default(RENDER_FINAL);
 *     render_view view = render_view_default();
 *     render_canvas *canvas = NULL;
 *     render_camera camera;
 *     render_image image = {0};
 *     bool ok = render_canvas_new(&def, &canvas) == RENDER_OK &&
 *               render_camera_fit_scene(&camera, &view, &scene, 1280, 720) == RENDER_OK &&
 *               render_canvas_draw(canvas, &scene, &camera, &image) == RENDER_OK &&
 *               render_png_write("two.png", &image, NULL, 0) == RENDER_OK;
 *     if (!ok) fprintf(stderr, "%s\n", render_error_text());
 *     render_image_free(&image);
 *     render_canvas_free(canvas);
 *
 * Conventions. Lengths are in metres, times in seconds, angles in degrees; colours are 8-bit sRGB.
 * The world is right-handed with no preferred axis. Pictures count pixels from the top left. Arrays
 * belong to the caller and are only read during the call. A zeroed struct or member means "none" or
 * "automatic", except the *_def structs, which come from their *_default function.
 *
 * Failure. Whatever depends on the outside world or on values in arrays returns a status that must
 * be looked at; render_error_text() then says what, where and what was expected. A broken promise
 * in the arguments themselves (a null pointer where none is allowed) stops the program with file
 * and line.
 *
 * Threads. A canvas belongs to the thread that made it. An encoder may be fed by any one thread.
 * Fonts and everything without a handle may be used by several threads, a single font by one at a
 * time.
 *
 * Determinism. The same arrays give the same bytes on every run, with either backend and for any
 * number of threads, as long as Mesa stays the same. Another Mesa may differ in single pixels.
 */
#ifndef RENDER_RENDER_H
#define RENDER_RENDER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define RENDER_MUST_CHECK __attribute__((warn_unused_result))
#else
#define RENDER_MUST_CHECK
#endif

/* ---- Status ---- */

typedef enum render_status {
    RENDER_OK = 0,
    RENDER_ERR_ARGUMENT,    /* a value is out of range, not finite, or does not fit the others */
    RENDER_ERR_MEMORY,      /* an allocation was refused */
    RENDER_ERR_UNAVAILABLE, /* no such backend, font or program on this machine */
    RENDER_ERR_GL,          /* OpenGL is too old, refuses a size, or reports an error */
    RENDER_ERR_FILE,   /* a file could not be written completely; nothing half-written is left */
    RENDER_ERR_PROCESS /* ffmpeg ran and failed */
} render_status;

/* What went wrong in the last call of this thread that returned anything but RENDER_OK. */
const char *render_error_text(void);
const char *render_status_name(render_status status);

/* ---- Colours ---- */

typedef struct render_rgb {
    uint8_t r, g, b;
} render_rgb;

typedef enum render_map { RENDER_VIRIDIS, RENDER_CIVIDIS } render_map;

/* The tints of the three velocity bands, slow first: below 30 %, 30 to 70 % and above 70 % of the
 * fastest. Red, blue and green as in the literature, in a ladder of lightness so that they also
 * part for colour-blind readers and in grey print. */
extern const render_rgb RENDER_BAND_TINT[3];

/* The colour of the map at t, 0 to 1 (clamped; not-a-number gives mid-grey). The dark tenth at the
 * start of the map is left out, because shading would turn it black: t = 0 is the map's own 0.1. */
render_rgb render_map_at(render_map map, double t);

/* Each fills rgb[0..count). Values outside [low, high] take the end colours. If high <= low, all
 * take the colour of low. */
void render_colour_map(render_map map, const double *value, size_t count, double low, double high,
                       render_rgb *rgb);

/* Three bands by |speed| relative to `fastest`, m/s; fastest = 0 means all are slow. */
void render_colour_bands(const double *speed, size_t count, double fastest, render_rgb *rgb);

/* A quiet tint by id, the same for the same id in every frame; neighbours in id differ. */
void render_colour_bodies(const int32_t *body, size_t count, render_rgb *rgb);

/* `stripes` >= 1 stripes of equal height between low and high, in two alternating tints. Feed it
 * the heights of the first frame to see how layers deform later. */
void render_colour_stripes(const double *height, size_t count, double low, double high, int stripes,
                           render_rgb *rgb);

/* rgb[i] = of_body[body[i]]: from one colour per body to one per sphere. Every body[i] must be in
 * [0, bodies). */
void render_colour_spread(const render_rgb *of_body, size_t bodies, const int32_t *body,
                          size_t count, render_rgb *rgb);

/* ---- What is drawn ---- */

/* Spheres, as columns of doubles. All opaque. */
typedef struct render_spheres {
    size_t count;
    const double *x, *y, *z; /* m, finite */
    const double *radius;    /* m, > 0 */
    const int32_t *body; /* >= 0; equal numbers melt into one outline; NULL: each is its own body */
    const render_rgb *colour; /* NULL: all in a neutral tint */
} render_spheres;

/* A surface of triangles or quads in one colour. Only edges that belong to one face, or where two
 * faces meet at more than 20 degrees, are drawn, so a meshed cylinder shows its rims and not its
 * triangles. */
typedef struct render_walls {
    size_t vertex_count;
    const double *vertex; /* m, x y z x y z ... */
    size_t face_count;
    int corners;           /* per face: 3 or 4 (planar quads) */
    const uint32_t *index; /* `corners` vertex numbers per face, in order around it */
    render_rgb colour;
    double opacity; /* 0: edges only, 0.1 to 0.3 reads well, 1: hides what is behind */
    double edge_px; /* width of the edges in picture pixels, 0: none */
    render_rgb edge_colour;
} render_walls;

typedef enum render_width { RENDER_PIXELS, RENDER_METRES } render_width;

/* Straight segments with round ends: force chains, tracks, arrows, axes. */
typedef struct render_lines {
    size_t count;
    const double *from, *to;  /* m, x y z x y z ... */
    const double *width;      /* one per segment, >= 0, in `unit`; NULL: 1.5 px */
    const render_rgb *colour; /* one per segment; NULL: near-black */
    render_width unit;        /* of width; metres are scaled at the depth of the segment's middle */
    double opacity;           /* 0 to 1; 0 means 1 */
    bool on_top;              /* true: not hidden by spheres (force chains inside a bed) */
} render_lines;

typedef struct render_scene {
    render_spheres spheres;
    size_t walls_count;
    const render_walls *walls;
    size_t lines_count;
    const render_lines *lines;
} render_scene;

/* The smallest box around everything; an empty scene gives zeros. */
void render_scene_bounds(const render_scene *scene, double low[3], double high[3]);

/* ---- Camera ---- */

typedef enum render_projection { RENDER_ORTHOGRAPHIC, RENDER_PERSPECTIVE } render_projection;

typedef struct render_camera {
    render_projection projection;
    double eye[3];    /* m */
    double target[3]; /* m; != eye */
    double up[3];     /* not along the line of sight; need not be unit or exactly upright */
    double height_m;  /* orthographic: what the full picture height spans, m */
    double angle_deg; /* perspective: what the full picture height spans, 0 to 170 */
    double shift_x,
        shift_y; /* target is drawn this far right / up of the centre, fraction of the picture */
} render_camera;

/* Room kept free around the particles, picture pixels. */
typedef struct render_margins {
    double left, right, top, bottom;
} render_margins;

/* From where to look when a camera is fitted to a box. */
typedef struct render_view {
    render_projection projection;
    double direction[3]; /* the line of sight, any length */
    double up[3];
    double angle_deg; /* perspective only, 0 to 170 */
    render_margins margins;
} render_view;

/* Orthographic, along +y with z up (the front view of a bed in the xz plane), margins of 24 px. */
render_view render_view_default(void);

/* The camera that shows the box low..high as large as the margins allow, in a picture of that size.
 */
RENDER_MUST_CHECK render_status render_camera_fit(render_camera *camera, const render_view *view,
                                                  const double low[3], const double high[3],
                                                  int width, int height);
RENDER_MUST_CHECK render_status render_camera_fit_scene(render_camera *camera,
                                                        const render_view *view,
                                                        const render_scene *scene, int width,
                                                        int height);

/* Where a world point falls in a picture: pixels from the top left corner, and the depth along the
 * line of sight in m. False if it lies behind a perspective camera. */
bool render_camera_project(const render_camera *camera, int width, int height,
                           const double point[3], double pixel[2], double *depth_m);

/* Pixels per metre at the depth of the target (everywhere, if orthographic): for scale bars. */
double render_camera_scale(const render_camera *camera, int height);

/* ---- Canvas: the thing that draws ---- */

/* RENDER_DRAFT: one sample per pixel, plain outline; for watching a run.
 * RENDER_FINAL: 2 x 2 samples per pixel, smooth outline; for papers and animations. */
typedef enum render_preset { RENDER_DRAFT, RENDER_FINAL } render_preset;

typedef struct render_canvas_def {
    int width, height;      /* picture pixels, 1 to 8192 each */
    int samples;            /* per pixel and direction: 1 or 2 */
    double outline;         /* darkness where the body changes, 0 (none) to 1 (black) */
    double outline_fade_px; /* bodies of smaller radius have a weaker outline, > 0 */
    double ambient;         /* light in the shade, 0.35 to 1 */
    render_rgb background;
    bool cull;           /* skip hidden spheres beforehand; the picture is the same to the byte */
    const char *backend; /* "auto", "osmesa" or "egl" */
    uint32_t magic;      /* set by render_canvas_default(); catches a def built by hand */
} render_canvas_def;

/* 1280 x 720, white, "auto", cull on. */
render_canvas_def render_canvas_default(render_preset preset);

/* An RGB picture, rows from the top, 3 bytes per pixel without padding. {0} is a valid empty one.
 */
typedef struct render_image {
    int width, height;
    uint8_t *rgb;
} render_image;

/* Gives the image that size, white; keeps its memory if it already has the size. */
RENDER_MUST_CHECK render_status render_image_resize(render_image *image, int width, int height);
void render_image_free(render_image *image);

/* What the last frame cost, s, and how many spheres it kept. */
typedef struct render_timing {
    double prepare_s; /* checks, projection, sort, cull */
    double draw_s;    /* OpenGL, until the last pixel is done */
    double read_s;    /* read-back */
    double resolve_s; /* outline and averaging to the final pixels */
    size_t spheres_drawn;
} render_timing;

typedef struct render_canvas render_canvas;

/* Sets LP_NUM_THREADS (llvmpipe's worker threads) to the number of cores, and asks Mesa for
 * software rendering, unless the environment says otherwise already; so call it before starting
 * threads that read the environment. */
RENDER_MUST_CHECK render_status render_canvas_new(const render_canvas_def *def,
                                                  render_canvas **canvas);

/* Draws into `image`, which is given the size of the canvas. Refused, with the index in the text:
 * not finite numbers, radii <= 0, negative bodies, vertex numbers out of range. Spheres that
 * contain the eye of a perspective camera, or lie behind it, are left out. */
RENDER_MUST_CHECK render_status render_canvas_draw(render_canvas *canvas, const render_scene *scene,
                                                   const render_camera *camera,
                                                   render_image *image);
render_timing render_canvas_timing(const render_canvas *canvas);
const char *render_canvas_backend(const render_canvas *canvas);  /* "osmesa" or "egl" */
void render_canvas_free(render_canvas *canvas);                  /* NULL is fine */

/* ---- Overlay: labels ---- */

enum { RENDER_TEXT_MAX = 96, RENDER_LEGEND_MAX = 8, RENDER_NOTES_MAX = 8 };

typedef struct render_legend_entry {
    render_rgb colour;
    char label[RENDER_TEXT_MAX];
} render_legend_entry;

typedef struct render_note {
    double x, y; /* picture pixels from the top left, of the left end of the baseline */
    char text[RENDER_TEXT_MAX];
} render_note;

/* Everything written on a picture. All text is UTF-8, longer text is cut off. A plain value: it may
 * be copied, and an encoder keeps its own copy. {0} draws nothing. Title and time stand in the top
 * margin, the scale bar in the bottom margin, colour bar and legend in the right margin. */
typedef struct render_overlay {
    char title[RENDER_TEXT_MAX];
    bool time_shown;
    double time_s;
    int time_decimals; /* digits after the point, 0 to 9 */

    double scale_px_per_m; /* from render_camera_scale(); 0: no scale bar */
    double scale_m;        /* length of the bar; 0: a round length near a sixth of the picture */

    bool bar_shown;
    render_map bar_map;
    double bar_low, bar_high; /* low < high */
    char bar_title[RENDER_TEXT_MAX];
    char bar_unit[RENDER_TEXT_MAX]; /* "m/s"; "" if it has none */

    int legend_count; /* 0 to RENDER_LEGEND_MAX */
    char legend_title[RENDER_TEXT_MAX];
    render_legend_entry legend[RENDER_LEGEND_MAX];

    int notes_count; /* 0 to RENDER_NOTES_MAX */
    render_note notes[RENDER_NOTES_MAX];

    double text_px; /* font size; 0: a 40th of the picture height (less if tall), at least 11 */
    bool dark_background; /* true: light ink */
} render_overlay;

/* Fills the legend with the three velocity bands of render_colour_bands(), fastest first. */
void render_overlay_bands(render_overlay *overlay, double fastest);

typedef struct render_font render_font;

/* NULL looks into CLAST_FONT and then the usual places of DejaVu Sans. A bold face beside it
 * (`*-Bold.ttf`) is used for titles when there. */
RENDER_MUST_CHECK render_status render_font_open(const char *path, render_font **font);
void render_font_close(render_font *font); /* NULL is fine */

/* The margins that keep the particles clear of the overlay, for render_view.margins. */
RENDER_MUST_CHECK render_status render_overlay_margins(render_font *font,
                                                       const render_overlay *overlay, int width,
                                                       int height, render_margins *margins);
RENDER_MUST_CHECK render_status render_overlay_draw(render_font *font,
                                                    const render_overlay *overlay,
                                                    render_image *image);

/* ---- Files ---- */

/* Metadata of a picture: becomes a PNG text chunk. */
typedef struct render_tag {
    const char
        *key; /* 1 to 79 characters of ASCII; "Title", "Software" and "Source" are customary */
    const char *text; /* UTF-8 */
} render_tag;

/* Writes to `path`.part and renames: `path` is the old file or the whole new one. */
RENDER_MUST_CHECK render_status render_png_write(const char *path, const render_image *image,
                                                 const render_tag *tags, size_t tag_count);

/* A background thread that labels and writes a sequence of pictures while the next one is drawn. */
typedef struct render_encoder_def {
    const char *folder; /* must exist */
    const char *stem;   /* files are folder/stem-000000.png and so on */
    int first;          /* number of the first picture, >= 0 */
    int queue;          /* pictures that may wait, >= 1; push blocks when it is full */
    const char *font;   /* path, or NULL: see render_font_open(); needed for labels only */
    uint32_t magic;     /* set by render_encoder_default() */
} render_encoder_def;

/* Stem "frame", first 0, queue of 3; the caller sets the folder. */
render_encoder_def render_encoder_default(void);

typedef struct render_encoder render_encoder;

RENDER_MUST_CHECK render_status render_encoder_new(const render_encoder_def *def,
                                                   render_encoder **encoder);

/* Copies the picture, overlay (NULL: none) and tags, and returns; pictures are numbered in the
 * order of the calls. The first failure of the thread is returned by every later push and by
 * finish, and the pictures after it are not written. */
RENDER_MUST_CHECK render_status render_encoder_push(render_encoder *encoder,
                                                    const render_image *image,
                                                    const render_overlay *overlay,
                                                    const render_tag *tags, size_t tag_count);

/* Waits until all is on disk, frees the encoder, returns its first failure. */
RENDER_MUST_CHECK render_status render_encoder_finish(render_encoder *encoder);

/* What the thread spent so far on labels and on PNG, s, and the number of pictures written. */
typedef struct render_encoder_timing {
    double label_s, png_s;
    int written;
} render_encoder_timing;
render_encoder_timing render_encoder_times(render_encoder *encoder);

typedef struct render_movie_def {
    const char *folder; /* of the sequence, as given to the encoder */
    const char *stem;
    int first;
    double frames_per_s; /* > 0 */
    int quality;         /* 0 (lossless) to 51 (worst); 18 is good to the eye */
    const char *path;    /* the .mp4 to write; replaced only when the new one is whole */
    uint32_t magic;      /* set by render_movie_default() */
} render_movie_def;

/* Stem "frame", first 0, 25 frames/s, quality 18. */
render_movie_def render_movie_default(void);

/* Runs ffmpeg (H.264, yuv420p, plays in every browser). RENDER_ERR_UNAVAILABLE without ffmpeg on
 * PATH. */
RENDER_MUST_CHECK render_status render_movie_make(const render_movie_def *def);

#endif
