// What a frame simulates to no end: each map, face and cascade, and each effect that a setting puts on, is left out in
// turn. Where no byte of the picture changes, it was waste.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "renderer/frame/renderer.h"
#include "renderer/reference/workers.h"

namespace si {

/// Something that the frame drew, left out.
struct Tried {
    std::string name;             ///< "cascade 2 of 4 of light 0"
    bool changes = false;         ///< a byte of the picture; else it is waste
    double read = -1;             ///< share of its texels that some visible pixel's kernel reads; below 0: it is no map
    std::uint64_t triangles = 0;  ///< drawn for it into maps
};

struct Waste {
    std::vector<Tried> tried;
    std::uint64_t triangles() const;  ///< of all maps
    std::uint64_t wasted() const;     ///< of those that change nothing
    /// The machine-independent share of the maps' work that is waste.
    double share() const { return triangles() ? double(wasted()) / double(triangles()) : 0; }
};

/// Draws a frame for each of them. Of virtual maps the pages are those that look-ups read, so that none is tried.
/// @param request whose picture is looked at; what settings show over it (view.*) is left out
/// @throws Error, Cancelled
Waste find_waste(Renderer& renderer, const Scene& scene, const Settings& settings, FrameRequest request,
                 const Workers& workers = {}, const std::function<void(double)>& report = {});

}  // namespace si
