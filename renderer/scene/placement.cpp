#include "renderer/scene/placement.h"

#include <algorithm>
#include <cmath>

#include "renderer/base/finite.h"
#include "renderer/base/index_of.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

bool is_length(const Settings& settings, const SettingRef& ref) {
    if (ref.param->key.starts_with("scene.")) return false;
    const std::string_view unit = shown_unit(settings, ref);
    return unit == "m" || unit == "metres";
}

}  // namespace

glm::dvec3 placement_direction(PlacedAlong along) {
    if (along == PlacedAlong::Aslant) return glm::normalize(glm::dvec3(2, 1, 5));
    return glm::dmat3(1)[index_of(along) - index_of(PlacedAlong::X)];
}

glm::dmat4 placement_of(const SceneSettings& settings) {
    const double scale = std::clamp(finite_or(settings.scale, 1), 1e-3, 1e6);
    const double distance = std::clamp(finite_or(settings.distance, 0), 0.0, 1e7);
    glm::dmat4 out(scale);
    out[3] = glm::dvec4(distance * placement_direction(settings.direction), 1);
    return out;
}

void carry_settings(Settings& settings, const SceneSettings& from, const SceneSettings& to) {
    if (same_placement(from, to)) return;
    const glm::dmat4 old = placement_of(from), now = placement_of(to);
    const double by = now[0][0] / old[0][0];
    CameraSettings& camera = settings.camera;
    const glm::dvec3 target = (glm::dvec3(camera.target_x, camera.target_y, camera.target_z) - glm::dvec3(old[3])) * by;
    const Settings before = settings;
    for (const SettingRef& ref : all_settings(before)) {
        if (!is_length(before, ref)) continue;
        const Value value = get_value(before, ref);
        if (const double* metres = std::get_if<double>(&value))
            set_value(settings, ref, std::clamp(*metres * by, ref.param->min, ref.param->max));
    }
    camera.target_x = target.x + now[3].x;
    camera.target_y = target.y + now[3].y;
    camera.target_z = target.z + now[3].z;
}

glm::dvec3 shader_origin(const Settings& settings, const glm::dvec3& nearby) {
    return settings.map.origin == MapOrigin::World ? glm::dvec3(0) : nearby;
}

bool same_placement(const SceneSettings& a, const SceneSettings& b) {
    return placement_of(a) == placement_of(b);
}

}  // namespace si
