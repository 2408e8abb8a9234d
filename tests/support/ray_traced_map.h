// Shadow maps of boxes on a ground, computed texel by texel from their matrix.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/base/float_image.h"
#include "renderer/bundle/conventions.h"
#include "renderer/projection/depth_curve.h"

namespace si::test {

/// Axis-aligned box, world space, metres.
struct TestBox {
    glm::dvec3 lo{0}, hi{0};
};

/// Returns the share of a ray segment before the first box; nothing without a hit.
std::optional<double> first_hit(const std::vector<TestBox>& boxes, const glm::dvec3& from, const glm::dvec3& to);

/// Returns boxes of unequal sizes on a ground around `centre`, without a symmetry.
std::vector<TestBox> unequal_boxes(const glm::dvec3& centre);

/// Returns the function that casts the rays of a map at boxes.
FirstCasters casters_of(std::vector<TestBox> boxes);

/// Map to compute.
struct TracedMap {
    glm::dmat4 clip_from_world{1.0};
    DepthConvention depth;
    BundleStored stored = BundleStored::Depth;
    glm::dvec3 eye{0}, forward{0};  ///< of stored kinds other than Depth
    double near = 0, far = 1;       ///< distances along the axis from the eye
    int width = 96, height = 40;
    int bits = 0;  ///< of a quantised depth; 0: floats
};

/// Computes a map by unprojecting each texel's centre with the inverse matrix. Row 0 of the result is the top.
FloatImage traced_map(const TracedMap& map, const std::vector<TestBox>& boxes);

/// Returns an image with its rows in the opposite order.
FloatImage upside_down(const FloatImage& image);

}  // namespace si::test
