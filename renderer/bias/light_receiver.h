// A surface point as a light's map sees it: shaders/lib/receiver.glsl in double. bias_breakdown() brings its bias.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string_view>

#include "renderer/settings/settings.h"
#include "renderer/view/lights/light.h"
#include "shaders/shared/facing.h"

namespace si {

/// Whether a surface faces the light. @param n_dot_l of its triangle's normal
inline bool faces_light(double n_dot_l) {
    return n_dot_l > double(shared::FACES_AWAY_COSINE);
}

/// Place of a surface point relative to a light's map.
enum class MapPlace {
    Inside,
    BeforeNear,           ///< nearer to the light than the near plane
    Sides,                ///< outside of the map's square
    BeyondFar,            ///< farther from the light than the far plane
    Behind,               ///< behind the light
    OutsideCasterRegion,  ///< outside the caster region: the light's fit has found that nothing can cast a shadow there
};

/// Returns the place as the probe prints it; "no map" for a light without one.
std::string_view place_name(std::optional<MapPlace> place);

struct LightReceiver {
    std::size_t view = 0;        ///< of the light's
    std::size_t other_view = 0;  ///< whose visibility is blended in,
    double blend = 0;            ///< by this share; everything else here is of `view`
    glm::dvec4 clip{0};
    glm::dvec3 ndc{0};
    glm::dvec3 uvd{0};        ///< map coordinates and depth in [0,1], before any bias
    glm::dvec3 to_light{0};   ///< unit
    double n_dot_l = 0;       ///< of the geometric normal
    double texel_m = 0;       ///< world size of a texel here, along its longest direction
    DepthCurve curve;         ///< depths along the light's ray through the point
    double own_m = 0;         ///< metres along the view's axis
    double axis_per_ray = 1;  ///< cosine between the ray to the light and the view's axis, at least 1e-6
    double bias_depth = 0;    ///< of bias.kind, depth-buffer units, >= 0 brings the compared depth nearer to the light
    double bias_m = 0;        ///< the same in metres along the axis
    double normal_offset_m = 0;
    glm::dvec3 tap{0};    ///< uvd after the normal offset, before the depth bias
    double tap_m = 1;     ///< metres along the view's axis there, above 0 from a perspective light
    double compared = 0;  ///< the depth that is compared at `tap`
    MapPlace place = MapPlace::Inside;
    bool in_map() const { return place == MapPlace::Inside || place == MapPlace::BeforeNear; }
};

/// Without the bias of bias.kind, which is bias_breakdown()'s to bring.
/// @param bias_normal unit, the one that bias.normal_source chooses
/// @param resolution of the map
LightReceiver light_receiver(const FittedLight& light, const BiasSettings& bias, int resolution,
                             const glm::dvec3& position_ws, const glm::dvec3& geometric_normal,
                             const glm::dvec3& bias_normal);

}  // namespace si
