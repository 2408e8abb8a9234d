// Lights (KHR_lights_punctual) and cameras of a glTF file.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "renderer/base/printable.h"
#include "renderer/gltf/extras.h"
#include "renderer/gltf/nodes.h"
#include "renderer/settings/settings.h"

namespace si::gltf {
namespace {

/// Returns `object[key]` when it is a number in [least, most], `otherwise` when it is absent, else nothing.
std::optional<double> number(const Json& object, const char* key, double least, double most, double otherwise) {
    const Json* const value = member(&object, key);
    if (!value) return otherwise;
    return is_number_within(*value, least, most) ? std::optional(value->get<double>()) : std::nullopt;
}

std::string name_of(const Json& object) {
    return printable(text_member(object, "name"));
}

/// Returns the light definition that a node refers to; null without one, and with a warning for an invalid reference.
const Json* referenced_light(Context& context, const Json& root, const Json& node, const Place& place) {
    const Json* reference = extension_of(node, "KHR_lights_punctual");
    if (!reference) return nullptr;
    const Json* all = member(extension_of(root, "KHR_lights_punctual"), "lights");
    const auto index = index_member(*reference, "light", all && all->is_array() ? all->size() : 0);
    if (index && (*all)[*index].is_object()) return &(*all)[*index];
    context.warn(Place(place, "KHR_lights_punctual"), "refers to no light; ignored");
    return nullptr;
}

bool read_type(const Json& json, SceneLight& light) {
    const auto found = std::ranges::find(kLightTypeKeys, text_member(json, "type"));
    if (found == std::end(kLightTypeKeys)) return false;
    light.type = LightType(found - kLightTypeKeys);
    return true;
}

bool read_colour(const Json& json, SceneLight& light) {
    const Json* colour = member(&json, "color");
    if (!colour) return true;
    if (!colour->is_array() || colour->size() != 3) return false;
    glm::dvec3 out;
    for (int i = 0; i < 3; ++i) {
        const Json& value = (*colour)[std::size_t(i)];
        if (!is_number_within(value, 0, 1e9)) return false;
        out[i] = value.get<double>();
    }
    light.colour = out;
    return true;
}

bool read_cone(const Json& json, SceneLight& light) {
    constexpr double kHalfPi = std::numbers::pi / 2, kDefaultOuter = std::numbers::pi / 4;
    const Json* spot = member(&json, "spot");
    light.outer_cone_rad = kDefaultOuter;
    if (!spot) return true;
    const auto inner = number(*spot, "innerConeAngle", 0, kHalfPi, 0);
    const auto outer = number(*spot, "outerConeAngle", 1e-6, kHalfPi + 1e-6, kDefaultOuter);
    if (!spot->is_object() || !inner || !outer || *inner > *outer) return false;
    light.inner_cone_rad = *inner;
    light.outer_cone_rad = std::min(*outer, kHalfPi);
    return true;
}

}  // namespace

void place_light(Context& context, const Json& root, const Json& node, const Place& node_place, const glm::dmat4& world,
                 Scene& scene) {
    const Json* json = referenced_light(context, root, node, node_place);
    if (!json) return;
    const Place place(node_place, "KHR_lights_punctual");
    SceneLight light;
    light.name = name_of(*json);
    if (light.name.empty()) light.name = name_of(node);
    light.world = world;
    if (!read_type(*json, light)) {
        context.warn(place, "the light is neither directional, spot nor point; ignored");
        return;
    }
    const auto intensity = number(*json, "intensity", 0, 1e12, 1);
    if (!intensity) context.warn(place, "the light's intensity is invalid; 1 is used");
    light.intensity = intensity.value_or(1);
    const auto range = number(*json, "range", 1e-30, 1e30, 0);
    if (!range) context.warn(place, "the light's range is invalid; it is unlimited");
    light.range = range.value_or(0);
    if (!read_colour(*json, light)) context.warn(place, "the light's color is invalid; white is used");
    if (light.type == LightType::Spot && !read_cone(*json, light)) {
        context.warn(place, "the light's cone is invalid; 45 degrees are used");
        light.inner_cone_rad = 0;
    }
    if (light.type != LightType::Point && !(glm::length(glm::dvec3(world[2])) > 0)) {
        context.warn(place, "the light's node is scaled to 0, it has no direction; ignored");
        return;
    }
    scene.lights.push_back(std::move(light));
}

void place_camera(Context& context, const Json& root, const Json& node, const Place& node_place,
                  const glm::dmat4& world, Scene& scene) {
    const auto index = node.find("camera");
    if (index == node.end()) return;
    const Json& json = root["cameras"][index->get<std::size_t>()];
    const Place place("cameras", index->get<std::int64_t>());
    SceneCamera camera;
    camera.name = name_of(json);
    if (camera.name.empty()) camera.name = name_of(node);
    camera.world = world;
    const auto ignore = [&](std::string_view why) { context.warn(place, fmt::format("{}; ignored", why)); };
    const Json* perspective = member(&json, "perspective");
    const Json* orthographic = member(&json, "orthographic");
    if (!(glm::length(glm::dvec3(world[2])) > 0) || !(glm::length(glm::dvec3(world[1])) > 0)) {
        return ignore(fmt::format("{} is scaled to 0, the camera has no direction", node_place.text()));
    }
    if (perspective && perspective->is_object()) {
        const auto fov = number(*perspective, "yfov", 1e-4, std::numbers::pi - 1e-4, -1);
        const auto near = number(*perspective, "znear", 1e-30, 1e30, -1);
        const auto far = number(*perspective, "zfar", 1e-30, 1e30, 0);
        if (!fov || *fov < 0 || !near || *near < 0 || !far || (*far != 0 && *far <= *near))
            return ignore("has an invalid yfov, znear or zfar");
        camera.fov_y_deg = *fov * 180 / std::numbers::pi;
        camera.near = is_automatic_camera_field(json, "znear_automatic") ? 0 : *near;
        camera.far = *far;
    } else if (orthographic && orthographic->is_object()) {
        const auto half = number(*orthographic, "ymag", -1e30, 1e30, 0);
        const auto near = number(*orthographic, "znear", 0, 1e30, -1);
        const auto far = number(*orthographic, "zfar", 1e-30, 1e30, -1);
        if (!half || *half == 0 || !near || *near < 0 || !far || *far <= *near)
            return ignore("has an invalid ymag, znear or zfar");
        camera.orthographic = true;
        camera.height = 2 * std::abs(*half);
        camera.near = is_automatic_camera_field(json, "znear_automatic") ? 0 : *near;
        camera.far = is_automatic_camera_field(json, "zfar_automatic") ? 0 : *far;
    } else {
        return ignore("is neither perspective nor orthographic");
    }
    scene.cameras.push_back(std::move(camera));
}

}  // namespace si::gltf
