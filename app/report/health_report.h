// Search for NaN, infinite and out-of-range numbers in a frame, for --check-numeric.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>

#include "renderer/base/workers.h"
#include "renderer/render/renderer.h"

namespace si {

/// Draws a frame and searches its maps, visibility and matrices for unsound numbers. @param workers for rays that the
/// light sources need @throws Error, Cancelled
std::shared_ptr<const NumericHealth> search_numbers(Renderer& renderer, const Scene& scene, const Settings& settings,
                                                    FrameRequest request, const Workers& workers = {});

/// Converts the findings of a search to JSON.
nlohmann::ordered_json health_json(const NumericHealth& health);

/// Checks that all numbers are sound. @throws Error naming each finding and its place
void require_sound(const NumericHealth& health);

}  // namespace si
