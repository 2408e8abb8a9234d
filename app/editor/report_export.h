// Report of the editor's settings beside pinned ones and presets, written in the background.
#pragma once

#include <string>

#include "app/base/job.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Report of one request at a time, made on a thread with an OpenGL context of its own.
class ReportExport {
public:
    /// @param state of the editor, which lives longer
    explicit ReportExport(EditorState& state) : state_(state) {}

    /// Starts to write a report. Faults become ReportFacts::problem. A file that exists is replaced only if the request
    /// says so. @param size of the picture, pixels
    void start(const Scene& scene, glm::ivec2 size, const ReportRequest& request);
    /// Cancels the report under way; its file stays as it was.
    void cancel() { job_.cancel(); }
    /// Logs the outcome of a report that has ended. Returns true if one has.
    bool poll();
    /// Returns progress and outcome for the dialog.
    ReportFacts facts() const;

    bool busy() const { return job_.busy(); }
    bool moved() const { return job_.moved(); }
    void finish() const { job_.wait(); }

private:
    EditorState& state_;
    std::string path_, problem_, wrote_;
    bool replaces_ = false;
    Job<std::string, SearchProgress> job_;  ///< text of the page
};

}  // namespace si
