// JSON schema of frame.json, from the same description as its parser.
#pragma once

#include <string>

namespace si {

/// Returns the JSON schema (draft 2020-12) of frame.json, the description of a bundle (an engine's frame as files): the
/// text of docs/bundle.schema.json.
std::string bundle_schema();

}  // namespace si
