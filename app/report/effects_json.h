// Effects of a frame and the time that optimisations save, as JSON and as text (docs/cli.md).
#pragma once

#include <span>

#include "app/base/json_text.h"
#include "renderer/advise/waste.h"
#include "renderer/inspect/effects.h"
#include "renderer/measure/optimisation_times.h"

namespace si {

/// Converts the pieces of rendering work of a frame (Effect) to JSON, one object each. @param saved measured times;
/// null: each saved_ms is null
nlohmann::ordered_json effects_json(std::span<const Effect> effects, const SavedTimes* saved);
/// Converts the table of optimisations to JSON. @param saved measured times; null: none
nlohmann::ordered_json optimisations_json(const SavedTimes* saved);
/// Converts wasted work (work that changes no pixel) to JSON.
nlohmann::ordered_json waste_json(const Waste& waste);

/// Prints the effects of a frame to stdout. @param saved measured times; null: none
void print_effects(std::span<const Effect> effects, const SavedTimes* saved);
/// Prints wasted work (work that changes no pixel) to stdout.
void print_waste(const Waste& waste);

}  // namespace si
