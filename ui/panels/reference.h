// Facts and requests about the ray-traced reference and the errors against it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace si {

/// State, progress and times of the ray-traced reference of the shown frame.
struct ReferenceFacts {
    bool current = false;          ///< the shown frame has all references that it needs
    bool wanted = false;           ///< a panel, overlay or light source needs it
    bool lacks_light_map = false;  ///< a light map is missing
    std::string doing;             ///< work in the background: "Tracing rays"; empty: none
    double progress = 0;           ///< progress of the background work, 0..1
    double traced_share = 0;       ///< pixels of the reference in work, or of a cancelled one, that are traced, 0..1
    double seconds_left = 0;       ///< estimated for the background work; 0: not known yet
    std::string problem;           ///< reason why there is no reference; empty: no problem
    // Wall times of the last trace; 0: the result was cached.
    double build_ms = 0;
    double place_ms = 0;
    double trace_ms = 0;
    std::uint64_t rays = 0;
    std::string noise;  ///< noise_text() of an area light; else empty
    int width = 0;      ///< pixels
    int height = 0;     ///< pixels
};

/// Requests of the panel Error to the application: measure errors against the ray-traced reference, cancel tracing, or
/// save the metrics.
struct ReferenceRequests {
    bool want_error = false;                ///< the error panel is shown
    bool cancel_reference = false;          ///< stop tracing until something changes
    std::optional<std::string> save_error;  ///< all metrics as JSON into this file
};

}  // namespace si
