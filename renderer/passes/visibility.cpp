// Visibility of each light as a texture of its own.
#include <fmt/format.h>

#include "renderer/frame/state.h"
#include "renderer/passes/shadow_volumes.h"
#include "renderer/reference/truth_picture.h"
#include "renderer/settings/sources.h"

namespace si {
namespace {

const TruthPicture* traced_picture(const FrameState& f, std::size_t light) {
    return light < f.traced_pictures.size() ? f.traced_pictures[light] : nullptr;
}

/// What is drawn to evaluate a light. Empty: its layer is all lit, or there already.
std::string_view source_file(const FrameState& f, std::size_t light) {
    if (light >= f.gl.fitted.size()) return {};
    const Source& source = source_of(f.settings, int(light));
    if (source.needs.stencil && f.gl.fitted[light].shadowed && !f.gl.owned.get<ShadowVolumes>().draws(light)) return {};
    const bool lit = !f.gl.fitted[light].shadowed || (source.file.empty() && !source.needs.truth);
    if (lit) return f.request.no_skip ? sources()[0].file : std::string_view();
    return source.file;
}

}  // namespace

void put_traced_visibility(const TruthPicture& truth, const gl::Target& visibility, int light) {
    const FloatImage& traced = truth.traced.truth->visibility;  // rows from the top, a pixel every `step`
    const int width = visibility.width, height = visibility.height, step = truth.step;
    std::vector<float> pixels(std::size_t(width) * std::size_t(height));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)] = traced.at(x / step, (height - 1 - y) / step);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage3D(visibility.texture.id(), 0, 0, 0, light, width, height, 1, GL_RED, GL_FLOAT, pixels.data());
}

void add_visibility_pass(FrameState& f, std::vector<Pass>& plan) {
    Pass pass;
    pass.name = "visibility";
    pass.reads = lookup_reads(f);
    pass.reads.push_back(Result::ShadowVolumes);
    pass.writes = {Result::Visibility};
    pass.idle_reason = "nothing reads it: the shading pass evaluates it itself";
    Key key = f.camera_key;
    key.add(f.geometry_key).add(f.lights_key).add(f.maps_key).add(f.gl.programs.source().generation());
    pass.key = key.value();
    pass.cached = &f.gl.visibility.key;
    pass.run = [&f](PassInfo& info) {
        const int layers = int(std::max<std::size_t>(f.gl.fitted.size(), 1));
        f.gl.visibility.ensure("visibility", GL_R32F, f.request.width, f.request.height, layers);
        for (int light = 0; light < layers; ++light) {
            f.gl.visibility_framebuffer =
                gl::make_framebuffer("visibility", &f.gl.visibility, &f.gl.camera_depth, light);
            const GLuint framebuffer = f.gl.visibility_framebuffer.id();
            const std::uint64_t depth = f.gl.depth_key;
            f.begin_camera_pass(framebuffer);
            const glm::vec4 lit(1);
            glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, &lit.x);
            const std::string_view file = source_file(f, std::size_t(light));
            if (file.empty()) {
                if (f.gl.depth_key != depth) f.gl.depth_key = 0;  // cleared, and nothing drawn
                if (const TruthPicture* truth = traced_picture(f, std::size_t(light))) {
                    put_traced_visibility(*truth, f.gl.visibility, light);
                    info.reason +=
                        fmt::format("; light {} by {} rays, traced before the frame", light, truth->traced.truth->rays);
                }
                continue;
            }
            if (source_of(f.settings, light).needs.stencil)
                glBindTextureUnit(kVolumes, f.gl.owned.get<ShadowVolumes>().lit().texture.id());
            f.draw_from_camera("passes/visibility.frag.glsl",
                               {{"LIGHT_INDEX", std::to_string(light)}, {"SOURCE_FILE", std::string(file)}}, info);
        }
        f.gl.visibility_view_layer = -1;
    };
    plan.push_back(std::move(pass));
}

}  // namespace si
