// The view and projection of one shadow map.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "renderer/projection/depth_curve.h"
#include "renderer/projection/map_size.h"

namespace si {

/// Longest and shortest side of a shadow map texel in metres, measured in a plane perpendicular to the light's axis.
/// For a skewed texel they are the singular values of the mapping from texels to metres. Both lengths are equal in a
/// square map of an unwarped view whose width equals its height.
struct TexelSize {
    double longest = 0, shortest = 0;
};

/// Rectangle that a light view covers across its axis. Metres for parallel rays; in perspective, tangents of the angles
/// to the axis (metres at a distance of one metre).
struct CrossSection {
    glm::dvec2 lo{0}, hi{0};
};

/// Distance by which casters move along a light view's axis, away from the light, before they are drawn. Some engines
/// bias shadows this way, in the vertex shader of casters.
struct CasterShift {
    double all_m = 0;      ///< metres at any angle
    double grazing_m = 0;  ///< metres times 1 - |n . axis|, where n is the vertex normal
    bool moves() const { return all_m != 0 || grazing_m != 0; }
    /// Returns the shift of a vertex in metres. @param cosine of the angle between the vertex normal and the axis
    double metres(double cosine) const { return all_m + grazing_m * (1 - std::min(std::abs(cosine), 1.0)); }
    bool operator==(const CasterShift&) const = default;
};

/// View and projection of one shadow map: a directional or spot map, a cube face, a cascade, or a clip level (virtual
/// map). The matrix decides what the map covers. set_half_extents() makes a projection centred on the axis;
/// view_of_matrix() accepts any.
struct LightView {
    glm::dvec3 eye{0};     ///< world
    glm::dmat3 axes{1.0};  ///< columns right, up, back (the view looks along -back)
    /// Matrix from view space to the clip space of curve.convention. In perspective w is the distance along the axis;
    /// for parallel rays w is 1 at the eye.
    glm::dmat4 projection{1.0};
    DepthCurve curve;          ///< depth range
    bool clamps_near = false;  ///< casters before the near plane are drawn on it (pancaking)
    CasterShift caster_shift;  ///< of an engine's maps
    /// Sets the light view's projection to one that is centred on the axis, with the depth range of `curve`.
    /// @param half half of the width and height: metres for parallel rays; in perspective, tangents of half the angles
    /// of view
    void set_half_extents(const glm::dvec2& half);
    /// Updates the light view's projection matrix after a change of the depth range (`curve`). The projection must be
    /// centred on the axis; its width and height stay.
    void update_depth();
    /// Returns the light view's view-projection matrix for positions relative to `origin`, composed in double
    /// precision.
    /// @param origin world
    glm::dmat4 clip_from_relative(const glm::dvec3& origin) const;
    /// Returns a world-space position in the light view's clip space. Equals the last column of
    /// clip_from_relative(point_ws).
    glm::dvec4 clip_position(const glm::dvec3& point_ws) const;
    /// Returns true for a view with parallel rays whose texels are not squares of one size, or whose depth range
    /// differs from row to row: a clip-space w that changes across the rays (light.fit lispsm), shear, or unequal width
    /// and height.
    bool warped() const { return curve.warp.has_value(); }
    /// Returns true for an unwarped light view whose shadow map texels are wider than high, or higher than wide.
    /// @param size texels of the map
    bool stretched(MapSize size) const;
    /// Returns the bounding rectangle of the shadow map across the light view's axis. Metres for parallel rays; in
    /// perspective, tangents of the angles to the axis (CrossSection).
    CrossSection cross_section() const;
    /// Returns half of the width and height of what a light view covers. For views not centred on the axis: the largest
    /// distance of the map's sides from the axis, horizontally and vertically. Metres for parallel rays; in
    /// perspective, tangents of the angles to the axis.
    glm::dvec2 half_extents() const;
    /// Returns the larger one of half the width and half the height of what a light view covers, see half_extents().
    /// Metres for parallel rays; in perspective, the tangent of an angle to the axis.
    double half_extent() const;
    /// Returns the world-space position at shadow map coordinates `uv` and distance z along the light's axis.
    /// @param uv map coordinates in [0,1]
    /// @param z metres
    glm::dvec3 position_ws(const glm::dvec2& uv, double z) const;
    /// Returns the longest side of a shadow map's texel in metres at distance z along the axis. Not valid for a warped
    /// view.
    /// @param size texels of the map
    double texel_size(double z, MapSize size) const { return texel_sizes(z, size).longest; }
    /// Returns the size in world space of the shadow map texel that contains a point, measured in a plane
    /// perpendicular to the light's axis.
    /// @param size texels of the map
    TexelSize texel_size_at(const glm::dvec3& point_ws, MapSize size) const;
    /// Returns the longest side of the largest texels of the shadow map and the shortest side of the smallest. In
    /// perspective, where texels grow with distance, only those within the depth range count.
    /// @param size texels of the map
    TexelSize texel_size_range(MapSize size) const;
    /// Returns the depth curve (mapping from distance to depth-buffer value) along the light's ray through a
    /// world-space point. It differs from `curve` in warped maps only.
    DepthCurve ray_depth_curve(const glm::dvec3& point_ws) const;
    /// Returns the relative change of clip-space w per metre across the light direction (LiSPSM) at a point; 0 for
    /// unwarped views. Used to bound the rounding errors of compared depths.
    double relative_dw_per_m(const glm::dvec3& point_ws) const;

private:
    /// Returns the longest and shortest side of a shadow map's texels at distance z along the axis, for an unwarped
    /// light view.
    /// @param z metres
    /// @param size texels of the map
    TexelSize texel_sizes(double z, MapSize size) const;
};

}  // namespace si
