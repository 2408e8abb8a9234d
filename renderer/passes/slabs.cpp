// Drawing of texels of the shown light's map as quads over a pane's picture.
#include "renderer/passes/slabs.h"

#include <algorithm>

#include "renderer/gl/driver_failure.h"
#include "renderer/passes/camera_drawing.h"
#include "renderer/passes/pages.h"
#include "renderer/passes/texel_slabs.h"
#include "renderer/settings/map_storage.h"

namespace si {
namespace {

using SlabTargets = TexelSlabs::Targets;

struct Instance {
    glm::vec3 corners[4];  // relative to the frame's origin
    float biased;
};
static_assert(sizeof(Instance) == 52);

constexpr float kHiddenStrength = 0.16f;  ///< opacity of quads behind surfaces

void read_depths(const FrameState& f, const PagePasses& pages, SlabTargets& s, int layer, const TexelRegion& region) {
    Key key;
    key.add(f.plan.key_of(Result::ShadowMaps)).add(layer).add(region);
    if (s.depths_key == key.value()) return;
    s.depths_key = key.value();
    const MapLayer of{f.shown_view()->curve, layer, f.paged, holds_distances(f.settings.map.format)};
    s.depths = pages.read_map_depths(f.result(Result::ShadowMaps), of, region.first, region.size);
}

/// Uploads the quads' corners, farthest from the camera first for blending.
void upload_instances(const FrameState& f, SlabTargets& s, const LightView& view, const TexelRegion& region) {
    std::vector<TexelSlab> slabs =
        texel_slabs(view, f.settings.bias, f.map_size, region, s.depths, f.settings.view.slabs);
    std::vector<std::pair<double, std::size_t>> order(slabs.size());
    for (std::size_t i = 0; i < slabs.size(); ++i) {
        const auto& c = slabs[i].corners;
        order[i] = {glm::dot(c[0] + c[3] - 2.0 * f.camera.eye, f.camera.axes[2]), i};
    }
    std::sort(order.begin(), order.end());
    std::vector<Instance> instances(slabs.size());
    for (std::size_t i = 0; i < slabs.size(); ++i) {
        const TexelSlab& slab = slabs[order[i].second];
        for (std::size_t c = 0; c < 4; ++c) instances[i].corners[c] = glm::vec3(slab.corners[c] - f.origin);
        instances[i].biased = slab.biased ? 1.f : 0.f;
    }
    s.count = int(instances.size());
    if (!s.vao) {
        s.vao = gl::VertexArray::create("texel slabs");
        s.instances = gl::Buffer::create("texel slabs");
        for (GLuint i = 0; i < 5; ++i) gl::enable_attribute(s.vao, i, 0, i < 4 ? 3 : 1, i * 12);
        glVertexArrayBindingDivisor(s.vao.id(), 0, 1);
    }
    gl::fill_buffer(s.instances, "texel slabs", instances, GL_STREAM_DRAW);
    glVertexArrayVertexBuffer(s.vao.id(), 0, s.instances.id(), 0, sizeof(Instance));
}

void draw_slabs(const FrameState& f, const SlabTargets& s, PassInfo& info) {
    const GLuint id = f.program("passes/slabs.vert.glsl", "passes/slabs.frag.glsl");
    glUseProgram(id);
    glBindVertexArray(s.vao.id());
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
    // Quads within a surface stay visible, as they are drawn nearer by a pixel's depth.
    const bool reversed = f.camera.curve.convention.reversed;
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(reversed ? 1.f : -1.f, reversed ? 1.f : -1.f);
    for (const bool hidden : {true, false}) {
        if (reversed)
            glDepthFunc(hidden ? GL_LESS : GL_GEQUAL);
        else
            glDepthFunc(hidden ? GL_GREATER : GL_LEQUAL);
        glUniform1f(glGetUniformLocation(id, "strength"), hidden ? kHiddenStrength : 1.f);
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, s.count);
        ++info.draws;
        info.triangles += 2 * std::uint64_t(s.count);
    }
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}

}  // namespace

Pass TexelSlabs::make_pass(FrameState& f, const FrameState::ShownPane& pane) {
    Pass pass;
    int layer = 0;
    const LightView* view = f.shown_view(&layer);
    if (!f.slabs_shown) {
        pass.unneeded = f.settings.view.slabs == Slabs::None ? "view.slabs is none" : "view.light has no shadow map";
        return pass;
    }
    SlabTargets& s = targets_;
    gl::Target& picture = s.pictures[std::size_t(pane.slot)];
    f.plan.place_result({Result::Slabs, pane.slot}, {&picture});
    const TexelRegion region = slab_region(f.settings.view, f.map_size);
    Key slabs = f.with_settings(f.camera_key, ReadBy::Slabs);
    slabs.add(f.plan.key_of(Result::ShadowMaps)).add(layer);
    pass.key = slabs.value();
    pass.cached = &picture.key;
    const ResultRef under = pane.row() ? ResultRef(Result::Composed, pane.slot) : f.base_picture_result();
    pass.run = [this, &f, &s, &picture, under, view, layer, region, slabs_key = slabs.value()](PassInfo& info) {
        if (s.instances_key != slabs_key) {
            read_depths(f, pages_, s, layer, region);
            upload_instances(f, s, *view, region);
            s.instances_key = slabs_key;
        }
        const int w = f.request.width, h = f.request.height;
        const CameraDrawing pass_over(f, "picture with stored-depth quads", GL_RGBA8, picture);
        glCopyImageSubData(f.result(under).texture.id(), GL_TEXTURE_2D, 0, 0, 0, 0, picture.texture.id(), GL_TEXTURE_2D,
                           0, 0, 0, 0, w, h, 1);
        draw_slabs(f, s, info);
    };
    return pass;
}

}  // namespace si
