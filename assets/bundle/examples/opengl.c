// Shadow Inspector. No licence has been chosen yet; all rights are the owner's until then.
//
// Draws a small scene with shadow maps of its own in OpenGL and writes the frame as a bundle.
// It needs EGL and libepoxy, but no window:
//
//     cc -std=c99 -I.. opengl.c -o opengl -lepoxy -lm
//     ./opengl frame.bundle --light sun --depth d16
//
// Read write_bundle() first. It has all that an engine adds; the rest is a renderer as others are.
//
// Options:
//     --light sun|spot        a directional light with two cascades in an atlas, or a spot light
//     --depth d16|d32f        d16 is drawn with a polygon offset, d32f without
//     --reversed              reversed depth by glClipControl: the near plane is stored as 1
//     --cull none|back|front  faces of casters that are not drawn into the maps
#include <epoxy/gl.h>
// epoxy/egl.h needs the types of epoxy/gl.h.
#include <epoxy/egl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SHADOW_BUNDLE_IMPLEMENTATION
#include "shadow_bundle.h"

enum { WIDTH = 640, HEIGHT = 360, MAP = 1024, MASK = 64, MAPS = 2, OBJECTS = 5 };

static const float kSplit = 9, kNear = 0.2f, kFar = 40;
static const float kConstantBias = 0.0008f, kNormalBias = 0.02f;

typedef struct {
    int is_sun, is_d16, is_reversed;
    sb_cull cull;
    const char* folder;
} options;

typedef struct {
    float m[16];  // by columns
} matrix;

typedef struct {
    float position[3], normal[3], uv[2];
} vertex;

typedef struct {
    const char* name;
    vertex* vertices;
    int count;  // of vertices: three a triangle
    matrix world;
    float colour[3];
    int masked;
    GLuint array, buffer;
} object;

static void fail(const char* what) {
    (void)fprintf(stderr, "opengl: %s\n", what);
    exit(1);
}

// ---- Matrices -------------------------------------------------------------------------------------------------------

static matrix identity(void) {
    matrix out;
    int i;
    for (i = 0; i < 16; ++i) out.m[i] = i % 5 == 0 ? 1.0f : 0.0f;
    return out;
}

static matrix product(matrix a, matrix b) {
    matrix out;
    int column, row, i;
    for (column = 0; column < 4; ++column)
        for (row = 0; row < 4; ++row) {
            out.m[4 * column + row] = 0;
            for (i = 0; i < 4; ++i) out.m[4 * column + row] += a.m[4 * i + row] * b.m[4 * column + i];
        }
    return out;
}

static float dot(const float* a, const float* b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void normalise(float* a) {
    const float length = sqrtf(dot(a, a));
    int i;
    for (i = 0; i < 3; ++i) a[i] /= length;
}

static void cross(const float* a, const float* b, float* out) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

// Returns view space from world for an eye that looks along a direction: x right, y up, -z forward.
static matrix look_along(const float* eye, const float* direction) {
    static const float up[3] = {0, 1, 0};
    float axes[3][3];
    matrix out = identity();
    int row, column;
    for (row = 0; row < 3; ++row) axes[2][row] = -direction[row];
    normalise(axes[2]);
    cross(up, axes[2], axes[0]);
    normalise(axes[0]);
    cross(axes[2], axes[0], axes[1]);
    for (row = 0; row < 3; ++row) {
        for (column = 0; column < 3; ++column) out.m[4 * column + row] = axes[row][column];
        out.m[12 + row] = -dot(axes[row], eye);
    }
    return out;
}

// Sets the depth row of a projection. Depth runs from -1 to 1, or with reversed depth from 1 to 0.
static matrix with_depth(matrix out, int perspective, float near, float far, int reversed) {
    const float at_near = reversed ? 1.0f : -1.0f, at_far = reversed ? 0.0f : 1.0f;
    if (perspective) {
        out.m[10] = (at_near * near - at_far * far) / (far - near);
        out.m[14] = (at_near - at_far) * near * far / (far - near);
        out.m[11] = -1;
        out.m[15] = 0;
    } else {
        out.m[10] = (at_near - at_far) / (far - near);
        out.m[14] = (at_near * far - at_far * near) / (far - near);
    }
    return out;
}

static matrix perspective(float tangent_x, float tangent_y, float near, float far, int reversed) {
    matrix out = identity();
    out.m[0] = 1 / tangent_x;
    out.m[5] = 1 / tangent_y;
    return with_depth(out, 1, near, far, reversed);
}

static matrix orthographic(float half_width, float near, float far, int reversed) {
    matrix out = identity();
    out.m[0] = 1 / half_width;
    out.m[5] = 1 / half_width;
    return with_depth(out, 0, near, far, reversed);
}

static matrix placed(float x, float y, float z, float angle, float scale) {
    matrix out = identity();
    out.m[0] = out.m[10] = scale * cosf(angle);
    out.m[2] = -scale * sinf(angle);
    out.m[8] = -out.m[2];
    out.m[5] = scale;
    out.m[12] = x;
    out.m[13] = y;
    out.m[14] = z;
    return out;
}

// ---- The scene ------------------------------------------------------------------------------------------------------

// Adds a rectangle, counter-clockwise seen from its front, as two triangles.
static void add_rectangle(object* to, const float* corner, const float* across, const float* up) {
    static const int order[6] = {0, 1, 2, 0, 2, 3};
    float normal[3];
    int i, c;
    cross(across, up, normal);
    normalise(normal);
    to->vertices = (vertex*)realloc(to->vertices, (size_t)(to->count + 6) * sizeof(vertex));
    if (to->vertices == NULL) fail("memory lacks");
    for (i = 0; i < 6; ++i) {
        vertex* const v = &to->vertices[to->count++];
        const float u = order[i] == 1 || order[i] == 2 ? 1.0f : 0.0f, w = order[i] >= 2 ? 1.0f : 0.0f;
        for (c = 0; c < 3; ++c) {
            v->position[c] = corner[c] + u * across[c] + w * up[c];
            v->normal[c] = normal[c];
        }
        v->uv[0] = u;
        v->uv[1] = w;
    }
}

static void add_box(object* to) {
    int axis, side, c;
    for (axis = 0; axis < 3; ++axis)
        for (side = 0; side < 2; ++side) {
            float corner[3], across[3] = {0, 0, 0}, up[3] = {0, 0, 0};
            for (c = 0; c < 3; ++c) corner[c] = -0.5f;
            if (side) corner[axis] = 0.5f;
            across[(axis + (side ? 1 : 2)) % 3] = 1;
            up[(axis + (side ? 2 : 1)) % 3] = 1;
            add_rectangle(to, corner, across, up);
        }
}

static void make_scene(object* scene, uint8_t* mask) {
    static const char* const names[OBJECTS] = {"Ground", "Box", "Turned box", "Pillar", "Fence"};
    static const float colours[OBJECTS][3] = {
        {0.5f, 0.5f, 0.45f}, {0.7f, 0.3f, 0.2f}, {0.2f, 0.45f, 0.7f}, {0.8f, 0.75f, 0.6f}, {0.35f, 0.25f, 0.15f}};
    static const float corner[3] = {-14, 0, 14}, across[3] = {28, 0, 0}, up[3] = {0, 0, -28};
    static const float left[3] = {-2, 0, 0}, right[3] = {2, 0, 0}, along[3] = {4, 0, 0}, back[3] = {-4, 0, 0};
    static const float height[3] = {0, 1.5f, 0};
    int i, x, y;
    memset(scene, 0, OBJECTS * sizeof *scene);
    for (i = 0; i < OBJECTS; ++i) {
        scene[i].name = names[i];
        scene[i].world = identity();
        memcpy(scene[i].colour, colours[i], sizeof colours[i]);
    }
    add_rectangle(&scene[0], corner, across, up);
    for (i = 1; i < 4; ++i) add_box(&scene[i]);
    scene[1].world = placed(-1.6f, 0.5f, 0.4f, 0, 1);
    scene[2].world = placed(1.2f, 0.75f, -1.5f, 0.7f, 1.5f);
    scene[3].world = placed(3.4f, 1.5f, -4, 0.3f, 0.6f);
    scene[3].world.m[5] = 3;
    // Both sides of the fence are surfaces, so that culling never removes it.
    add_rectangle(&scene[4], left, along, height);
    add_rectangle(&scene[4], right, back, height);
    scene[4].world = placed(-1.5f, 0, 2.6f, 0.25f, 1);
    scene[4].masked = 1;
    for (y = 0; y < MASK; ++y)
        for (x = 0; x < MASK; ++x) {
            uint8_t* const texel = mask + 4 * (y * MASK + x);
            const int is_post = x % 16 >= 5 && x % 16 < 11, is_rail = y % 32 >= 12 && y % 32 < 20;
            texel[0] = texel[1] = texel[2] = 255;
            texel[3] = is_post || is_rail ? 255 : 0;
        }
}

// ---- OpenGL ---------------------------------------------------------------------------------------------------------

static void open_context(void) {
    static const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    static const EGLint version[] = {
        EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    EGLConfig config = NULL;
    EGLContext context;
    EGLint count = 0;
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, NULL, NULL)) fail("EGL has no display without a surface");
    if (!eglBindAPI(EGL_OPENGL_API) || !eglChooseConfig(display, wanted, &config, 1, &count) || count == 0)
        fail("EGL has no configuration for OpenGL");
    context = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
    if (context == EGL_NO_CONTEXT || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
        fail("the driver has no OpenGL 4.5");
}

static GLuint compile(GLenum stage, const char* source) {
    const GLuint shader = glCreateShader(stage);
    GLint compiled = 0;
    char log[1024];
    glShaderSource(shader, 1, &source, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (!compiled) {
        glGetShaderInfoLog(shader, sizeof log, NULL, log);
        fail(log);
    }
    return shader;
}

static GLuint link(const char* vertex_source, const char* fragment_source) {
    const GLuint program = glCreateProgram();
    GLint linked = 0;
    glAttachShader(program, compile(GL_VERTEX_SHADER, vertex_source));
    glAttachShader(program, compile(GL_FRAGMENT_SHADER, fragment_source));
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked) fail("a program does not link");
    return program;
}

static const char kVertex[] =
    "#version 450 core\n"
    "layout(location = 0) in vec3 position;\n"
    "layout(location = 1) in vec3 normal;\n"
    "layout(location = 2) in vec2 uv;\n"
    "layout(location = 0) uniform mat4 clip_from_world;\n"
    "layout(location = 1) uniform mat4 world_from_mesh;\n"
    "out vec3 at;\n"
    "out vec3 facing;\n"
    "out vec2 mask_uv;\n"
    "void main() {\n"
    "  vec4 world = world_from_mesh * vec4(position, 1);\n"
    "  at = world.xyz;\n"
    "  facing = inverse(transpose(mat3(world_from_mesh))) * normal;\n"
    "  mask_uv = uv;\n"
    "  gl_Position = clip_from_world * world;\n"
    "}\n";

static const char kCaster[] =
    "#version 450 core\n"
    "layout(binding = 0) uniform sampler2D mask;\n"
    "layout(location = 2) uniform bool masked;\n"
    "in vec2 mask_uv;\n"
    "void main() {\n"
    "  if (masked && texture(mask, mask_uv).a < 0.5) discard;\n"
    "}\n";

// The look-up, which the bundle gets as text.
static const char kLookup[] =
    "float lit(vec3 at, vec3 facing, float depth) {\n"
    "  int map = maps > 1 && depth > split ? 1 : 0;\n"
    "  vec4 clip = light_clip_from_world[map] * vec4(at + normal_bias * facing, 1);\n"
    "  vec3 ndc = clip.xyz / clip.w;\n"
    "  if (any(greaterThan(abs(ndc.xy), vec2(1)))) return 1;\n"
    "  vec2 uv = 0.5 * ndc.xy + 0.5;\n"
    "  float own = reversed ? ndc.z + constant_bias : 0.5 * ndc.z + 0.5 - constant_bias;\n"
    "  return texture(shadow_map, vec3((uv.x + map) / maps, uv.y, own));\n"
    "}\n";

static const char kPictureHead[] =
    "#version 450 core\n"
    "layout(binding = 0) uniform sampler2D mask;\n"
    "layout(binding = 1) uniform sampler2DShadow shadow_map;\n"
    "layout(location = 2) uniform bool masked;\n"
    "layout(location = 3) uniform vec3 colour;\n"
    "layout(location = 4) uniform vec3 sun;\n"
    "layout(location = 5) uniform vec3 place;\n"
    "layout(location = 6) uniform int maps;\n"
    "layout(location = 7) uniform float split;\n"
    "layout(location = 8) uniform bool reversed;\n"
    "layout(location = 9) uniform float constant_bias;\n"
    "layout(location = 10) uniform float normal_bias;\n"
    "layout(location = 11) uniform bool is_sun;\n"
    "layout(location = 12) uniform mat4 light_clip_from_world[2];\n"
    "in vec3 at;\n"
    "in vec3 facing;\n"
    "in vec2 mask_uv;\n"
    "out vec4 result;\n";

static const char kPictureMain[] =
    "void main() {\n"
    "  if (masked && texture(mask, mask_uv).a < 0.5) discard;\n"
    "  vec3 n = normalize(facing);\n"
    "  vec3 to_light = is_sun ? -sun : normalize(place - at);\n"
    "  float cone = is_sun ? 1 : smoothstep(0.75, 0.8, dot(-to_light, sun));\n"
    "  float light = cone * max(dot(n, to_light), 0) * lit(at, n, 1 / gl_FragCoord.w);\n"
    "  result = vec4(pow(colour * (0.25 + 0.75 * light), vec3(1 / 2.2)), 1);\n"
    "}\n";

static void upload(object* scene) {
    int i;
    for (i = 0; i < OBJECTS; ++i) {
        glGenVertexArrays(1, &scene[i].array);
        glBindVertexArray(scene[i].array);
        glGenBuffers(1, &scene[i].buffer);
        glBindBuffer(GL_ARRAY_BUFFER, scene[i].buffer);
        glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)((size_t)scene[i].count * sizeof(vertex)), scene[i].vertices,
                     GL_STATIC_DRAW);
        glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(vertex), (void*)offsetof(vertex, position));
        glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(vertex), (void*)offsetof(vertex, normal));
        glVertexAttribPointer(2, 2, GL_FLOAT, GL_FALSE, sizeof(vertex), (void*)offsetof(vertex, uv));
        glEnableVertexAttribArray(0);
        glEnableVertexAttribArray(1);
        glEnableVertexAttribArray(2);
    }
}

static void draw(const object* scene, matrix clip_from_world, int with_colour) {
    int i;
    glUniformMatrix4fv(0, 1, GL_FALSE, clip_from_world.m);
    for (i = 0; i < OBJECTS; ++i) {
        glUniformMatrix4fv(1, 1, GL_FALSE, scene[i].world.m);
        glUniform1i(2, scene[i].masked);
        if (with_colour) glUniform3fv(3, 1, scene[i].colour);
        glBindVertexArray(scene[i].array);
        glDrawArrays(GL_TRIANGLES, 0, scene[i].count);
    }
}

static GLuint texture(GLenum format, int width, int height) {
    GLuint out;
    glGenTextures(1, &out);
    glBindTexture(GL_TEXTURE_2D, out);
    glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return out;
}

static GLuint framebuffer(GLuint depth, GLuint colour) {
    GLuint out;
    glGenFramebuffers(1, &out);
    glBindFramebuffer(GL_FRAMEBUFFER, out);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
    if (colour != 0)
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour, 0);
    else
        glDrawBuffer(GL_NONE);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) fail("a framebuffer is not complete");
    return out;
}

// ---- The frame ------------------------------------------------------------------------------------------------------

typedef struct {
    matrix camera;       // clip space from world
    matrix light[MAPS];  // clip space from world, a map each
    float direction[3];  // in which the light shines
    float place[3];      // of the spot light
    int maps;            // 2 cascades, or 1
    float offset[2];     // polygon offset: factor, units
    GLuint map_frame, picture_frame, map_texture;
} frame;

static void place_light(frame* f, const options* o) {
    static const float sun[3] = {-0.9f, -1, -0.3f}, spot[3] = {-0.95f, -1, -0.45f}, origin[3] = {5, 5.5f, 2};
    static const float middles[MAPS][3] = {{0, 0, 1}, {0, 0, -3}};
    static const float half_widths[MAPS] = {5.5f, 13};
    int map, c;
    memcpy(f->direction, o->is_sun ? sun : spot, sizeof sun);
    normalise(f->direction);
    memcpy(f->place, origin, sizeof origin);
    f->maps = o->is_sun ? MAPS : 1;
    for (map = 0; map < f->maps; ++map) {
        float eye[3];
        if (!o->is_sun) {
            f->light[map] = product(perspective(0.8f, 0.8f, 1, 25, o->is_reversed), look_along(origin, f->direction));
            continue;
        }
        for (c = 0; c < 3; ++c) eye[c] = middles[map][c] - 20 * f->direction[c];
        f->light[map] = product(orthographic(half_widths[map], 1, 40, o->is_reversed), look_along(eye, f->direction));
    }
    // A 16-bit map needs an offset. Reversed depth takes the opposite sign.
    f->offset[0] = o->is_d16 ? (o->is_reversed ? -1.5f : 1.5f) : 0;
    f->offset[1] = o->is_d16 ? (o->is_reversed ? -2.0f : 2.0f) : 0;
}

static void draw_frame(frame* f, const object* scene, const uint8_t* mask, const options* o) {
    static const float eye[3] = {1, 3.6f, 7.5f}, ahead[3] = {-0.1f, -0.42f, -1};
    const GLuint caster = link(kVertex, kCaster);
    char* const source = (char*)malloc(sizeof kPictureHead + sizeof kLookup + sizeof kPictureMain);
    GLuint mask_texture, picture;
    int map;
    if (source == NULL) fail("memory lacks");
    strcpy(source, kPictureHead);
    strcat(source, kLookup);
    strcat(source, kPictureMain);
    picture = link(kVertex, source);
    free(source);
    // Reversed depth keeps its precision in the range 0 to 1 alone.
    if (o->is_reversed) glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(o->is_reversed ? GL_GREATER : GL_LESS);
    glClearDepth(o->is_reversed ? 0 : 1);

    mask_texture = texture(GL_RGBA8, MASK, MASK);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, MASK, MASK, GL_RGBA, GL_UNSIGNED_BYTE, mask);
    f->map_texture = texture(o->is_d16 ? GL_DEPTH_COMPONENT16 : GL_DEPTH_COMPONENT32F, f->maps * MAP, MAP);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, o->is_reversed ? GL_GEQUAL : GL_LEQUAL);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    f->map_frame = framebuffer(f->map_texture, 0);
    f->picture_frame = framebuffer(texture(GL_DEPTH_COMPONENT32F, WIDTH, HEIGHT), texture(GL_RGBA8, WIDTH, HEIGHT));
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, mask_texture);
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, f->map_texture);

    // The maps, side by side.
    glBindFramebuffer(GL_FRAMEBUFFER, f->map_frame);
    glClear(GL_DEPTH_BUFFER_BIT);
    glUseProgram(caster);
    if (o->cull != SB_CULL_NONE) {
        glEnable(GL_CULL_FACE);
        glCullFace(o->cull == SB_CULL_BACK ? GL_BACK : GL_FRONT);
    }
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(f->offset[0], f->offset[1]);
    for (map = 0; map < f->maps; ++map) {
        glViewport(map * MAP, 0, MAP, MAP);
        draw(scene, f->light[map], 0);
    }
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDisable(GL_CULL_FACE);

    // The picture.
    f->camera = product(perspective(0.6f * WIDTH / HEIGHT, 0.6f, kNear, kFar, o->is_reversed), look_along(eye, ahead));
    glBindFramebuffer(GL_FRAMEBUFFER, f->picture_frame);
    glViewport(0, 0, WIDTH, HEIGHT);
    glClearColor(0.6f, 0.7f, 0.8f, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glUseProgram(picture);
    glUniform3fv(4, 1, f->direction);
    glUniform3fv(5, 1, f->place);
    glUniform1i(6, f->maps);
    glUniform1f(7, kSplit);
    glUniform1i(8, o->is_reversed);
    glUniform1f(9, kConstantBias);
    glUniform1f(10, kNormalBias);
    glUniform1i(11, o->is_sun);
    glUniformMatrix4fv(12, f->maps, GL_FALSE, f->light[0].m);
    draw(scene, f->camera, 1);
    glFinish();
    if (glGetError() != GL_NO_ERROR) fail("OpenGL reports an error");
}

// ---- The bundle -----------------------------------------------------------------------------------------------------

static void write_bundle(const frame* f, const object* scene, const uint8_t* mask, const options* o) {
    shadow_bundle* const sb = sb_begin(o->folder, "opengl.c");
    // glClipControl(GL_ZERO_TO_ONE) changes the depth range of clip space. OpenGL's own is -1 to 1.
    const sb_range range = o->is_reversed ? SB_RANGE_0_TO_1 : SB_RANGE_MINUS_1_TO_1;
    const size_t texel = o->is_d16 ? sizeof(uint16_t) : sizeof(float);
    void* const texels = malloc((size_t)f->maps * MAP * MAP * texel);
    uint8_t* const pixels = (uint8_t*)malloc((size_t)WIDTH * HEIGHT * 4);
    sb_image_data image;
    char message[512];
    int instances[OBJECTS];
    int i, light, atlas;
    if (texels == NULL || pixels == NULL) fail("memory lacks");

    // The scene: all that casts or receives, in world space. These matrices are by columns, as in glUniformMatrix4fv
    // with GL_FALSE. A matrix that is uploaded with GL_TRUE is read by sb_rows_f().
    for (i = 0; i < OBJECTS; ++i) {
        sb_mesh_data mesh;
        memset(&mesh, 0, sizeof mesh);
        mesh.name = scene[i].name;
        mesh.positions = scene[i].vertices[0].position;
        mesh.normals = scene[i].vertices[0].normal;
        mesh.uv = scene[i].vertices[0].uv;
        mesh.position_stride = mesh.normal_stride = mesh.uv_stride = sizeof(vertex);
        mesh.vertex_count = (size_t)scene[i].count;
        memcpy(mesh.colour, scene[i].colour, sizeof mesh.colour);
        if (scene[i].masked) {
            // The first row of glTexSubImage2D lies at v = 0, and so does the first row of mask_rgba.
            mesh.mask_rgba = mask;
            mesh.mask_width = MASK;
            mesh.mask_height = MASK;
            mesh.mask_cutoff = 0.5f;
        }
        instances[i] =
            sb_instance(sb, sb_mesh(sb, &mesh), sb_columns_f(scene[i].world.m), scene[i].name, SB_CASTS | SB_RECEIVES);
    }

    // The camera and its picture. glReadPixels returns the bottom row first.
    sb_camera(sb, sb_columns_f(f->camera.m), WIDTH, HEIGHT, range, o->is_reversed);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glBindFramebuffer(GL_FRAMEBUFFER, f->picture_frame);
    glReadPixels(0, 0, WIDTH, HEIGHT, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    sb_picture(sb, pixels, WIDTH, HEIGHT, 0, SB_FIRST_ROW_BOTTOM);

    // The light. A direction is the one in which light travels, not the one towards the light.
    light = sb_light(sb, o->is_sun ? "sun" : "spot", o->is_sun ? SB_DIRECTIONAL : SB_SPOT);
    sb_light_direction(sb, light, f->direction[0], f->direction[1], f->direction[2]);
    if (!o->is_sun) sb_light_position(sb, light, f->place[0], f->place[1], f->place[2]);
    if (!o->is_sun) sb_light_cone(sb, light, 2 * 57.29577951 * acos(0.75));

    // The texels, in the type that the map has. Floats of a D16 map would do as well; integers keep every bit.
    glBindFramebuffer(GL_FRAMEBUFFER, f->map_frame);
    glReadPixels(0, 0, f->maps * MAP, MAP, GL_DEPTH_COMPONENT, o->is_d16 ? GL_UNSIGNED_SHORT : GL_FLOAT, texels);
    memset(&image, 0, sizeof image);
    image.texels = texels;
    image.type = o->is_d16 ? SB_U16 : SB_F32;
    image.width = f->maps * MAP;
    image.height = MAP;
    image.first_row = SB_FIRST_ROW_BOTTOM;
    atlas = sb_image(sb, &image);
    for (i = 0; i < f->maps; ++i) {
        // The matrix of the caster pass, not the one of the look-up, which often has 0.5 z + 0.5 in it.
        const int map = sb_map(sb, light, atlas, sb_columns_f(f->light[i].m), range, o->is_reversed);
        if (f->maps > 1) sb_map_region(sb, map, i * MAP, 0, MAP, MAP);
        if (f->maps > 1) sb_map_interval(sb, map, i == 0 ? kNear : kSplit, i == 0 ? kSplit : kFar);
        sb_map_format(sb, map, o->is_d16 ? SB_D16 : SB_D32F);
        sb_map_clear(sb, map, o->is_reversed ? 0 : 1);
        // State as it was set, with the signs of OpenGL. No offset is 0, not unknown.
        sb_map_offset(sb, map, f->offset[0], f->offset[1], 0);
        sb_map_cull(sb, map, o->cull, SB_FRONT_CCW);
        sb_map_depth_clamp(sb, map, 0);
        sb_map_drawn(sb, map, instances, OBJECTS);
    }

    // The look-up: each term of the bias, in the unit in which the shader adds it.
    sb_lookup_bias(sb, light, SB_BIAS_CONSTANT, kConstantBias, SB_UNIT_DEPTH);
    sb_lookup_bias(sb, light, SB_BIAS_SLOPE, 0, SB_UNIT_DEPTH);
    sb_lookup_bias(sb, light, SB_BIAS_NORMAL, kNormalBias, SB_UNIT_METRES);
    sb_lookup_kernel(sb, light, "hw2x2");
    sb_lookup_compare(sb, light, o->is_reversed ? SB_GREATER_EQUAL : SB_LESS_EQUAL);
    sb_lookup_sampler(sb, light, SB_LINEAR, SB_CLAMP);
    sb_lookup_shader(sb, light, kLookup);

    free(texels);
    free(pixels);
    if (sb_end(sb, message, sizeof message) != SB_OK) fail(message);
}

static int read_options(options* o, int count, char** words) {
    int i;
    memset(o, 0, sizeof *o);
    o->is_sun = 1;
    o->cull = SB_CULL_BACK;
    for (i = 1; i < count; ++i) {
        const char* const value = i + 1 < count ? words[i + 1] : "";
        if (strcmp(words[i], "--reversed") == 0) {
            o->is_reversed = 1;
            continue;
        }
        if (words[i][0] != '-' && o->folder == NULL) {
            o->folder = words[i];
            continue;
        }
        if (strcmp(words[i], "--light") == 0 && (strcmp(value, "sun") == 0 || strcmp(value, "spot") == 0))
            o->is_sun = strcmp(value, "sun") == 0;
        else if (strcmp(words[i], "--depth") == 0 && (strcmp(value, "d16") == 0 || strcmp(value, "d32f") == 0))
            o->is_d16 = strcmp(value, "d16") == 0;
        else if (strcmp(words[i], "--cull") == 0 && strcmp(value, "none") == 0)
            o->cull = SB_CULL_NONE;
        else if (strcmp(words[i], "--cull") == 0 && strcmp(value, "back") == 0)
            o->cull = SB_CULL_BACK;
        else if (strcmp(words[i], "--cull") == 0 && strcmp(value, "front") == 0)
            o->cull = SB_CULL_FRONT;
        else
            return 0;
        ++i;
    }
    return o->folder != NULL;
}

int main(int count, char** words) {
    static uint8_t mask[MASK * MASK * 4];
    object scene[OBJECTS];
    options o;
    frame f;
    int i;
    if (!read_options(&o, count, words)) {
        (void)fprintf(stderr,
                      "usage: %s FOLDER.bundle [--light sun|spot] [--depth d16|d32f] [--reversed] "
                      "[--cull none|back|front]\n",
                      words[0]);
        return 2;
    }
    memset(&f, 0, sizeof f);
    make_scene(scene, mask);
    open_context();
    upload(scene);
    place_light(&f, &o);
    draw_frame(&f, scene, mask, &o);
    write_bundle(&f, scene, mask, &o);
    for (i = 0; i < OBJECTS; ++i) free(scene[i].vertices);
    return 0;
}
