#include "renderer/scene/scene_lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/base/directions.h"
#include "renderer/base/printable.h"
#include "renderer/settings/settings.h"

namespace si {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kMaxDistance = 1e7;  // of light.distance
constexpr double kMaxPlace = 1e8;     // of light.target_* and light.range
// With the last character, which may be an escape, and "…" below light.name's 60.
constexpr std::size_t kNameBytes = 44;

/// Where a light stands, in the terms of light.*: centre + target + distance * direction.
struct Stand {
    glm::dvec3 direction{0, 1, 0}, target{0};
    double distance = 0;
};

double azimuth(const glm::dvec3& d) {
    return std::atan2(d.x, d.z) * kDegrees;
}
double elevation(const glm::dvec3& d) {
    return std::atan2(d.y, std::hypot(d.x, d.z)) * kDegrees;
}

Stand stand_of(const SceneLight& light, const Scene& scene) {
    const Bounds bounds = light_fit_bounds(scene);  // whose centre light.target_* count from
    const glm::dvec3 centre = bounds.centre(), position(light.world[3]);
    const double radius = bounds.radius() > 0 ? bounds.radius() : 1;
    const double away = glm::distance(position, centre);
    Stand s;
    if (light.type == LightType::Point) {
        // Seen from the centre, so that the target is the centre; a light in the middle of it all hangs above a target.
        if (away > 1e-3 * radius) s.direction = (position - centre) / away;
    } else {
        s.direction = glm::normalize(glm::dvec3(light.world[2]));
    }
    if (light.type == LightType::Directional) return s;
    s.distance = std::clamp(away, 1e-3 * radius, kMaxDistance);
    // With the direction that the written angles give: the target takes up their rounding.
    s.target = position - centre - s.distance * direction_from_angles(azimuth(s.direction), elevation(s.direction));
    return s;
}

/// Brightness and colour in the ranges of the settings.
struct Brightness {
    double intensity = 1;
    glm::dvec3 colour{1};
};

Brightness brightness_of(const SceneLight& light) {
    const double strongest = std::max({light.colour.x, light.colour.y, light.colour.z});
    if (!(strongest > 1)) return {light.intensity, light.colour};
    return {light.intensity * strongest, light.colour / strongest};
}

}  // namespace

void suggest_lights(Scene& scene) {
    if (scene.lights.empty()) return;
    // The fit does not follow from the lights: the loader suggests it for scenes with far objects.
    std::erase_if(scene.suggested,
                  [](const auto& row) { return row.first.starts_with("light.") && !row.first.ends_with(".fit"); });
    const std::size_t count = std::min<std::size_t>(scene.lights.size(), kMaxLights);
    double strongest[2] = {0, 0};  // of the directional lights, of the others
    for (std::size_t i = 0; i < count; ++i) {
        double& most = strongest[scene.lights[i].type != LightType::Directional];
        most = std::max(most, brightness_of(scene.lights[i]).intensity);
    }
    const auto suggest = [&](std::string key, std::string value) {
        scene.suggested.emplace_back(std::move(key), std::move(value));
    };
    suggest("light.count", std::to_string(count));
    for (std::size_t i = 0; i < count; ++i) {
        const SceneLight& light = scene.lights[i];
        const auto number = [&](std::string_view name, double value) {
            value = std::isfinite(value) ? std::clamp(value, -kMaxPlace, kMaxPlace) : 0;
            suggest(fmt::format("light.{}.{}", i, name), fmt::format("{}", value));  // the shortest text of this double
        };
        // However long it is and whatever is in it, as a name that light.name takes.
        if (!light.name.empty()) suggest(fmt::format("light.{}.name", i), printable(light.name, kNameBytes));
        suggest(fmt::format("light.{}.type", i), std::string(kLightTypeKeys[std::size_t(light.type)]));
        const Stand stand = stand_of(light, scene);
        number("azimuth", azimuth(stand.direction));
        number("elevation", elevation(stand.direction));
        if (light.type != LightType::Directional) {
            number("distance", stand.distance);
            number("target_x", stand.target.x);
            number("target_y", stand.target.y);
            number("target_z", stand.target.z);
            number("range", light.range < kMaxPlace ? light.range : 0);  // beyond all places: unlimited
        }
        if (light.type == LightType::Spot) {
            number("cone", std::max(0.2, 2 * light.outer_cone_rad * kDegrees));
            number("cone_blend", std::clamp(1 - light.inner_cone_rad / light.outer_cone_rad, 0.0, 1.0));
        }
        const Brightness b = brightness_of(light);
        const double most = strongest[light.type != LightType::Directional];
        number("intensity", most > 0 ? b.intensity / most : 0);
        number("red", b.colour.x);
        number("green", b.colour.y);
        number("blue", b.colour.z);
    }
}

}  // namespace si
