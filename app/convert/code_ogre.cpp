// Code template of OGRE 1.12.
#include <fmt/format.h>

#include "app/convert/targets.h"

namespace si {

std::string ogre_code(const CodeInput& in) {
    return "// Pass of the shadow caster material:\n" +
           fmt::format("pass->setDepthBias({}, {});  // constant, slope\n", in.c_text("depth_bias.constant"),
                       in.c_text("depth_bias.slope")) +
           in.line("sceneManager->setShadowTextureSize({});", "ShadowTextureSize");
}

}  // namespace si
