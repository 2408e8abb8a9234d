// How deep and how large a JSON text is, told before it is read.
#pragma once

#include <cstddef>
#include <string_view>

namespace si {

struct JsonShape {
    int depth = 0;           ///< deepest nesting
    std::size_t values = 0;  ///< a bound on the number of values, keys left out
};

/// Counts brackets and commas outside of strings; of a text that is no JSON it says as much as that.
JsonShape json_shape(std::string_view text);

}  // namespace si
