// What one editor measures in the background: sweeps and the present settings' dot among them, the least bias, cures.
#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "app/editor/advice.h"
#include "app/editor/cures.h"
#include "app/editor/lab.h"
#include "app/editor/saved.h"
#include "app/editor/scene_desk.h"
#include "app/editor/sweep.h"
#include "app/editor/tuner.h"
#include "ui/state/editor_ui.h"

namespace si {

class BackgroundWork {
public:
    /// @param state of the editor, which lives longer @param state_folder see EditorSweep
    BackgroundWork(EditorState& state, const std::filesystem::path& state_folder)
        : state_(state), sweep_(state_folder) {}

    /// Takes what searches found over into the settings and the log. Returns whether any ended.
    bool poll(const Scene* scene);
    /// Does what was wished for; errors go to the log. Returns whether anything was.
    /// @param size of the scene's picture, pixels @param dossiers of the probed pixel
    bool fulfil(const SceneDesk& scenes, glm::ivec2 size, std::span<const PixelDiagnosis> diagnoses,
                const EditorActions& actions);
    /// Measures what savings are worth, as wished for. Returns whether anything was. @param request of the frame shown
    bool fulfil_saved(const SceneDesk& scenes, const FrameRequest& request, const EditorActions& actions);
    /// Follows sweeps, and the present settings' place among their cases. Returns whether there are news.
    bool follow(const Scene* scene, const EditorActions& actions);
    void open_sweep(const std::filesystem::path& folder) { sweep_.open(folder, state_.sweep); }
    void fill(EditorFrame& frame, const Scene* scene, glm::ivec2 size) const;

    bool busy() const {
        return sweep_.busy() || tuner_.running() || fixes_.running() || saved_.running() || advice_.running() ||
               pipelines_.running() || shimmer_.running();
    }
    bool moved() const {
        return sweep_.moved() || tuner_.moved() || fixes_.moved() || saved_.moved() || advice_.moved() ||
               pipelines_.moved() || shimmer_.moved();
    }
    void finish() const {
        sweep_.wait();
        tuner_.wait();
        fixes_.wait();
        saved_.wait();
        advice_.wait();
        pipelines_.wait();
        shimmer_.wait();
    }

private:
    bool poll_tuning(const Scene* scene);
    /// Of cures, of savings, and of advice.
    bool poll_found(auto& search);
    void start_fixes(const Scene& scene, glm::ivec2 size, std::span<const PixelDiagnosis> diagnoses,
                     const FixWish& wish);
    void take_sweep_base();

    EditorState& state_;
    EditorSweep sweep_;
    EditorTuner tuner_;
    std::optional<TuningOutcome> tuned_;  ///< the last that tried families of biases
    EditorFixes fixes_;
    EditorSaved saved_;
    EditorAdvice advice_;
    EditorPipelines pipelines_;
    EditorShimmer shimmer_;
};

}  // namespace si
