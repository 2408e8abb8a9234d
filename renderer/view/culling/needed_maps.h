// Parts of a light's shadow maps that the look-ups of a picture may read. Computed from bounds of visible surfaces;
// CPU, double precision, conservative.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/projection/camera.h"
#include "renderer/scene/clusters.h"
#include "renderer/scene/scene.h"
#include "renderer/view/cascades/cascades.h"
#include "renderer/view/culling/map_cells.h"
#include "renderer/view/lights/light.h"

namespace si {

/// Reason that reports give for a light without effect: it is off or black.
inline constexpr const char* kLightAddsNothing =
    "the light adds nothing: it is off, or its colour or its intensity is 0";

/// Returns true when a light's range and cone may reach the convex hull of world-space points. Occluders are ignored.
bool may_illuminate(const FittedLight& light, std::span<const glm::dvec3> points);

/// Bounds of surfaces that the camera may see: one object, or one cluster of an object's triangles.
struct VisibleBody {
    Box box{};                     ///< world
    std::vector<glm::dvec3> seen;  ///< points around the visible part, world; empty: the whole box may be visible
    Cluster cluster;               ///< cluster of triangles, valid where `side` is known
    VisibleSide side = VisibleSide::Either;  ///< side of the triangles that faces the camera
    std::size_t object = 0;                  ///< index into Scene::objects
    /// Returns world-space points whose convex hull contains the visible part of this object or cluster.
    std::span<const glm::dvec3> points() const {
        return seen.empty() ? std::span<const glm::dvec3>(box) : std::span<const glm::dvec3>(seen);
    }
};

/// Bounds of all surfaces that one camera may see. Only parts of shadow maps that look-ups at these surfaces read are
/// needed.
struct VisibleBodies {
    CameraSlice view;  ///< view frustum with padding for rounding
    std::vector<VisibleBody> bodies;
    bool unknown = false;  ///< a body has non-finite bounds: anything may be visible
    /// Inverse world matrices by object. Set only for objects with a cluster that has a normal cone (Cluster::axis).
    std::vector<glm::dmat4> mesh_from_world;
};

/// Finds the objects, or clusters of their triangles, inside a camera's view frustum. From them needed_maps() finds the
/// parts of shadow maps to draw.
/// @param lines height of the picture in pixels
/// @param clusters function that returns the clusters (groups of near triangles) of a mesh, as build_clusters(); an
/// empty result: the mesh is one cluster
VisibleBodies find_visible_bodies(const Scene& scene, const Camera& camera, int lines,
                                  const std::function<std::span<const Cluster>(std::size_t mesh)>& clusters);

/// Extent of a picture's look-ups in a shadow map: reach of the filter kernel, normal offset, and treatment of look-ups
/// outside the map (MapWrap). From it needed_maps() finds the parts of the map to draw (cells of a grid, MapCells).
struct LookupArea {
    int resolution = 1;       ///< texels along the map's shorter side
    double reach_texels = 0;  ///< largest distance in texels between look-up and texels read, without the normal offset
    double normal_texels = 0;  ///< normal offset if it is set in texels, else 0
    double normal_m = 0;       ///< normal offset if it is set in metres, else 0
    MapWrap wrap = MapWrap::Border;
    bool whole_maps = false;  ///< every value read depends on the whole map, as with mip levels or summed-area tables
    bool reads_border_texels = false;  ///< look-ups outside the map read its border texels, even with weight 0
    bool only_lit_points = false;      ///< visibility matters only where the light arrives
};

/// Parts of one light's shadow maps that look-ups read: for each cascade or cube face, a set of grid cells (MapCells).
/// Other cells need not be drawn.
struct NeededMaps {
    std::vector<MapCells> views;  ///< needed cells by view of the light
    std::string unneeded_reason;  ///< reason why no cell is needed; empty: some cells are needed
};

/// Finds the parts of a light's shadow maps (cells of a grid, MapCells) that look-ups at visible surfaces may read.
/// Casters that cover none of the needed cells of a map need not be drawn into that map.
/// @param seen surfaces that the camera may see
/// @param area extent of a look-up around a surface's place in the map
NeededMaps needed_maps(const FittedLight& light, const VisibleBodies& seen, const LookupArea& area);

}  // namespace si
