// Whether the numbers of a frame are sound, for commands.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>

#include "renderer/base/workers.h"
#include "renderer/render/renderer.h"

namespace si {

/// Draws what is missing of a frame, and searches all its maps and its visibility. What its sources ask for is traced
/// by `workers`. @throws Error, Cancelled
std::shared_ptr<const NumericHealth> search_numbers(Renderer& renderer, const Scene& scene, const Settings& settings,
                                                    FrameRequest request, const Workers& workers = {});

nlohmann::ordered_json health_json(const NumericHealth& health);

/// @throws Error that names what was found and where, unless all numbers are sound
void require_sound(const NumericHealth& health);

}  // namespace si
