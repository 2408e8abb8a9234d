// Code template of Godot 3.
#include <fmt/format.h>

#include "app/convert/targets.h"

namespace si {

std::string godot3_code(const CodeInput& in) {
    std::string out = in.line("light.shadow_bias = {}", "shadow_bias");
    out += in.line("light.directional_shadow_normal_bias = {}", "directional_shadow_normal_bias");
    out += in.line("light.directional_shadow_bias_split_scale = {}", "directional_shadow_bias_split_scale");
    out += fmt::format("light.rotation_degrees = Vector3({}, {}, 0)\n", code_number(-in.light().elevation),
                       code_number(in.light().azimuth));
    return out + fmt::format("# Project settings: rendering/quality/directional_shadow/size = {}\n", in.facts.texels);
}

}  // namespace si
