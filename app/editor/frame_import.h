// Import of frames of other engines in the editor: a capture, or the image of a map, becomes a bundle and is opened.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/base/job.h"
#include "app/editor/persistence.h"
#include "app/editor/scene_loader.h"
#include "app/report/map_import.h"
#include "renderer/importers/importers.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Import of one frame of another engine at a time. Work runs on a thread of its own, and captures in a child process,
/// while the editor shows its scene. The bundle that it writes is opened as a scene.
class FrameImport {
public:
    /// @param state, memory, scenes parts of the editor, which outlive this object
    FrameImport(EditorState& state, EditorPersistence& memory, SceneLoader& scenes)
        : state_(state), persistence_(memory), scenes_(scenes) {}

    /// Begins to import a file of frame_files(); an earlier import is cancelled.
    void open(const std::filesystem::path& path, FrameFileKind kind);
    /// Fulfils the requests of the dialogs. Returns true if there was one. Errors go to the log.
    bool fulfil(const ImportRequests& requests);
    /// Takes the outcome of work that has ended, and opens a written bundle. Returns true if work has ended.
    bool poll();
    /// Returns the data that the dialogs and the progress show; nothing: no frame is being imported.
    std::optional<ImportFacts> facts() const;

    /// Returns true while work runs, or its outcome waits for poll().
    bool busy() const { return job_.busy(); }
    /// Returns true if facts() have changed since their last call.
    bool moved() const;
    /// Waits until no work runs.
    void finish() const { job_.wait(); }

private:
    /// Progress of the work.
    struct Step {
        double share = 0;
        std::string doing;
    };
    /// Outcome of an import: the bundle that was made.
    struct Made {
        std::vector<ImportChoice> choices;     ///< after ImportStep::Reading
        std::shared_ptr<const MapImport> map;  ///< the readings of an image
        std::vector<LogLine> lines;            ///< after ImportStep::Writing
    };
    using Work = Job<Made, Step>;

    /// Starts to list the maps of the capture, or the readings of the image. @throws Error
    void start_reading();
    /// Starts to write the chosen maps, or the chosen reading. @throws Error
    void start_writing();
    /// Runs the work of a step on a thread of its own. @param doing text beside the progress bar
    void start_step(ImportStep step, const char* doing, Work::Work work);
    /// Shows the choices that reading has found.
    void show_choices(Made made);
    /// Ends the import.
    void end_import();

    EditorState& state_;
    EditorPersistence& persistence_;
    SceneLoader& scenes_;
    std::optional<ImportStep> step_;  ///< none: no frame is being imported
    FrameFileKind kind_ = FrameFileKind::Capture;
    std::filesystem::path file_;
    std::string output_;  ///< bundle that is being written
    std::vector<ImportChoice> choices_;
    std::shared_ptr<const MapImport> map_;
    std::string problem_;
    std::chrono::steady_clock::time_point began_;
    mutable int shown_seconds_ = 0;
    Work job_;  ///< last: ends before what it uses
};

}  // namespace si
