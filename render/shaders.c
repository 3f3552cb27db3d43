/* View coordinates in all shaders: x right, y up, z = distance ahead. Depth is linear in z, in both
 * projections: every shader writes it, and a 32-bit float then resolves 1e-7 of the scene. */
#include "render/shaders.h"

const char RENDER_SHADER_COMMON[] =
    "layout(location = 0) uniform vec4 lens;\n"
    "layout(location = 1) uniform vec2 depths;\n"
    "layout(location = 2) uniform float ambient;\n"
    "float depth_of(float z) { return (z - depths.x) * depths.y; }\n"
    "vec4 project(vec3 view) {\n"
    "#if PERSPECTIVE\n"
    /* z = 0 lies inside the clip volume wherever w > 0: there is no near or far plane to tune */
    "    return vec4(view.xy * lens.xy + lens.zw * view.z, 0.0, view.z);\n"
    "#else\n"
    "    return vec4(view.xy * lens.xy + lens.zw, 0.0, 1.0);\n"
    "#endif\n"
    "}\n";

/* One triangle around each sphere: around its disc (orthographic) or around the cone that touches
 * it, cut through its centre (perspective). A thousandth larger, so that rounding takes nothing
 * away. */
const char RENDER_BALL_VERTEX[] =
    "struct Ball { vec4 place; uint rgba; uint body; uint unused0; uint unused1; };\n"
    "layout(std430, binding = 0) readonly buffer Balls { Ball ball[]; };\n"
    "flat out vec4 colour;\n"
    "flat out uint body;\n"
    "#if PERSPECTIVE\n"
    "flat out vec4 place;\n"
    "out vec3 ray;\n"
    "#else\n"
    "flat out vec2 depth;\n"
    "out vec2 at;\n"
    "#endif\n"
    "const vec2 CORNER[3] = vec2[3](vec2(0.0, 2.002), vec2(-1.7338, -1.001),\n"
    "                               vec2(1.7338, -1.001));\n"
    "void main() {\n"
    "    Ball b = ball[gl_VertexID / 3];\n"
    "    vec2 corner = CORNER[gl_VertexID % 3];\n"
    "    colour = unpackUnorm4x8(b.rgba);\n"
    "    body = b.body;\n"
    "#if PERSPECTIVE\n"
    "    float away = dot(b.place.xyz, b.place.xyz);\n"
    "    vec3 sight = b.place.xyz * inversesqrt(away);\n"
    "    vec3 across = normalize(abs(sight.y) < 0.9 ? vec3(sight.z, 0.0, -sight.x)\n"
    "                                               : vec3(0.0, -sight.z, sight.y));\n"
    "    float wide = b.place.w * inversesqrt(1.0 - b.place.w * b.place.w / away);\n"
    "    place = b.place;\n"
    "    ray = b.place.xyz + wide * (corner.x * across + corner.y * cross(sight, across));\n"
    "    gl_Position = project(ray);\n"
    "#else\n"
    "    depth = vec2(depth_of(b.place.z), b.place.w * depths.y);\n"
    "    at = corner;\n"
    "    gl_Position = project(vec3(b.place.xy + b.place.w * corner, b.place.z));\n"
    "#endif\n"
    "}\n";

/* A soft key light from the upper left that wraps around the sphere (no hard terminator), over an
 * ambient floor. No highlight: it would bleach the colour that carries the value. */
const char RENDER_BALL_FRAGMENT[] =
    "flat in vec4 colour;\n"
    "flat in uint body;\n"
    "#if PERSPECTIVE\n"
    "flat in vec4 place;\n"
    "in vec3 ray;\n"
    "#else\n"
    "flat in vec2 depth;\n"
    "in vec2 at;\n"
    "#endif\n"
    "layout(location = 0) out vec4 pixel;\n"
    "layout(location = 1) out uint owner;\n"
    "void main() {\n"
    "#if PERSPECTIVE\n"
    "    vec3 sight = normalize(ray);\n"
    "    float along = dot(sight, place.xyz);\n"
    "    vec3 off = along * sight - place.xyz;\n"
    "    float square = place.w * place.w - dot(off, off);\n"
    "    if (square < 0.0) discard;\n"
    "    vec3 hit = (along - sqrt(square)) * sight;\n"
    "    if (hit.z <= 0.0) discard;\n"
    "    vec3 normal = (hit - place.xyz) / place.w;\n"
    "    gl_FragDepth = depth_of(hit.z);\n"
    "#else\n"
    "    float square = 1.0 - dot(at, at);\n"
    "    if (square < 0.0) discard;\n"
    "    vec3 normal = vec3(at, -sqrt(square));\n"
    "    gl_FragDepth = depth.x + depth.y * normal.z;\n"
    "#endif\n"
    "    float key = 0.5 + 0.5 * dot(normal, vec3(-0.43, 0.62, -0.656));\n"
    "    key *= key;\n"
    "    pixel = vec4(colour.rgb * (ambient + (1.0 - ambient) * key), colour.a);\n"
    "    owner = body;\n"
    "}\n";

const char RENDER_FACE_VERTEX[] =
    "struct Corner { vec4 place; };\n" /* view coordinates; w holds the bits of the colour */
    "layout(std430, binding = 0) readonly buffer Corners { Corner corner[]; };\n"
    "flat out vec4 colour;\n"
    "out float z;\n"
    "void main() {\n"
    "    Corner c = corner[gl_VertexID];\n"
    "    colour = unpackUnorm4x8(floatBitsToUint(c.place.w));\n"
    "    z = c.place.z;\n"
    "    gl_Position = project(c.place.xyz);\n"
    "}\n";

const char RENDER_FACE_FRAGMENT[] = "flat in vec4 colour;\n"
                                    "in float z;\n"
                                    "layout(location = 0) out vec4 pixel;\n"
                                    "void main() {\n"
                                    "    gl_FragDepth = depth_of(z);\n"
                                    "    pixel = colour;\n"
                                    "}\n";

/* Lines come in drawn pixels: a quad around the segment, and the fragment measures its distance,
 * which gives round ends and smooth borders. lens.xy holds 2 / size here. */
const char RENDER_LINE_VERTEX[] =
    "struct Line { vec4 from; vec4 to; };\n" /* x y z and: half width, bits of the colour */
    "layout(std430, binding = 0) readonly buffer Lines { Line line[]; };\n"
    "flat out vec4 colour;\n"
    "flat out vec4 from;\n"
    "flat out vec3 to;\n"
    "const vec2 CORNER[6] = vec2[6](vec2(-1.0, -1.0), vec2(1.0, -1.0), vec2(1.0, 1.0),\n"
    "                               vec2(-1.0, -1.0), vec2(1.0, 1.0), vec2(-1.0, 1.0));\n"
    "void main() {\n"
    "    Line l = line[gl_VertexID / 6];\n"
    "    vec2 corner = CORNER[gl_VertexID % 6];\n"
    "    vec2 span = l.to.xy - l.from.xy;\n"
    "    float far = length(span);\n"
    "    vec2 along = far > 0.0 ? span / far : vec2(1.0, 0.0);\n"
    "    float reach = l.from.w + 1.0;\n"
    "    vec2 end = corner.x < 0.0 ? l.from.xy : l.to.xy;\n"
    "    vec2 at = end + reach * (corner.x * along + corner.y * vec2(-along.y, along.x));\n"
    "    colour = unpackUnorm4x8(floatBitsToUint(l.to.w));\n"
    "    from = l.from;\n"
    "    to = l.to.xyz;\n"
    "    gl_Position = vec4(at * lens.xy - 1.0, 0.0, 1.0);\n"
    "}\n";

const char RENDER_LINE_FRAGMENT[] =
    "flat in vec4 colour;\n"
    "flat in vec4 from;\n"
    "flat in vec3 to;\n"
    "layout(location = 0) out vec4 pixel;\n"
    "void main() {\n"
    "    vec2 span = to.xy - from.xy;\n"
    "    vec2 here = gl_FragCoord.xy - from.xy;\n"
    "    float t = clamp(dot(here, span) / max(dot(span, span), 1e-12), 0.0, 1.0);\n"
    "    float cover = clamp(from.w + 0.5 - distance(here, t * span), 0.0, 1.0);\n"
    "    cover *= min(1.0, 2.0 * from.w);\n"
    "    if (cover <= 0.0) discard;\n"
    "#if PERSPECTIVE\n"
    "    float z = 1.0 / mix(1.0 / from.z, 1.0 / to.z, t);\n"
    "#else\n"
    "    float z = mix(from.z, to.z, t);\n"
    "#endif\n"
    /* a little nearer, so that the edges of a wall win over the wall */
    "    gl_FragDepth = depth_of(z) - 2e-4;\n"
    "    pixel = vec4(colour.rgb, colour.a * cover);\n"
    "}\n";
