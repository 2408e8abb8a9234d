#include "ui/state/scene_choices.h"

#include <fmt/format.h>

#include "renderer/scene/animation.h"
#include "renderer/scenes/builtin.h"
#include "ui/state/light_list.h"
#include "ui/state/selection.h"

namespace si {
namespace {

/// Formats a choice with its number, which presets and --set use: "2: Walk".
std::string numbered(std::size_t i, const std::string& name) {
    return name.empty() ? fmt::format("{}", i) : fmt::format("{}: {}", i, name);
}

}  // namespace

std::string scene_label(const std::string& name) {
    if (name.empty()) return "No scene";
    for (const BuiltinScene& scene : builtin_scenes())
        if (scene.key == name) return std::string(scene.label);
    return is_builtin_scene(name) ? name : last_path_part(name);
}

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

NamedValues view_choices(const Settings& settings, const FrameResult* result, std::string_view key) {
    const FittedLight* const light = key == "view.face" && result ? shown_fitted_light(settings, *result) : nullptr;
    if (!light || light->views.size() < 2) return {};
    NamedValues out;
    for (std::size_t i = 0; i < light->views.size(); ++i)
        out.emplace_back(int(i), view_name(light->chooser.choice, i, light->views.size()));
    if (settings.view.face >= int(light->views.size())) out.emplace_back(settings.view.face, out.back().second);
    return out;
}

}  // namespace si
