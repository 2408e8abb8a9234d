// What a light sees first along given rays: what a shadow map of endlessly many texels that loses no caster would hold.
#pragma once

#include <span>
#include <vector>

#include "renderer/reference/truth_scene.h"

namespace si {

/// A straight way away from a light, in world space.
struct LightWay {
    glm::dvec3 from_ws{0}, to_ws{0};
};

/// Metres along each way to the first of all casters, whichever side it shows; NaN where none stands on it. Accurate to
/// single precision of the way's length and the scene's size.
std::vector<double> first_surfaces(const ReferenceScene& scene, std::span<const LightWay> ways);

}  // namespace si
