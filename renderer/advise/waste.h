// What a frame simulates to no end: each map, face and cascade, and each effect that the frame simulates, is left out
// in turn. Where no byte of the picture changes, it was waste.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "renderer/base/workers.h"
#include "renderer/render/renderer.h"

namespace si {

/// Something that the frame drew, left out.
struct Tried {
    std::string name;             ///< "cascade 2 of 4 of light 0"
    bool changes = false;         ///< a byte of the picture; else it is waste
    double read = -1;             ///< share of its texels that some visible pixel's kernel reads; below 0: it is no map
    std::uint64_t triangles = 0;  ///< drawn for it into maps
    double maps_ms = 0;           ///< of waste: what maps take less without it, where times were asked for; noisy
};

struct Waste {
    std::vector<Tried> tried;
    std::optional<double> maps_ms;    ///< that the frame's maps take; nothing: times were not asked for
    std::uint64_t triangles() const;  ///< of all maps
    std::uint64_t wasted() const;     ///< of those that change nothing
    double wasted_ms() const;         ///< of the maps' time
    /// The machine-independent share of the maps' work that is waste.
    double share() const { return triangles() ? double(wasted()) / double(triangles()) : 0; }
    /// The share of the maps' time; nothing: it was not asked for, or there is none.
    std::optional<double> share_of_time() const;
};

/// Draws a frame for each of them. Virtual maps are tried light by light: their pages are those that look-ups read.
/// @param request whose picture is looked at, without what settings show over it (view.*), which is tried by itself;
/// where it asks for `timing`, frames with and without what is waste are timed in turns
/// @throws Error, Cancelled
Waste find_waste(Renderer& renderer, const Scene& scene, const Settings& settings, FrameRequest request,
                 const Workers& workers = {}, const std::function<void(double)>& report = {});

}  // namespace si
