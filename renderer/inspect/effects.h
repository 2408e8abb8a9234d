// What a frame could simulate, and what it did of it: each effect with why, in sentences. Made from a frame's facts
// when somebody asks, so that who does not pays nothing.
#pragma once

#include <span>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/inspect/effect.h"

namespace si {

/// All effects of a drawn frame in the order of its passes, each pass before its parts. Every pass is the `pass` of
/// one effect at least.
/// @param settings that it was drawn under, repaired or not
/// @param forced FrameRequest::forced of the frame
std::vector<Effect> frame_effects(const Scene& scene, const Settings& settings, const FrameResult& frame,
                                  OptimisationSet forced = {});

/// Moving the scene's nodes, skins and morph targets, which is done before a frame, by the CPU.
/// @param anew the scene was posed since the frame before
Effect posing_effect(const Scene& scene, const SceneSettings& settings, bool again);

/// How many of `effects`, one of which is `effect`, share its saving: what was measured of that is of all together.
std::size_t sharing_optimisation_count(std::span<const Effect> effects, const Effect& effect);

}  // namespace si
