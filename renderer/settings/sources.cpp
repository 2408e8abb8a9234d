#include "renderer/settings/sources.h"

#include <algorithm>

#include "renderer/settings/choices_of.h"

namespace si {
namespace {

constexpr Source kSourceRows[] = {
    {.key = "map",
     .label = "shadow map",
     .help = "The depth that the light sees is drawn, and every surface compares its own with it.",
     .paper = "Williams, Casting Curved Shadows on Curved Surfaces, SIGGRAPH 1978",
     .fused = true,
     .needs = {.map = true},
     .file = "sources/map.glsl"},
    {.key = "none",
     .label = "no shadow",
     .help = "Everything that faces the light is lit; what a picture lacks without shadows.",
     .fused = true},
    {.key = "volumes-zfail",
     .label = "shadow volumes (z-fail)",
     .help =
         "What each caster shadows is drawn as a volume into a stencil buffer, which counts at each pixel how many "
         "of them hold the surface. Exact to the pixel, hard, without a bias, wherever the camera stands; the cost "
         "is the area that the volumes' faces cover. Faces cast from both sides whatever caster.cull says, masked "
         "ones as if they were solid, and so do blended ones where caster.blend lets them cast; on blended surfaces "
         "there is no shadow.",
     .paper = "Everitt and Kilgard, Practical and Robust Stenciled Shadow Volumes for Hardware-Accelerated Rendering, "
              "2002; McGuire et al., Fast, Practical and Robust Shadows, 2003",
     .needs = {.stencil = true, .camera_depth = true},
     .file = "sources/volumes.glsl"},
    {.key = "traced",
     .label = "ray traced",
     .help = "The ray-traced truth itself, as truth.area, truth.samples, truth.noise and truth.step say. Exact and "
             "slow: rays are traced on the CPU before the frame is drawn, and their time is not in the frame's. Until "
             "they are traced, the light has no shadow; on blended surfaces it never has.",
     .paper = "Appel, Some Techniques for Shading Machine Renderings of Solids, AFIPS 1968",
     .needs = {.truth = true}},
};

}  // namespace

std::span<const Source> sources() {
    return kSourceRows;
}

std::span<const Choice> source_choices() {
    static const std::vector<Choice> choices = choices_of(sources());
    return choices;
}

const Source& source_of(const Settings& settings, int light) {
    const auto i = std::size_t(std::clamp(light, 0, kMaxLights - 1));
    return kSourceRows[std::clamp(settings.lights[i].source, 0, int(std::size(kSourceRows)) - 1)];
}

bool any_source_is_volumes(const Settings& settings) {
    const int count = std::clamp(settings.light_count, 0, kMaxLights);
    for (int i = 0; i < count; ++i)
        if (settings.lights[std::size_t(i)].cast && source_of(settings, i).needs.stencil) return true;
    return false;
}

bool no_source_is_map(const Settings& settings) {
    const int count = std::clamp(settings.light_count, 0, kMaxLights);
    for (int i = 0; i < count; ++i)
        if (source_of(settings, i).needs.map) return false;
    return count > 0;
}

}  // namespace si
