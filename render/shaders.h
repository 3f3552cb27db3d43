/* shaders.h: the GLSL of the three things that are drawn. A prelude defines PERSPECTIVE as 0 or 1.
 * Uniforms have fixed locations, the same in all of them. */
#ifndef RENDER_SHADERS_H
#define RENDER_SHADERS_H

enum {
    RENDER_AT_LENS = 0,   /* vec4: x scale, y scale, x shift, y shift, to clip coordinates */
    RENDER_AT_DEPTHS = 1, /* vec2: nearest depth, 1 / range */
    RENDER_AT_AMBIENT = 2 /* float */
};

extern const char RENDER_SHADER_COMMON[]; /* to be put before each of the bodies below */
extern const char RENDER_BALL_VERTEX[], RENDER_BALL_FRAGMENT[];
extern const char RENDER_FACE_VERTEX[], RENDER_FACE_FRAGMENT[];
extern const char RENDER_LINE_VERTEX[], RENDER_LINE_FRAGMENT[];

#endif
