// JSON schema of presets, from the table of settings.
#pragma once

#include <string>

namespace si {

/// Returns the JSON schema (draft 2020-12) of preset files: the text of docs/preset.schema.json. The schema accepts any
/// text for kernels and other techniques, as their tables may grow.
std::string preset_schema();

}  // namespace si
