// JSON schema of presets, from the table of settings.
#pragma once

#include <string>

namespace si {

/// Returns the JSON schema (draft 2020-12) of presets: the text of docs/preset.schema.json. Kernels and other
/// techniques, whose tables are open, are plain texts in it.
std::string preset_schema();

}  // namespace si
