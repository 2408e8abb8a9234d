#include "renderer/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "renderer/driver.h"
#include "renderer/error.h"
#include "renderer/param.h"
#include "renderer/renderer_impl.h"

namespace si {
namespace {

void run_passes(const std::vector<Pass>& plan, std::vector<PassInfo>& infos, gl::PassClock* clock) {
    std::vector<std::pair<std::size_t, std::size_t>> timed;
    if (clock) clock->reset();
    for (std::size_t i = 0; i < plan.size(); ++i) {
        if (infos[i].state != PassState::Ran) continue;
        const gl::DebugGroup group(plan[i].name);
        if (clock) clock->begin();
        const auto start = std::chrono::steady_clock::now();
        if (plan[i].cached) *plan[i].cached = 0;  // an exception below leaves undefined contents
        plan[i].run(infos[i]);
        if (plan[i].cached) *plan[i].cached = plan[i].key;
        infos[i].cpu_ms =
            clock ? std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count() : 0;
        if (clock) timed.emplace_back(i, clock->end());
    }
    for (const auto& [pass, slot] : timed) infos[pass].gpu_ms = clock->milliseconds(slot);
}

Image image_of(const gl::Target& t) { return {t.texture.id(), t.width, t.height}; }

/// One layer of the visibility array as a plain texture.
Image visibility_image(Resources& r, int light) {
    const int layer = std::clamp(light, 0, r.visibility.layers - 1);
    if (r.visibility_view_layer != layer) {
        GLuint id = 0;
        glGenTextures(1, &id);
        glTextureView(id, GL_TEXTURE_2D, r.visibility.texture.id(), GL_R32F, 0, 1, GLuint(layer), 1);
        r.visibility_view = gl::Texture::adopt("visibility of one light", id);
        r.visibility_view_layer = layer;
    }
    return {r.visibility_view.id(), r.visibility.width, r.visibility.height};
}

std::vector<std::string> wanted_results(const FrameState& f) {
    std::vector<std::string> wanted;
    const Outputs& o = f.request.outputs;
    if (o.colour) wanted.push_back(f.overlay() ? "composed" : "shaded");
    if (o.visibility) wanted.push_back("visibility");
    if (o.overlay) wanted.push_back("overlay");
    if (o.shadow_map) wanted.insert(wanted.end(), {"map view", "shadow maps"});
    return wanted;
}

}  // namespace

Renderer::Renderer() : impl_(std::make_unique<Impl>()) {}
Renderer::~Renderer() = default;

FrameResult Renderer::render(const Scene& scene, const Settings& settings, const FrameRequest& request) {
    if (request.width < 1 || request.height < 1 || request.width > impl_->driver.max_texture_size ||
        request.height > impl_->driver.max_texture_size)
        throw Error(fmt::format("a picture of {} x {} pixels cannot be drawn; each side is 1 to {}", request.width,
                                request.height, impl_->driver.max_texture_size));
    FrameState f = impl_->prepare(scene, settings, request);
    std::vector<Pass> plan;
    add_light_depth_passes(f, plan);
    add_depth_blur_pass(f, plan);
    add_visibility_pass(f, plan);
    add_shade_pass(f, plan);
    add_overlay_passes(f, plan);
    add_map_view_pass(f, plan);

    FrameResult result;
    result.passes = plan_passes(plan, wanted_results(f), request.force, request.no_skip);
    const bool draws = std::any_of(result.passes.begin(), result.passes.end(),
                                   [](const PassInfo& p) { return p.state == PassState::Ran; });
    if (draws) {
        impl_->upload_blocks(f);
        if (impl_->resources.camera_depth.ensure("camera depth", GL_DEPTH_COMPONENT32F, request.width, request.height))
            impl_->resources.depth_key = 0;
        if (request.force) impl_->resources.depth_key = 0;
    }
    run_passes(plan, result.passes, request.timing ? &impl_->pass_clock() : nullptr);

    Resources& r = impl_->resources;
    const auto valid = [&](std::string_view name) {
        const PassInfo* p = result.pass(name);
        return p && p->state != PassState::Skipped;
    };
    if (request.outputs.colour) result.colour = image_of(f.overlay() ? r.composed : r.shaded);
    if (valid("map viewer")) result.map_view = image_of(r.map_view);
    if (valid("visibility")) result.visibility = visibility_image(r, f.settings.view.light);
    if (valid("overlay values")) result.overlay = image_of(r.overlay);
    if (const Overlay* o = f.overlay()) {
        const ViewSettings& v = f.settings.view;
        result.overlay_min = float(v.overlay_range != int(OverlayRange::Manual) ? o->min : v.overlay_min);
        result.overlay_max = float(v.overlay_range != int(OverlayRange::Manual) ? o->max : v.overlay_max);
    }
    result.panes = {{result.colour, result.overlay, f.settings.view.overlay, result.overlay_min, result.overlay_max}};
    if (const auto& s = r.shown; result.map_view.texture) {
        result.map_view_size = glm::ivec2(f.map_resolution);
        result.map_view_curve = r.fitted[std::size_t(s.light)].views[std::size_t(s.face)].curve;
        result.map_black = float(f.settings.view.map_black);
        result.map_white = float(f.settings.view.map_white);
    }
    result.camera = f.camera;
    result.lights = r.fitted;
    result.notes = std::move(f.notes);
    result.map_resolution = f.map_resolution;
    if (request.timing) result.clock = impl_->pass_clock().name();
    return result;
}

const DriverInfo& Renderer::driver() const {
    impl_->pass_clock();
    return impl_->driver;
}

std::vector<std::string> Renderer::take_gl_messages() { return impl_->messages.take(); }
std::string Renderer::shader_log() const { return impl_->resources.programs.log(); }
bool Renderer::shaders_changed() { return impl_->resources.programs.source().poll(); }

}  // namespace si
