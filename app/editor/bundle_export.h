// Export of the editor's frame as a bundle, in the background.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/base/job.h"
#include "renderer/scene/scene.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Background export of the shown frame as a bundle: scene, lights and shadow maps as files. Runs one export at a time,
/// on a thread with an OpenGL context of its own.
class BundleExport {
public:
    /// Makes an exporter; no export runs yet. @param state the editor's state, which must outlive this object
    explicit BundleExport(EditorState& state) : state_(state) {}

    /// Starts to write the present frame as a bundle (scene, lights and shadow maps as files).
    /// @param size the size of the picture, pixels
    /// @param replace true: overwrites an existing bundle; false: the editor asks the user first (state.files.replace)
    /// @throws UsageError if `path` does not name a bundle, or names a bundle that the scene or its imported maps come
    /// from
    void start(const Scene& scene, glm::ivec2 size, const std::string& path, bool replace);
    /// Logs the outcome of a finished bundle export. Call once a frame. Returns true if an export has ended.
    bool poll();

    bool busy() const { return job_.busy(); }
    bool has_news() const { return job_.has_news(); }
    void finish() const { job_.wait(); }

private:
    EditorState& state_;
    std::string path_;
    Job<std::vector<std::string>> job_;  ///< its result: remarks about the written scene
};

}  // namespace si
