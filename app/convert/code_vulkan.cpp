// Code template of Vulkan.
#include <fmt/format.h>

#include "app/convert/targets.h"

namespace si {

std::string vulkan_code(const CodeInput& in) {
    return fmt::format(
        "/* while the map is drawn; the clamp needs the feature depthBiasClamp */\n"
        "vkCmdSetDepthBias(commands, {}, {}, {}); /* constant factor, clamp, slope factor */\n"
        "/* in the shader that reads the map */\n"
        "static const float shader_depth_bias = {};      /* normalised depth, towards the light */\n"
        "static const float shader_normal_offset_m = {}; /* along the geometric normal */\n",
        in.c_text("depthBiasConstantFactor"), in.c_text("depthBiasClamp"), in.c_text("depthBiasSlopeFactor"),
        in.c_text("shader.depthBias"), in.c_text("shader.normalOffset"));
}

}  // namespace si
