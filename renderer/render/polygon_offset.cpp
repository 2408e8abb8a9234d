#include "renderer/render/polygon_offset.h"

#include <algorithm>
#include <vector>

#include "renderer/bias/theory.h"
#include "renderer/frame/driver.h"
#include "renderer/gl/program_cache.h"
#include "renderer/gl/target.h"
#include "renderer/settings/map_storage.h"
#include "renderer/settings/settings.h"

namespace si {
namespace {

/// Saved OpenGL state that the measurement changes; restored at the end.
class SavedGlState {
public:
    SavedGlState() {
        for (std::size_t i = 0; i < std::size(kSwitches); ++i) on_[i] = glIsEnabled(kSwitches[i]);
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_);
        glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_);
        glGetIntegerv(GL_CURRENT_PROGRAM, &program_);
        glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &vao_);
        glGetIntegerv(GL_VIEWPORT, viewport_);
        glGetIntegerv(GL_DEPTH_FUNC, &depth_func_);
        glGetBooleanv(GL_DEPTH_WRITEMASK, &depth_mask_);
        glGetBooleanv(GL_COLOR_WRITEMASK, colour_mask_);
        glGetDoublev(GL_DEPTH_RANGE, depth_range_);
        glGetIntegerv(GL_CLIP_ORIGIN, &clip_origin_);
        glGetIntegerv(GL_CLIP_DEPTH_MODE, &clip_depth_);
        glGetFloatv(GL_POLYGON_OFFSET_FACTOR, &factor_);
        glGetFloatv(GL_POLYGON_OFFSET_UNITS, &units_);
        if (clamps_) glGetFloatv(GL_POLYGON_OFFSET_CLAMP_EXT, &clamp_);
        glGetIntegerv(GL_PACK_ALIGNMENT, &pack_);
    }
    ~SavedGlState() {
        for (std::size_t i = 0; i < std::size(kSwitches); ++i)
            on_[i] ? glEnable(kSwitches[i]) : glDisable(kSwitches[i]);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, GLuint(draw_));
        glBindFramebuffer(GL_READ_FRAMEBUFFER, GLuint(read_));
        glUseProgram(GLuint(program_));
        glBindVertexArray(GLuint(vao_));
        glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
        glDepthFunc(GLenum(depth_func_));
        glDepthMask(depth_mask_);
        glColorMask(colour_mask_[0], colour_mask_[1], colour_mask_[2], colour_mask_[3]);
        glDepthRange(depth_range_[0], depth_range_[1]);
        glClipControl(GLenum(clip_origin_), GLenum(clip_depth_));
        if (clamps_)
            glPolygonOffsetClampEXT(factor_, units_, clamp_);
        else
            glPolygonOffset(factor_, units_);
        glPixelStorei(GL_PACK_ALIGNMENT, pack_);
    }
    SavedGlState(const SavedGlState&) = delete;
    SavedGlState& operator=(const SavedGlState&) = delete;

private:
    static constexpr GLenum kSwitches[] = {GL_DEPTH_TEST,   GL_CULL_FACE,         GL_BLEND,
                                           GL_STENCIL_TEST, GL_SCISSOR_TEST,      GL_POLYGON_OFFSET_FILL,
                                           GL_DEPTH_CLAMP,  GL_RASTERIZER_DISCARD};
    GLboolean on_[std::size(kSwitches)] = {};
    const bool clamps_ = epoxy_has_gl_extension("GL_EXT_polygon_offset_clamp");
    GLint draw_ = 0, read_ = 0, program_ = 0, vao_ = 0, viewport_[4] = {}, depth_func_ = 0, clip_origin_ = 0,
          clip_depth_ = 0, pack_ = 4;
    GLboolean depth_mask_ = GL_TRUE, colour_mask_[4] = {};
    GLdouble depth_range_[2] = {};
    GLfloat factor_ = 0, units_ = 0, clamp_ = 0;
};

/// Plane to draw, with `depth` at its centre and slope `per_pixel` along x and y.
struct TiltedPlane {
    double depth = 0.4;
    glm::dvec2 per_pixel{0};
    float factor = 0, units = 0;
};

constexpr int kPlanePixels = 8;  ///< pixels along a plane's side

/// Measures the shift of the stored depth at the centre of each plane, by its polygon offset.
std::vector<double> offsets(MapFormat format, const std::vector<TiltedPlane>& probes) {
    const SavedGlState kept;
    const bool colour = is_colour(format);
    const int width = int(probes.size()) * kPlanePixels,
              height = 2 * kPlanePixels;  // lower half without offset, upper half with it
    gl::Target stored, beside;
    stored.ensure("polygon offset calibration", map_internal_format(format), width, height);
    if (colour) beside.ensure("polygon offset calibration, depth", GL_DEPTH_COMPONENT32F, width, height);
    const auto framebuffer = colour ? gl::make_framebuffer("polygon offset calibration", &stored, &beside)
                                    : gl::make_framebuffer("polygon offset calibration", nullptr, &stored);
    const auto vao = gl::VertexArray::create("polygon offset calibration");
    gl::ProgramCache programs;
    const GLuint program =
        programs.get({.vertex = "passes/offset_probe.vert.glsl",
                      .fragment = "passes/depth.frag.glsl",
                      .defines = {{"MAP_IS_COLOUR", colour ? "1" : "0"}, {"MAP_HOLDS_DISTANCES", "0"}}});
    const GLint plane = glGetUniformLocation(program, "plane");
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    for (const GLenum off :
         {GL_CULL_FACE, GL_BLEND, GL_STENCIL_TEST, GL_SCISSOR_TEST, GL_DEPTH_CLAMP, GL_RASTERIZER_DISCARD})
        glDisable(off);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthRange(0, 1);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glUseProgram(program);
    glBindVertexArray(vao.id());
    for (std::size_t i = 0; i < probes.size(); ++i) {
        const TiltedPlane& p = probes[i];
        // Normalised coordinates grow by 2 across the tile.
        const glm::dvec2 slope = p.per_pixel * (0.5 * kPlanePixels);
        glUniform3f(plane, float(slope.x), float(slope.y), float(p.depth));
        for (const int row : {0, 1}) {
            glPolygonOffset(float(row) * p.factor, float(row) * p.units);
            glViewport(int(i) * kPlanePixels, row * kPlanePixels, kPlanePixels, kPlanePixels);
            glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
        }
    }
    std::vector<float> depths(std::size_t(width) * std::size_t(height));
    gl::prepare_read_back();
    glGetTextureImage(stored.texture.id(), 0, colour ? GL_RED : GL_DEPTH_COMPONENT, GL_FLOAT,
                      GLsizei(depths.size() * sizeof(float)), depths.data());
    std::vector<double> out;
    for (std::size_t i = 0; i < probes.size(); ++i) {
        const auto at = [&](int row) {
            return double(depths[std::size_t(row * kPlanePixels + kPlanePixels / 2) * std::size_t(width) +
                                 i * kPlanePixels + kPlanePixels / 2]);
        };
        const double moved = at(1) - at(0);
        out.push_back(std::max(moved - depth_quantum(format, at(1)), 0.0));
    }
    return out;
}

constexpr double kEqual = 0.01;  ///< relative tolerance; possible kinds of r and m differ far more

}  // namespace

PolygonOffset measure_polygon_offset(MapFormat format) {
    if (holds_distances(format)) return {.measured = true, .unit_steps = 0, .slope_gain = 0};
    // Offset units: some hundredths of the depth range in fixed-point formats, thousands of steps in float formats.
    const float units = format == MapFormat::D16 ? 0x1p10f : format == MapFormat::D24 ? 0x1p16f : 0x1p12f;
    const float factor = 8;
    std::vector<TiltedPlane> probes;
    for (const double depth : {0x1p-12, 0.01, 0.1, 0.3, 0.6}) probes.push_back({.depth = depth, .units = units});
    const std::size_t flat = probes.size();
    for (const glm::dvec2& direction : {glm::dvec2(1, 0), {0, 1}, {1, 1}, {-1, 0.5}, {0.5, -1}})
        probes.push_back({.per_pixel = 0.01 * direction, .factor = factor});
    const std::vector<double> moved = offsets(format, probes);

    PolygonOffset out;
    out.measured = true;
    double least = 1, most = 0, least_steps = 1e300;
    for (std::size_t i = 0; i < flat; ++i) {
        const double r = moved[i] / units;
        least = std::min(least, r);
        most = std::max(most, r);
        least_steps = std::min(least_steps, r / depth_quantum(format, probes[i].depth));
    }
    const bool same = most <= (1 + kEqual) * least;
    out.unit_depth = same ? least : 0;
    out.unit_steps = same ? 0 : least_steps;

    double of_larger = 1e300, of_length = 1e300;
    for (std::size_t i = flat; i < probes.size(); ++i) {
        const glm::dvec2 s = glm::abs(probes[i].per_pixel);
        of_larger = std::min(of_larger, moved[i] / (factor * std::max(s.x, s.y)));
        of_length = std::min(of_length, moved[i] / (factor * glm::length(s)));
    }
    out.slope_is_length = of_length > 1 - kEqual;
    out.slope_gain = out.slope_is_length ? of_length : of_larger;
    return out;
}

}  // namespace si
