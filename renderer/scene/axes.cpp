#include "renderer/scene/axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <memory>

#include "renderer/scene/animation.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

constexpr std::array kUpAxes = {UpAxis::X, UpAxis::Y, UpAxis::Z, UpAxis::MinusX, UpAxis::MinusY, UpAxis::MinusZ};

/// Applies a rotation and a scale to the values of a channel of a root node. Both are linear, so tangents need no care.
void turn_channel(AnimationChannel& channel, const glm::dquat& rotation, double scale) {
    const std::size_t width = channel.width;
    if (channel.property == AnimatedProperty::Weights) return;
    for (std::size_t i = 0; i + width <= channel.values.size(); i += width) {
        float* const v = &channel.values[i];
        if (channel.property == AnimatedProperty::Rotation) {
            const glm::dquat turned = rotation * glm::dquat(v[3], v[0], v[1], v[2]);
            v[0] = float(turned.x);
            v[1] = float(turned.y);
            v[2] = float(turned.z);
            v[3] = float(turned.w);
            continue;
        }
        const glm::dvec3 from(v[0], v[1], v[2]);
        const bool moves = channel.property == AnimatedProperty::Translation;
        const glm::dvec3 to = scale * (moves ? rotation * from : from);
        for (int k = 0; k < 3; ++k) v[k] = float(to[k]);
    }
}

/// Turns and scales the root nodes of a rig: their rest pose, and the channels that replace it.
void turn_rig(Scene& scene, const glm::dquat& rotation, double scale) {
    auto rig = std::make_shared<Rig>(*scene.rig);
    const auto is_root = [&](int node) { return scene.nodes[std::size_t(node)].parent < 0; };
    for (std::size_t i = 0; i < rig->rest.size(); ++i) {
        if (!is_root(int(i))) continue;
        NodeRestPose& rest = rig->rest[i];
        rest.translation = scale * (rotation * rest.translation);
        rest.rotation = rotation * rest.rotation;
        rest.scale *= scale;
    }
    for (Animation& animation : rig->animations)
        for (AnimationChannel& channel : animation.channels)
            if (is_root(channel.node)) turn_channel(channel, rotation, scale);
    scene.rig = std::move(rig);
    apply_pose(scene, -1, 0);
}

}  // namespace

glm::dmat3 y_up_from(UpAxis up) {
    // Columns: images of the file's x, y and z.
    switch (up) {
        case UpAxis::X:
            return {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}};
        case UpAxis::Z:
            return {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
        case UpAxis::MinusX:
            return {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
        case UpAxis::MinusY:
            return {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
        case UpAxis::MinusZ:
            return {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
        case UpAxis::File:
        case UpAxis::Y:
            break;
    }
    return glm::dmat3(1);
}

UpAxis up_axis_of(const glm::dmat3& rotation) {
    constexpr double kRounding = 1e-4;
    for (const UpAxis axis : kUpAxes) {
        const glm::dmat3 difference = y_up_from(axis) - rotation;
        double most = 0;
        for (int c = 0; c < 3; ++c) most = std::max(most, glm::length(difference[c]));
        if (most < kRounding) return axis;
    }
    return UpAxis::Y;
}

std::string up_axis_key(UpAxis up) {
    Settings settings;
    settings.scene.up = up;
    const SettingRef ref = *find_setting("scene.up");
    return value_text(*ref.param, get_value(settings, ref));
}

void apply_file_choices(Scene& scene, const FileChoices& choices) {
    const UpAxis up = choices.up == UpAxis::File ? scene.file_up : choices.up;
    const double unit = choices.unit > 0 ? choices.unit : scene.file_unit_m;
    if (up == scene.file_up && unit == scene.file_unit_m) return;
    const glm::dmat3 rotation = y_up_from(up) * glm::transpose(y_up_from(scene.file_up));
    const double scale = unit / scene.file_unit_m;
    const glm::dmat4 whole(scale * rotation);
    for (Node& node : scene.nodes)
        if (node.parent < 0) node.local = whole * node.local;
    for (SceneCamera& camera : scene.cameras) {
        camera.world = whole * camera.world;
        camera.height *= scale;
        camera.near *= scale;
        camera.far *= scale;
    }
    for (SceneLight& light : scene.lights) {
        light.world = whole * light.world;
        light.range *= scale;
    }
    if (scene.rig) turn_rig(scene, glm::dquat(rotation), scale);
    scene.file_up = up;
    scene.file_unit_m = unit;
}

void apply_world(Scene& scene, const glm::dmat4& world) {
    if (world == glm::dmat4(1)) return;
    if (scene.rig) {
        // Rest poses and channels have no mirror and no translation of the whole.
        apply_pose(scene, -1, 0);
        scene.rig.reset();
        scene.warnings.push_back("animations are left out: the file's space differs from metres, y up, right-handed");
    }
    const double volume = glm::determinant(glm::dmat3(world));
    const double scale = std::cbrt(std::abs(volume));
    const glm::dmat4 unmirror = glm::dmat4(glm::dmat3(volume < 0 ? -1 : 1, 0, 0, 0, 1, 0, 0, 0, 1));
    for (Node& node : scene.nodes)
        if (node.parent < 0) node.local = world * node.local;
    for (SceneCamera& camera : scene.cameras) {
        camera.world = world * camera.world * unmirror;
        camera.height *= scale;
        camera.near *= scale;
        camera.far *= scale;
    }
    for (SceneLight& light : scene.lights) {
        light.world = world * light.world * unmirror;
        light.range *= scale;
    }
}

}  // namespace si
