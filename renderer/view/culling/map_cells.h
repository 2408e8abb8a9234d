// Which parts of a shadow map look-ups may read, in cells: coarse enough to be kept and compared, fine enough to tell
// which casters matter.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/base/key.h"
#include "renderer/view/culling/box_culling.h"

namespace si {

/// Map coordinates; all from 0 to 1 lie in the map.
struct MapRect {
    glm::dvec2 lo{0}, hi{1};
};

/// Texels of a map, from the first to before the last.
struct TexelRect {
    glm::ivec2 from{0}, to{0};
    bool operator==(const TexelRect&) const = default;
};

/// Around what a box covers in a map; nothing where that may be anything, as part of the box lies behind the viewer.
/// @param uvd_from_relative homogeneous map coordinates from positions relative to `origin`
/// @param before least w of what is seen
std::optional<MapRect> projected_rect(const SkewBox& box, const glm::dmat4& uvd_from_relative, const glm::dvec3& origin,
                                      double before);

class MapCells {
public:
    static constexpr int kCells = 64;  ///< along a side
    MapCells() = default;
    static MapCells whole();
    bool empty() const;
    bool is_whole() const;
    bool holds(const MapCells& other) const;
    bool meets(const MapRect& rect) const;
    /// @param beyond what lies beyond a side is looked up at it; else nowhere
    void add(const MapRect& rect, bool beyond);
    /// The cells along the sides.
    void add_border_cells();
    void add(const MapCells& other);
    /// Few rectangles that together hold the cells' texels. They overlap only where a texel lies in two cells.
    /// @param resolution texels along a side of the map
    std::vector<TexelRect> texels(int resolution) const;
    void add_to(Key& key) const { key.bytes(rows_.data(), sizeof rows_); }
    bool operator==(const MapCells&) const = default;

private:
    std::array<std::uint64_t, kCells> rows_{};
};

}  // namespace si
