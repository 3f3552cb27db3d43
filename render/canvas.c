#include "render/clock.h"
#include "render/cull.h"
#include "render/gl.h"
#include "render/resolve.h"
#include "render/scene.h"
#include "render/shaders.h"
#include "render/status.h"
#include "render/strokes.h"

#include <stdio.h>
#include <stdlib.h>

enum { MAGIC = 0x63616e76, MAX_SIDE = 8192, CELL_PX = 2 };

/* One program per thing and projection; the projection is the index. */
typedef struct programs {
    GLuint ball[2], face[2], line[2];
} programs;

struct render_canvas {
    render_canvas_def def;
    render_context *context;
    render_gl gl;
    programs program;
    GLuint frame, colour, body, depth; /* framebuffer and its renderbuffers */
    GLuint vertices, buffer; /* an empty vertex array; the storage that shaders pull from */
    int width, height;       /* samples */
    render_cull cull;
    render_strokes strokes;
    uint32_t *read; /* colours, body numbers, then scratch for the resolve */
    render_timing timing;
};

render_canvas_def render_canvas_default(render_preset preset) {
    return (render_canvas_def){
        .width = 1280,
        .height = 720,
        .samples = preset == RENDER_FINAL ? 2 : 1,
        .outline = preset == RENDER_FINAL ? 0.8 : 0.6,
        .outline_fade_px = 4,
        .ambient = 0.5,
        .background = {255, 255, 255},
        .cull = true,
        .backend = "auto",
        .magic = MAGIC,
    };
}

static render_status check_def(const render_canvas_def *d) {
    RENDER_ASSERT(d->magic == MAGIC);
    if (d->width < 1 || d->height < 1 || d->width > MAX_SIDE || d->height > MAX_SIDE)
        return render_fail(RENDER_ERR_ARGUMENT,
                           "canvas of %d x %d pixels, expected 1 to %d in each direction", d->width,
                           d->height, MAX_SIDE);
    if (d->samples != 1 && d->samples != 2)
        return render_fail(RENDER_ERR_ARGUMENT, "canvas: %d samples, expected 1 or 2", d->samples);
    if (!(d->outline >= 0 && d->outline <= 1) || !(d->outline_fade_px > 0))
        return render_fail(RENDER_ERR_ARGUMENT,
                           "canvas: outline %g (expected 0 to 1) fading below %g px (expected > 0)",
                           d->outline, d->outline_fade_px);
    if (!(d->ambient >= 0.35 && d->ambient <= 1))
        return render_fail(RENDER_ERR_ARGUMENT, "canvas: ambient light %g, expected 0.35 to 1",
                           d->ambient);
    if (!d->backend) return render_fail(RENDER_ERR_ARGUMENT, "canvas: no backend named");
    return RENDER_OK;
}

static render_status make_programs(render_canvas *c) {
    const struct {
        const char *name, *vertex, *fragment;
        GLuint *program;
    } kinds[] = {
        {"ball", RENDER_BALL_VERTEX, RENDER_BALL_FRAGMENT, c->program.ball},
        {"face", RENDER_FACE_VERTEX, RENDER_FACE_FRAGMENT, c->program.face},
        {"line", RENDER_LINE_VERTEX, RENDER_LINE_FRAGMENT, c->program.line},
    };
    for (int perspective = 0; perspective < 2; perspective++) {
        char prelude[1024];
        snprintf(prelude, sizeof prelude, "#define PERSPECTIVE %d\n%s", perspective,
                 RENDER_SHADER_COMMON);
        for (int k = 0; k < 3; k++) {
            render_status status =
                render_gl_program(&c->gl, kinds[k].name, prelude, kinds[k].vertex,
                                  kinds[k].fragment, &kinds[k].program[perspective]);
            if (status != RENDER_OK) return status;
        }
    }
    return RENDER_OK;
}

static void attach(const render_gl *gl, GLuint *buffer, GLenum format, GLenum point, int width,
                   int height) {
    gl->GenRenderbuffers(1, buffer);
    gl->BindRenderbuffer(GL_RENDERBUFFER, *buffer);
    gl->RenderbufferStorage(GL_RENDERBUFFER, format, width, height);
    gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, point, GL_RENDERBUFFER, *buffer);
}

static render_status make_frame(render_canvas *c) {
    const render_gl *gl = &c->gl;
    if (c->width > gl->max_size || c->height > gl->max_size)
        return render_fail(RENDER_ERR_GL, "OpenGL draws at most %d pixels a side, %d x %d needed",
                           (int)gl->max_size, c->width, c->height);
    gl->GenFramebuffers(1, &c->frame);
    gl->BindFramebuffer(GL_FRAMEBUFFER, c->frame);
    attach(gl, &c->colour, GL_RGBA8, GL_COLOR_ATTACHMENT0, c->width, c->height);
    attach(gl, &c->body, GL_R32UI, GL_COLOR_ATTACHMENT1, c->width, c->height);
    attach(gl, &c->depth, GL_DEPTH_COMPONENT32F, GL_DEPTH_ATTACHMENT, c->width, c->height);
    GLenum complete = gl->CheckFramebufferStatus(GL_FRAMEBUFFER);
    if (complete != GL_FRAMEBUFFER_COMPLETE)
        return render_fail(RENDER_ERR_GL, "OpenGL framebuffer is incomplete (0x%x)", complete);
    gl->DrawBuffers(2, (const GLenum[]){GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1});
    gl->GenVertexArrays(1, &c->vertices);
    gl->GenBuffers(1, &c->buffer);
    return render_gl_check(gl, "making the framebuffer");
}

/* With the context current. */
static render_status set_up(render_canvas *c) {
    render_status status = render_gl_load(&c->gl, c->context);
    if (status == RENDER_OK) status = make_programs(c);
    if (status == RENDER_OK) status = make_frame(c);
    return status;
}

render_status render_canvas_new(const render_canvas_def *def, render_canvas **canvas) {
    RENDER_ASSERT(def && canvas);
    *canvas = NULL;
    render_status status = check_def(def);
    if (status != RENDER_OK) return status;
    render_canvas *c = calloc(1, sizeof *c);
    if (!c) return render_fail(RENDER_ERR_MEMORY, "no memory for a canvas");
    c->def = *def;
    c->def.backend = NULL; /* the caller's string; render_canvas_backend() knows the real one */
    c->width = def->width * def->samples;
    c->height = def->height * def->samples;
    size_t samples = (size_t)c->width * (size_t)c->height;
    c->read = malloc((2 * samples + 4 * (size_t)c->width) * sizeof *c->read);
    status = c->read ? render_context_open(def->backend, &c->context)
                     : render_fail(RENDER_ERR_MEMORY, "no memory for %d x %d samples", c->width,
                                   c->height);
    if (status == RENDER_OK) status = render_context_bind(c->context, true);
    if (status == RENDER_OK) {
        status = set_up(c);
        render_status unbound = render_context_bind(c->context, false);
        if (status == RENDER_OK) status = unbound;
    }
    if (status == RENDER_OK)
        *canvas = c;
    else
        render_canvas_free(c);
    return status;
}

static void delete_objects(render_canvas *c) {
    const render_gl *gl = &c->gl;
    if (!gl->DeleteFramebuffers) return; /* the functions were never loaded */
    gl->DeleteFramebuffers(1, &c->frame);
    gl->DeleteRenderbuffers(3, (const GLuint[]){c->colour, c->body, c->depth});
    gl->DeleteBuffers(1, &c->buffer);
    gl->DeleteVertexArrays(1, &c->vertices);
    for (int k = 0; k < 2; k++) {
        gl->DeleteProgram(c->program.ball[k]);
        gl->DeleteProgram(c->program.face[k]);
        gl->DeleteProgram(c->program.line[k]);
    }
}

void render_canvas_free(render_canvas *canvas) {
    if (!canvas) return;
    if (canvas->context) {
        if (render_context_bind(canvas->context, true) == RENDER_OK) {
            delete_objects(canvas);
            (void)render_context_bind(canvas->context, false); /* it is closed next either way */
        }
        render_context_close(canvas->context);
    }
    render_cull_free(&canvas->cull);
    render_strokes_free(&canvas->strokes);
    free(canvas->read);
    free(canvas);
}

/* ---- One frame ---- */

static render_status prepare(render_canvas *c, const render_scene *scene, const render_lens *lens) {
    render_cull_def cull = {.occlusion = c->def.cull,
                            .cell_px = CELL_PX * c->def.samples,
                            .outline = c->def.outline,
                            .outline_fade_px = c->def.outline_fade_px * c->def.samples};
    render_status status = render_cull_spheres(&c->cull, &scene->spheres, lens, &cull);
    if (status == RENDER_OK)
        status = render_strokes_build(&c->strokes, scene, lens, c->def.samples);
    return status;
}

static void clear(const render_canvas *c) {
    const render_gl *gl = &c->gl;
    render_rgb b = c->def.background;
    gl->BindFramebuffer(GL_FRAMEBUFFER, c->frame);
    gl->Viewport(0, 0, c->width, c->height);
    gl->BindVertexArray(c->vertices);
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthFunc(GL_LESS);
    gl->DepthMask(GL_TRUE);
    gl->Disablei(GL_BLEND, 0);
    gl->ColorMaski(1, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->ClearBufferfv(GL_COLOR, 0,
                      (const GLfloat[]){b.r / 255.0f, b.g / 255.0f, b.b / 255.0f, 0.0f});
    gl->ClearBufferuiv(GL_COLOR, 1, (const GLuint[]){0, 0, 0, 0});
    gl->ClearBufferfv(GL_DEPTH, 0, (const GLfloat[]){1.0f});
}

/* Uniforms of the projection; for lines, which come in pixels, see the shader. */
static void use(const render_canvas *c, const GLuint program[2], const render_lens *lens,
                const double depths[2], bool in_pixels) {
    const render_gl *gl = &c->gl;
    double to_x = 2.0 / c->width, to_y = 2.0 / c->height;
    double by = in_pixels ? 1 : lens->scale;
    gl->UseProgram(program[lens->perspective]);
    gl->Uniform4f(RENDER_AT_LENS, (float)(by * to_x), (float)(by * to_y),
                  (float)(lens->centre_x * to_x - 1), (float)(lens->centre_y * to_y - 1));
    gl->Uniform2f(RENDER_AT_DEPTHS, (float)depths[0], (float)(1 / (depths[1] - depths[0])));
}

static render_status upload(const render_canvas *c, const void *data, size_t bytes) {
    const render_gl *gl = &c->gl;
    if (bytes > (size_t)gl->max_bytes)
        return render_fail(RENDER_ERR_GL, "%zu bytes to draw at once, OpenGL takes %zu", bytes,
                           (size_t)gl->max_bytes);
    gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, c->buffer);
    gl->BufferData(GL_SHADER_STORAGE_BUFFER, (GLsizeiptr)bytes, data, GL_STREAM_DRAW);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, c->buffer);
    return RENDER_OK;
}

static render_status draw_balls(const render_canvas *c, const render_lens *lens,
                                const double depths[2]) {
    size_t count = c->cull.drawn;
    if (count == 0) return RENDER_OK;
    render_status status = upload(c, c->cull.sorted, count * sizeof *c->cull.sorted);
    if (status != RENDER_OK) return status;
    use(c, c->program.ball, lens, depths, false);
    c->gl.Uniform1f(RENDER_AT_AMBIENT, (float)c->def.ambient);
    c->gl.DrawArrays(GL_TRIANGLES, 0, (GLsizei)(3 * count));
    return RENDER_OK;
}

/* Walls and lines go over the spheres, and fade the outlines that they cover (in alpha) alike. */
static void blend_over(const render_gl *gl) {
    gl->ColorMaski(1, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    gl->Enablei(GL_BLEND, 0);
    gl->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE_MINUS_SRC_ALPHA);
}

static render_status draw_faces(const render_canvas *c, const render_lens *lens,
                                const double depths[2]) {
    const render_strokes *st = &c->strokes;
    if (st->corners == 0) return RENDER_OK;
    render_status status = upload(c, st->corner, st->corners * sizeof *st->corner);
    if (status != RENDER_OK) return status;
    use(c, c->program.face, lens, depths, false);
    c->gl.DrawArrays(GL_TRIANGLES, 0, (GLsizei)st->opaque_corners);
    c->gl.DepthMask(GL_FALSE);
    c->gl.DrawArrays(GL_TRIANGLES, (GLint)st->opaque_corners,
                     (GLsizei)(st->corners - st->opaque_corners));
    return RENDER_OK;
}

static render_status draw_segments(const render_canvas *c, const render_lens *lens,
                                   const double depths[2]) {
    const render_strokes *st = &c->strokes;
    if (st->segments == 0) return RENDER_OK;
    render_status status = upload(c, st->segment, st->segments * sizeof *st->segment);
    if (status != RENDER_OK) return status;
    use(c, c->program.line, lens, depths, true);
    c->gl.DepthMask(GL_FALSE);
    c->gl.DrawArrays(GL_TRIANGLES, 0, (GLsizei)(6 * st->hidden_segments));
    c->gl.Disable(GL_DEPTH_TEST);
    c->gl.DrawArrays(GL_TRIANGLES, (GLint)(6 * st->hidden_segments),
                     (GLsizei)(6 * (st->segments - st->hidden_segments)));
    return RENDER_OK;
}

static render_status draw(render_canvas *c, const render_scene *scene, const render_lens *lens) {
    double depths[2];
    render_scene_depths(scene, lens, &depths[0], &depths[1]);
    clear(c);
    render_status status = draw_balls(c, lens, depths);
    blend_over(&c->gl);
    if (status == RENDER_OK) status = draw_faces(c, lens, depths);
    if (status == RENDER_OK) status = draw_segments(c, lens, depths);
    if (status != RENDER_OK) return status;
    c->gl.Finish();
    return render_gl_check(&c->gl, "drawing");
}

static render_status read_back(render_canvas *c, render_samples *samples) {
    const render_gl *gl = &c->gl;
    size_t count = (size_t)c->width * (size_t)c->height;
    gl->PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl->ReadBuffer(GL_COLOR_ATTACHMENT0);
    gl->ReadPixels(0, 0, c->width, c->height, GL_RGBA, GL_UNSIGNED_BYTE, c->read);
    gl->ReadBuffer(GL_COLOR_ATTACHMENT1);
    gl->ReadPixels(0, 0, c->width, c->height, GL_RED_INTEGER, GL_UNSIGNED_INT, c->read + count);
    *samples = (render_samples){.width = c->width,
                                .height = c->height,
                                .per_pixel = c->def.samples,
                                .rgba = c->read,
                                .body = c->read + count,
                                .scratch = c->read + 2 * count};
    return render_gl_check(gl, "reading the picture back");
}

/* The part of a frame that needs the context. */
static render_status draw_and_read(render_canvas *c, const render_scene *scene,
                                   const render_lens *lens, render_samples *samples) {
    render_status status = render_context_bind(c->context, true);
    if (status != RENDER_OK) return status;
    double start = render_clock_s();
    status = draw(c, scene, lens);
    double drawn = render_clock_s();
    if (status == RENDER_OK) status = read_back(c, samples);
    c->timing.draw_s = drawn - start;
    c->timing.read_s = render_clock_s() - drawn;
    render_status unbound = render_context_bind(c->context, false);
    return status == RENDER_OK ? unbound : status;
}

render_status render_canvas_draw(render_canvas *canvas, const render_scene *scene,
                                 const render_camera *camera, render_image *image) {
    RENDER_ASSERT(canvas && scene && camera && image);
    render_lens lens;
    render_samples samples;
    double start = render_clock_s();
    render_status status = render_scene_check(scene);
    if (status == RENDER_OK)
        status = render_lens_make(&lens, camera, canvas->width, canvas->height);
    if (status == RENDER_OK)
        status = render_image_resize(image, canvas->def.width, canvas->def.height);
    if (status == RENDER_OK) status = prepare(canvas, scene, &lens);
    if (status != RENDER_OK) return status;
    canvas->timing.prepare_s = render_clock_s() - start;
    status = draw_and_read(canvas, scene, &lens, &samples);
    if (status != RENDER_OK) return status;
    double resolving = render_clock_s();
    render_resolve(&samples, image);
    canvas->timing.resolve_s = render_clock_s() - resolving;
    canvas->timing.spheres_drawn = canvas->cull.drawn;
    return RENDER_OK;
}

render_timing render_canvas_timing(const render_canvas *canvas) {
    RENDER_ASSERT(canvas);
    return canvas->timing;
}

const char *render_canvas_backend(const render_canvas *canvas) {
    RENDER_ASSERT(canvas);
    return render_context_name(canvas->context);
}
