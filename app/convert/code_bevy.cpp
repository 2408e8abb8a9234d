// Code template of Bevy.
#include <fmt/format.h>

#include "app/convert/targets.h"

namespace si {

std::string bevy_code(const CodeInput& in) {
    std::string out = "DirectionalLight {\n    shadows_enabled: true,\n";
    for (const char* key : {"shadow_depth_bias", "shadow_normal_bias"})
        out += fmt::format("    {}: {},\n", key, rust_float(in.number(key)));
    out += "    ..default()\n}\n";
    out += in.line("// resource: DirectionalLightShadowMap { size: {} }", "size");
    out += in.line("// component of the camera: ShadowFilteringMethod::{}", "ShadowFilteringMethod");
    if (in.has("num_cascades") && in.number("num_cascades") > 1)
        out +=
            fmt::format("// CascadeShadowConfigBuilder {{ num_cascades: {}, overlap_proportion: {}, ..default() }}\n",
                        in.text("num_cascades"), rust_float(in.number("overlap_proportion")));
    return out + fmt::format(
                     "// Transform::from_rotation(Quat::from_euler(EulerRot::YXZ, {}f32.to_radians(), "
                     "{}f32.to_radians(), 0.0))\n",
                     code_number(in.light().azimuth), code_number(-in.light().elevation));
}

}  // namespace si
