// What of a light's maps a picture's look-ups may read: where bounds of what its camera sees lie in them. Pure CPU,
// double precision, on the safe side.
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

/// Why a black light counts for nothing.
inline constexpr const char* kLightAddsNothing =
    "the light brings nothing: it is off, or its colour or its intensity is 0";

/// Whether some of the light may arrive among points, whatever stands between.
bool may_illuminate(const FittedLight& light, std::span<const glm::dvec3> points);

/// A body that holds surfaces that the camera sees.
struct VisibleBody {
    Box box{};
    std::vector<glm::dvec3> seen;            ///< points around the part of it that is seen; none: all of it may be
    Cluster cluster;                         ///< that it is, where `side` is known
    VisibleSide side = VisibleSide::Either;  ///< of its triangles that the camera sees
    std::size_t object = 0;                  ///< in Scene::objects;
    std::span<const glm::dvec3> points() const {
        return seen.empty() ? std::span<const glm::dvec3>(box) : std::span<const glm::dvec3>(seen);
    }
};

/// All that a camera may see.
struct VisibleBodies {
    CameraSlice view;  ///< a little wider than the picture
    std::vector<VisibleBody> bodies;
    bool unknown = false;                     ///< a body has no place: anything may be seen
    std::vector<glm::dmat4> mesh_from_world;  ///< by object; of those whose clusters show a side
};

/// @param clusters of a mesh: as build_clusters() finds them; none: it is one
/// @param lines pixels of the picture's height
VisibleBodies find_visible_bodies(const Scene& scene, const Camera& camera, int lines,
                                  const std::function<std::span<const Cluster>(std::size_t mesh)>& clusters);

/// How a picture's look-ups read.
struct LookupArea {
    int resolution = 1;
    double reach_texels = 0;   ///< of texels that are read, with all that moves the look-up but the normal offset
    double normal_texels = 0;  ///< bias.normal
    MapWrap wrap = MapWrap::Border;
    bool whole_maps = false;           ///< what is read depends on the whole of each map that is read
    bool reads_border_texels = false;  ///< beyond a map's sides its last texels are read, if only to count for nothing
    bool only_lit_points = false;      ///< visibility counts only where light arrives
};

struct NeededMaps {
    std::vector<MapCells> views;  ///< of each of the light's
    std::string uncalled;         ///< why all of them are empty; empty: they are not
};

/// What of the maps of a light that casts is read. A caster may be left out of a view if it covers nothing of its
/// region.
NeededMaps needed_maps(const FittedLight& light, const VisibleBodies& seen, const LookupArea& area);

}  // namespace si
