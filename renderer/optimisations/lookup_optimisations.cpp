#include "renderer/optimisations/lookup_optimisations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/base/poisson_disk.h"
#include "renderer/settings/depth_compare.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/map_storage.h"
#include "renderer/view/lights/kernel_reach.h"

namespace si {
namespace {

/// From how many texture calls a look-up on it pays to ask for bounds first, with the maps kept. Mesa 22.3's llvmpipe,
/// the agreed scene at 1280 x 720, 2048 texels, adaptive bias: time of that by that of all taps,
///     16, 32, 64 calls: vogel 1.26, 1.16, 0.77; poisson 1.13, 1.14, 0.90; dpcf 1.19, 1.25, 0.78;
///     32, 64, 128: pcss (searching and comparing by as many) 1.03, 0.76, 0.82;
///     16, 25, 64: pcf 0.97, 0.88, 0.80; smrt, whose rays end at once where nothing is, 0.97 to 1.00.
/// `bench --benchmark_filter=lookups` measures it.
constexpr int kLeastCalls = 64;

/// How far depths may be from those that kernels compare. By hand they are the same numbers; samplers may round a
/// reference to the format's steps, and depths of stored distances rise but for rounding.
double depths_margin(const FrameState& f) {
    const auto format = f.settings.map.format;
    if (holds_distances(f.settings.map.format)) return 1e-6;
    if (!f.filter_sampler) return 0;
    return format == MapFormat::D16 ? 2.0 / 65535 : format == MapFormat::D24 ? 2.0 / 16777215 : 0;
}

/// What single precision makes of planes; depths are 0 to 1.
constexpr double kBoundsMargin = 1e-6;

/// Texture calls of a look-up.
int calls_of(const FrameState& f) {
    const FilterCost cost = cost_of(f.settings);
    return cost.gathers > 0 && !f.filter_sampler ? cost.gathers : cost.sampler_taps;
}

/// Whether the kernel compares depths, and not along rays, which end at once where nothing stands.
bool may_ask(const FrameState& f) {
    const Filter& row = filter_of(f.settings);
    return row.samples == Samples::Depth && (!row.reads_light_size || row.searches_blockers);
}

bool fetches_many(const FrameState& f) {
    return may_ask(f) && calls_of(f) >= kLeastCalls;
}

std::string saved_or_not(const FrameState& f, Optimisation saving) {
    return f.request.forced.contains(saving) ? "0" : "1";
}

/// GLSL of an array's contents.
std::string glsl_list(std::span<const glm::vec2> places) {
    std::string out;
    for (const glm::vec2& p : places) out += fmt::format("{}vec2({:.9g}, {:.9g})", out.empty() ? "" : ", ", p.x, p.y);
    return "vec2[](" + out + ")";
}

/// Of so many taps Mesa unrolls a loop; a compiler for CPUs then has places as numbers within the code.
constexpr std::size_t kMostUnrolled = 32;

}  // namespace

int bounds_reach_cells(const FrameState& f, const FittedLight& light) {
    // Centres that are read, the half texel around them, and what rounding moves them by.
    const double texels = std::ceil(reach_under(f.settings, light, f.map_resolution).read + 0.5 + 1e-3);
    return int(std::min(std::ceil(texels / kBoundsCell), double(f.map_resolution)));
}

std::string why_no_bounds(const FrameState& f) {
    const Filter& row = filter_of(f.settings);
    if (f.view_count == 0) return "no light has a shadow map";
    if (f.request.forced.contains(Optimisation::EarlyOut)) return "look-ups are to fetch all their taps";
    if (row.samples != Samples::Depth) return "filter.kernel reads averages of depths, not depths";
    if (!may_ask(f)) return "the kernel's rays end at once where the map holds nothing";
    if (!fetches_many(f))
        return fmt::format("a look-up fetches {} times; finding bounds pays from {} on", calls_of(f), kLeastCalls);
    if (f.paged) return "the map is drawn by pages, each when it is wanted";
    if (row.reads_light_size &&
        std::ranges::any_of(f.gl.fitted, [](const FittedLight& l) { return l.casts && l.is_warped(); }))
        return "how far the kernel reaches differs over a warped map";
    // Finding them takes a fifth to a third of a frame in which PCSS or 64 taps look up a map of 2048 texels a side.
    if (f.request.force || !f.plan.is_current(Result::ShadowMaps)) return std::string(kBoundsWaitForMaps);
    return {};
}

std::vector<gl::Define> lookup_optimisation_defines(const FrameState& f) {
    return {{"BOUNDS_TELL_DARK", filter_of(f.settings).linear ? "1" : "0"},
            {"BOUNDS_MARGIN", fmt::format("{:.9f}", kBoundsMargin)},
            {"DEPTHS_MARGIN", fmt::format("{:.9f}", depths_margin(f))},
            {"BOUNDS_BLOCK", std::to_string(kBoundsBlock)},
            {"BOUNDS_CELL", std::to_string(kBoundsCell)},
            {"SKIPS_SEARCH", saved_or_not(f, Optimisation::BlockerSearch)},
            {"SKIPS_UNLIT", saved_or_not(f, Optimisation::BackFacingReceivers)}};
}

void choose_taps(FrameState& f, bool asks_bounds) {
    const Filter& row = filter_of(f.settings);
    const std::pair<const char*, std::vector<glm::vec2>> lists[] = {
        {"TAP", disk_of(row, f.settings, f.settings.filter.taps)},
        {"BLOCKER", disk_of(row, f.settings, f.settings.filter.blocker_taps)},
        {"RAY", spiral_places(f.settings.filter.rays)}};
    // Compilers for CPUs run both sides of a branch, but leave loops that nobody needs.
    const bool keeps_loops = asks_bounds && f.driver.software;
    const bool from_image = f.blocks_as_images() && (keeps_loops || std::ranges::any_of(lists, [](const auto& list) {
                                                         return list.second.size() > kMostUnrolled;
                                                     }));
    f.defines.push_back({"MAP_BOUNDS", asks_bounds ? "1" : "0"});
    f.defines.push_back({"KEEPS_LOOPS", keeps_loops ? "1" : "0"});
    f.defines.push_back({"DISK_FROM_IMAGE", from_image ? "1" : "0"});
    f.defines.push_back({"DISK_CONSTANTS", std::to_string(kDiskTable)});
    f.disk_texels.clear();
    for (const auto& [name, places] : lists) {
        const bool listed = !from_image && int(places.size()) <= kDiskTable;
        f.defines.push_back({fmt::format("{}_COUNT", name), std::to_string(places.size())});
        f.defines.push_back({fmt::format("{}_PLACES", name), listed ? glsl_list(places) : "0"});
        if (from_image) f.disk_texels.insert(f.disk_texels.end(), places.begin(), places.end());
    }
}

}  // namespace si
