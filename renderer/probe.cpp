// The lit/shadow test of one pixel written out: the surface from the GPU, the arithmetic again in double.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "renderer/error.h"
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

int face_of(const glm::dvec3& d) {
    const glm::dvec3 a = glm::abs(d);
    if (a.x >= a.y && a.x >= a.z) return d.x >= 0 ? 0 : 1;
    if (a.y >= a.z) return d.y >= 0 ? 2 : 3;
    return d.z >= 0 ? 4 : 5;
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
    if (!light.casts) {
        p.where = "no map";
        p.verdict = "lit: " + light.reason;
        return p;
    }
    const glm::dvec3 position = glm::dvec3(facts.values[0]) + f.origin;
    const glm::dvec3 geometric(facts.values[1]), mapped(facts.values[2]);
    const glm::dvec3 vertex(facts.values[3].y, facts.values[3].z, facts.values[3].w);
    const glm::dvec3 to_light = light.type == LightType::Directional ? light.to_light
                                                                     : glm::normalize(light.position - position);
    const BiasSettings& bias = f.settings.bias;
    const glm::dvec3 normal = bias.normal_source == int(NormalSource::Mapped)    ? mapped
                              : bias.normal_source == int(NormalSource::Shading) ? vertex
                                                                                 : geometric;
    p.n_dot_l = glm::dot(geometric, to_light);
    p.face = light.views.size() == 6 ? face_of(position - light.position) : 0;
    const LightView& view = light.views[std::size_t(p.face)];
    p.clip = view.clip_from_relative(position) * glm::dvec4(0, 0, 0, 1);
    const double w = p.clip.w;
    p.ndc = glm::dvec3(p.clip) / w;
    const auto to_unit = [&](const glm::dvec3& ndc) {
        const double z = view.curve.convention.zero_to_one ? ndc.z : ndc.z * 0.5 + 0.5;
        return glm::dvec3(ndc.x * 0.5 + 0.5, ndc.y * 0.5 + 0.5, z);
    };
    p.uvd = to_unit(p.ndc);
    const int n = f.map_resolution;
    const double z = view.curve.perspective ? w : 1.0;
    p.texel_m = view.texel_size(z, n);
    p.own = p.uvd.z;
    p.own_m = view.curve.distance(p.own);
    const double per_m = view.curve.slope(p.own_m);
    const double amount = std::max(bias.slope * (1 - std::clamp(glm::dot(normal, to_light), 0.0, 1.0)), bias.constant);
    p.bias_depth = bias.unit == int(BiasUnit::Texels)   ? amount * p.texel_m * per_m
                   : bias.unit == int(BiasUnit::Metres) ? amount * per_m
                                                        : amount;
    p.bias_m = p.bias_depth / per_m;
    p.bias_texels = p.bias_m / p.texel_m;
    p.normal_offset_m = bias.normal * p.texel_m;
    p.offset_position_ws = position + normal * p.normal_offset_m;
    const glm::dvec4 moved = view.clip_from_relative(p.offset_position_ws) * glm::dvec4(0, 0, 0, 1);
    const glm::dvec3 tap = to_unit(glm::dvec3(moved) / moved.w);
    p.compared = tap.z - (view.curve.convention.reversed ? -p.bias_depth : p.bias_depth);
    p.texel = glm::ivec2(glm::clamp(glm::floor(glm::dvec2(tap) * double(n)), glm::dvec2(-1e9), glm::dvec2(1e9)));
    const bool beyond = view.curve.convention.reversed ? p.uvd.z < 0 : p.uvd.z > 1;
    const bool sides = p.uvd.x < 0 || p.uvd.x > 1 || p.uvd.y < 0 || p.uvd.y > 1;
    p.where = w <= 0 ? "behind" : beyond ? "beyond far" : sides ? "sides" : p.own_m < view.curve.near ? "before near" : "inside";
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
    p.verdict = verdict(f, p, facts.values[1].w > 0.5f);
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
            map = read_shadow_map(int(i), f.gl.fitted[i].views.size() == 6 ? face_of(d) : 0);
        }
        out.lights.push_back(test_light(f, i, facts, &map));
    }
    return out;
}

}  // namespace si
