// A probed pixel as JSON (docs/cli.md).
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "renderer/inspect/dossier.h"

namespace si {

/// @param dossiers one for each light of the probe, or none where no truth was asked for
nlohmann::ordered_json probe_json(const Probe& probe, std::span<const PixelDiagnosis> diagnoses);

}  // namespace si
