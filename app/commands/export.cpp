#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "app/base/notes.h"
#include "app/base/output.h"
#include "app/commands/commands.h"
#include "app/context/headless_context.h"
#include "app/report/frame_bundle.h"
#include "renderer/base/error.h"
#include "renderer/base/printable.h"
#include "renderer/bundle/given_maps.h"
#include "renderer/gltf/gltf.h"
#include "renderer/scene/ground.h"
#include "renderer/settings/param.h"

namespace si {

namespace {

/// Checks that no file of the scene or its given maps lies in the bundle to be written. @throws UsageError
void require_other_bundle(const std::string& bundle, const Session& session) {
    namespace fs = std::filesystem;
    std::vector<StampedFile> read = session.scene.files;
    if (const std::string& given = session.settings.map.bundle; !given.empty()) {
        const auto maps = given_maps(given);
        read.insert(read.end(), maps->files.begin(), maps->files.end());
    }
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(bundle, error);
    const fs::path folder = whole.has_filename() ? whole : whole.parent_path();
    for (const StampedFile& file : read) {
        const fs::path path = fs::weakly_canonical(file.path, error);
        const auto [end, unused] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
        if (end == folder.end())
            throw UsageError(fmt::format("{}: the command reads {} of this bundle; write another one",
                                         printable(bundle), printable(path.filename().string())));
    }
}

/// Writes the frame of a session as a bundle.
void export_bundle(const ExportOptions& options) {
    require_bundle_name(options.bundle);
    const Session session = open_session(options.session);
    require_other_bundle(options.bundle, session);
    const HeadlessContext context;
    Renderer renderer;
    Scene scene = session.scene;
    hide_objects(scene, {});
    remove_ground(scene);
    const BundleContents contents = frame_bundle(renderer, scene, session.scene, session.settings,
                                                 {.width = options.size.width, .height = options.size.height});
    write_bundle_files(contents, options.bundle);
    print_notes(session.notes);
    print_notes(export_notes(scene));
}

}  // namespace

void run_export(const ExportOptions& options) {
    if (!options.bundle.empty()) return export_bundle(options);
    if (options.output.empty()) throw UsageError("export: name the file to write: -o FILE or --bundle BUNDLE");
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
