// Geometry of map texels shown as quads in the scene. CPU only, double precision, no OpenGL.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/frame/frame.h"

namespace si {

/// Rectangle of shadow map texels: first texel and size, x to the right, y up.
struct TexelRegion {
    glm::ivec2 first{0}, size{0};
    bool operator==(const TexelRegion&) const = default;
};

/// Returns the square region of a shadow map whose texels are shown as quads in the scene (view.slabs):
/// view.slabs_texels wide, around view.slabs_u and view.slabs_v, clipped to the map.
/// @param size texels of the map
TexelRegion slab_region(const ViewSettings& view, MapSize size);

/// Quad in the scene that shows one shadow map texel. The quad lies at the stored depth, or where the biased depth of a
/// fragment equals the stored depth (compared_distance()).
struct TexelSlab {
    glm::ivec2 texel{0};
    bool biased = false;
    std::array<glm::dvec3, 4> corners;  ///< world; (u, v) = (0,0), (1,0), (0,1), (1,1) of the texel
};

/// Returns the distance along the light's axis, metres, at which a fragment's depth, after the shift by bias.constant,
/// equals the depth stored in a shadow map texel. Used for the quads that show texels in the scene (view.slabs). A
/// fragment at this distance has the stored depth once the bias has shifted it towards the light. With z0 the stored
/// distance and c the constant, the distance is, by the bias's unit:
///   depth:  distance(stored + c), under reversed depth distance(stored - c)
///   metres: z0 + c
///   texels: z0 + c t, with t the size of a texel at z0; in perspective z0 / (1 - c t / z0), as texels grow with z
/// @param stored depth that the texel holds
/// @param uv map coordinates of the texel; matter for warped views only
/// @return nullopt when no fragment compares equal
std::optional<double> compared_distance(const LightView& view, const BiasSettings& bias, MapSize size, double stored,
                                        const glm::dvec2& uv);

/// Returns quads in the scene that show the texels of a rectangle of a shadow map (view.slabs). A quad lies at the
/// stored depth, or where the biased depth of a fragment equals the stored depth (compared_distance()). Texels that
/// hold the far plane have no quad.
/// @param size texels of the map
/// @param region the rectangle of texels
/// @param depths one channel, the region's stored depths, bottom row first
/// @param which the depths to show: stored, with bias, or both
std::vector<TexelSlab> texel_slabs(const LightView& view, const BiasSettings& bias, MapSize size,
                                   const TexelRegion& region, const std::vector<float>& depths, Slabs which);

}  // namespace si
