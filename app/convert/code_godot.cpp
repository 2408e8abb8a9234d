// Code template of Godot 4.
#include <fmt/format.h>

#include "app/convert/targets.h"

namespace si {

std::string godot_code(const CodeInput& in) {
    std::string out = in.line("light.shadow_bias = {}", "shadow_bias");
    out += in.line("light.shadow_normal_bias = {}", "shadow_normal_bias");
    out += in.line("light.shadow_blur = {}", "shadow_blur");
    out += in.line("light.light_angular_distance = {}  # not verified: a diameter", "light_angular_distance");
    out += in.line("light.shadow_reverse_cull_face = {}", "shadow_reverse_cull_face");
    // Names in the order of the choices.
    static constexpr const char* kModes[] = {"ORTHOGONAL", "PARALLEL_2_SPLITS", "PARALLEL_4_SPLITS"};
    out += fmt::format("light.directional_shadow_mode = DirectionalLight3D.SHADOW_{}\n",
                       kModes[std::size_t(in.number("directional_shadow_mode"))]);
    for (const char* split : {"directional_shadow_split_1", "directional_shadow_split_2", "directional_shadow_split_3"})
        out += in.line(fmt::format("light.{} = {{}}", split), split);
    out += fmt::format("light.rotation_degrees = Vector3({}, {}, 0)\n", code_number(-in.light().elevation),
                       code_number(in.light().azimuth));
    out += "# Project settings, rendering/lights_and_shadows:\n";
    out += in.line("# directional_shadow/size = {}", "directional_shadow/size");
    out += in.line("# directional_shadow/soft_shadow_filter_quality = {}", "soft_shadow_filter_quality");
    return out + in.line("# directional_shadow/16_bits = {}", "directional_shadow/16_bits");
}

}  // namespace si
