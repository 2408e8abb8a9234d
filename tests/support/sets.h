// Settings for tests: changes as the option --set writes them, and cameras.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

#include "renderer/settings/param.h"
#include "renderer/settings/starting_values.h"

namespace si {

/// Change of one setting: a key with a value.
struct Assignment : std::pair<std::string, std::string> {
    using pair::pair;
    /// Splits "KEY=VALUE" at the last '=', as apply_set() does.
    Assignment(const std::string& text) : pair(text.substr(0, text.rfind('=')), text.substr(text.rfind('=') + 1)) {}
    /// Splits "KEY=VALUE".
    Assignment(const char* text) : Assignment(std::string(text)) {}
};

/// Changes of settings: {"light.type=spot", {"light.distance", distance}}.
using Sets = std::vector<Assignment>;

/// Applies changes to settings, in order. @throws Error for an unknown key or value
inline void set_all(Settings& settings, const Sets& sets) {
    for (const auto& [key, value] : sets) set_setting(settings, key, value);
}

/// Returns settings with changes. @throws Error for an unknown key or value
inline Settings settings_with(Settings settings, const Sets& sets) {
    set_all(settings, sets);
    return settings;
}

/// Returns settings under the slope bias with its starting values: 0.1 texels, and 3 texels of normal offset.
inline Settings slope_settings(Settings settings = {}) {
    const Settings before = settings;
    set_setting(settings, "bias.kind", "slope");
    set_starting_values(before, settings);
    return settings;
}

/// Sets the target of a camera or a light to a point. @tparam T CameraSettings or LightSettings
template <class T>
void set_target(T& settings, const glm::dvec3& target) {
    settings.target_x = target.x;
    settings.target_y = target.y;
    settings.target_z = target.z;
}

/// Returns the settings of a manual camera that orbits a target, angles in degrees.
inline CameraSettings orbiting_camera(const glm::dvec3& target, double azimuth, double elevation, double distance) {
    CameraSettings camera;
    camera.source = CameraSource::Manual;
    camera.azimuth = azimuth;
    camera.elevation = elevation;
    camera.distance = distance;
    set_target(camera, target);
    return camera;
}

}  // namespace si
