// Names of files in a bundle.
#pragma once

#include <string_view>

namespace si {

/// Returns the reason why a name may not be that of a file in a bundle, such as "holds .."; empty for an allowed name.
/// Allowed are relative paths by '/', of UTF-8, without "..", ".", empty parts, backslashes, colons and control
/// characters, of at most 1,000 bytes.
std::string_view bundle_path_fault(std::string_view name);

}  // namespace si
