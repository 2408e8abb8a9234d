#include "app/base/notes.h"
#include "app/base/output.h"
#include "app/commands/commands.h"
#include "renderer/gltf/gltf.h"
#include "renderer/scene/ground.h"
#include "renderer/settings/param.h"

namespace si {

void run_export(const CommandOptions& options) {
    require_output(options.output, "the file", {".gltf", ".glb"});
    Session session = open_session(options.session);
    if (!options.session.preset.empty() || !options.session.sets.empty()) {
        session.scene.suggested.clear();
        for (const SettingRef& ref : changed_settings(session.settings))
            if (!ref.param->key.starts_with("scene."))  // the file holds the pose at one time only
                session.scene.suggested.emplace_back(setting_key(ref),
                                                     value_text(*ref.param, get_value(session.settings, ref)));
    }
    hide_objects(session.scene, {});  // hidden objects are exported, and hidden again by their setting
    remove_ground(session.scene);     // the ground is not part of the scene
    const std::vector<std::string> changes = export_notes(session.scene);
    save_gltf(session.scene, options.output);
    print_notes(session.notes);
    print_notes(changes);
}

}  // namespace si
