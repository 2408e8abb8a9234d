#include "renderer/bias/light_receiver.h"

#include <algorithm>

#include "renderer/projection/projection.h"
#include "renderer/settings/biases.h"

namespace si {

std::string_view place_name(std::optional<MapPlace> place) {
    constexpr std::string_view kNames[] = {"inside", "before near", "sides", "beyond far", "behind", "beyond shadows"};
    static_assert(std::size(kNames) == std::size_t(MapPlace::OutsideCasterRegion) + 1);
    return place ? kNames[std::size_t(*place)] : "no map";
}

LightReceiver light_receiver(const FittedLight& light, const BiasSettings& bias, MapSize size,
                             const glm::dvec3& position_ws, const glm::dvec3& geometric_normal,
                             const glm::dvec3& bias_normal) {
    LightReceiver r;
    const glm::dvec3 away = light.position - position_ws;
    const double distance = glm::length(away);
    r.to_light = light.type == LightType::Directional || !(distance > 0) ? light.to_light : away / distance;
    r.n_dot_l = glm::dot(geometric_normal, r.to_light);
    const ChosenView chosen = light.chooser.choose(light.views, position_ws);
    r.view = chosen.view;
    r.other_view = chosen.other;
    r.blend = chosen.share;
    const LightView& view = light.views[r.view];
    const auto to_unit = [&](const glm::dvec3& ndc) { return uvd_from_ndc(view.curve.convention, ndc); };
    r.clip = view.clip_position(position_ws);
    const double w = r.clip.w;
    r.ndc = glm::dvec3(r.clip) / w;
    r.uvd = to_unit(r.ndc);
    const TexelSize texel = view.texel_size_at(position_ws, size);
    r.texel_m = texel.longest;
    r.texel_short_m = texel.shortest;
    r.curve = view.ray_depth_curve(position_ws);
    r.own_m = r.curve.distance(r.uvd.z);
    r.axis_per_ray = std::max(glm::dot(r.to_light, view.axes[2]), 1e-6);
    r.normal_offset_ws = normal_offset(bias, bias_normal, r.to_light, r.texel_m);
    r.normal_offset_m =
        bias_of_stage(BiasStage::LookUp)
            .amount(bias, {.curve = r.curve, .texel_m = r.texel_m, .n_dot_l = glm::dot(bias_normal, r.to_light)});
    const glm::dvec4 moved = view.clip_position(position_ws + r.normal_offset_ws);
    r.tap = to_unit(glm::dvec3(moved) / moved.w);
    r.tap_m = std::max(view.curve.perspective ? moved.w : 1.0, 1e-3 * view.curve.near);
    r.compared = r.tap.z;
    const bool reversed = view.curve.convention.reversed;
    const bool beyond = reversed ? r.uvd.z < 0 : r.uvd.z > 1;
    const bool sides = r.uvd.x < 0 || r.uvd.x > 1 || r.uvd.y < 0 || r.uvd.y > 1;
    const glm::dvec2 rim = 1.0 / size.texels();
    const bool shadowless =
        light.closed && (r.uvd.x < rim.x || r.uvd.x > 1 - rim.x || r.uvd.y < rim.y || r.uvd.y > 1 - rim.y);
    r.place = w <= 0                   ? MapPlace::Behind
              : shadowless             ? MapPlace::OutsideCasterRegion
              : beyond                 ? MapPlace::BeyondFar
              : sides                  ? MapPlace::Sides
              : r.own_m < r.curve.near ? MapPlace::BeforeNear
                                       : MapPlace::Inside;
    return r;
}

}  // namespace si
