// Profile of Godot 3, without conversions.
#include "renderer/profiles/bias_numbers.h"

namespace si {
namespace {

constexpr std::string_view kGodot3Source = "from memory";

constexpr EngineParameter kGodot3Parameters[] = {
    {.key = "shadow_bias",
     .standard = 0.1,
     .min = -16,
     .max = 16,
     .meaning = "Shift in depth; unit not known here.",
     .source = kGodot3Source,
     .setting = "bias.constant",
     .is_bias = true},
    {.key = "directional_shadow_normal_bias",
     .standard = 0.8,
     .min = 0,
     .max = 16,
     .meaning = "Shift along the normal; unit not known here.",
     .source = kGodot3Source,
     .setting = "bias.normal",
     .is_bias = true},
    {.key = "directional_shadow_bias_split_scale",
     .standard = 0.25,
     .min = 0,
     .max = 1,
     .meaning = "Scale of the bias by cascade; formula not known here.",
     .source = kGodot3Source,
     .is_bias = true},
};

}  // namespace

const EngineProfile& godot3_profile() {
    static const EngineProfile row{
        .name = "godot3",
        .title = "Godot 3",
        .version = "3.2",
        .unverified =
            "all of it: names and defaults are from memory, and no formula is known, so that nothing converts",
        .parameters = kGodot3Parameters};
    return row;
}

}  // namespace si
