// Layout of a light map's atlas: charts of neighbouring triangles, projected flat and packed into a square.
//
//     const LightMapLayout layout = light_map_layout(geometry, 1024, workers);
//     layout.chart_of[layout.objects[object].first + triangle];     // a row of layout.charts
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/base/workers.h"
#include "renderer/reference/reference_geometry.h"

namespace si {

/// Chart of a light map: neighbouring triangles of one object, projected along a common normal into a rectangle of the
/// atlas. A point p of the chart has the atlas position (dot(u, p - centre), dot(v, p - centre)) * texels_per_metre +
/// at, in texels. LightMapLayout has `centre` and `texels_per_metre`.
struct LightMapChart {
    glm::dvec3 u{1, 0, 0}, v{0, 1, 0};  ///< unit vectors in the chart's plane, along the atlas's axes
    glm::dvec2 lo{0}, extent_m{0};      ///< lower corner and size of the projection along u and v, metres
    glm::dvec2 at{0};                   ///< offset of the chart in the atlas, texels
    glm::ivec4 rect{0};                 ///< x and y of the first texel, width, height; includes gutters
    std::uint32_t object = 0;
    std::uint32_t first = 0, count = 0;  ///< range in LightMapLayout::triangles
    bool flat = true;                    ///< true when the triangles lie in one plane
};

/// Layout of a light map's atlas: the chart of every triangle of a scene, and the rectangle of every chart in the
/// square atlas.
struct LightMapLayout {
    static constexpr std::uint32_t kNoChart = 0xffffffff;
    static constexpr int kGutter = 1;              ///< border around each chart for bilinear look-ups, texels
    static constexpr double kMaxTiltDegrees = 30;  ///< largest angle between the normals of a triangle and its chart
    /// Range of one object's triangles in a list of the triangles of all objects.
    struct ObjectPart {
        std::uint32_t first = 0, count = 0;
    };

    int side = 0;  ///< width and height of the atlas, texels
    double texels_per_metre = 0;
    glm::dvec3 centre{0};                 ///< centre of the scene, world space, metres
    std::vector<ObjectPart> objects;      ///< range of triangles by index in Scene::objects
    std::vector<std::uint32_t> chart_of;  ///< index of each triangle's chart; kNoChart: degenerate triangle
    /// Border edges by triangle: bit k is set when no triangle of the same chart adjoins the edge from corner k to
    /// corner k + 1.
    std::vector<std::uint8_t> borders;
    std::vector<LightMapChart> charts;
    std::vector<std::uint32_t> triangles;  ///< indices of triangles within their object, listed chart by chart

    /// Returns the position in the light map of a world-space point on a chart, in texels.
    glm::dvec2 atlas_position(const LightMapChart& chart, const glm::dvec3& position_ws) const {
        const glm::dvec3 p = position_ws - centre;
        return glm::dvec2(glm::dot(chart.u, p), glm::dot(chart.v, p)) * texels_per_metre + chart.at;
    }
};

/// Computes a light map's layout for a scene. Grows charts from triangle to neighbour, within
/// LightMapLayout::kMaxTiltDegrees of the first triangle's normal. Packs them in shelves by height, at the highest
/// density at which all fit. A chart whose projection overlaps itself is split into flat ones.
/// @param side the side of the atlas, texels
/// @throws Error naming the least light_map.resolution when the charts do not fit at any density; Cancelled
LightMapLayout light_map_layout(const ReferenceGeometry& geometry, int side, const Workers& workers = {});

}  // namespace si
