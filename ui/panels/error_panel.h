// State of the error table.
#pragma once

#include <string>

namespace si {

/// State of the panel Error, the table of errors against the ray-traced reference.
struct ErrorPanel {
    std::string save_path = "error.json";  ///< file that its Save button writes
};

}  // namespace si
