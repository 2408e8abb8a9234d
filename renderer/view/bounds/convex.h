// Convex bodies cut by planes, for what lies in a light's or a camera's view. Pure CPU, double precision.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/view/bounds/half_space.h"

namespace si {

using Polygon = std::vector<glm::dvec3>;

/// Leaves of a convex polygon what lies on the positive side. Sutherland, Hodgman, Reentrant Polygon Clipping, CACM
/// 17(1), 1974.
void clip(Polygon& polygon, const HalfSpace& plane);

/// Around points in a plane, counter-clockwise. Andrew, Another efficient algorithm for convex hulls in two dimensions,
/// IPL 9(5), 1979.
std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points);

/// Of a polygon that goes round counter-clockwise.
double polygon_area(std::span<const glm::dvec2> polygon);

/// The planes of a body with eight corners (ordered as Box), facing inwards; those of sides without area are left out.
std::vector<HalfSpace> box_half_spaces(const Box& body);

/// Where a body lies of planes: all of it beyond one of them, or all of it within all of them.
enum class Lies { Beyond, Across, Within };
Lies lies(const Box& body, std::span<const HalfSpace> planes);

/// Points whose hull is what lies of a body within all of the planes, where these are sides that never end (of a
/// prism): no corner of theirs may lie within the body.
std::vector<glm::dvec3> points_inside_planes(const Box& body, std::span<const HalfSpace> planes);

struct ConvexBody {
    Box corners;
    std::span<const HalfSpace> sides;
};

/// Points whose hull is what a box and a few bodies have in common; none when that is nothing. All may be flat; of flat
/// ones in one plane nothing is found but what their sides cut of each other.
std::vector<glm::dvec3> intersection_points(const Box& box, std::span<const ConvexBody> bodies);

}  // namespace si
