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
    out += fmt::format("light.directional_shadow_mode = {}\n",
                       in.facts.cascades >= 4   ? "DirectionalLight3D.SHADOW_PARALLEL_4_SPLITS"
                       : in.facts.cascades == 2 ? "DirectionalLight3D.SHADOW_PARALLEL_2_SPLITS"
                                                : "DirectionalLight3D.SHADOW_ORTHOGONAL");
    for (const char* split : {"directional_shadow_split_1", "directional_shadow_split_2", "directional_shadow_split_3"})
        out += in.line(fmt::format("light.{} = {{}}", split), split);
    out += fmt::format("light.rotation_degrees = Vector3({}, {}, 0)\n", code_number(-in.light().elevation),
                       code_number(in.light().azimuth));
    const int shared = in.facts.cascades > 1 ? 2 : 1;  // splits share the atlas
    out += fmt::format("# Project settings, rendering/lights_and_shadows:\n# directional_shadow/size = {}\n",
                       shared * in.facts.texels);
    out += in.line("# directional_shadow/soft_shadow_filter_quality = {}", "soft_shadow_filter_quality");
    return out + in.line("# directional_shadow/16_bits = {}", "directional_shadow/16_bits");
}

}  // namespace si
