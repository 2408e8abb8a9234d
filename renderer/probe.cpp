// The lit/shadow test of one pixel written out: the surface from the GPU, the arithmetic again in double.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "renderer/error.h"
#include "renderer/light_receiver.h"
#include "renderer/renderer_impl.h"

namespace si {
namespace {

struct PixelFacts {
    std::array<glm::vec4, 4> values{};  // the outputs of probe.frag.glsl
    bool hit() const { return values[0].w > 0.5f; }
};

/// Draws the 2x2 block that holds the pixel, so that derivatives are those of the whole picture.
PixelFacts draw_pixel(FrameState& f, int x, int y_bottom, int light) {
    std::array<gl::Target, 4> targets;
    gl::Target depth;
    auto framebuffer = gl::Framebuffer::create("probe");
    std::array<GLenum, 4> buffers{};
    for (std::size_t i = 0; i < 4; ++i) {
        targets[i].ensure("probe", GL_RGBA32F, 2, 2);
        buffers[i] = GL_COLOR_ATTACHMENT0 + GLenum(i);
        glNamedFramebufferTexture(framebuffer.id(), buffers[i], targets[i].texture.id(), 0);
    }
    depth.ensure("probe depth", GL_DEPTH_COMPONENT32F, 2, 2);
    glNamedFramebufferTexture(framebuffer.id(), GL_DEPTH_ATTACHMENT, depth.texture.id(), 0);
    glNamedFramebufferDrawBuffers(framebuffer.id(), 4, buffers.data());
    const std::uint64_t pictures = std::exchange(f.gl.depth_key, 0);  // this depth is fresh, and not the picture's
    f.begin_camera_pass(framebuffer.id());
    f.gl.depth_key = pictures;
    glViewport(-(x & ~1), -(y_bottom & ~1), f.request.width, f.request.height);
    const glm::vec4 nothing(0);
    for (GLint i = 0; i < 4; ++i) glClearNamedFramebufferfv(framebuffer.id(), GL_COLOR, i, &nothing.x);
    PassInfo info;
    f.surface_flags = true;  // the object's number is asked for
    f.draw_from_camera("passes/probe.frag.glsl", {{"LIGHT_INDEX", std::to_string(light)}}, info);
    PixelFacts facts;
    for (std::size_t i = 0; i < 4; ++i) {
        std::array<glm::vec4, 4> block;
        glGetTextureImage(targets[i].texture.id(), 0, GL_RGBA, GL_FLOAT, sizeof block, block.data());
        facts.values[i] = block[std::size_t((y_bottom & 1) * 2 + (x & 1))];
    }
    return facts;
}

std::string_view place_name(MapPlace place) {
    switch (place) {
        case MapPlace::Inside: return "inside";
        case MapPlace::BeforeNear: return "before near";
        case MapPlace::Sides: return "sides";
        case MapPlace::BeyondFar: return "beyond far";
        case MapPlace::Behind: return "behind";
    }
    return "";
}

/// Why no light comes to a place, whatever stands between; empty when some does.
std::string unreached(const FittedLight& light, const glm::dvec3& position_ws) {
    if (light.type == LightType::Directional) return {};
    const glm::dvec3 away = light.position - position_ws;
    const double distance = glm::length(away);
    if (light.type == LightType::Spot && !(glm::dot(away, light.to_light) > light.cos_cone_outer * distance))
        return "no light: outside of the light's cone";
    if (within_range(distance, light.range_m)) return {};
    return fmt::format("no light: {:.4g} m away, beyond the light's range of {:.4g} m", distance, light.range_m);
}

std::string verdict(const FrameState& f, const Probe::PerLight& p, bool receives) {
    if (!receives) return "lit: this object receives no shadows";
    if (p.n_dot_l <= 0) return "in shadow: the surface faces away from the light";
    if (p.where == "behind") return "outside the map: behind the light";
    if (p.where == "beyond far" && f.settings.map.far_guard)
        return fmt::format("{}: beyond the light's far plane, the far guard decides", p.visibility > 0.5 ? "lit" : "unlit");
    const double gap = p.own_m - p.stored_m;
    const std::string bias = fmt::format("bias brings it {:.4g} m ({:.3g} texels) nearer", p.bias_m, p.bias_texels);
    const std::string texel = gap > 0 ? fmt::format("its texel stores a surface {:.4g} m nearer to the light", gap)
                                      : fmt::format("its texel stores nothing nearer (own depth is {:.4g} m before it)", -gap);
    if (p.visibility >= 1) return fmt::format("lit: {}, {}", texel, bias);
    if (p.visibility <= 0) return fmt::format("in shadow: {}, {}", texel, bias);
    return fmt::format("partly lit ({:.0f} %): {}, {}; the kernel's taps disagree", p.visibility * 100, texel, bias);
}

Probe::PerLight test_light(const FrameState& f, std::size_t i, const PixelFacts& facts, const FloatImage* map) {
    const FittedLight& light = f.gl.fitted[i];
    Probe::PerLight p;
    p.light = int(i);
    p.casts = light.casts;
    p.visibility = facts.values[3].x;
    const glm::dvec3 position = glm::dvec3(facts.values[0]) + f.origin;
    const std::string dark = unreached(light, position);
    if (!light.casts) {
        p.where = "no map";
        p.verdict = dark.empty() ? "lit: " + light.reason : dark;
        return p;
    }
    const glm::dvec3 geometric(facts.values[1]), mapped(facts.values[2]);
    const glm::dvec3 vertex(facts.values[3].y, facts.values[3].z, facts.values[3].w);
    const BiasSettings& bias = f.settings.bias;
    const glm::dvec3 normal = bias.normal_source == int(NormalSource::Mapped)    ? mapped
                              : bias.normal_source == int(NormalSource::Shading) ? vertex
                                                                                 : geometric;
    const int n = f.map_resolution;
    const LightReceiver r = light_receiver(light, bias, n, position, geometric, normal);
    const LightView& view = light.views[r.view];
    p.face = int(r.view);
    p.n_dot_l = r.n_dot_l;
    p.clip = r.clip, p.ndc = r.ndc, p.uvd = r.uvd;
    p.texel_m = r.texel_m;
    p.own = r.uvd.z, p.own_m = r.own_m;
    p.bias_depth = r.bias_depth, p.bias_m = r.bias_m, p.bias_texels = r.bias_m / r.texel_m;
    p.normal_offset_m = r.normal_offset_m;
    p.offset_position_ws = position + normal * p.normal_offset_m;
    p.compared = r.compared;
    p.texel = glm::ivec2(glm::clamp(glm::floor(glm::dvec2(r.tap) * double(n)), glm::dvec2(-1e9), glm::dvec2(1e9)));
    p.where = place_name(r.place);
    glm::ivec2 at = p.texel;
    if (f.settings.map.wrap == int(MapWrap::Repeat)) at = ((at % n) + n) % n;
    const bool in_map = at.x >= 0 && at.y >= 0 && at.x < n && at.y < n;
    const bool outside_lit = f.settings.map.outside == int(Outside::Lit);
    const double far_depth = view.curve.convention.far_depth();
    if (in_map || f.settings.map.wrap == int(MapWrap::Clamp)) {
        at = glm::clamp(at, glm::ivec2(0), glm::ivec2(n - 1));
        p.stored = map->at(at.x, n - 1 - at.y);  // the image's first row is the map's top
    } else {
        p.stored = outside_lit ? far_depth : 1 - far_depth;
    }
    p.stored_m = view.curve.distance(p.stored);
    p.verdict = dark.empty() ? verdict(f, p, facts.values[1].w > 0.5f) : dark;
    return p;
}

}  // namespace

Probe Renderer::probe(const Scene& scene, const Settings& settings, const FrameRequest& request, int x, int y) {
    if (x < 0 || y < 0 || x >= request.width || y >= request.height)
        throw UsageError(fmt::format("pixel {},{} lies outside the picture of {} x {} pixels", x, y, request.width,
                                     request.height));
    FrameRequest maps = request;
    maps.outputs = {.colour = false, .shadow_map = true};
    maps.force = maps.timing = false;
    render(scene, settings, maps);
    FrameState f = impl_->prepare(scene, settings, maps);
    impl_->upload_blocks(f);
    Probe out;
    out.x = x, out.y = y;
    const int y_bottom = request.height - 1 - y;
    for (std::size_t i = 0; i < std::max<std::size_t>(f.gl.fitted.size(), 1); ++i) {
        const PixelFacts facts = draw_pixel(f, x, y_bottom, int(i));
        out.hit = facts.hit();
        if (!out.hit) return out;
        out.position_ws = glm::dvec3(facts.values[0]) + f.origin;
        out.normal_ws = glm::dvec3(facts.values[1]);
        const auto object = std::size_t(facts.values[0].w - 0.5f);
        if (object < scene.objects.size())
            out.object = scene.nodes[std::size_t(scene.objects[object].node)].path;
        if (i >= f.gl.fitted.size()) break;
        FloatImage map;
        if (f.gl.fitted[i].casts) {
            const glm::dvec3 d = out.position_ws - f.gl.fitted[i].position;
            map = read_shadow_map(int(i), int(view_index(d, f.gl.fitted[i].views.size())));
        }
        out.lights.push_back(test_light(f, i, facts, &map));
    }
    return out;
}

}  // namespace si
