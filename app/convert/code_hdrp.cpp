// Code template of Unity HDRP.
#include <fmt/format.h>

#include "app/convert/targets.h"

namespace si {

std::string hdrp_code(const CodeInput& in) {
    return "// HDAdditionalLightData hd = light.GetComponent<HDAdditionalLightData>();\n" +
           in.line("hd.slopeBias = {}f;", "slopeBias") + in.line("hd.normalBias = {}f;", "normalBias") +
           fmt::format("hd.SetShadowResolutionOverride(true);\nhd.SetShadowResolution({});\n", in.facts.texels);
}

}  // namespace si
