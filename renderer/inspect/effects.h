// List of a frame's effects: the work that was drawn, cached or skipped, each with a reason in words. The list is made
// only on request, so that frames without it cost nothing.
#pragma once

#include <span>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/inspect/effect.h"

namespace si {

/// Lists all effects (pieces of rendering work) of a drawn frame in the order of its passes, each pass before its
/// parts. Every pass belongs to at least one effect.
/// @param settings settings of the frame, sanitised or not
/// @param forced the optimisations that are switched off, FrameRequest::forced of the frame
std::vector<Effect> frame_effects(const Scene& scene, const Settings& settings, const FrameResult& frame,
                                  OptimisationSet forced = {});

/// Makes the effect "posing" for the report on a frame's work: before the frame, the CPU animates nodes, skins and
/// morph targets of the scene.
/// @param again true: the scene was posed since the frame before, so the effect counts as drawn instead of cached
Effect posing_effect(const Scene& scene, const SceneSettings& settings, bool again);

/// Counts the effects that are skipped by the same optimisation as `effect`, including `effect` itself. Returns 1 for
/// an effect without optimisation. The measured time of an optimisation belongs to all of these effects together.
/// @param effects all effects (pieces of rendering work) of a frame
std::size_t sharing_optimisation_count(std::span<const Effect> effects, const Effect& effect);

}  // namespace si
