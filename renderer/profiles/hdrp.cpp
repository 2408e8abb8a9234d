// Profile of Unity HDRP.
#include <algorithm>
#include <numbers>

#include "renderer/profiles/bias_numbers.h"

namespace si {
namespace {

constexpr std::string_view kHdrpSource = "Unity-Technologies/Graphics: HDShadowAlgorithms.hlsl, HDShadowUtils.cs";
constexpr double kHdrpSlope = 5;                  ///< polygon offset factor per slopeBias
constexpr double kHdrpHiddenDepth = 1.0 / 65536;  ///< at the look-up, share of the depth range

constexpr EngineParameter kHdrpParameters[] = {
    {.key = "slopeBias",
     .standard = 0.5,
     .min = 0,
     .max = 1,
     .meaning = "Polygon offset factor while the map is drawn: five times this number.",
     .source = kHdrpSource,
     .setting = "bias.raster_slope",
     .is_bias = true},
    {.key = "normalBias",
     .unit = "diagonals of a texel",
     .standard = 0.75,
     .min = 0,
     .max = 5,
     .meaning = "Shift of the look-up along the normal, times the square root of 2.",
     .source = kHdrpSource,
     .setting = "bias.normal",
     .is_bias = true},
};

constexpr ForcedSetting kHdrpForced[] = {
    {"bias.raster_units", "1", "HDRP draws its maps with one unit of polygon offset"},
};

constexpr LackingSetting kHdrpLacking[] = {
    {"bias.slope", "", "the slope is in slopeBias, as polygon offset"},
};

double hidden_hdrp(const EngineProfile&, const EngineValues&, const MapFacts& facts) {
    return kHdrpHiddenDepth * facts.depth_m / facts.texel_m() + raster_equivalent(0, 1, facts);
}

BiasNumbers read_hdrp(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts) {
    BiasNumbers out;
    out.constant_unit = BiasUnit::Depth;
    out.constant_texels = kHdrpHiddenDepth * facts.depth_m / facts.texel_m();
    out.constant_note = "hidden: 1/65536 of the depth range at the look-up";
    out.raster_slope = kHdrpSlope * engine_value(profile, values, "slopeBias");
    out.raster_units = 1;
    out.normal_texels = engine_value(profile, values, "normalBias") * std::numbers::sqrt2;
    return out;
}

void write_hdrp(const BiasNumbers& bias, const EngineValues& values, const MapFacts& facts, EngineOutput& to) {
    const double wanted = bias.constant_texels + bias.raster_texels(facts);
    const double left = std::max(0.0, wanted - hidden_hdrp(hdrp_profile(), values, facts));
    to.put_slope("slopeBias", kHdrpSlope, left, bias);
    to.put_length_offset("normalBias", bias.normal_texels / std::numbers::sqrt2, bias);
}

}  // namespace

const EngineProfile& hdrp_profile() {
    static const EngineProfile row{.name = "hdrp",
                                   .title = "Unity HDRP",
                                   .version = "stored source of 2026",
                                   .unverified =
                                       "ranges of the sliders, and slopeBias under the filter High, where the "
                                       "factor grows from 5 to 18 with softness",
                                   .parameters = kHdrpParameters,
                                   .forced = kHdrpForced,
                                   .lacking = kHdrpLacking,
                                   .bias_rows = kRasterAndNormal,
                                   .hidden_depth = kHdrpHiddenDepth,
                                   .hidden_texels = hidden_hdrp,
                                   .read_bias = read_hdrp,
                                   .write_bias = write_hdrp};
    return row;
}

}  // namespace si
