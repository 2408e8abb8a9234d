// The ray-traced truth and the errors by it: what is known, what the error panel wishes for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace si {

/// What is known of the ray-traced truth about the frame.
struct ReferenceFacts {
    bool current = false;                             ///< the frame shown has all that it asks for
    bool wanted = false;                              ///< something that is shown asks for it
    bool lacks_light_map = false;                     ///< what is missing is a light map, or that too
    std::string doing;                                ///< what runs in the background: "Tracing rays"; empty: nothing
    double progress = 0;                              ///< 0..1, of that
    std::string problem;                              ///< why there is none
    double build_ms = 0, place_ms = 0, trace_ms = 0;  ///< wall time of the last trace; 0 where it was known
    std::uint64_t rays = 0;
    std::string noise;          ///< noise_text() of a light of size
    int width = 0, height = 0;  ///< in pixels
};

struct ReferenceActions {
    bool want_error = false;  ///< the error panel is shown
    bool cancel_reference = false;
    std::optional<std::string> save_error;  ///< all metrics as JSON into this file
};

}  // namespace si
