// Where each surface of a scene lies in its light map: charts of neighbouring triangles, laid flat and packed into a
// square.
//
//     const LightMapLayout layout = light_map_layout(geometry, 1024, workers);
//     layout.chart_of[layout.objects[object].first + triangle];     // a row of layout.charts
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/reference/truth_geometry.h"
#include "renderer/reference/workers.h"

namespace si {

/// Neighbouring triangles of one object, projected along a common normal. A point p of them lies at
/// (dot(u, p - centre), dot(v, p - centre)) * texels_per_metre + at, in texels of the atlas, counted from its corner.
struct LightMapChart {
    glm::dvec3 u{1, 0, 0}, v{0, 1, 0};  ///< unit, across the normal
    glm::dvec2 lo{0}, extent_m{0};      ///< of the projection
    glm::dvec2 at{0};                   ///< texels
    glm::ivec4 rect{0};                 ///< first texel, and how many across and up, gutters included
    std::uint32_t object = 0;
    std::uint32_t first = 0, count = 0;  ///< its part of LightMapLayout::triangles
    bool flat = true;                    ///< all of it lies in one plane
};

struct LightMapLayout {
    static constexpr std::uint32_t kNoChart = 0xffffffff;
    static constexpr int kGutter = 1;               ///< texels around each chart, which bilinear look-ups may reach
    static constexpr double kMostTiltDegrees = 30;  ///< of a triangle against the chart that it is in
    struct ObjectPart {
        std::uint32_t first = 0, count = 0;  ///< of its triangles among all
    };

    int side = 0;  ///< texels
    double texels_per_metre = 0;
    glm::dvec3 centre{0};                 ///< of the scene, metres
    std::vector<ObjectPart> objects;      ///< by their number
    std::vector<std::uint32_t> chart_of;  ///< by triangle; kNoChart: it has no area
    /// By triangle, a bit an edge (corner k to k + 1): another chart, or nothing, lies beyond it.
    std::vector<std::uint8_t> borders;
    std::vector<LightMapChart> charts;
    std::vector<std::uint32_t> triangles;  ///< chart by chart, as their object numbers them

    /// Where a point of a chart lies, in texels.
    glm::dvec2 place(const LightMapChart& chart, const glm::dvec3& position_ws) const {
        const glm::dvec3 p = position_ws - centre;
        return glm::dvec2(glm::dot(chart.u, p), glm::dot(chart.v, p)) * texels_per_metre + chart.at;
    }
    /// The share of texels within charts, gutters included.
    double used() const;
};

/// Grows charts from triangle to neighbour, within LightMapLayout::kMostTiltDegrees of the first one's normal, and
/// packs them on shelves by their height, at the greatest density at which all fit. A chart that would lie upon itself
/// is taken apart into those that are flat.
/// @param side of the atlas, texels
/// @throws Error naming the least light_map.resolution when the charts do not fit at any density; Cancelled
LightMapLayout light_map_layout(const ReferenceGeometry& geometry, int side, const Workers& workers = {});

}  // namespace si
