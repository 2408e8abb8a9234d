// Size of a shadow map's image.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

namespace si {

/// Width and height of a shadow map in texels. One number makes a square map.
struct MapSize {
    int width = 0, height = 0;
    constexpr MapSize() = default;
    constexpr MapSize(int side) : width(side), height(side) {}
    constexpr MapSize(int across, int down) : width(across), height(down) {}
    /// Returns the texels along the longer side.
    int longest() const { return std::max(width, height); }
    /// Returns the texels along the shorter side.
    int shortest() const { return std::min(width, height); }
    /// Returns true when the map is as wide as high.
    bool is_square() const { return width == height; }
    /// Returns width and height in texels.
    glm::ivec2 sides() const { return {width, height}; }
    /// Returns width and height as factors that convert map coordinates in [0,1] to texels.
    glm::dvec2 texels() const { return {width, height}; }
    bool operator==(const MapSize&) const = default;
};

}  // namespace si
