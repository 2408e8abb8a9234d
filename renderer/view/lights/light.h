// Lights as the settings place them, and with the views of their shadow maps. Pure CPU, double precision, no GL.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/type_precision.hpp>
#include <memory>
#include <string>
#include <vector>

#include "renderer/projection/light_view.h"
#include "renderer/projection/view_choice.h"
#include "renderer/settings/settings.h"

namespace si {

struct SceneShape;

/// Where a level lies on the light's plane: its texels are 2^exponent m wide, and its first page, at the lower left, is
/// this page of the grid that starts at the world's origin.
struct ClipLevel {
    int exponent = 0;
    glm::i64vec2 corner{0};
    double eye_m = 0;  ///< where the views' eyes are along the axis that points to the light, from the world's origin
    double texel_m() const;
};

/// What no bias and no kernel can mend; see map_limits().
struct MapLimits {
    bool one_depth_step = false;       ///< all depth lies in one step of the map's format
    bool one_texel = false;            ///< a texel is larger than the scene
    double step_m = 0, depth_m = 0;    ///< along the light's axis: that step at its coarsest, and what the map holds
    double texel_m = 0, across_m = 0;  ///< width of a texel at the scene's centre, and of what the map holds
    bool any() const { return one_depth_step || one_texel; }
};

/// A light where the settings place it, before it has a map. Nothing of it depends on the camera.
struct PlacedLight {
    LightType type = LightType::Directional;
    glm::dvec3 position{0};        ///< world; directional: as the settings place it, before a fit centres the map
    glm::dvec3 target{0};          ///< world; what `position` is `to_light` away from
    glm::dvec3 to_light{0, 1, 0};  ///< unit; directional: towards the light; spot: against its axis
    double distance_m = 0;         ///< of the place from the target
    double half_cone_rad = 0, cos_cone_outer = -1, cos_cone_inner = -1;
    double size = 0;  ///< tangent of a directional light's angular radius (below 89 degrees), else its radius in metres
    bool six_faces = false;          ///< no single map holds all directions that it shines in
    double range_m = 0;              ///< of spot and point lights: no light from there on; 0: unlimited
    glm::dvec3 radiance{1};          ///< colour × intensity, normalised to the scene's centre (see place_lights)
    glm::dvec3 map_origin{0};        ///< world; what the shaders that draw its maps count positions from
    std::vector<std::string> notes;  ///< values clamped on the way, and (fitted) what the map cannot do
};

struct FittedLight : PlacedLight {
    bool shadowed = false;  ///< light.cast is on and something casts and receives, by whatever source
    bool casts = false;     ///< the same, and the source is a map: has views and anything to draw into them
    std::string reason;     ///< why it has no map
    std::string dark;       ///< why no surface of the scene gets anything of it; empty: some may
    std::string empty;  ///< of one that casts, under a fit that knows no camera: why its maps stay empty; else empty
    std::vector<LightView> views;   ///< all perspective or none; six faces: +x -x +y -y +z -z; cascades
    ViewChooser chooser;            ///< which of them a point is looked up in
    std::vector<ClipLevel> levels;  ///< where its views lie, if they are clip levels; else none
    /// No point that the light reaches lies in shadow beyond its map: there the shaders say lit, without a look.
    bool closed = false;
    int clipped_casters = 0;  ///< objects reaching in front of the near plane
    MapLimits limits;         ///< of lights that cast
    /// Whether its maps are drawn in perspective, all of them; false when it has none.
    bool is_perspective() const { return !views.empty() && views[0].curve.perspective; }
    /// Whether its maps are warped across their rays, all of them.
    bool is_warped() const { return !views.empty() && views[0].warped(); }
    /// Whether its views are for parts of what the camera sees: cascades or clip levels.
    bool is_cascaded() const {
        return chooser.choice == ViewChoice::Interval || chooser.choice == ViewChoice::Map ||
               chooser.choice == ViewChoice::Distance;
    }
};

/// Whether a light of this range (0: unlimited) shines so far.
constexpr bool within_range(double distance_m, double range_m) {
    return range_m <= 0 || distance_m < range_m;
}

/// The lights 0..light_count-1 of the settings, and what of the scene their maps may have to cover.
struct PlacedLights {
    std::shared_ptr<const SceneShape> shape;
    std::vector<PlacedLight> lights;
    std::vector<std::shared_ptr<const SceneShape>> shapes;  ///< of each light; on a ground each has its own
};

}  // namespace si
