// Report of the editor's settings beside pinned ones and presets, written in the background.
#pragma once

#include <string>

#include "app/base/job.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Writer of the HTML report that compares the present settings with pinned ones and presets. Makes one report at a
/// time, on a thread with an OpenGL context of its own.
class ReportExport {
public:
    /// Makes a writer; no report is made yet. @param state the editor's state, which must outlive this object
    explicit ReportExport(EditorState& state) : state_(state) {}

    /// Starts to make the HTML report that the dialog Report requests. Errors are shown in the dialog
    /// (ReportFacts::problem). An existing file is replaced only if request.replace is set.
    /// @param size size of the picture, pixels
    void start(const Scene& scene, glm::ivec2 size, const ReportRequest& request);
    /// Cancels the HTML report under way; its file stays as it was.
    void cancel() { job_.cancel(); }
    /// Writes the HTML report once its measurements have ended, and logs the outcome. Call once a frame. Returns true
    /// if a report has ended.
    bool poll();
    /// Returns progress and outcome of the HTML report, for the dialog Report.
    ReportFacts facts() const;

    bool busy() const { return job_.busy(); }
    bool has_news() const { return job_.has_news(); }
    void finish() const { job_.wait(); }

private:
    EditorState& state_;
    std::string path_, problem_, wrote_;
    std::string taken_;                     ///< path of the last request where a file exists
    Job<std::string, SearchProgress> job_;  ///< its result: HTML text of the report
};

}  // namespace si
