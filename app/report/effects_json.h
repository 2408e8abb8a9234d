// The effects of a frame, and what their savings are worth, as JSON and as text (docs/cli.md).
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "renderer/advise/waste.h"
#include "renderer/inspect/effects.h"
#include "renderer/measure/optimisation_times.h"

namespace si {

/// An object an effect. @param saved null: nothing was measured, and each saved_ms is null
nlohmann::ordered_json effects_json(std::span<const Effect> effects, const SavedTimes* saved);
/// Every row of savings(), with what it is worth where that was measured.
nlohmann::ordered_json savings_json(const SavedTimes* saved);
nlohmann::ordered_json waste_json(const Waste& waste);

/// "1.20 (0.90 to 1.50), of 3 together", or a dash where it is not known.
/// @param together effects that the time is of
std::string saved_text(const Spread* ms, std::size_t together);
void print_effects(std::span<const Effect> effects, const SavedTimes* saved);
void print_waste(const Waste& waste);

}  // namespace si
