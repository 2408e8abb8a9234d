// Export of the editor's frame as a bundle, in the background.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/base/job.h"
#include "renderer/scene/scene.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Export of one frame at a time as a bundle, on a thread with an OpenGL context of its own.
class BundleExport {
public:
    /// @param state of the editor, which lives longer
    explicit BundleExport(EditorState& state) : state_(state) {}

    /// Starts to write the present frame as a bundle. A bundle that exists is replaced only with `replace`; without it
    /// the editor's question opens. @param size of the picture, pixels
    /// @throws UsageError, Error for another name, and for a bundle that the frame reads
    void start(const Scene& scene, glm::ivec2 size, const std::string& path, bool replace);
    /// Logs the outcome of an export that has ended. Returns true if one has.
    bool poll();

    bool busy() const { return job_.busy(); }
    bool moved() const { return job_.moved(); }
    void finish() const { job_.wait(); }

private:
    EditorState& state_;
    std::string path_;
    Job<std::vector<std::string>> job_;  ///< remarks about the written scene
};

}  // namespace si
