#include "renderer/frame/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "renderer/base/error.h"
#include "renderer/frame/driver.h"
#include "renderer/frame/renderer_impl.h"
#include "renderer/passes/shadow_volumes.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

void run_passes(const std::vector<Pass>& plan, std::vector<PassInfo>& infos, Resources& resources,
                gl::PassClock* clock) {
    std::vector<std::pair<std::size_t, std::size_t>> timed;
    if (clock) clock->reset();
    for (std::size_t i = 0; i < plan.size(); ++i) {
        if (infos[i].state != PassState::Ran) continue;
        const gl::DebugGroup group(plan[i].name);
        if (clock) clock->begin();
        const auto start = std::chrono::steady_clock::now();
        if (plan[i].cached) *plan[i].cached = 0;  // an exception below leaves undefined contents
        plan[i].run(infos[i]);
        if (plan[i].cached) {
            *plan[i].cached = plan[i].key;
            resources.drawings[plan[i].cached] = ++resources.last_drawing;
        }
        infos[i].cpu_ms =
            clock ? std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count() : 0;
        if (clock) timed.emplace_back(i, clock->end());
    }
    for (const auto& [pass, slot] : timed) infos[pass].gpu_ms = clock->milliseconds(slot);
}

std::vector<ResultRef> wanted_results(const FrameState& f) {
    std::vector<ResultRef> wanted;
    const Outputs& o = f.request.outputs;
    for (const FrameState::ShownPane& pane : f.panes) {
        if (o.colour) wanted.push_back(f.picture_of(pane));
        if (o.overlay) wanted.push_back(f.values_of(pane));
    }
    if (o.surface_ids) wanted.push_back(Result::SurfaceIds);
    if (o.visibility) wanted.push_back(Result::Visibility);
    if (o.error) wanted.push_back(Result::Error);
    if (o.judged) wanted.push_back(Result::Judged);
    if (o.unfiltered_map) wanted.push_back(Result::UnfilteredMap);
    if (o.evidence) wanted.push_back(Result::Evidence);
    if (o.true_colour) wanted.push_back(Result::TruePicture);
    if (o.map_coordinates) wanted.push_back(Result::MapCoordinates);
    if (o.texels_read) wanted.push_back(Result::TexelsRead);
    if (o.shadow_map) wanted.insert(wanted.end(), {Result::MapView, Result::ShadowMaps});
    return wanted;
}

}  // namespace

Renderer::Renderer() : impl_(std::make_unique<Impl>()) {}
Renderer::~Renderer() {
    glUseProgram(0);  // so that nobody restores a program that is gone
    glFinish();       // drivers with threads of their own crash when the process ends with work under way
}

FrameResult Renderer::render(const Scene& scene, const Settings& settings, const FrameRequest& request) {
    if (request.width < 1 || request.height < 1 || request.width > impl_->driver.max_texture_size ||
        request.height > impl_->driver.max_texture_size)
        throw Error(fmt::format("a picture of {} x {} pixels cannot be drawn; each side is 1 to {}", request.width,
                                request.height, impl_->driver.max_texture_size));
    FrameState f = impl_->prepare(scene, settings, request);
    std::vector<Pass> plan;
    add_light_depth_passes(f, plan);
    add_depth_blur_pass(f, plan);
    add_moments_pass(f, plan);
    add_camera_depth_pass(f, plan);
    add_surface_ids_pass(f, plan);
    add_shadow_volume_passes(f, plan);
    add_visibility_pass(f, plan);
    add_unfiltered_map_pass(f, plan);
    add_seen_surfaces_pass(f, plan);
    add_truth_passes(f, plan);
    add_true_shade_pass(f, plan);
    add_shade_pass(f, plan);
    add_pane_passes(f, plan);
    add_map_coordinates_pass(f, plan);
    add_texels_read_pass(f, plan);
    add_map_view_passes(f, plan);

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
    run_passes(plan, result.passes, impl_->resources, request.timing ? &impl_->pass_clock() : nullptr);

    describe_frame(f, result);
    result.contents = contents_of(plan, result.passes, impl_->resources);
    result.contents.renderer = impl_->number;
    if (request.timing) result.clock = impl_->pass_clock().name();
    return result;
}

const DriverInfo& Renderer::driver() const {
    impl_->pass_clock();
    for (int format = 0; format < int(kMapFormats); ++format) impl_->calibrate_offset(format);
    return impl_->driver;
}

std::vector<std::string> Renderer::take_gl_messages() {
    return impl_->messages.take();
}
std::string Renderer::shader_log() const {
    return impl_->resources.programs.log();
}
bool Renderer::shaders_changed() {
    return impl_->resources.programs.source().poll();
}

}  // namespace si
