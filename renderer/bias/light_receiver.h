// A surface point projected into a light's shadow map: shaders/lib/receiver.glsl in double precision. The depth bias
// itself comes from bias_breakdown().
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string_view>

#include "renderer/settings/settings.h"
#include "renderer/view/lights/light.h"
#include "shaders/shared/facing.h"

namespace si {

/// Returns true when a surface faces the light. @param n_dot_l cosine between the triangle's normal and the light
inline bool faces_light(double n_dot_l) {
    return n_dot_l > double(shared::FACES_AWAY_COSINE);
}

/// Position of a surface point relative to the volume that a light's shadow map covers.
enum class MapPlace {
    Inside,
    BeforeNear,           ///< nearer to the light than the near plane
    Sides,                ///< outside of the map's square
    BeyondFar,            ///< farther from the light than the far plane
    Behind,               ///< behind the light
    OutsideCasterRegion,  ///< outside the caster region: the light's fit has found that nothing can cast a shadow there
};

/// Returns the name of a surface point's place relative to a light's shadow map, as the command `probe` prints it:
/// "inside", "beyond far". Returns "no map" for nullopt, which stands for a light without a map.
std::string_view place_name(std::optional<MapPlace> place);

/// Surface point projected into a light's shadow map, with its texel size, depth curve, bias and compared depth.
struct LightReceiver {
    std::size_t view = 0;        ///< index among the light's views (cascade or face)
    std::size_t other_view = 0;  ///< view whose visibility is blended in by `blend`
    double blend = 0;            ///< weight of `other_view`; all other members belong to `view`
    glm::dvec4 clip{0};
    glm::dvec3 ndc{0};
    glm::dvec3 uvd{0};               ///< map coordinates and depth in [0,1], before any bias
    glm::dvec3 to_light{0};          ///< unit vector towards the light, world space
    double n_dot_l = 0;              ///< cosine between the geometric normal and the light
    double texel_m = 0;              ///< size of a texel at the point in metres, along its longest direction
    double texel_short_m = 0;        ///< size of the same texel along its shortest direction, metres
    DepthCurve curve;                ///< depths along the light's ray through the point
    double own_m = 0;                ///< metres from the light along the view's axis
    double axis_per_ray = 1;         ///< cosine between the ray to the light and the view's axis, at least 1e-6
    double bias_depth = 0;           ///< bias by bias.kind, depth-buffer units; above 0 shifts towards the light
    double bias_m = 0;               ///< `bias_depth` in metres along the view's axis
    glm::dvec3 normal_offset_ws{0};  ///< shift of the look-up's point by the normal offset, metres
    double normal_offset_m = 0;      ///< length of `normal_offset_ws`
    glm::dvec3 tap{0};               ///< map coordinates and depth after the normal offset, before the depth bias
    double tap_m = 1;     ///< perspective light: metres from the light along the view's axis at `tap`, above 0
    double compared = 0;  ///< depth that is compared with the map at `tap`
    MapPlace place = MapPlace::Inside;
    /// Returns true if the shadow map covers the projected surface point, or the point lies before the near plane.
    bool in_map() const { return place == MapPlace::Inside || place == MapPlace::BeforeNear; }
};

/// Projects a surface point into a light's shadow map, and applies the normal offset of `bias` to the look-up. Leaves
/// `bias_depth` and `bias_m` at 0: bias_breakdown() computes the depth bias of bias.kind.
/// @param geometric_normal unit normal of the triangle, world space
/// @param bias_normal unit normal that bias.normal_source selects, world space
/// @param size texels of the light's maps
LightReceiver light_receiver(const FittedLight& light, const BiasSettings& bias, MapSize size,
                             const glm::dvec3& position_ws, const glm::dvec3& geometric_normal,
                             const glm::dvec3& bias_normal);

}  // namespace si
