#include "render/gl.h"

#include "render/status.h"

#include <stdio.h>

/* OSMesa and eglGetProcAddress return a stub for any name, so the version decides, not NULL. */
static render_status check_version(const render_gl *gl) {
    GLint64 major = 0, minor = 0;
    gl->GetInteger64v(GL_MAJOR_VERSION, &major);
    gl->GetInteger64v(GL_MINOR_VERSION, &minor);
    if (major < 4 || (major == 4 && minor < 5))
        return render_fail(RENDER_ERR_GL, "OpenGL %d.%d found, 4.5 needed (Mesa 20 or newer)",
                           (int)major, (int)minor);
    return RENDER_OK;
}

render_status render_gl_load(render_gl *gl, const render_context *context) {
    const char *missing = NULL;
#define X(type, name)                                                                              \
    gl->name = (type)render_context_proc(context, "gl" #name);                                     \
    if (!gl->name) missing = "gl" #name;
    RENDER_GL_FUNCTIONS(X)
#undef X
    if (missing) return render_fail(RENDER_ERR_GL, "OpenGL has no %s: 4.5 needed", missing);
    render_status status = check_version(gl);
    if (status != RENDER_OK) return status;
    gl->GetInteger64v(GL_MAX_RENDERBUFFER_SIZE, &gl->max_size);
    gl->GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &gl->max_bytes);
    return RENDER_OK;
}

static render_status compile(const render_gl *gl, GLenum kind, const char *name,
                             const char *prelude, const char *body, GLuint *shader) {
    const char *parts[] = {"#version 450 core\n", prelude, body};
    *shader = gl->CreateShader(kind);
    gl->ShaderSource(*shader, 3, parts, NULL);
    gl->CompileShader(*shader);
    GLint done = 0;
    gl->GetShaderiv(*shader, GL_COMPILE_STATUS, &done);
    if (done) return RENDER_OK;
    char log[512] = "";
    gl->GetShaderInfoLog(*shader, sizeof log, NULL, log);
    return render_fail(RENDER_ERR_GL, "shader %s (%s) does not compile: %s", name,
                       kind == GL_VERTEX_SHADER ? "vertex" : "fragment", log);
}

static render_status link(const render_gl *gl, const char *name, const GLuint shader[2],
                          GLuint *program) {
    *program = gl->CreateProgram();
    gl->AttachShader(*program, shader[0]);
    gl->AttachShader(*program, shader[1]);
    gl->LinkProgram(*program);
    GLint done = 0;
    gl->GetProgramiv(*program, GL_LINK_STATUS, &done);
    if (done) return RENDER_OK;
    char log[512] = "";
    gl->GetProgramInfoLog(*program, sizeof log, NULL, log);
    return render_fail(RENDER_ERR_GL, "program %s does not link: %s", name, log);
}

render_status render_gl_program(const render_gl *gl, const char *name, const char *prelude,
                                const char *vertex, const char *fragment, GLuint *program) {
    RENDER_ASSERT(gl && name && prelude && vertex && fragment && program);
    GLuint shader[2] = {0, 0};
    render_status status = compile(gl, GL_VERTEX_SHADER, name, prelude, vertex, &shader[0]);
    if (status == RENDER_OK)
        status = compile(gl, GL_FRAGMENT_SHADER, name, prelude, fragment, &shader[1]);
    if (status == RENDER_OK) status = link(gl, name, shader, program);
    gl->DeleteShader(shader[0]); /* 0 is ignored */
    gl->DeleteShader(shader[1]);
    return status;
}

render_status render_gl_check(const render_gl *gl, const char *doing) {
    GLenum error = gl->GetError();
    if (error == GL_NO_ERROR) return RENDER_OK;
    const char *meaning = error == GL_OUT_OF_MEMORY ? " (out of memory)" : "";
    return render_fail(RENDER_ERR_GL, "OpenGL error 0x%x%s while %s", error, meaning, doing);
}
