#include "renderer/advise/advice_facts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/inspect/texel_usage.h"

namespace si {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Returns the width of the penumbra of an edge `gap_m` before a surface, metres across the light.
double penumbra_m(const FittedLight& light, const glm::dvec3& at_ws, double gap_m) {
    if (light.type == LightType::Directional) return 2 * light.size * gap_m;
    const double room = glm::distance(light.position, at_ws) - gap_m;
    return room > 0 ? 2 * light.size * gap_m / room : std::numeric_limits<double>::infinity();
}

double shadowed_share(const Reference& reference) {
    const FloatImage& hard = reference.hard();
    std::size_t counted = 0, dark = 0;
    for (std::size_t i = 0; i < reference.state.size(); ++i)
        if (reference.state[i] == PixelState::Counted) {
            ++counted;
            dark += hard.data[i] < 0.5f;
        }
    return counted ? double(dark) / double(counted) : kUnknown;
}

/// Collects the range of depths from all pixels, and the widths of texels and penumbrae from every seventh.
void add_pixel_facts(AdviceFacts& f, const MeasuredError& m, const Settings& settings) {
    const Reference& reference = *m.traced.reference;
    const FittedLight& light = m.lights[std::size_t(m.light)];
    std::vector<double> texels, penumbrae;
    f.nearest_m = std::numeric_limits<double>::infinity();
    f.farthest_m = 0;
    for (std::size_t i = 0; i < reference.state.size(); ++i) {
        if (reference.state[i] != PixelState::Counted) continue;
        ++f.pixels;
        const Receiver& r = m.traced.receivers->pixels[i];
        const double depth_m = depth_along_axis_m(m.camera, r.position_ws);
        f.nearest_m = std::min(f.nearest_m, depth_m);
        f.farthest_m = std::max(f.farthest_m, depth_m);
        if (i % 7 || light.views.empty() || m.classified[i].has(ClassifiedPixel::kOutside)) continue;
        const double texel_m = receiver_in_light(m, settings, r).texel_m;
        texels.push_back(texel_m / pixel_m(m.camera, depth_m, m.picture.y));
        const double gap_m = reference.blocker_m.data.empty() ? kUnknown : double(reference.blocker_m.data[i]);
        if (std::isfinite(gap_m)) penumbrae.push_back(penumbra_m(light, r.position_ws, gap_m) / texel_m);
    }
    f.texel_px = lower_quantile(std::move(texels), 0.5, kUnknown);
    f.penumbra_texels = lower_quantile(std::move(penumbrae), 0.99, 0);
}

}  // namespace

AdviceFacts advice_facts(const SearchTools& tools, const Settings& s) {
    const auto& [renderer, scene, width, height, cache, workers, report, engine] = tools;
    FrameRequest request{.width = width, .height = height};
    trace_sources(renderer, scene, s, request, cache, workers);
    const MeasuredError m =
        measure_error(renderer, scene, s, request, s.view.light, reference_options(s), cache, workers);
    AdviceFacts f;
    f.error = m.metrics;
    f.lights = m.lights;
    f.light = m.light;
    f.map_resolution = m.map_resolution;
    f.map_size = m.map_size;
    add_pixel_facts(f, m, s);
    const FittedLight& light = m.lights[std::size_t(m.light)];
    f.starts = bias_starts(m, s, renderer.driver());
    f.shadowed.assign(f.lights.size(), kUnknown);
    f.shadowed[std::size_t(m.light)] = shadowed_share(*m.traced.reference);
    for (std::size_t i = 0; i < f.lights.size(); ++i) {
        if (int(i) == m.light || !f.lights[i].shadowed) continue;
        const ReferenceTask task = reference_task(renderer, scene, s, request, int(i), {});
        f.shadowed[i] = shadowed_share(*cache.trace(task, workers).reference);
    }
    request.outputs.texels_read = light.casts && light.views.size() == 1 && !s.map.paged;
    const FrameResult frame = renderer.render(scene, s, request);
    if (request.outputs.texels_read) f.read_share = exact_utilisation(renderer.read_float(frame.texels_read, 1));
    if (frame.pages) f.paged_texels = frame.pages->read_texels();
    f.notes = frame.notes;
    return f;
}

}  // namespace si
