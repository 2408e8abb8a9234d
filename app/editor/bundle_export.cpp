#include "app/editor/bundle_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "app/base/output.h"
#include "app/context/headless_context.h"
#include "app/editor/requests.h"
#include "app/report/frame_bundle.h"
#include "renderer/base/error.h"
#include "renderer/gltf/gltf.h"

namespace si {

void BundleExport::start(const Scene& scene, glm::ivec2 size, const std::string& path, bool replace) {
    require_bundle_name(path);
    require_other_bundle(path, scene, state_.settings);
    if (!replace && is_taken(path)) {
        state_.files.replace = Replacement{.path = path, .exported = ExportKind::Bundle};
        return;
    }
    path_ = path;
    FrameRequest request{.width = std::max(size.x, 1), .height = std::max(size.y, 1)};
    if (state_.frozen) request.map_camera = MapCamera{state_.frozen->camera, state_.frozen->seen_m};
    const auto shown = std::make_shared<const Scene>(scene);
    job_.start([shown, settings = state_.settings, request, path](const Workers& workers, const auto&) {
        const HeadlessContext context;
        Renderer renderer;
        const BundleContents contents = frame_bundle(renderer, *shown, settings, request);
        if (workers.stop.stop_requested()) throw Cancelled();
        write_bundle_files(contents, path);
        return export_notes(written_scene(*shown));
    });
    state_.log.add(LogKind::Info, "Exporting " + path);
}

bool BundleExport::poll() {
    const auto outcome = job_.poll();
    if (!outcome) return false;
    if (outcome->cancelled) return true;
    if (!outcome->value) {
        report(state_, exception_message(outcome->problem));
        return true;
    }
    for (const std::string& note : *outcome->value) state_.log.add(LogKind::Warning, note);
    state_.log.add(LogKind::Info, "Wrote " + path_);
    return true;
}

}  // namespace si
