// Profile of Babylon.js.
#include <algorithm>
#include <numbers>

#include "renderer/profiles/bias_numbers.h"

namespace si {
namespace {

constexpr std::string_view kBabylonSource = "npm @babylonjs/core@9.35.0: shadowGenerator.js";

/// Filters of ShadowGenerator, in the order of kBabylonFilters.
enum class BabylonFilter { None, Poisson, Pcf, Pcss, Esm };

constexpr EngineChoice kBabylonFilters[] = {
    {"NONE", "filter.kernel=hard"},
    {"POISSON", "filter.kernel=poisson filter.taps=4|filter.kernel=poisson|filter.kernel=vogel"},
    {"PCF",
     "filter.kernel=castano5|filter.kernel=tent "
     "filter.size=5|filter.kernel=tent|filter.kernel=tent3|filter.kernel=hw2x2|"
     "filter.kernel=pcf|filter.kernel=gauss"},
    {"PCSS", "filter.kernel=pcss"},
    {"ESM", "filter.kernel=esm"},
};

constexpr EngineChoice kBabylonBackFaces[] = {{"false", "caster.cull=back|caster.cull=none"},
                                              {"true", "caster.cull=front"}};

constexpr EngineParameter kBabylonParameters[] = {
    {.key = "bias",
     .unit = "depth, by filter",
     .standard = 0.00005,
     .min = 0,
     .max = 1,
     .meaning = "Shift of casters away from the light: normalised depth; half of it counts under PCF and PCSS, 1.5 of "
                "it under cascades with PCF.",
     .source = kBabylonSource,
     .setting = "bias.constant",
     .is_bias = true},
    {.key = "normalBias",
     .unit = "m",
     .standard = 0,
     .min = 0,
     .max = 1e3,
     .meaning = "Shift of casters inwards along the vertex normal, times the sine of the angle.",
     .source = "npm @babylonjs/core@9.35.0: shadowMapVertexNormalBias.js",
     .setting = "bias.normal",
     .is_bias = true},
    {.key = "mapSize",
     .unit = "texels",
     .standard = 1024,
     .min = 1,
     .max = 16384,
     .meaning = "Texels across the map.",
     .source = kBabylonSource,
     .setting = "map.resolution",
     .scale = 1},
    {.key = "filter",
     .standard = 0,
     .min = 0,
     .max = 4,
     .meaning = "Filter. The bias counts differently under each.",
     .source = kBabylonSource,
     .setting = "filter.kernel",
     .choices = kBabylonFilters},
    {.key = "shadowFrustumSize",
     .unit = "m",
     .standard = 0,
     .min = 0,
     .max = 1e6,
     .meaning = "Width of the map; 0 fits it, 20 % wider than the casters.",
     .source = "npm @babylonjs/core@9.35.0: directionalLight.pure.js",
     .setting = "light.extent",
     .scale = 0.5},
    {.key = "forceBackFacesOnly",
     .standard = 0,
     .min = 0,
     .max = 1,
     .meaning = "Only back faces cast; else the faces that a material draws.",
     .source = kBabylonSource,
     .setting = "caster.cull",
     .choices = kBabylonBackFaces},
    {.key = "lambda",
     .standard = 0.5,
     .min = 0,
     .max = 1,
     .meaning = "Splits of cascades: 0 even, 1 logarithmic.",
     .source = "npm @babylonjs/core@9.35.0: cascadedShadowGenerator.pure.js",
     .setting = "light.split_lambda",
     .scale = 1},
};

constexpr ForcedSetting kBabylonForced[] = {
    {"map.format", "d32f",
     "maps of ShadowGenerator(size, light, true); without true, 16-bit floats add 2^-11 of the range"},
};

constexpr LackingSetting kBabylonLacking[] = {
    {"bias.slope", "", "Babylon.js has no slope bias"},
    {"bias.raster_slope", "", "Babylon.js draws its maps without polygon offset"},
    {"bias.raster_units", "", "Babylon.js draws its maps without polygon offset"},
    {"light.split", "manual", "cascades are split by lambda alone"},
};

/// Returns the part of `bias` that counts in normalised depth.
double babylon_share(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts) {
    const auto filter = BabylonFilter(int(engine_value(profile, values, "filter")));
    if (filter == BabylonFilter::Pcss) return 0.5;
    if (filter == BabylonFilter::Pcf) return facts.cascades > 1 ? 1.5 : 0.5;
    return 1;
}

BiasNumbers read_babylon(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts) {
    BiasNumbers out;
    out.constant_unit = BiasUnit::Depth;
    out.constant_texels =
        engine_value(profile, values, "bias") * babylon_share(profile, values, facts) * facts.depth_m / facts.texel_m();
    out.normal_texels = engine_value(profile, values, "normalBias") / facts.texel_m();
    out.normal_by = OffsetBy::Sine;
    return out;
}

void write_babylon(const BiasNumbers& bias, const EngineValues& values, const MapFacts& facts, EngineOutput& to) {
    const double raster = bias.raster_texels(facts);
    const double constant = bias.constant_texels + raster;
    const double to_number = facts.texel_m() / facts.depth_m / babylon_share(babylon_profile(), values, facts);
    to.put("bias", constant * to_number, raster == 0 ? bias.constant : Exactness::EqualAtAngle, constant,
           bias.constant_texels * to_number, bias.constant_note);
    const double metres = quotient(bias.normal_texels * facts.texel_m(), sin_angle(facts));
    to.put("normalBias", metres,
           bias.normal_texels == 0 || bias.settings_by == OffsetBy::Sine ? Exactness::Exact : Exactness::EqualAtAngle,
           metres / facts.texel_m() * offset_equivalent(OffsetBy::Sine, facts.angle_deg), metres,
           metres == 0 && bias.normal_texels > 0 ? std::string(kNoBiasAtAngle) : std::string());
}

}  // namespace

const EngineProfile& babylon_profile() {
    static const EngineProfile row{.name = "babylon",
                                   .title = "Babylon.js",
                                   .version = "9.35.0",
                                   .unverified = "the factor 1.5 of cascades with PCF, which is read and not measured",
                                   .parameters = kBabylonParameters,
                                   .forced = kBabylonForced,
                                   .lacking = kBabylonLacking,
                                   .bias_rows = kConstantAndNormal,
                                   .normal_by = OffsetBy::Sine,
                                   .read_bias = read_babylon,
                                   .write_bias = write_babylon};
    return row;
}

}  // namespace si
