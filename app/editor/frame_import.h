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

/// Import of a frame of another engine: a RenderDoc capture, or the image of a shadow map. The import writes a bundle
/// (scene, lights and maps as files) and opens it as a scene. Runs in the background, one import at a time; a child
/// process reads captures.
class FrameImport {
public:
    /// Makes an importer; no frame is imported yet.
    /// @param state, memory, scenes parts of the editor, which must outlive this object
    FrameImport(EditorState& state, EditorPersistence& memory, SceneLoader& scenes)
        : state_(state), persistence_(memory), scenes_(scenes) {}

    /// Starts the import of a RenderDoc capture or of the image of a shadow map: reads the file, or opens a dialog
    /// first. An earlier import is cancelled. @param path a file of a kind that frame_files() lists
    void open(const std::filesystem::path& path, FrameFileKind kind);
    /// Performs the requests of the import dialogs: continue, write or cancel. Errors are shown in the dialog. Returns
    /// true if there was a request.
    bool fulfil(const ImportRequests& requests);
    /// Continues the import when a background step has ended: shows the choices that were read, or opens the written
    /// bundle. Call once a frame. Returns true if a step has ended.
    bool poll();
    /// Returns the data that the import's dialogs and progress bar show; nothing: no frame is being imported.
    std::optional<ImportFacts> facts() const;

    /// Returns true while a background step of the import runs, or its outcome waits for poll().
    bool busy() const { return job_.busy(); }
    /// Returns true if the import's progress or elapsed seconds have changed since the last call of facts().
    bool has_news() const;
    /// Waits until no background step of the import runs.
    void finish() const { job_.wait(); }

private:
    /// Progress of a background step of the import, for the progress bar.
    struct Step {
        double share = 0;
        std::string doing;
    };
    /// Result of a background step of the import: the choices after reading, or lines for the log after writing.
    struct Made {
        std::vector<ImportChoice> choices;     ///< choices for the user, after ImportStep::Reading
        std::shared_ptr<const MapImport> map;  ///< a map's image with its possible depth conventions; null: none
        std::vector<LogLine> lines;            ///< lines for the log, after ImportStep::Writing
    };
    using Work = Job<Made, Step>;

    /// Starts to list the shadow maps of a capture, or the possible depth conventions of a map's image, in the
    /// background. The user then chooses among them. @throws Error
    void start_reading();
    /// Starts to write a bundle. It holds those maps of a capture that the user has chosen, or a map's image read by
    /// the chosen depth convention. @throws Error
    void start_writing();
    /// Runs a step of the import on a thread of its own. @param doing text beside the progress bar @param work the
    /// function to run
    void start_step(ImportStep step, const char* doing, Work::Work work);
    /// Opens the dialog in which the user chooses the maps of a capture, or the depth convention of a map's image.
    /// @param made result of start_reading()
    void show_choices(Made made);
    /// Ends the import: cancels its background work and closes its dialogs.
    void end_import();

    EditorState& state_;
    EditorPersistence& persistence_;
    SceneLoader& scenes_;
    std::optional<ImportStep> step_;  ///< present step of the import; none: no frame is being imported
    FrameFileKind kind_ = FrameFileKind::Capture;
    std::filesystem::path file_;
    std::string output_;  ///< path of the bundle that is being written
    std::vector<ImportChoice> choices_;
    std::shared_ptr<const MapImport> map_;
    std::string problem_;
    std::chrono::steady_clock::time_point began_;
    mutable int shown_seconds_ = 0;
    Work job_;  ///< declared last, so that its thread ends first
};

}  // namespace si
