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

/// Least texture calls of a look-up for which testing bounds first saves time, with unchanged maps. Time with bounds
/// over time with all taps on llvmpipe (Mesa 22.3), reference scene at 1280 x 720, 2048 texels, adaptive bias:
///     16, 32, 64 calls: vogel 1.26, 1.16, 0.77; poisson 1.13, 1.14, 0.90; dpcf 1.19, 1.25, 0.78;
///     32, 64, 128: pcss (equal numbers of search and filter taps) 1.03, 0.76, 0.82;
///     16, 25, 64: pcf 0.97, 0.88, 0.80; smrt, whose rays end early in empty regions, 0.97 to 1.00.
/// `bench --benchmark_filter=lookups` measures it.
constexpr int kMinTextureCalls = 64;

/// Returns the largest difference between bounds and the depths that kernels compare. Comparison in the shader uses the
/// same numbers; samplers may round a reference to the format's steps, and stored distances rise only up to rounding.
double depths_margin(const FrameState& f) {
    const auto format = f.settings.map.format;
    if (holds_distances(f.settings.map.format)) return 1e-6;
    if (!f.filter_sampler) return 0;
    return format == MapFormat::D16 ? 2.0 / 65535 : format == MapFormat::D24 ? 2.0 / 16777215 : 0;
}

/// Error of planes in single precision; depths are 0 to 1.
constexpr double kBoundsMargin = 1e-6;

/// Returns the texture calls of a look-up.
int calls_of(const FrameState& f) {
    const FilterCost cost = kernel_cost(f.settings);
    return cost.gathers > 0 && !f.filter_sampler ? cost.gathers : cost.sampler_taps;
}

/// Returns true when the kernel compares depths, and not along rays, which end early in empty regions.
bool may_use_bounds(const FrameState& f) {
    const Filter& row = filter_of(f.settings);
    return row.samples() == Samples::Depth && (!row.reads_light_size || row.searches_blockers);
}

/// Returns "1" for the shader define of an optimisation, or "0" when it is forced off.
std::string unless_forced(const FrameState& f, Optimisation optimisation) {
    return f.request.forced.contains(optimisation) ? "0" : "1";
}

/// Returns a GLSL array of positions.
std::string glsl_list(std::span<const glm::vec2> places) {
    std::string out;
    for (const glm::vec2& p : places) out += fmt::format("{}vec2({:.9g}, {:.9g})", out.empty() ? "" : ", ", p.x, p.y);
    return "vec2[](" + out + ")";
}

/// Largest number of taps for which Mesa unrolls a loop, so that positions become constants in the code.
constexpr std::size_t kMaxUnrolledTaps = 32;

}  // namespace

int kernel_reach_cells(const FrameState& f, const FittedLight& light) {
    // Texel centres that are read, half a texel around them, and rounding.
    const double texels = std::ceil(kernel_reach_in_light(f.settings, light, f.map_size).read + 0.5 + 1e-3);
    return int(std::min(std::ceil(texels / kBoundsCell), double(f.map_size.longest())));
}

std::string map_bounds_skip_reason(const FrameState& f) {
    const Filter& row = filter_of(f.settings);
    if (f.view_count == 0) return "no light has a shadow map";
    if (f.request.forced.contains(Optimisation::EarlyOut)) return "forced: look-ups fetch all their taps";
    if (row.samples() != Samples::Depth) return "filter.kernel reads averages of depths, not depths";
    if (!may_use_bounds(f)) return "the kernel's rays end at once where the map holds nothing";
    if (calls_of(f) < kMinTextureCalls)
        return fmt::format("a look-up fetches {} times; bounds save time from {} on", calls_of(f), kMinTextureCalls);
    if (f.paged) return "the map is drawn by pages, on demand";
    if (holds_distances(f.settings.map.format) && compares_per_texel(f.settings) &&
        std::ranges::any_of(f.gl.fitted, [](const FittedLight& l) { return l.casts && l.is_perspective(); }))
        return "texels hold distances (map.format), along which the depth of a plane is not linear";
    if (row.reads_light_size &&
        std::ranges::any_of(f.gl.fitted, [](const FittedLight& l) { return l.casts && l.is_warped(); }))
        return "the kernel's reach differs across a warped map";
    // Finding bounds takes a fifth to a third of a frame with PCSS or 64 taps and 2048 texels a side.
    if (f.request.force || !f.plan.is_current(Result::ShadowMaps)) return std::string(kMapBoundsWaitReason);
    return {};
}

std::vector<gl::Define> lookup_optimisation_defines(const FrameState& f) {
    return {{"BOUNDS_TELL_DARK", filter_of(f.settings).linear ? "1" : "0"},
            {"BOUNDS_MARGIN", fmt::format("{:.9f}", kBoundsMargin)},
            {"DEPTHS_MARGIN", fmt::format("{:.9f}", depths_margin(f))},
            {"BOUNDS_BLOCK", std::to_string(kBoundsBlock)},
            {"BOUNDS_CELL", std::to_string(kBoundsCell)},
            {"SKIPS_SEARCH", unless_forced(f, Optimisation::BlockerSearch)},
            {"SKIPS_UNLIT", unless_forced(f, Optimisation::BackFacingReceivers)}};
}

void define_kernel_taps(FrameState& f, bool tests_bounds) {
    const Filter& row = filter_of(f.settings);
    const std::pair<const char*, std::vector<glm::vec2>> lists[] = {
        {"TAP", disk_points(row, f.settings, f.settings.filter.taps)},
        {"BLOCKER", disk_points(row, f.settings, f.settings.filter.blocker_taps)},
        {"RAY", spiral_places(f.settings.filter.rays)}};
    // CPU rasterisers run both sides of a branch, but leave loops early.
    const bool keeps_loops = tests_bounds && f.driver.software;
    const bool from_image = f.blocks_as_images() && (keeps_loops || std::ranges::any_of(lists, [](const auto& list) {
                                                         return list.second.size() > kMaxUnrolledTaps;
                                                     }));
    f.defines.push_back({"MAP_BOUNDS", tests_bounds ? "1" : "0"});
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
