// Bounds on depth and size of a JSON text before it is parsed.
#pragma once

#include <cstddef>
#include <string_view>

namespace si {

/// Nesting depth and size of a JSON text, to refuse hostile files before they are parsed.
struct JsonShape {
    int depth = 0;           ///< deepest nesting
    std::size_t values = 0;  ///< upper bound of the number of values inside objects and lists, without keys
};

/// Measures depth and size of a JSON text by counting brackets and commas outside strings. Accepts any text: the counts
/// of invalid JSON are no error.
JsonShape json_shape(std::string_view text);

}  // namespace si
