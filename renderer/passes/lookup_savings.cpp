#include "renderer/passes/lookup_savings.h"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/settings/filters.h"
#include "renderer/settings/map_storage.h"

namespace si {
namespace {

/// From how many texels on a kernel's look-ups pay for bounds.
constexpr int kLeastTexels = 16;

/// How far stored and compared depths may be from those that kernels compare. By hand they are the same numbers;
/// samplers may round a reference to the format's steps, and depths of stored distances rise but for rounding.
double bounds_margin(const FrameState& f) {
    const auto format = MapFormat(f.settings.map.format);
    if (holds_distances(f.settings.map.format)) return 1e-6;
    if (!f.filter_sampler) return 0;
    return format == MapFormat::D16 ? 1.0 / 65535 : format == MapFormat::D24 ? 1.0 / 16777215 : 0;
}

bool fetches_many(const FrameState& f) {
    return filter_of(f.settings).samples == Samples::Depth && cost_of(f.settings).texels >= kLeastTexels;
}

std::string saved_or_not(const FrameState& f, Saving saving) {
    return f.request.forced.contains(saving) ? "0" : "1";
}

}  // namespace

std::string why_no_bounds(const FrameState& f) {
    const Filter& row = filter_of(f.settings);
    if (f.view_count == 0) return "no light has a shadow map";
    if (f.request.forced.contains(Saving::EarlyOut)) return "look-ups are to fetch all their taps";
    if (row.samples != Samples::Depth) return "filter.kernel reads averages of depths, not depths";
    if (f.paged) return "the map is drawn by pages, each when it is wanted";
    if (row.reads_light_size &&
        std::ranges::any_of(f.gl.fitted, [](const FittedLight& l) { return l.casts && l.is_warped(); }))
        return "how far the kernel reaches differs over a warped map";
    if (!fetches_many(f))
        return fmt::format("the kernel fetches {} texels; finding bounds pays from {} on", cost_of(f.settings).texels,
                           kLeastTexels);
    return {};
}

std::vector<gl::Define> lookup_saving_defines(const FrameState& f) {
    const bool bounds = why_no_bounds(f).empty();
    return {{"MAP_BOUNDS", bounds ? "1" : "0"},
            {"BOUNDS_TELL_DARK", filter_of(f.settings).linear ? "1" : "0"},
            {"BOUNDS_MARGIN", fmt::format("{:.9f}", bounds_margin(f))},
            {"BOUNDS_BLOCK", std::to_string(kBoundsBlock)},
            {"BOUNDS_CELL", std::to_string(kBoundsCell)},
            // Compilers for CPUs run both sides of a branch, but leave loops that nobody needs.
            // Also where taps are forced: places of a disk round otherwise where the compiler knows them.
            {"KEEPS_LOOPS", fetches_many(f) && f.driver.software ? "1" : "0"},
            {"SKIPS_SEARCH", saved_or_not(f, Saving::Blockers)},
            {"SKIPS_UNLIT", saved_or_not(f, Saving::Facing)}};
}

}  // namespace si
