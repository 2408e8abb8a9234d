// Probe of one pixel as JSON (docs/cli.md).
#pragma once

#include <span>

#include "app/base/json_text.h"
#include "renderer/advise/trial.h"
#include "renderer/inspect/pixel_diagnosis.h"

namespace si {

/// Converts the probe of a pixel (the steps of its shadow tests) to JSON.
/// @param diagnoses one for each light of the probe; empty without a reference
/// @param fix the fix that was drawn and measured, for the light Candidate::light; null: none
nlohmann::ordered_json probe_json(const Probe& probe, std::span<const PixelDiagnosis> diagnoses,
                                  const Trial* fix = nullptr);

}  // namespace si
