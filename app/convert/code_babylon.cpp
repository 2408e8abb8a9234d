// Code template of Babylon.js.
#include <fmt/format.h>

#include "app/convert/targets.h"

namespace si {

std::string babylon_code(const CodeInput& in) {
    // The third argument asks for 32-bit floats, in whose steps the numbers hold.
    std::string out =
        fmt::format("// const gen = new BABYLON.{}({}, light, true);\n",
                    in.facts.cascades > 1 ? "CascadedShadowGenerator" : "ShadowGenerator", in.text("mapSize"));
    const std::string filter = in.text("filter");
    const char* name = filter == "PCF"       ? "FILTER_PCF"
                       : filter == "PCSS"    ? "FILTER_PCSS"
                       : filter == "POISSON" ? "FILTER_POISSONSAMPLING"
                       : filter == "ESM"     ? "FILTER_EXPONENTIALSHADOWMAP"
                                             : "FILTER_NONE";
    out += fmt::format("gen.filter = BABYLON.ShadowGenerator.{};\n", name);
    out += in.line("gen.bias = {};", "bias") + in.line("gen.normalBias = {};", "normalBias");
    out += in.line("gen.forceBackFacesOnly = {};", "forceBackFacesOnly");
    if (in.facts.cascades > 1)
        return out + fmt::format("gen.numCascades = {};\n", in.facts.cascades) + in.line("gen.lambda = {};", "lambda");
    return out + fmt::format(
                     "light.shadowFrustumSize = {};\n"
                     "// NEAR and FAR count from the light's position: far - near must be D.\n"
                     "light.shadowMinZ = NEAR;\nlight.shadowMaxZ = NEAR + {};\n",
                     code_number(in.facts.width_m), code_number(in.facts.depth_m));
}

}  // namespace si
