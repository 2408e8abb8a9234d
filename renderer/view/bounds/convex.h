// Convex polygons and bodies clipped by planes: the geometry of culling and fitting. CPU, double precision.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/view/bounds/half_space.h"

namespace si {

/// Corners of a convex polygon in space, metres, in order around it.
using Polygon = std::vector<glm::dvec3>;

/// Clips a convex polygon by a plane in place: keeps the part on the plane's positive side. The polygon is empty
/// afterwards if no part of it lies there.
/// Sutherland, Hodgman, Reentrant Polygon Clipping, CACM 17(1), 1974.
void clip_polygon(Polygon& polygon, const HalfSpace& plane);

/// Returns the corners of the convex hull of points in a plane, counter-clockwise.
/// Andrew, Another efficient algorithm for convex hulls in two dimensions, IPL 9(5), 1979.
std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points);

/// Returns the area of a simple (not self-intersecting) polygon in a plane, in the square of the coordinates' unit. A
/// clockwise polygon has a negative area.
double polygon_area(std::span<const glm::dvec2> polygon);

/// Returns the planes of the sides of a box (any convex body with eight corners), facing inwards. Sides without area
/// are left out, so a flat body has fewer than six planes.
/// @param body corners in the order of Box
std::vector<HalfSpace> box_half_spaces(const Box& body);

/// Position of a box relative to half-spaces: outside one of them, inside all of them, or neither is certain.
enum class BoxPlacement { Outside, Crossing, Inside };
/// Returns whether a box lies outside one of the half-spaces, inside all of them, or possibly crosses one of their
/// planes. Tests corners only, so a box reported as Crossing may still be outside.
/// @param planes the half-spaces, such as the sides of a frustum
BoxPlacement classify_box(const Box& body, std::span<const HalfSpace> planes);

/// Returns points whose convex hull is the part of a box inside all of the half-spaces; none if no part is inside.
/// Precondition: the half-spaces bound an infinite prism, so that none of their common corners lies inside the box.
/// @param planes the half-spaces, such as the sides of a light's view
std::vector<glm::dvec3> points_inside_planes(const Box& body, std::span<const HalfSpace> planes);

/// Convex body with eight corners, together with the planes of its sides.
struct ConvexBody {
    Box corners;                       ///< in the order of Box
    std::span<const HalfSpace> sides;  ///< planes facing inwards, see box_half_spaces()
};

/// Returns points whose convex hull is the intersection of a box with several convex bodies; none if the intersection
/// is empty. Used to clip boxes to frusta. For a flat box, the points are the corners of its sides after clipping by
/// the bodies.
std::vector<glm::dvec3> intersection_points(const Box& box, std::span<const ConvexBody> bodies);

}  // namespace si
