// Lights as placed by the settings, and lights with the views of their shadow maps. CPU, double precision, no GL.
#pragma once

#include <algorithm>
#include <cmath>
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

/// Grid position of a clip level (one of the concentric shadow maps of a directional light) on the plane across the
/// light. Texels are 2^exponent m wide; `corner` is the level's first page, counted from the world's origin.
struct ClipLevel {
    int exponent = 0;
    glm::i64vec2 corner{0};  ///< page at the lower left
    double eye_m = 0;        ///< position of the eye along the axis to the light, metres from the world's origin
    /// Returns the width of a texel of the clip level in metres.
    double texel_m() const { return std::exp2(double(exponent)); }
};

/// Result of testing whether a shadow map is too coarse for the scene, which no bias or kernel can overcome; from
/// map_limits().
struct MapLimits {
    bool one_depth_step = false;  ///< all depths fall into one step of the map format
    bool one_texel = false;       ///< a texel is larger than the scene
    double step_m = 0;            ///< coarsest step of the format along the light's axis, metres
    double depth_m = 0;           ///< depth range of the scene in the map, metres
    double texel_m = 0;           ///< width of a texel at the scene's centre, metres
    double across_m = 0;          ///< width of the scene in the map, metres
    /// Returns true when at least one limit of the shadow map applies: too coarse a depth format or resolution.
    bool any() const { return one_depth_step || one_texel; }
};

/// Light as the settings place it in the scene, before its shadow maps are fitted. Independent of the camera.
struct PlacedLight {
    LightType type = LightType::Directional;
    glm::dvec3 position{0};        ///< world; for a directional light, its place before a fit centres the map
    glm::dvec3 target{0};          ///< world; `position` is `target` + `distance_m` times `to_light`
    glm::dvec3 to_light{0, 1, 0};  ///< unit vector; directional: towards the light; spot: against its axis
    double distance_m = 0;         ///< distance between position and target
    double half_cone_rad = 0;      ///< half the angle of a spot light's cone
    double cos_cone_outer = -1;    ///< cosine of the angle from the axis at which a spot light ends
    double cos_cone_inner = -1;    ///< cosine of the angle from the axis at which a spot light begins to fall off
    double size = 0;           ///< tangent of the angular radius (directional, up to 89 degrees), else radius in metres
    bool six_faces = false;    ///< needs six cube faces, since one map cannot hold all its directions
    double range_m = 0;        ///< distance at which a spot or point light ends; 0: unlimited
    glm::dvec3 radiance{1};    ///< colour x intensity, normalised by place_lights()
    glm::dvec3 map_origin{0};  ///< world; origin of positions in the shaders that draw its maps
    std::vector<std::string> notes;  ///< messages about clamped values and limits of the map
};

/// Origin of a light's shadow maps: drawn from the scene's casters, or imported as images.
enum class MapProvider { Drawn, Imported };

/// Light placed in the scene, together with the views of its shadow maps.
struct FittedLight : PlacedLight {
    bool shadowed = false;                      ///< light.cast is on, and the scene has casters and receivers
    bool casts = false;                         ///< has shadow maps: shadowed, and the source is a shadow map
    MapProvider provider = MapProvider::Drawn;  ///< origin of its maps
    std::string reason;                         ///< reason why the light has no map; empty: it has one
    std::string dark;                           ///< reason why the light lights no surface; empty: it may light some
    std::string empty;  ///< reason why the light's maps contain no caster, if the fit ignores the camera; else empty
    std::vector<LightView> views;   ///< all perspective or none; faces in the order +x -x +y -y +z -z; or cascades
    ViewChooser chooser;            ///< rule that chooses the view in which a point is looked up
    std::vector<ClipLevel> levels;  ///< grid positions of clip levels; else empty
    /// Guarantee of the fit: no surface that the light reaches lies in shadow outside the map. Shaders treat points
    /// outside the map as lit.
    bool closed = false;
    int clipped_casters = 0;  ///< casters with a part in front of the near plane
    MapLimits limits;         ///< limits of the maps of a casting light
    /// Returns true when the light's shadow maps are perspective; false for a light without maps.
    bool is_perspective() const { return !views.empty() && views[0].curve.perspective; }
    /// Returns true when a shadow map of the light is warped (LightView::warped).
    bool is_warped() const {
        return std::ranges::any_of(views, [](const LightView& v) { return v.warped(); });
    }
    /// Returns true when texels of an unwarped shadow map of the light are wider than high, or higher than wide.
    bool is_stretched(MapSize texels) const {
        return std::ranges::any_of(views, [&](const LightView& v) { return v.stretched(texels); });
    }
    /// Returns true when shaders derive the sizes of texels from the shadow map's matrix: for parallel rays where
    /// texels are not squares of one size.
    /// @param texels size of the light's maps
    bool derives_texels(MapSize texels) const { return is_warped() || (!is_perspective() && is_stretched(texels)); }
    /// Returns true when each view of the light covers a part of the camera's frustum: cascades or clip levels.
    bool is_cascaded() const {
        return chooser.choice == ViewChoice::Interval || chooser.choice == ViewChoice::Map ||
               chooser.choice == ViewChoice::Distance;
    }
};

/// Returns true when a distance lies within the range of a light.
/// @param distance_m,range_m metres; a range of 0 is unlimited
constexpr bool within_range(double distance_m, double range_m) {
    return range_m <= 0 || distance_m < range_m;
}

/// Lights of the settings, from 0 to light_count - 1, placed in a scene. Each light comes with the boxes of objects
/// (SceneShape) that its shadow maps have to cover.
struct PlacedLights {
    std::shared_ptr<const SceneShape> shape;  ///< shape of the whole scene
    std::vector<PlacedLight> lights;
    std::vector<std::shared_ptr<const SceneShape>> shapes;  ///< shape by light; with a ground each light has its own
};

}  // namespace si
