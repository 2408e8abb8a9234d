#include "renderer/frame/blocks.h"

#include <fmt/format.h>

#include <cmath>

#include "renderer/frame/settings_block.h"
#include "renderer/frame/state.h"
#include "renderer/projection/projection.h"
#include "renderer/scene/placement.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/depth_compare.h"
#include "renderer/settings/filters.h"
#include "renderer/view/lights/kernel_reach.h"
#include "renderer/view/lights/sky.h"
#include "shaders/shared/units.h"

namespace si {
namespace {

/// Returns the border colour of map samplers by map.wrap: the value outside the map, in each channel.
void set_map_wrap(GLuint sampler, const MapSettings& map, float border) {
    const GLint wrap = map.wrap == MapWrap::Border   ? GL_CLAMP_TO_BORDER
                       : map.wrap == MapWrap::Repeat ? GL_REPEAT
                                                     : GL_CLAMP_TO_EDGE;
    const glm::vec4 colour(border);
    glSamplerParameteri(sampler, GL_TEXTURE_WRAP_S, wrap);
    glSamplerParameteri(sampler, GL_TEXTURE_WRAP_T, wrap);
    glSamplerParameterfv(sampler, GL_TEXTURE_BORDER_COLOR, &colour.x);
}

void set_samplers(const FrameState& f) {
    const MapSettings& m = f.settings.map;
    const bool bilinear = is_bilinear(filter_of(f.settings), f.settings);
    const float far_depth = m.reversed_z ? 0.f : 1.f;
    const float border = m.outside == Outside::Lit ? far_depth : 1.f - far_depth;
    for (const GLuint sampler : {f.gl.map_nearest.id(), f.gl.map_compare.id()}) {
        set_map_wrap(sampler, m, border);
        const bool compare = sampler == f.gl.map_compare.id();
        glSamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, compare && bilinear ? GL_LINEAR : GL_NEAREST);
        glSamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, compare && bilinear ? GL_LINEAR : GL_NEAREST);
    }
    const bool less = m.compare == Compare::Less;
    // Border moments depend on the kernel: lib/moments.glsl blends them in.
    MapSettings held = m;
    if (m.wrap == MapWrap::Border) held.wrap = MapWrap::Clamp;
    const GLuint blended = f.gl.map_blended.id();
    set_map_wrap(blended, held, 0);
    glSamplerParameteri(blended, GL_TEXTURE_MIN_FILTER, f.settings.filter.mips ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    glSamplerParameteri(blended, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    if (f.driver.anisotropy)
        glSamplerParameterf(blended, GL_TEXTURE_MAX_ANISOTROPY,
                            f.settings.filter.mips ? float(f.settings.filter.anisotropy) : 1.f);
    const GLint function = m.reversed_z ? (less ? GL_GREATER : GL_GEQUAL) : (less ? GL_LESS : GL_LEQUAL);
    glSamplerParameteri(f.gl.map_compare.id(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glSamplerParameteri(f.gl.map_compare.id(), GL_TEXTURE_COMPARE_FUNC, function);
}

shared::LightBlock light_block(const FrameState& f, std::size_t i) {
    const FittedLight& light = f.gl.fitted[i];
    shared::LightBlock b{};
    b.position = glm::vec4(glm::vec3(light.position - f.origin), float(light.range_m));
    b.to_light = glm::vec4(glm::vec3(light.to_light), float(light.cos_cone_outer));
    if (light.type == LightType::Directional) b.to_light.w = float(light.radiance.r);
    const Reach reach = kernel_reach_in_light(f.settings, light, f.map_size);
    b.kernel = glm::vec4(light.size, reach.bias, reach.edge, reach.read);
    b.radiance = glm::vec4(glm::vec3(light.radiance), float(light.cos_cone_inner));
    return b;
}

void put_sky(const FrameState& f, shared::FrameBlock& block) {
    const Sky sky = sky_for_sun(direction_to_brightest_sun(f.gl.fitted));
    const ShadingSettings& s = f.settings.shading;
    const double exposure = std::exp2(s.exposure);
    const auto lit = [](const glm::dvec3& colour) { return glm::vec4(glm::vec3(colour), 0); };
    const glm::dvec3 level(sky.to_sun.x, 0, sky.to_sun.z);
    block.ambient = lit(s.ambient * sky.ambient);
    block.ambient.w = float(exposure);
    block.ambient_rise = lit(sky.rise * glm::normalize(glm::dvec3(0, 1, 0) + sky.sunward * level));
    block.sky_zenith = lit(exposure * sky.zenith);
    block.sky_horizon = lit(exposure * sky.horizon);
    block.sky_below = lit(exposure * sky.below);
    block.sky_sun = glm::vec4(glm::vec3(sky.to_sun), float(sky.glow));
    const Bounds& ground = f.scene.ground_bounds;
    if (!ground.empty())
        block.ground = glm::vec4(glm::vec3(ground.centre() - f.origin), 2 / std::max(ground.hi.x - ground.lo.x, 1e-30));
}

shared::ViewBlock view_block(const FrameState& f, const FittedLight& light, std::size_t i) {
    const LightView& v = light.views[i];
    shared::ViewBlock b{};
    if (light.is_cascaded()) b.span = glm::vec4(light.chooser.spans[i].ends, light.chooser.spans[i].blends_from, 0, 0);
    // Matrices of the block are stored by rows. Nothing reads the last row of a map without perspective.
    b.uvd_from_relative = glm::transpose(glm::mat4(uvd_from_clip(v.curve.convention) * v.clip_from_relative(f.origin)));
    // Two texels a side are as long as half of the map.
    const int longest = f.map_size.longest();
    const double half = v.warped()               ? 0
                        : f.map_size.is_square() ? v.texel_size(1, 2)
                                                 : 0.5 * longest * v.texel_size(1, f.map_size);
    b.curve = glm::vec4(v.curve.near, v.curve.far, half, 1.0 / longest);
    if (light.derives_texels(f.map_size)) {
        const DepthWarp warp = v.curve.warp.value_or(DepthWarp{0, v.curve.near, v.curve.far, 0});
        b.warp = glm::vec4(warp.middle_m, warp.near_m, warp.far_m, warp.rise);
    }
    if (light.chooser.choice == ViewChoice::One) b.span.x = b.curve.w;
    // Single precision, as in lib/receiver.glsl for all other views.
    b.span.z = 2.f * b.curve.z * b.curve.w;
    b.span.w = 1.f / (b.curve.y - b.curve.x);
    if (v.curve.perspective) {
        const glm::dvec2 scale =
            f.map_size.texels() * glm::dvec2(std::abs(v.projection[0][0]), std::abs(v.projection[1][1]));
        b.span.z = float(scale.x / std::max(scale.x, scale.y));
        b.span.w = float(scale.y / std::max(scale.x, scale.y));
    }
    return b;
}

}  // namespace

std::string blocks_glsl(bool as_images) {
    return fmt::format("#define BLOCKS_AS_IMAGES {}\n", int(as_images)) + settings_block_text(as_images);
}

shared::FrameBlock make_frame_block(const FrameState& f) {
    shared::FrameBlock block{};
    block.clip_from_relative = glm::mat4(f.camera.clip_from_relative(f.origin));
    const glm::dmat3& axes = f.camera.axes;
    const glm::dmat3 turn = glm::transpose(axes);
    const glm::dvec3 eye = f.camera.eye - f.origin;
    block.eye_from_relative = glm::mat4(glm::dmat4(turn));
    block.eye_from_relative[3] = glm::vec4(glm::vec3(-(turn * eye)), 1);
    block.relative_from_eye = glm::mat4(glm::dmat4(axes));
    block.relative_from_eye[3] = glm::vec4(glm::vec3(eye), 1);
    for (glm::mat4* m : {&block.clip_from_relative, &block.eye_from_relative, &block.relative_from_eye})
        *m = glm::transpose(*m);
    const DepthCurve& depth = f.camera.curve;
    const double half = f.camera.orthographic ? 0.5 * f.camera.height : std::tan(0.5 * f.camera.fov_y_rad);
    block.lens = glm::vec4(half * f.camera.aspect, half,
                           depth.perspective ? 1 / depth.near - 1 / depth.far : depth.far - depth.near,
                           depth.perspective ? 1 / depth.far : depth.far);
    block.eye = glm::vec4(glm::vec3(f.camera.eye - f.origin), f.camera.orthographic ? 1.f : 0.f);
    block.forward = glm::vec4(glm::vec3(-f.camera.axes[2]), 0.f);
    const Camera& divided = f.request.map_camera ? f.request.map_camera->camera : f.camera;
    block.divided_eye = glm::vec4(glm::vec3(divided.eye - f.origin), 0.f);
    block.divided_forward = glm::vec4(glm::vec3(-divided.axes[2]), 0.f);
    block.map_origin = glm::vec4(glm::vec3(shader_origin(f.settings, main_bounds(f.scene).centre()) - f.origin), 0.f);
    block.picture = glm::vec4(f.request.width, f.request.height, 0, 0);
    const PolygonOffset& offset = f.driver.offset[std::size_t(f.settings.map.format)];
    block.pixel = glm::vec4(f.pixel_origin, kernel_cost(f.settings).texels, 0);
    block.offset = glm::vec4(offset.unit_depth, offset.unit_steps, offset.slope_gain, offset.slope_is_length ? 1 : 0);
    put_sky(f, block);
    for (std::size_t i = 0; i < f.gl.fitted.size(); ++i) {
        block.lights[i] = light_block(f, i);
        const FittedLight& light = f.gl.fitted[i];
        if (!light.casts) continue;
        for (std::size_t v = 0; v < light.views.size(); ++v)
            block.views[std::size_t(f.first_view[i]) + v] = view_block(f, light, v);
    }
    return block;
}

void replace_frame_block(const FrameState& f, const shared::FrameBlock& block) {
    TexelBuffer& frame = f.gl.blocks.frame;
    frame.upload(std::as_bytes(std::span(&block, 1)));
    frame.bind_block(shared::BLOCK_FRAME);
    if (f.blocks_as_images()) frame.bind_image(shared::IMAGE_FRAME_BLOCK, GL_RGBA32UI);
}

void upload_blocks(const FrameState& f) {
    Blocks& blocks = f.gl.blocks;
    replace_frame_block(f, make_frame_block(f));
    blocks.settings.upload(settings_block_bytes(f.settings));
    blocks.settings.bind_block(shared::BLOCK_SETTINGS);
    if (f.blocks_as_images()) blocks.settings.bind_image(shared::IMAGE_SETTINGS_BLOCK, GL_RGBA32UI);
    if (!f.disk_texels.empty()) {
        blocks.disk.upload(std::as_bytes(std::span(f.disk_texels)));
        blocks.disk.bind_image(shared::IMAGE_DISK_PLACES, GL_RG32UI);
    }
    set_samplers(f);
}

}  // namespace si
