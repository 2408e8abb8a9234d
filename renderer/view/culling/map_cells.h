// Parts of a shadow map that look-ups may read, as a grid of 64 x 64 cells.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/base/key.h"
#include "renderer/projection/map_size.h"
#include "renderer/view/culling/box_culling.h"

namespace si {

/// Rectangle of texels: `from` is its first texel, `to` lies one past its last.
struct TexelRect {
    glm::ivec2 from{0}, to{0};
    bool operator==(const TexelRect&) const = default;
};

/// Projects a world-space box into a shadow map. Returns the bounding rectangle in map coordinates; empty if a part of
/// the box lies behind the viewer, so that the rectangle has no bound.
/// @param uvd_from_relative homogeneous map coordinates from positions relative to `origin` (world)
/// @param min_w smallest clip-space w that counts as in front of the viewer
std::optional<Bounds2> projected_rect(const SkewBox& box, const glm::dmat4& uvd_from_relative, const glm::dvec3& origin,
                                      double min_w);

/// Set of cells of a shadow map, which is divided into a grid of 64 x 64 cells. Marks the parts of the map that are
/// read or drawn.
class MapCells {
public:
    static constexpr int kCells = 64;  ///< cells along a side
    /// Makes an empty set of shadow map cells.
    MapCells() = default;
    /// Returns the set of all cells of a shadow map.
    static MapCells whole();
    /// Returns true when the set contains no cell of the shadow map.
    bool empty() const;
    /// Returns true when the set contains all 64 x 64 cells of the shadow map.
    bool is_whole() const;
    /// Returns true when this set of shadow map cells contains every cell of another set.
    bool contains(const MapCells& other) const;
    /// Returns true when a rectangle of a shadow map overlaps a cell of the set.
    /// @param rect map coordinates
    bool overlaps(const Bounds2& rect) const;
    /// Adds the shadow map cells that a rectangle overlaps to the set.
    /// @param rect map coordinates
    /// @param clamp decides about the part of the rectangle outside the map. true: adds the border cells (clamp to
    /// edge); false: adds nothing
    void add(const Bounds2& rect, bool clamp);
    /// Adds the cells along the four sides of the shadow map to the set.
    void add_border_cells();
    /// Adds all cells of another set of shadow map cells to this set.
    void add(const MapCells& other);
    /// Returns a few rectangles of texels that together cover this set of shadow map cells, for copies and scissored
    /// draws. Rectangles overlap only in texels that two cells share.
    /// @param size texels of the map
    std::vector<TexelRect> texel_rects(MapSize size) const;
    /// Adds this set of shadow map cells to a cache key.
    void add_to(Key& key) const { key.bytes(rows_.data(), sizeof rows_); }
    bool operator==(const MapCells&) const = default;

private:
    std::array<std::uint64_t, kCells> rows_{};  ///< one bit per cell
};

}  // namespace si
