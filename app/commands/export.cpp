#include <algorithm>
#include <string_view>
#include <vector>

#include "app/base/notes.h"
#include "app/base/output.h"
#include "app/commands/commands.h"
#include "app/context/headless_context.h"
#include "app/report/frame_bundle.h"
#include "renderer/base/error.h"
#include "renderer/gltf/gltf.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

/// Writes the frame of a session as a bundle.
void export_bundle(const ExportOptions& options) {
    require_bundle_name(options.bundle);
    const Session session = open_session(options.session);
    require_other_bundle(options.bundle, session.scene, session.settings);
    const HeadlessContext context;
    Renderer renderer;
    write_bundle_files(frame_bundle(renderer, session.scene, session.settings,
                                    {.width = options.size.width, .height = options.size.height},
                                    options.maps == "exr" ? MapFile::Exr : MapFile::Pfm),
                       options.bundle);
    print_notes(session.notes);
    print_notes(export_notes(written_scene(session.scene)));
}

/// Returns true for a setting that a loader suggests on its own where a file does not state it.
bool is_suggested_by_loader(const SettingRef& ref, const Settings& settings) {
    constexpr std::string_view kKeys[] = {"light.count",   "light.type",      "light.fit",
                                          "light.azimuth", "light.elevation", "caster.blend"};
    if (std::ranges::find(kKeys, ref.param->key) == std::end(kKeys)) return false;
    return ref.param->scope != Scope::Light || ref.light < settings.light_count;
}

/// Returns the settings that a file states, so that it opens with all of them.
std::vector<SettingRef> stated_settings(const Settings& settings) {
    std::vector<SettingRef> stated = all_settings(settings);
    std::erase_if(stated, [&](const SettingRef& ref) {
        return ref.param->key.starts_with("scene.") ||  // the file holds the pose at one time only
               (get_value(settings, ref) == default_value(ref) && !is_suggested_by_loader(ref, settings));
    });
    return stated;
}

}  // namespace

void run_export(const ExportOptions& options) {
    if (!options.bundle.empty()) return export_bundle(options);
    if (options.output.empty()) throw UsageError("export: name the file to write: -o FILE or --bundle BUNDLE");
    require_output(options.output, "the file", {".gltf", ".glb"});
    Session session = open_session(options.session);
    if (!options.session.preset.empty() || !options.session.sets.empty()) {
        session.scene.suggested.clear();
        for (const SettingRef& ref : stated_settings(session.settings))
            session.scene.suggested.emplace_back(setting_key(ref),
                                                 value_text(*ref.param, get_value(session.settings, ref)));
    }
    const Scene written = written_scene(session.scene);
    const std::vector<std::string> changes = export_notes(written);
    save_gltf(written, options.output);
    print_notes(session.notes);
    print_notes(changes);
}

}  // namespace si
