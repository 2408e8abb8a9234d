// Passes that draw the panes: overlay values, and the picture with the overlay over it.
#include "renderer/passes/panes.h"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/frame/value_range.h"
#include "renderer/passes/camera_drawing.h"
#include "renderer/passes/moments.h"
#include "renderer/passes/reference.h"

namespace si {
namespace {

using ShownPane = FrameState::ShownPane;

/// Returns the name of a slot's pass or image; the first slot has no suffix.
std::string slot_name(std::string_view name, const ShownPane& pane) {
    if (pane.slot == 0) return std::string(name);
    return fmt::format("{} ({})", name, pane.row() ? pane.row()->key : "none");
}

std::vector<gl::Define> overlay_defines(const FrameState& f, const Overlay& row) {
    const int last = std::max(int(f.gl.fitted.size()) - 1, 0);
    std::vector<gl::Define> out{{"OVERLAY_FILE", row.file()},
                                {"LIGHT_INDEX", std::to_string(std::clamp(f.settings.view.light, 0, last))}};
    if (!row.keeps_optimisations)
        out.insert(out.end(), {{"MAP_BOUNDS", "0"}, {"SKIPS_SEARCH", "0"}, {"SKIPS_UNLIT", "0"}});
    if (row.scalar) out.push_back({"OVERLAY_SCALAR", "1"});
    if (f.separate_visibility) out.push_back({"SEPARATE_VISIBILITY", "1"});
    if (row.reads_reference) {
        out.push_back({"DEPTH_BLUR_TEXELS", std::to_string(f.settings.map.blur_texels)});
        for (gl::Define& d : reference_defines(f)) out.push_back(std::move(d));
    }
    return out;
}

/// Scope that sets the OpenGL state for drawing an overlay's triangles, and restores it at the end.
class DrawState {
public:
    DrawState(OverlayDraw draw, bool reversed) : draw_(draw) {
        if (draw == OverlayDraw::Edges) {
            glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
            glDepthMask(GL_FALSE);
            glEnable(GL_POLYGON_OFFSET_LINE);  // lines lie in front of their faces
            glPolygonOffset(reversed ? 1.f : -1.f, reversed ? 4.f : -4.f);
        } else if (draw == OverlayDraw::Count) {
            glDisable(GL_DEPTH_TEST);
            glEnable(GL_BLEND);
            glBlendFunc(GL_ONE, GL_ONE);
        }
    }
    ~DrawState() {
        if (draw_ == OverlayDraw::Fragments) return;
        glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
        glDisable(GL_POLYGON_OFFSET_LINE);
        glDepthMask(GL_TRUE);
        glEnable(GL_DEPTH_TEST);
        glDisable(GL_BLEND);
    }
    DrawState(const DrawState&) = delete;
    DrawState& operator=(const DrawState&) = delete;

private:
    OverlayDraw draw_;
};

}  // namespace

Pass PanePasses::values_pass(FrameState& f, const ShownPane& pane) {
    Pass pass{.name = slot_name("overlay values", pane),
              .reads = kernel_inputs(f),
              .writes = {{Result::Overlay, pane.slot}},
              .idle_reason = "the overlay is not requested"};
    if (f.separate_visibility) pass.reads.push_back(Result::Visibility);
    if (pane.row() && pane.row()->reads_reference)
        pass.reads.insert(pass.reads.end(), {Result::Reference, Result::Classified});
    if (pane.row() && pane.row()->reads_precision) pass.reads.push_back(Result::Precision);
    if (pane.row() && pane.row()->reads_flip) pass.reads.push_back(Result::Flip);
    if (!pane.row()) {
        pass.unneeded = pane.lacks_reference ? "the reference of this frame is not traced" : "no overlay is chosen";
        return pass;
    }
    // Overlays drawn without depth writes need the camera depth.
    if (pane.row()->draw != OverlayDraw::Fragments) pass.reads.push_back(Result::CameraDepth);
    Targets& t = targets_of(pane);
    f.plan.place_result({Result::Overlay, pane.slot}, {&t.values, shared::UNIT_OVERLAY_VALUES});
    pass.key = f.shown_light_key().add(pane.overlay).add(f.separate_visibility).value();
    pass.cached = &t.values.key;
    pass.run = [&f, &t, pane](PassInfo& info) {
        CameraDrawing draw(f, "overlay values", GL_RGBA32F, t.values);
        draw.clear(glm::vec4(0));
        const DrawState state(pane.row()->draw, f.camera.curve.convention.reversed);
        draw.draw("passes/overlay.frag.glsl", overlay_defines(f, *pane.row()), info);
    };
    return pass;
}

Pass PanePasses::compose_pass(FrameState& f, const ShownPane& pane) {
    Pass pass{.name = slot_name("overlay over picture", pane),
              .reads = {f.base_picture_result(), {Result::Overlay, pane.slot}},
              .writes = {{Result::Composed, pane.slot}},
              .idle_reason = "the picture is not requested"};
    if (!pane.row()) {
        pass.unneeded = "no overlay is chosen";
        return pass;
    }
    Targets& t = targets_of(pane);
    f.plan.place_result({Result::Composed, pane.slot}, {&t.composed});
    // Fitted ranges follow from the values.
    pass.key = f.with_settings({}, ReadBy::Compose).add(f.tints(pane)).value();
    pass.cached = &t.composed.key;
    pass.run = [this, &f, &t, pane](PassInfo& info) {
        t.composed.ensure("picture with overlay", GL_RGBA8, f.request.width, f.request.height);
        const ValueRange range = range_of(f, pane);
        const gl::Framebuffer framebuffer = f.begin_fullscreen_pass("picture with overlay", t.composed);
        const GLuint id = f.use_fullscreen("passes/compose.frag.glsl");
        glUniform4f(glGetUniformLocation(id, "scale"), range.min, range.max, float(f.settings.view.overlay_opacity),
                    pane.row()->diverging ? 1.f : 0.f);
        glUniform1i(glGetUniformLocation(id, "scalar"), pane.row()->scalar);
        glUniform1i(glGetUniformLocation(id, "grey"), pane.row()->reads_reference && !pane.row()->scalar);
        glUniform1i(glGetUniformLocation(id, "tint"), f.tints(pane));
        FrameState::draw_fullscreen(info);
    };
    return pass;
}

Pass PanePasses::slabs_pass(FrameState& f, const ShownPane& pane) {
    Pass pass = slabs_.make_pass(f, pane);
    pass.name = slot_name("stored-depth quads", pane);
    pass.reads = {pane.row() ? ResultRef(Result::Composed, pane.slot) : f.base_picture_result(), Result::CameraDepth,
                  Result::ShadowMaps};
    pass.writes = {{Result::Slabs, pane.slot}};
    pass.idle_reason = "the picture is not requested";
    return pass;
}

ValueRange PanePasses::range_of(const FrameState& f, const ShownPane& pane) {
    const ViewSettings& v = f.settings.view;
    if (!pane.row()) return {};
    const Overlay& row = *pane.row();
    Targets& t = targets_of(pane);
    if (v.overlay_range == OverlayRange::Manual && pane.overlay == v.overlay)
        return {float(v.overlay_min), float(v.overlay_max)};
    const ValueRange declared{float(row.min), float(row.max)};
    if (v.overlay_range != OverlayRange::Fitted || !row.scalar || t.values.key == 0) return declared;
    if (t.fitted_key != t.values.key) {
        const std::size_t texels = std::size_t(t.values.width) * std::size_t(t.values.height);
        const FloatImage values{t.values.width, t.values.height, 4,
                                gl::read_texture<float>(t.values.texture.id(), texels * 4, GL_RGBA, GL_FLOAT)};
        t.fitted = fitted_range(values, row.diverging).value_or(declared);
        t.fitted_key = t.values.key;
    }
    return t.fitted;
}

void PanePasses::declare(FrameState& f) {
    for (std::size_t i = 0; i < f.panes.size(); ++i) {
        const ShownPane& pane = f.panes[i];
        if (pane.slot != int(i)) continue;  // drawn by an earlier pane of equal content
        if (pane.row() || i == 0) {
            f.plan.add_pass(values_pass(f, pane));
            f.plan.add_pass(compose_pass(f, pane));
        }
        f.plan.add_pass(slabs_pass(f, pane));
    }
}

}  // namespace si
