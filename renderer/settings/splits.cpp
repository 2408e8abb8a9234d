// Rows of the table of cascade splits, and the order of manual splits.
#include "renderer/settings/splits.h"

#include <fmt/format.h>

#include <algorithm>

namespace si {
namespace {

constexpr std::string_view kLambda[] = {"light.split_lambda"};
constexpr std::string_view kByHand[] = {"light.split_1", "light.split_2", "light.split_3", "light.split_4",
                                        "light.split_5", "light.split_6", "light.split_7"};
static_assert(std::size(kByHand) == kMaxCascades - 1);

constexpr SplitRow kSplits[] = {
    {.key = "uniform",
     .label = "even",
     .help = "Intervals of equal length: far ones get finer texels than pixels need."},
    {.key = "logarithmic",
     .label = "by equal ratios",
     .help = "Each interval ends at the same multiple of its beginning: a texel then covers about the same number of "
             "pixels in each, and near intervals are very short. Even under an orthographic camera.",
     .paper = "Wimmer, Scherzer, Purgathofer, Light Space Perspective Shadow Maps, EGSR 2004"},
    {.key = "practical",
     .label = "practical (PSSM)",
     .help = "The mean of the even and of the logarithmic division, weighted by light.split_lambda.",
     .paper = "Zhang, Sun, Xu, Lun, Parallel-Split Shadow Maps for Large-scale Virtual Environments, VRCIA 2006",
     .settings = kLambda},
    {.key = "manual", .label = "by hand", .help = "At light.split_1, light.split_2, and so on.", .settings = kByHand},
};

/// Members of LightSettings with the manual splits.
using Members = std::array<double LightSettings::*, kMaxCascades - 1>;
constexpr Members kMembers = {&LightSettings::split_1, &LightSettings::split_2, &LightSettings::split_3,
                              &LightSettings::split_4, &LightSettings::split_5, &LightSettings::split_6,
                              &LightSettings::split_7};

}  // namespace

std::span<const SplitRow> splits() {
    return kSplits;
}

std::array<double, kMaxCascades - 1> manual_splits(const LightSettings& light) {
    std::array<double, kMaxCascades - 1> out;
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = light.*kMembers[i];
    return out;
}

void push_splits(Settings& settings, const SettingRef& changed) {
    const auto found = std::ranges::find(kByHand, changed.param->key);
    if (found == std::end(kByHand)) return;
    const auto moved = std::size_t(found - std::begin(kByHand));
    LightSettings& light = settings.lights[std::size_t(changed.light)];
    const double at = light.*kMembers[moved];
    for (std::size_t i = 0; i < kMembers.size(); ++i) {
        double& split = light.*kMembers[i];
        split = i < moved ? std::min(split, at) : std::max(split, at);
    }
}

void repair_splits(Settings& settings, std::vector<std::string>& repairs) {
    for (std::size_t l = 0; l < settings.lights.size(); ++l) {
        LightSettings& light = settings.lights[l];
        if (light.split != Split::Manual) continue;
        for (int i = 1; i + 1 < std::min(light.cascades, kMaxCascades); ++i) {
            const double before = light.*kMembers[std::size_t(i - 1)];
            double& split = light.*kMembers[std::size_t(i)];
            if (!(split < before)) continue;
            const std::string prefix = l == 0 ? "light." : fmt::format("light.{}.", l);
            repairs.push_back(fmt::format("{0}split_{1} {2:.6g} lies before {0}split_{3} {4:.6g}: moved up to it",
                                          prefix, i + 1, split, i, before));
            split = before;
        }
    }
}

}  // namespace si
