// Code template of Godot 3.
#include <fmt/format.h>

#include "app/convert/targets.h"

namespace si {

std::string godot3_code(const CodeInput& in) {
    std::string out = in.line("light.shadow_bias = {}", "shadow_bias");
    out += in.line("light.directional_shadow_normal_bias = {}", "directional_shadow_normal_bias");
    out += in.line("light.directional_shadow_bias_split_scale = {}", "directional_shadow_bias_split_scale");
    out += in.line("light.shadow_reverse_cull_face = {}", "shadow_reverse_cull_face");
    // Names in the order of the choices.
    static constexpr const char* kModes[] = {"ORTHOGONAL", "PARALLEL_2_SPLITS", "PARALLEL_4_SPLITS"};
    out += fmt::format("light.directional_shadow_mode = DirectionalLight.SHADOW_{}\n",
                       kModes[std::size_t(in.number("directional_shadow_mode"))]);
    out += fmt::format("light.rotation_degrees = Vector3({}, {}, 0)\n", code_number(-in.light().elevation),
                       code_number(in.light().azimuth));
    out += "# Project settings, rendering/quality:\n";
    out += in.line("# directional_shadow/size = {}", "directional_shadow/size");
    return out + in.line("# shadows/filter_mode = {}", "filter_mode");
}

}  // namespace si
