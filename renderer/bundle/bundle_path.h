// Names of files in a bundle.
#pragma once

#include <string_view>

namespace si {

/// Returns the reason why a name may not be that of a file in a bundle, such as "has .."; empty for an allowed name.
/// Allowed are relative paths in UTF-8 with '/', of at most 1,000 bytes, without "..", ".", empty parts, backslashes,
/// colons and control characters.
std::string_view bundle_path_fault(std::string_view name);

}  // namespace si
