#include "ui/state/scene_choices.h"

#include <fmt/format.h>

#include "renderer/scene/animation.h"

namespace si {
namespace {

/// "2: Walk", so that the number that presets and --set take is seen.
std::string numbered(std::size_t i, const std::string& name) {
    return name.empty() ? fmt::format("{}", i) : fmt::format("{}: {}", i, name);
}

}  // namespace

NamedValues scene_choices(const Scene* scene, std::string_view key) {
    NamedValues out;
    if (!scene) return out;
    if (key == "scene.animation" && scene->rig && !scene->rig->animations.empty()) {
        out.emplace_back(-1, "-1: rest pose");
        const auto& all = scene->rig->animations;
        for (std::size_t i = 0; i < all.size(); ++i) out.emplace_back(int(i), numbered(i, all[i].name));
    }
    if (key == "scene.index" && scene->file_scenes.size() > 1) {
        out.emplace_back(-1, "-1: the file's default");
        for (std::size_t i = 0; i < scene->file_scenes.size(); ++i)
            out.emplace_back(int(i), numbered(i, scene->file_scenes[i]));
    }
    if (key == "camera.index" && !scene->cameras.empty()) {
        out.emplace_back(-1, "-1: none, show everything");
        for (std::size_t i = 0; i < scene->cameras.size(); ++i)
            out.emplace_back(int(i), numbered(i, scene->cameras[i].name));
    }
    return out;
}

}  // namespace si
