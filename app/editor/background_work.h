// Measurements of one editor in the background: sweeps, the smallest bias, fixes, advice, optimisations, lab.
#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "app/editor/advice.h"
#include "app/editor/bias_search.h"
#include "app/editor/fixes.h"
#include "app/editor/lab.h"
#include "app/editor/optimisation_times.h"
#include "app/editor/scene_loader.h"
#include "app/editor/sweep.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Background measurements of one editor (sweeps, searches, Lab), connected with the panels that show them.
class BackgroundWork {
public:
    /// @param state of the editor, which lives longer @param state_folder see EditorSweep
    BackgroundWork(EditorState& state, const std::filesystem::path& state_folder)
        : state_(state), sweep_(state_folder) {}

    /// Moves results of finished background searches into the settings and the log. Returns true if a search has
    /// ended. @param scene shown scene; null: none
    bool poll(const Scene* scene);
    /// Starts and cancels background measurements that panels request. Errors go to the log. Returns true if there was
    /// a request. @param size scene picture, pixels @param diagnoses diagnoses of the probed pixel, one a light
    bool fulfil(const SceneLoader& scenes, glm::ivec2 size, std::span<const PixelDiagnosis> diagnoses,
                const EditorRequests& requests);
    /// Starts or cancels the background measurement of the time that each optimisation saves, as panels request.
    /// Returns true if there was a request. @param request frame request of the shown frame
    bool fulfil_optimisation_times(const SceneLoader& scenes, const FrameRequest& request,
                                   const EditorRequests& requests);
    /// Updates the facts of the running sweep, and measures the present settings while a panel shows them. Returns true
    /// if the facts have changed. Call once a frame.
    bool update(const Scene* scene, const EditorRequests& requests);
    /// Shows the results in a sweep's folder in the panel Frontier. @throws Error if the folder cannot be read
    void open_sweep(const std::filesystem::path& folder) { sweep_.open(folder, state_.sweep); }
    /// Writes the facts of all background measurements into `frame`. Pointers in it stay valid until the next call of a
    /// non-const member. @param size scene picture, pixels
    void fill(EditorFrame& frame, const Scene* scene, glm::ivec2 size) const;

    /// Returns true while something is being measured.
    bool busy() const {
        return sweep_.busy() || bias_search_.running() || fixes_.running() || optimisation_times_.running() ||
               advice_.running() || pipelines_.running() || shimmer_.running();
    }
    /// Returns true if results or progress have changed since the last poll() and update().
    bool moved() const {
        return sweep_.moved() || bias_search_.moved() || fixes_.moved() || optimisation_times_.moved() ||
               advice_.moved() || pipelines_.moved() || shimmer_.moved();
    }
    /// Waits until nothing is being measured.
    void finish() const {
        sweep_.wait();
        bias_search_.wait();
        fixes_.wait();
        optimisation_times_.wait();
        advice_.wait();
        pipelines_.wait();
        shimmer_.wait();
    }

private:
    /// Applies the result of a finished bias search to the settings, and logs it. Returns true if a search has ended.
    bool poll_tuning(const Scene* scene);
    /// Polls one background search and logs its error. Returns true if the search has ended.
    bool poll_found(auto& search);
    /// Starts the search for fixes of a pixel or of the whole picture. @param size scene picture, pixels
    /// @param diagnoses diagnoses of the probed pixel, whose own fixes are tried too
    void start_fixes(const Scene& scene, glm::ivec2 size, std::span<const PixelDiagnosis> diagnoses,
                     const FixRequest& request);
    /// Applies the settings that all cases of the shown sweep share, as one step of undo.
    void apply_sweep_base();

    EditorState& state_;
    EditorSweep sweep_;
    EditorBiasSearch bias_search_;
    std::optional<BiasSearchResult> tuning_;  ///< result of the last search that compared kinds of bias
    EditorFixes fixes_;
    EditorOptimisationTimes optimisation_times_;
    EditorAdvice advice_;
    EditorPipelines pipelines_;
    EditorShimmer shimmer_;
};

}  // namespace si
