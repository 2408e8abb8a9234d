#include "ui/state/scene_label.h"

#include "renderer/scenes/builtin.h"
#include "ui/state/selection.h"

namespace si {

std::string scene_label(const std::string& name) {
    if (name.empty()) return "No scene";
    for (const BuiltinScene& scene : builtin_scenes())
        if (scene.key == name) return std::string(scene.label);
    if (is_builtin_scene(name)) return name;
    return last_path_part(name);
}

}  // namespace si
