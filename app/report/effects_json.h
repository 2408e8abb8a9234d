// Effects of a frame and the time that optimisations save, as JSON and as text (docs/cli.md).
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "renderer/advise/waste.h"
#include "renderer/inspect/effects.h"
#include "renderer/measure/optimisation_times.h"

namespace si {

/// Converts the effects of a frame to JSON, one object each. @param saved measured times; null: each saved_ms is null
nlohmann::ordered_json effects_json(std::span<const Effect> effects, const SavedTimes* saved);
/// Converts the table of optimisations to JSON. @param saved measured times; null: none
nlohmann::ordered_json optimisations_json(const SavedTimes* saved);
/// Converts wasted work (work that changes no pixel) to JSON.
nlohmann::ordered_json waste_json(const Waste& waste);

/// Formats the time that an optimisation saves, in ms: "1.20 (0.90 to 1.50), of 3 together"; a dash for null.
/// @param together number of effects that were forced together for this time
std::string saved_time_text(const Spread* ms, std::size_t together);
/// Prints the effects of a frame to stdout. @param saved measured times; null: none
void print_effects(std::span<const Effect> effects, const SavedTimes* saved);
/// Prints wasted work (work that changes no pixel) to stdout.
void print_waste(const Waste& waste);

}  // namespace si
