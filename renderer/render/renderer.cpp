#include "renderer/render/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "renderer/base/error.h"
#include "renderer/base/held_memory.h"
#include "renderer/base/index_of.h"
#include "renderer/frame/blocks.h"
#include "renderer/gl/driver_failure.h"
#include "renderer/render/pass_progress.h"
#include "renderer/render/renderer_impl.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/param.h"
#include "renderer/settings/sources.h"
#include "renderer/software/llvmpipe_queue.h"

namespace si {
namespace {

void run_passes(FrameState& f, std::vector<PassInfo>& infos, gl::PassClock* clock) {
    const std::vector<Pass>& plan = f.plan.passes();
    std::vector<std::pair<std::size_t, std::size_t>> timed;
    if (clock) clock->reset();
    PassProgress* const progress = PassProgressScope::current();
    const auto of = std::size_t(std::ranges::count(infos, PassState::Drawn, &PassInfo::state));
    std::size_t done = 0;
    for (std::size_t i = 0; i < plan.size(); ++i) {
        if (infos[i].state != PassState::Drawn) continue;
        if (progress) progress->set(plan[i].name, done++, of);
        const gl::DebugGroup group(plan[i].name);
        if (clock) clock->begin();
        const auto start = std::chrono::steady_clock::now();
        if (plan[i].cached) *plan[i].cached = 0;
        f.bind_results(plan[i].reads);
        plan[i].run(infos[i]);
        if (plan[i].cached) {
            *plan[i].cached = plan[i].key;
            f.gl.drawings[plan[i].cached] = ++f.gl.last_drawing;
        }
        infos[i].cpu_ms =
            clock ? std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count() : 0;
        if (clock) timed.emplace_back(i, clock->end());
        if (f.driver.software) gl::throttle_background_drawing();
    }
    for (const auto& [pass, slot] : timed) {
        infos[pass].gpu_ms = clock->milliseconds(slot);
        infos[pass].wall_ms = clock->wall_ms(slot);
    }
}

std::vector<ResultRef> wanted_results(const FrameState& f) {
    std::vector<ResultRef> wanted;
    const Outputs& o = f.request.outputs;
    for (const FrameState::ShownPane& pane : f.panes) {
        if (o.colour) wanted.push_back(f.pane_picture_result(pane));
        if (o.overlay) wanted.push_back({Result::Overlay, pane.slot});
    }
    if (o.colour && f.request.smoothed > 0) wanted.push_back(Result::Smooth);
    if (o.surface_ids) wanted.push_back(Result::SurfaceIds);
    if (o.visibility) wanted.push_back(Result::Visibility);
    if (o.error) wanted.push_back(Result::Error);
    if (o.classified) wanted.push_back(Result::Classified);
    if (o.compared) wanted.push_back(Result::Compared);
    if (o.unfiltered_map) {
        wanted.push_back(Result::UnfilteredMap);
        for (const ResultRef& read : kernel_inputs(f)) wanted.push_back(read);
    }
    if (o.precision) wanted.push_back(Result::Precision);
    if (o.evidence) wanted.push_back(Result::Evidence);
    if (o.true_colour) wanted.push_back(Result::ReferenceLitPicture);
    if (o.map_coordinates) wanted.push_back(Result::MapCoordinates);
    if (o.texels_read) wanted.push_back(Result::TexelsRead);
    if (o.health) wanted.push_back(Result::Health);
    if (o.shadow_map) wanted.insert(wanted.end(), {Result::MapView, Result::ShadowMaps});
    return wanted;
}

}  // namespace

Renderer::Renderer() : impl_(std::make_unique<RendererImpl>()) {}
Renderer::~Renderer() {
    glUseProgram(0);  // no later code may restore a deleted program
    glFinish();       // multi-threaded drivers crash when the process ends with pending work
}

void Renderer::set_number_watcher(NumberWatcher watch) {
    impl_->watch = std::move(watch);
}

FrameResult Renderer::render(const Scene& scene, const Settings& settings, const FrameRequest& request) {
    const Outputs& o = request.outputs;
    const bool of_picture = o.colour || o.overlay || o.visibility || o.error || o.classified || o.compared;
    if (!impl_->watch || request.timing || !of_picture) return impl_->render(scene, settings, request);
    FrameRequest searched = request;
    searched.outputs.health = true;
    FrameResult result = impl_->render(scene, settings, searched);
    impl_->watch(settings, *numeric_health(result));
    return result;
}

FrameResult RendererImpl::render(const Scene& scene, const Settings& settings, const FrameRequest& request) {
    if (request.width < 1 || request.height < 1 || request.width > driver.max_texture_size ||
        request.height > driver.max_texture_size)
        throw Error(fmt::format("a picture of {} x {} pixels cannot be drawn; each side is 1 to {}", request.width,
                                request.height, driver.max_texture_size));
    gl::check_context_alive();
    while (true) {
        FrameState f = prepare_frame(scene, settings, request);
        plan_frame(f);
        FrameResult result;
        try {
            result = run_plan(f);
        } catch (const gl::OutOfMemory& e) {
            if (!reduce_map_limit(settings, f, e.what())) throw;
            continue;
        }
        gl::check_context_alive();
        result.seen_m = f.seen_m;
        if (f.seen_m) result.passes.insert(result.passes.begin(), resources.seen.info);
        return result;
    }
}

bool RendererImpl::reduce_map_limit(const Settings& settings, const FrameState& f, const std::string& why) {
    constexpr int kMinMapTexels = 64;  // smaller maps would free little memory compared with a picture
    if (f.view_count == 0 || f.map_size_is_given || f.map_size.longest() <= kMinMapTexels) {
        reduced_resolution.reset();  // smaller maps are no help, so later frames begin at the requested size
        return false;
    }
    reduced_resolution = ReducedResolution{settings.map.resolution, f.map_size.longest() / 2, why};
    return true;
}

std::uint64_t Renderer::programs_key(const Scene& scene, const Settings& settings, const FrameRequest& request) {
    FrameState f = impl_->prepare_frame(scene, settings, request);
    Key key;
    // Defines set during planning are left out: look-ups use depth bounds only once maps are cached, and both variants
    // are compiled.
    for (const gl::Define& d : f.defines) key.add(d.name).add(d.value);
    impl_->plan_frame(f);
    key.add(f.preamble).add(f.gl.programs.source().generation()).add(f.map_format()).add(f.settings.map.samples);
    key.add(f.settings.shading.sky).add(f.settings.shading.curve).add(f.settings.shading.exposure != 0);
    key.add(filter_of(f.settings).file).add(bias_of(f.settings).file).add(request.forced.value());
    for (const FrameState::ShownPane& pane : f.panes) key.add(pane.overlay);
    for (int i = 0; i < f.settings.light_count; ++i) key.add(source_of(f.settings, i).key);
    const std::vector<PassInfo> infos = plan_passes(f.plan.passes(), wanted_results(f), true, false);
    for (std::size_t i = 0; i < infos.size(); ++i)
        if (infos[i].state == PassState::Drawn && !f.plan.passes()[i].only_saves_work) key.add(infos[i].name);
    std::uint32_t ways = 0;  // combinations of batch state in use
    for (const Batch& b : f.gl.scene->batches())
        ways |= 1u << (int(b.mirrored) + 2 * int(b.cast) + 4 * index_of(b.cull));
    return key.add(ways).value();
}

void RendererImpl::plan_frame(FrameState& f) {
    for (FramePass* pass : passes.in_order(f.paged)) pass->declare(f);
}

FrameResult RendererImpl::run_plan(FrameState& f) {
    FrameResult result;
    result.passes = plan_passes(f.plan.passes(), wanted_results(f), f.request.force,
                                f.request.forced.contains(Optimisation::DeadPasses));
    f.plan.run_releases();
    const bool draws = std::any_of(result.passes.begin(), result.passes.end(),
                                   [](const PassInfo& p) { return p.state == PassState::Drawn; });
    if (draws) upload_blocks(f);
    try {
        run_passes(f, result.passes, f.request.timing ? &pass_clock() : nullptr);
    } catch (...) {
        // Images that passes share may be lost.
        for (const Pass& pass : f.plan.passes())
            if (pass.cached) *pass.cached = 0;
        throw;
    }
    resources.programs.end_frame(gl::fault_injection().max_programs);
    describe_frame(f, result);
    result.contents = contents_of(f, result.passes);
    result.contents.renderer = number;
    if (f.request.timing) result.clock = std::string(gl::name(pass_clock().kind()));
    return result;
}

const DriverInfo& Renderer::driver() const {
    impl_->pass_clock();
    for (std::size_t format = 0; format < kMapFormats; ++format) impl_->calibrate_offset(MapFormat(format));
    return impl_->driver;
}

std::vector<std::string> Renderer::take_gl_messages() {
    return impl_->messages.take_messages();
}
void Renderer::release_unused_memory() {
    if (impl_->driver.renderer.starts_with("llvmpipe")) gl::release_finished_images();
    trim_heap();
}
std::string Renderer::shader_log() const {
    return impl_->resources.programs.log();
}
bool Renderer::reload_changed_shaders() {
    return impl_->resources.programs.source().poll();
}

}  // namespace si
