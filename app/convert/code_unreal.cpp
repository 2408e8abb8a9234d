// Code template of Unreal Engine 5.
#include <fmt/format.h>

#include "app/convert/targets.h"

namespace si {

std::string unreal_code(const CodeInput& in) {
    std::string out = "; Details of the light. The engine counts in centimetres; these numbers are without unit.\n";
    for (const char* key : {"ShadowBias", "ShadowSlopeBias", "LightSourceAngle", "DynamicShadowCascades"})
        out += in.line(fmt::format("; {} = {{}}", key), key);
    out += "; DefaultEngine.ini\n[SystemSettings]\nr.Shadow.Virtual.Enable=0\n";
    for (const char* key :
         {"r.Shadow.CSMDepthBias", "r.Shadow.CSMSlopeScaleDepthBias", "r.Shadow.ShadowMaxSlopeScaleDepthBias"})
        out += fmt::format("{}={}\n", key, in.text(key));
    out += in.line("r.Shadow.MaxCSMResolution={}", "r.Shadow.MaxCSMResolution");
    if (in.has("r.Shadow.Virtual.NormalBias"))
        out += fmt::format(
            "; With virtual shadow maps instead, {} m from the camera at a field of view of {} degrees (not "
            "verified):\n"
            "; r.Shadow.Virtual.NormalBias={}\n",
            code_number(in.facts.view_m), code_number(in.facts.view_fov_deg), in.text("r.Shadow.Virtual.NormalBias"));
    return out;
}

}  // namespace si
