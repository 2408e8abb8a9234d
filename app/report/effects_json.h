// Effects of a frame and the time that optimisations save, as JSON and as text (docs/cli.md).
#pragma once

#include <span>

#include "app/base/json_text.h"
#include "renderer/advise/waste.h"
#include "renderer/inspect/effects.h"
#include "renderer/measure/optimisation_times.h"

namespace si {

/// Converts the effects of a frame to a JSON array, one object each. An effect is a piece of rendering work that the
/// frame has drawn, cached or skipped. An optimisation may be the reason why it was cached or skipped.
/// @param saved measured times that optimisations save: an effect's field saved_ms holds the time of its optimisation;
/// null: not measured, and saved_ms is null
nlohmann::ordered_json effects_json(std::span<const Effect> effects, const SavedTimes* saved);
/// Converts the table of optimisations (work that frames skip) to JSON. @param saved measured time that each one saves;
/// null: not measured
nlohmann::ordered_json optimisations_json(const SavedTimes* saved);
/// Converts the result of a search for waste to JSON. Waste is work of a frame that changes no pixel.
nlohmann::ordered_json waste_json(const Waste& waste);

/// Prints the effects of a frame (pieces of rendering work) to stdout as a table: state, time, saved time, name and
/// reason.
/// @param saved measured time that each optimisation saves; null: not measured
void print_effects(std::span<const Effect> effects, const SavedTimes* saved);
/// Prints the result of a search for waste to stdout. Waste is work of a frame that changes no pixel.
void print_waste(const Waste& waste);

}  // namespace si
