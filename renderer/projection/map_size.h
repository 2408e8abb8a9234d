// Size of a shadow map's image.
#pragma once

namespace si {

/// Texels of one shadow map across and down. One number makes a square map.
struct MapSize {
    int width = 0, height = 0;
    constexpr MapSize(int side) : width(side), height(side) {}
    constexpr MapSize(int across, int down) : width(across), height(down) {}
    bool operator==(const MapSize&) const = default;
};

}  // namespace si
