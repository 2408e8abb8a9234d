// Code template of three.js.
#include <fmt/format.h>

#include "app/convert/targets.h"

namespace si {

std::string three_code(const CodeInput& in) {
    const double half = 0.5 * in.facts.width_m;
    std::string out = in.line("light.shadow.bias = {};", "bias");
    out += in.line("light.shadow.normalBias = {};", "normalBias");
    if (in.has("mapSize")) out += fmt::format("light.shadow.mapSize.set({0}, {0});\n", in.text("mapSize"));
    out += fmt::format(
        "Object.assign(light.shadow.camera, {{left: -{0}, right: {0}, bottom: -{0}, top: {0}}});\n"
        "// NEAR and FAR count from the light's position: far - near must be D.\n"
        "Object.assign(light.shadow.camera, {{near: NEAR, far: NEAR + {1}}});\n"
        "light.shadow.camera.updateProjectionMatrix();\n",
        code_number(half), code_number(in.facts.depth_m));
    out += in.line("renderer.shadowMap.type = THREE.{};", "shadowMap.type");
    out += in.line("light.shadow.radius = {};", "radius");
    out += in.line("material.shadowSide = THREE.{};  // of every material that casts", "shadowSide");
    return out;
}

}  // namespace si
