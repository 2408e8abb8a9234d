// draw_captured VARIANT FOLDER: draws one frame with shadow maps in OpenGL, captured by RenderDoc if its library is
// preloaded. FOLDER gets truth.json with all matrices and states, and the texels of each map as truth_N.raw (floats,
// bottom row first). The program shares no code with the program under test.
#include <epoxy/gl.h>
// epoxy/egl.h needs the types of epoxy/gl.h.
#include <epoxy/egl.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/capture_program/frame_capture.h"

namespace {

using Json = nlohmann::json;
using glm::mat4;
using glm::vec3;
using glm::vec4;

constexpr int kMapSide = 256, kWidth = 320, kHeight = 180;
constexpr float kFarRange = 20;

enum class Storage { kPlane, kCube, kLayers, kAtlas };
enum class Holds { kDepth, kDistanceInDepth, kDistanceInColour };

/// Choices of one frame.
struct Variant {
    const char* name;
    bool sun = false, spot = false, point = false;
    Storage storage = Storage::kPlane;
    Holds holds = Holds::kDepth;
    GLenum format = GL_DEPTH_COMPONENT32F;
    GLenum cull = GL_BACK;        ///< GL_NONE: no culling
    bool one_matrix = false;      ///< the shaders get the product alone
    bool compares = true;         ///< the sampler compares
    bool depth_clamp = false;     ///< with a near plane inside the casters
    bool reversed = false;        ///< with a clip range of 0 to 1
    bool misses = false;          ///< the face +Y draws nothing
    bool skips = false;           ///< faces draw what they may see alone
    float factor = 0, units = 0;  ///< polygon offset
    vec3 origin = vec3(0);        ///< place of the scene in the world
    bool relative = false;        ///< matrices are relative to the camera
    bool block = false;           ///< matrices are in a uniform block, the world first
    bool clockwise = false;       ///< front faces are clockwise, and so are the meshes
    bool mirrored = false;        ///< matrices of maps are flipped in y, as engines for Vulkan do
    vec3 step = vec3(0);          ///< way of all objects but the ground from the frame before to the captured one
};

const Variant kVariants[] = {
    {.name = "directional", .sun = true},
    {.name = "spot", .spot = true, .format = GL_DEPTH_COMPONENT24},
    {.name = "point-cube", .point = true, .storage = Storage::kCube},
    {.name = "point-layers", .point = true, .storage = Storage::kLayers, .format = GL_DEPTH_COMPONENT16},
    {.name = "point-skips", .point = true, .storage = Storage::kCube, .skips = true},
    {.name = "point-misses", .point = true, .storage = Storage::kCube, .misses = true},
    {.name = "layers-miss", .spot = true, .point = true, .storage = Storage::kLayers, .misses = true},
    {.name = "point-distance", .point = true, .storage = Storage::kCube, .holds = Holds::kDistanceInDepth},
    {.name = "point-colour",
     .point = true,
     .storage = Storage::kCube,
     .holds = Holds::kDistanceInColour,
     .format = GL_R32F},
    {.name = "spot-and-point", .spot = true, .point = true, .storage = Storage::kLayers},
    {.name = "atlas", .sun = true, .spot = true, .storage = Storage::kAtlas, .step = vec3(0.7f, 0, 0.4f)},
    {.name = "front-culling", .sun = true, .cull = GL_FRONT},
    {.name = "clockwise", .sun = true, .clockwise = true},
    {.name = "mirrored", .sun = true, .format = GL_DEPTH_COMPONENT16, .mirrored = true},
    {.name = "one-matrix", .sun = true, .one_matrix = true},
    {.name = "one-matrix-spot", .spot = true, .one_matrix = true},
    {.name = "no-compare", .sun = true, .compares = false},
    {.name = "depth-clamp", .sun = true, .depth_clamp = true},
    {.name = "offset", .sun = true, .format = GL_DEPTH_COMPONENT16, .factor = 2, .units = 4},
    {.name = "offset-float", .spot = true, .factor = 1.5f, .units = 3},
    {.name = "reversed", .spot = true, .reversed = true, .factor = -1, .units = -2},
    {.name = "far-away", .sun = true, .origin = vec3(9000, 40, -17000), .relative = true},
    {.name = "block", .sun = true, .cull = GL_NONE, .block = true},
};

struct Object {
    const char* name;
    int first = 0, count = 0, base = 0;
    mat4 world = mat4(1);
    vec3 colour = vec3(0.7f);
    float radius = 1;  ///< of a sphere around the place of the object
};

struct Light {
    const char* type;
    vec3 direction, position;
};

struct Map {
    int slice = 0;
    int light = 0;
    mat4 clip_from_world;
};

[[noreturn]] void fail(const std::string& text) {
    throw std::runtime_error(text);
}

void open_context() {
    const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    const EGLint version[] = {
        EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) fail("EGL has no display");
    EGLConfig config;
    EGLint count = 0;
    if (!eglBindAPI(EGL_OPENGL_API) || !eglChooseConfig(display, wanted, &config, 1, &count) || count == 0)
        fail("EGL has no configuration for OpenGL");
    const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
    if (context == EGL_NO_CONTEXT || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
        fail("the driver has no OpenGL 4.5");
}

/// Meshes of all objects in one vertex and one index buffer.
class Scene {
public:
    Scene() {
        const int ground = rectangle(vec3(-8, 0, 8), vec3(16, 0, 0), vec3(0, 0, -16));
        const int box = box_mesh();
        const int pyramid = pyramid_mesh();
        add("Ground", ground, mat4(1), vec3(0.5f, 0.5f, 0.45f), 12);
        add("Box", box, glm::translate(mat4(1), vec3(-2.2f, 0.5f, 0.6f)), vec3(0.7f, 0.3f, 0.2f), 1);
        add("Turned box", box,
            glm::scale(glm::rotate(glm::translate(mat4(1), vec3(1.9f, 0.75f, -1.6f)), 0.7f, vec3(0, 1, 0)), vec3(1.5f)),
            vec3(0.2f, 0.45f, 0.7f), 1.5f);
        add("Pillar", box,
            glm::scale(glm::rotate(glm::translate(mat4(1), vec3(-1.4f, 1.5f, -3)), 0.3f, vec3(0, 1, 0)),
                       vec3(0.5f, 3, 0.5f)),
            vec3(0.8f, 0.75f, 0.6f), 2);
        add("Pyramid", pyramid,
            glm::rotate(glm::translate(mat4(1), vec3(2.2f, 0.9f, 1.7f)), 0.5f, glm::normalize(vec3(1, 2, 0.5f))),
            vec3(0.35f, 0.6f, 0.3f), 1.3f);
    }

    /// @param clockwise corners of all triangles are turned
    void upload(bool clockwise) {
        if (clockwise)
            for (std::size_t i = 0; i < indices_.size(); i += 3) std::swap(indices_[i], indices_[i + 1]);
        GLuint array, buffers[2];
        glGenVertexArrays(1, &array);
        glBindVertexArray(array);
        glGenBuffers(2, buffers);
        glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
        glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(vertices_.size() * sizeof(vec3)), vertices_.data(), GL_STATIC_DRAW);
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
        glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(indices_.size() * sizeof(GLushort)), indices_.data(),
                     GL_STATIC_DRAW);
        glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 2 * sizeof(vec3), nullptr);
        glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, 2 * sizeof(vec3), static_cast<char*>(nullptr) + sizeof(vec3));
        glEnableVertexAttribArray(0);
        glEnableVertexAttribArray(1);
    }

    std::vector<Object> objects;

private:
    void begin() { starts_.push_back({int(indices_.size()), int(vertices_.size() / 2)}); }

    void add_rectangle(vec3 corner, vec3 across, vec3 up) {
        const vec3 normal = glm::normalize(glm::cross(across, up));
        add_corners({corner, corner + across, corner + across + up, corner + up}, normal);
        for (const int i : {0, 1, 2, 0, 2, 3}) indices_.push_back(GLushort(local_ - 4 + i));
    }

    void add_corners(const std::vector<vec3>& corners, vec3 normal) {
        for (const vec3& corner : corners) {
            vertices_.push_back(corner);
            vertices_.push_back(normal);
        }
        local_ += int(corners.size());
    }

    int finish() {
        counts_.push_back(int(indices_.size()) - starts_.back()[0]);
        local_ = 0;
        return int(starts_.size()) - 1;
    }

    int rectangle(vec3 corner, vec3 across, vec3 up) {
        begin();
        add_rectangle(corner, across, up);
        return finish();
    }

    int box_mesh() {
        begin();
        for (int axis = 0; axis < 3; ++axis)
            for (const int side : {0, 1}) {
                vec3 corner(-0.5f), across(0), up(0);
                if (side) corner[axis] = 0.5f;
                across[(axis + (side ? 1 : 2)) % 3] = 1;
                up[(axis + (side ? 2 : 1)) % 3] = 1;
                add_rectangle(corner, across, up);
            }
        return finish();
    }

    int pyramid_mesh() {
        begin();
        const vec3 top(0.1f, 0.9f, -0.2f);
        const vec3 base[] = {{-0.8f, -0.5f, 0.7f}, {0.9f, -0.5f, 0.6f}, {0.1f, -0.6f, -0.9f}};
        for (int i = 0; i < 3; ++i) {
            const vec3 a = base[i], b = base[(i + 1) % 3];
            add_corners({a, b, top}, glm::normalize(glm::cross(b - a, top - a)));
            for (const int corner : {3, 2, 1}) indices_.push_back(GLushort(local_ - corner));
        }
        add_corners({base[0], base[2], base[1]}, glm::normalize(glm::cross(base[2] - base[0], base[1] - base[0])));
        for (const int corner : {3, 2, 1}) indices_.push_back(GLushort(local_ - corner));
        return finish();
    }

    void add(const char* name, int mesh, const mat4& world, vec3 colour, float radius) {
        objects.push_back({name, starts_[std::size_t(mesh)][0], counts_[std::size_t(mesh)],
                           starts_[std::size_t(mesh)][1], world, colour, radius});
    }

    std::vector<vec3> vertices_;  ///< position and normal in turns
    std::vector<GLushort> indices_;
    std::vector<std::array<int, 2>> starts_;
    std::vector<int> counts_;
    int local_ = 0;
};

GLuint compile(GLenum stage, const std::string& source) {
    const GLuint shader = glCreateShader(stage);
    const char* const text = source.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint compiled = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (!compiled) {
        char log[2048];
        glGetShaderInfoLog(shader, sizeof log, nullptr, log);
        fail(log + source);
    }
    return shader;
}

GLuint link(const std::string& vertex, const std::string& fragment) {
    const GLuint program = glCreateProgram();
    glAttachShader(program, compile(GL_VERTEX_SHADER, vertex));
    glAttachShader(program, compile(GL_FRAGMENT_SHADER, fragment));
    glLinkProgram(program);
    GLint linked = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked) fail("a program does not link");
    return program;
}

/// Names of uniforms say nothing, as import must not read them.
std::string vertex_source(const Variant& v) {
    std::string text =
        "#version 450 core\n"
        "layout(location = 0) in vec3 a0;\n"
        "layout(location = 1) in vec3 a1;\n"
        "out vec3 v0;\n"
        "out vec3 v1;\n";
    if (v.one_matrix) {
        // The picture's light comes from a second product.
        return text +
               "layout(location = 0) uniform mat4 u0;\n"
               "layout(location = 12) uniform mat4 u12;\n"
               "out vec4 v2;\n"
               "void main() { v0 = a0; v1 = a1; v2 = u12 * vec4(a0, 1); gl_Position = u0 * vec4(a0, 1); }\n";
    }
    if (v.block)
        text +=
            "layout(binding = 0, std140) uniform B { vec4 b0; mat4 b1; mat4 b2; mat4 b3; };\n"
            "#define world b1\n#define clip b3\n";
    else
        text +=
            "layout(location = 0) uniform mat4 u0;\nlayout(location = 1) uniform mat4 u1;\n"
            "#define world u1\n#define clip u0\n";
    return text +
           "void main() {\n"
           "  vec4 at = world * vec4(a0, 1);\n"
           "  v0 = at.xyz;\n"
           "  v1 = inverse(transpose(mat3(world))) * a1;\n"
           "  gl_Position = clip * at;\n"
           "}\n";
}

std::string caster_source(const Variant& v) {
    const std::string head = "#version 450 core\nin vec3 v0;\nlayout(location = 5) uniform vec3 u5;\n";
    if (v.holds == Holds::kDistanceInDepth) return head + "void main() { gl_FragDepth = distance(v0, u5) / 20.0; }\n";
    if (v.holds == Holds::kDistanceInColour) return head + "out float o0;\nvoid main() { o0 = distance(v0, u5); }\n";
    return "#version 450 core\nvoid main() {}\n";
}

std::string picture_source(const Variant& v) {
    std::string text =
        "#version 450 core\n"
        "in vec3 v0;\n"
        "in vec3 v1;\n"
        "out vec4 o0;\n"
        "layout(location = 3) uniform vec3 u3;\n"
        "layout(location = 4) uniform vec3 u4;\n"
        "layout(location = 5) uniform vec3 u5;\n";
    if (v.one_matrix) {
        return text +
               "in vec4 v2;\n"
               "layout(binding = 0) uniform sampler2DShadow t0;\n"
               "void main() {\n"
               "  vec3 p = 0.5 * v2.xyz / v2.w + 0.5;\n"
               "  o0 = vec4(u3 * (0.3 + 0.7 * texture(t0, vec3(p.xy, p.z - 0.001))), 1);\n"
               "}\n";
    }
    const std::string range = v.reversed ? "p.z" : "(0.5 * p.z + 0.5)";
    const std::string own = v.reversed ? range + " + 0.001" : range + " - 0.001";
    text += "layout(location = 12) uniform mat4 u12[7];\n";
    const std::string projected = "vec4 q = u12[%] * vec4(v0, 1); vec3 p = q.xyz / q.w; vec2 uv = 0.5 * p.xy + 0.5;\n";
    const auto with_index = [&](const std::string& index) {
        std::string out = projected;
        return out.replace(out.find('%'), 1, index);
    };
    std::string lit;
    if (v.storage == Storage::kCube && v.holds == Holds::kDistanceInColour) {
        text += "layout(binding = 0) uniform samplerCube t0;\n";
        lit = "vec3 d = v0 - u5; lit *= texture(t0, d).r + 0.05 > length(d) ? 1.0 : 0.0;\n";
    } else if (v.storage == Storage::kCube && v.holds == Holds::kDistanceInDepth) {
        text += "layout(binding = 0) uniform samplerCube t0;\n";
        lit = "vec3 d = v0 - u5; lit *= texture(t0, d).r + 0.0025 > length(d) / 20.0 ? 1.0 : 0.0;\n";
    } else if (v.storage == Storage::kCube) {
        text += "layout(binding = 0) uniform samplerCubeShadow t0;\n";
        lit =
            "vec3 d = v0 - u5; vec3 a = abs(d); int f = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 2 : 4;\n"
            "if (d[f / 2] < 0) ++f;\n" +
            with_index("f") + "lit *= texture(t0, vec4(d, " + own + "));\n";
    } else if (v.storage == Storage::kLayers) {
        text += "layout(binding = 0) uniform sampler2DArrayShadow t0;\n";
        if (v.spot) lit += "{" + with_index("0") + "lit *= 0.5 + 0.5 * texture(t0, vec4(uv, 0, " + own + ")); }\n";
        lit +=
            "{ vec3 d = v0 - u5; vec3 a = abs(d); int f = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 2 : 4;\n"
            "if (d[f / 2] < 0) ++f;\n"
            "f += " +
            std::string(v.spot ? "1" : "0") + ";\n" + with_index("f") + "lit *= texture(t0, vec4(uv, f, " + own +
            ")); }\n";
    } else if (v.storage == Storage::kAtlas) {
        text += "layout(binding = 0) uniform sampler2DShadow t0;\n";
        for (const std::string index : {"0", "1"})
            lit += "{" + with_index(index) + "lit *= 0.5 + 0.5 * texture(t0, vec3(0.5 * (clamp(uv.x, 0, 1) + " + index +
                   "), uv.y, " + own + ")); }\n";
    } else if (!v.compares) {
        text += "layout(binding = 0) uniform sampler2D t0;\n";
        lit = with_index("0") + "lit *= " + range + " - 0.001 <= texture(t0, uv).r ? 1.0 : 0.0;\n";
    } else {
        text += "layout(binding = 0) uniform sampler2DShadow t0;\n";
        lit = with_index("0") + "lit *= texture(t0, vec3(uv, " + own + "));\n";
    }
    return text +
           "void main() {\n"
           "  float lit = max(dot(normalize(v1), -u4), 0.2);\n" +
           lit + "  o0 = vec4(u3 * (0.3 + 0.7 * lit), 1);\n}\n";
}

/// Sets the depth row of a projection: -1 to 1, or reversed 1 to 0.
mat4 with_depth(const Variant& v, mat4 matrix, float near, float far) {
    if (!v.reversed) return matrix;
    const bool perspective = matrix[3][3] == 0;
    matrix[2][2] = perspective ? near / (far - near) : 1 / (far - near);
    matrix[3][2] = perspective ? near * far / (far - near) : far / (far - near);
    return matrix;
}

class Frame {
public:
    explicit Frame(const Variant& variant) : v_(variant) {
        const vec3 eye = v_.origin + vec3(1, 4.2f, 8.5f);
        shift_ = v_.relative ? -eye : vec3(0);
        for (Object& object : scene_.objects) object.world = glm::translate(mat4(1), v_.origin + shift_) * object.world;
        const vec3 from = v_.origin + shift_;
        camera_ =
            with_depth(v_, glm::perspective(glm::radians(50.0f), float(kWidth) / kHeight, 0.2f, 60.0f), 0.2f, 60) *
            glm::lookAt(eye + shift_, eye + shift_ + vec3(-0.1f, -0.45f, -1), vec3(0, 1, 0));
        if (v_.sun) {
            const vec3 direction = glm::normalize(vec3(-0.5f, -1, -0.35f));
            const float near = v_.depth_clamp ? 10.5f : 2;
            lights_.push_back({"directional", direction, vec3(0)});
            maps_.push_back({0, 0,
                             with_depth(v_, glm::ortho(-6.0f, 6.0f, -6.0f, 6.0f, near, 24.0f), near, 24) *
                                 glm::lookAt(from - 12.0f * direction, from, vec3(0, 1, 0))});
        }
        if (v_.spot) {
            const vec3 position = from + vec3(4, 6, 3.5f);
            const vec3 direction = glm::normalize(from - position);
            lights_.push_back({"spot", direction, position});
            maps_.push_back({0, 0,
                             with_depth(v_, glm::perspective(glm::radians(70.0f), 1.0f, 1.0f, 20.0f), 1, 20) *
                                 glm::lookAt(position, position + direction, vec3(0, 1, 0))});
        }
        if (v_.point) add_point_light(from + vec3(0.25f, 1.9f, 0.1f));
        if (v_.mirrored)
            for (Map& map : maps_) map.clip_from_world = glm::scale(mat4(1), vec3(1, -1, 1)) * map.clip_from_world;
    }

    void prepare() {
        open_context();
        scene_.upload(v_.clockwise);
        caster_ = link(vertex_source(v_), caster_source(v_));
        picture_ = link(vertex_source(v_), picture_source(v_));
        target_ = v_.storage == Storage::kCube     ? GL_TEXTURE_CUBE_MAP
                  : v_.storage == Storage::kLayers ? GL_TEXTURE_2D_ARRAY
                                                   : GL_TEXTURE_2D;
        glGenTextures(1, &map_);
        glBindTexture(target_, map_);
        if (v_.storage == Storage::kLayers)
            glTexStorage3D(target_, 1, v_.format, kMapSide, kMapSide, GLsizei(maps_.size()));
        else
            glTexStorage2D(target_, 1, v_.format, atlas_x(int(maps_.size()) - 1) + kMapSide, kMapSide);
        const bool compares = v_.compares && v_.holds == Holds::kDepth;
        glTexParameteri(target_, GL_TEXTURE_MIN_FILTER, compares ? GL_LINEAR : GL_NEAREST);
        glTexParameteri(target_, GL_TEXTURE_MAG_FILTER, compares ? GL_LINEAR : GL_NEAREST);
        for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
            glTexParameteri(target_, axis, GL_CLAMP_TO_EDGE);
        if (compares) {
            glTexParameteri(target_, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
            glTexParameteri(target_, GL_TEXTURE_COMPARE_FUNC, v_.reversed ? GL_GEQUAL : GL_LEQUAL);
        }
        if (v_.holds == Holds::kDistanceInColour) {
            glGenTextures(1, &own_depth_);
            glBindTexture(GL_TEXTURE_2D, own_depth_);
            glTexStorage2D(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT32F, kMapSide, kMapSide);
        }
        glGenFramebuffers(1, &map_frame_);
        GLuint colour, depth;
        glGenTextures(1, &colour);
        glBindTexture(GL_TEXTURE_2D, colour);
        glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, kWidth, kHeight);
        glGenTextures(1, &depth);
        glBindTexture(GL_TEXTURE_2D, depth);
        glTexStorage2D(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT32F, kWidth, kHeight);
        glGenFramebuffers(1, &picture_frame_);
        glBindFramebuffer(GL_FRAMEBUFFER, picture_frame_);
        glFramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, colour, 0);
        glFramebufferTexture(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, depth, 0);
        if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) fail("the picture is not complete");
        if (v_.block) glGenBuffers(1, &block_);
    }

    /// Moves the objects to their places in the captured frame.
    void step() {
        for (Object& object : scene_.objects)
            if (object.name != std::string("Ground")) object.world = glm::translate(mat4(1), v_.step) * object.world;
    }

    void draw() {
        if (v_.reversed) glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(v_.reversed ? GL_GREATER : GL_LESS);
        glClearDepth(v_.reversed ? 0 : 1);
        glFrontFace(v_.clockwise != v_.mirrored ? GL_CW : GL_CCW);
        draw_maps();
        glDisable(GL_CULL_FACE);
        glBindFramebuffer(GL_FRAMEBUFFER, picture_frame_);
        glViewport(0, 0, kWidth, kHeight);
        glClearColor(0.6f, 0.7f, 0.8f, 1);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glUseProgram(picture_);
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(target_, map_);
        glUniform3fv(4, 1, glm::value_ptr(lights_.back().direction));
        glUniform3fv(5, 1, glm::value_ptr(lights_.back().position));
        if (!v_.one_matrix) {
            std::vector<mat4> matrices;
            for (const Map& map : maps_) matrices.push_back(map.clip_from_world);
            glUniformMatrix4fv(12, GLsizei(matrices.size()), GL_FALSE, glm::value_ptr(matrices[0]));
        }
        for (const Object& object : scene_.objects) {
            glUniform3fv(3, 1, glm::value_ptr(object.colour));
            if (v_.one_matrix) {
                const mat4 light = maps_[0].clip_from_world * object.world;
                glUniformMatrix4fv(12, 1, GL_FALSE, glm::value_ptr(light));
            }
            draw_object(object, camera_);
        }
        glFinish();
        if (glGetError() != GL_NO_ERROR) fail("OpenGL reports an error");
    }

    /// Writes matrices, states and texels.
    void write(const std::string& folder) {
        Json truth{{"variant", v_.name}, {"camera", floats(camera_)}, {"maps", Json::array()}};
        for (const Object& object : scene_.objects)
            truth["objects"].push_back({{"name", object.name}, {"world", floats(object.world)}});
        for (const Light& light : lights_)
            truth["lights"].push_back({{"type", light.type},
                                       {"direction", {light.direction.x, light.direction.y, light.direction.z}},
                                       {"position", {light.position.x, light.position.y, light.position.z}}});
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        for (std::size_t i = 0; i < maps_.size(); ++i) {
            const Map& map = maps_[i];
            attach(map);
            std::vector<float> texels(kMapSide * kMapSide);
            const bool colour = v_.holds == Holds::kDistanceInColour;
            if (colour) glReadBuffer(GL_COLOR_ATTACHMENT0);
            glReadPixels(atlas_x(int(i)), 0, kMapSide, kMapSide, colour ? GL_RED : GL_DEPTH_COMPONENT, GL_FLOAT,
                         texels.data());
            std::ofstream(folder + "/truth_" + std::to_string(i) + ".raw", std::ios::binary)
                .write(reinterpret_cast<const char*>(texels.data()), std::streamsize(texels.size() * sizeof(float)));
            truth["maps"].push_back(
                {{"slice", map.slice},
                 {"light", map.light},
                 {"clip_from_world", floats(map.clip_from_world)},
                 {"drawn", drawn_in(map)},
                 {"range", v_.reversed ? "0..1" : "-1..1"},
                 {"reversed", v_.reversed},
                 {"offset_factor", v_.factor},
                 {"offset_units", v_.units},
                 {"cull", v_.cull == GL_BACK    ? "back"
                          : v_.cull == GL_FRONT ? "front"
                                                : "none"},
                 {"front", v_.clockwise != v_.mirrored ? "cw" : "ccw"},
                 {"mirrored", v_.mirrored},
                 {"depth_clamp", v_.depth_clamp},
                 {"compare",
                  v_.compares && v_.holds == Holds::kDepth ? (v_.reversed ? "greater-equal" : "less-equal") : ""},
                 {"stored", v_.holds == Holds::kDepth ? "depth" : "distance"}});
        }
        std::ofstream(folder + "/truth.json") << truth.dump(1) << "\n";
    }

private:
    static Json floats(const mat4& matrix) {
        return std::vector<float>(glm::value_ptr(matrix), glm::value_ptr(matrix) + 16);
    }

    void add_point_light(vec3 position) {
        static const vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
        static const vec3 ups[] = {{0, -1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0, -1, 0}, {0, -1, 0}};
        const int light = int(lights_.size()), first = int(maps_.size());
        lights_.push_back({"point", vec3(0, -1, 0), position});
        for (int face = 0; face < 6; ++face)
            maps_.push_back(
                {first + face, light,
                 with_depth(v_, glm::perspective(glm::radians(90.0f), 1.0f, 0.1f, kFarRange), 0.1f, kFarRange) *
                     glm::lookAt(position, position + axes[face], ups[face])});
    }

    /// Returns the first texel column of a map in its texture.
    int atlas_x(int map) const { return v_.storage == Storage::kAtlas ? map * kMapSide : 0; }

    void attach(const Map& map) {
        glBindFramebuffer(GL_FRAMEBUFFER, map_frame_);
        const GLenum point = v_.holds == Holds::kDistanceInColour ? GL_COLOR_ATTACHMENT0 : GL_DEPTH_ATTACHMENT;
        if (v_.storage == Storage::kCube)
            glFramebufferTexture2D(GL_FRAMEBUFFER, point, GLenum(GL_TEXTURE_CUBE_MAP_POSITIVE_X + map.slice), map_, 0);
        else if (v_.storage == Storage::kLayers)
            glFramebufferTextureLayer(GL_FRAMEBUFFER, point, map_, 0, map.slice);
        else
            glFramebufferTexture2D(GL_FRAMEBUFFER, point, GL_TEXTURE_2D, map_, 0);
        if (v_.holds == Holds::kDistanceInColour)
            glFramebufferTexture(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, own_depth_, 0);
        else
            glDrawBuffer(GL_NONE);
        if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) fail("a map is not complete");
    }

    std::vector<int> drawn_in(const Map& map) const {
        std::vector<int> drawn;
        if (v_.misses && lights_[std::size_t(map.light)].type == std::string("point") &&
            map.slice == int(maps_.size()) - 4)
            return drawn;
        for (int i = 0; i < int(scene_.objects.size()); ++i) {
            const Object& object = scene_.objects[std::size_t(i)];
            const vec4 place = map.clip_from_world * object.world * vec4(0, 0, 0, 1);
            // A sphere lies within sides of 45 degrees.
            const float reach = place.w + 1.5f * object.radius;
            const bool is_seen = place.w + object.radius > 0 && std::abs(place.x) < reach && std::abs(place.y) < reach;
            if (!v_.skips || is_seen) drawn.push_back(i);
        }
        return drawn;
    }

    void draw_maps() {
        glUseProgram(caster_);
        if (v_.cull != GL_NONE) {
            glEnable(GL_CULL_FACE);
            glCullFace(v_.cull);
        }
        if (v_.factor != 0 || v_.units != 0) {
            glEnable(GL_POLYGON_OFFSET_FILL);
            glPolygonOffset(v_.factor, v_.units);
        }
        if (v_.depth_clamp) glEnable(GL_DEPTH_CLAMP);
        glEnable(GL_SCISSOR_TEST);
        for (std::size_t i = 0; i < maps_.size(); ++i) {
            const Map& map = maps_[i];
            attach(map);
            glViewport(atlas_x(int(i)), 0, kMapSide, kMapSide);
            glScissor(atlas_x(int(i)), 0, kMapSide, kMapSide);
            glClearColor(1000, 0, 0, 0);
            glClear(GL_DEPTH_BUFFER_BIT | (v_.holds == Holds::kDistanceInColour ? GL_COLOR_BUFFER_BIT : 0u));
            if (v_.holds != Holds::kDepth) glUniform3fv(5, 1, glm::value_ptr(lights_[std::size_t(map.light)].position));
            for (const int drawn : drawn_in(map)) draw_object(scene_.objects[std::size_t(drawn)], map.clip_from_world);
        }
        glDisable(GL_SCISSOR_TEST);
        glDisable(GL_POLYGON_OFFSET_FILL);
        glDisable(GL_DEPTH_CLAMP);
    }

    void draw_object(const Object& object, const mat4& clip_from_world) {
        if (v_.block) {
            struct {
                vec4 colour;
                mat4 world, unused, clip;
            } data{vec4(object.colour, 1), object.world, glm::inverse(clip_from_world), clip_from_world};
            glBindBufferBase(GL_UNIFORM_BUFFER, 0, block_);
            glBufferData(GL_UNIFORM_BUFFER, sizeof data, &data, GL_DYNAMIC_DRAW);
        } else if (v_.one_matrix) {
            const mat4 whole = clip_from_world * object.world;
            glUniformMatrix4fv(0, 1, GL_FALSE, glm::value_ptr(whole));
        } else {
            glUniformMatrix4fv(0, 1, GL_FALSE, glm::value_ptr(clip_from_world));
            glUniformMatrix4fv(1, 1, GL_FALSE, glm::value_ptr(object.world));
        }
        glDrawElementsBaseVertex(GL_TRIANGLES, object.count, GL_UNSIGNED_SHORT,
                                 static_cast<char*>(nullptr) + object.first * int(sizeof(GLushort)), object.base);
    }

    const Variant& v_;
    Scene scene_;
    vec3 shift_;
    mat4 camera_;
    std::vector<Light> lights_;
    std::vector<Map> maps_;
    GLenum target_ = GL_TEXTURE_2D;
    GLuint caster_ = 0, picture_ = 0, map_ = 0, own_depth_ = 0, map_frame_ = 0, picture_frame_ = 0, block_ = 0;
};

void run(const std::string& name, const std::string& folder) {
    const Variant* chosen = nullptr;
    for (const Variant& variant : kVariants)
        if (name == variant.name) chosen = &variant;
    if (!chosen) fail(name + " is no variant");
    Frame frame(*chosen);
    frame.prepare();
    // A layer of Vulkan is loaded with the driver.
    si::test::FrameCapture capture(folder + "/frame");
    // Programs of a first frame are compiled outside the capture.
    frame.draw();
    frame.step();
    capture.begin();
    frame.draw();
    if (!capture.end()) fail("no frame was captured");
    frame.write(folder);
}

}  // namespace

int main(int count, char** words) {
    if (count != 3) {
        std::fprintf(stderr, "usage: %s VARIANT FOLDER\n", words[0]);
        for (const Variant& variant : kVariants) std::fprintf(stderr, "%s\n", variant.name);
        return 2;
    }
    try {
        run(words[1], words[2]);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "draw_captured: %s\n", e.what());
        return 1;
    }
}
