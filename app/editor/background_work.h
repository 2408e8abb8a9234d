// Measurements of one editor in the background: sweeps, the smallest bias, fixes, advice, waste,
// optimisations, lab.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "app/convert/measured_conversion.h"
#include "app/editor/frame_facts.h"
#include "app/editor/scene_loader.h"
#include "app/editor/search.h"
#include "app/editor/sweep.h"
#include "renderer/advise/autopilot.h"
#include "renderer/advise/fixes.h"
#include "renderer/advise/tuning.h"
#include "renderer/advise/waste.h"
#include "renderer/measure/light_path.h"
#include "renderer/measure/optimisation_times.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Result of a background search for fixes, which are changes of settings that put wrong pixels right.
struct FixesFound {
    FixTable table;
    std::optional<glm::ivec2> pixel;  ///< pixel that the search was for; none: the whole picture
};

/// Result so far of a background search for better settings. AdviceReport ranks setting changes by measured error and
/// time, and lists problems of the frame. AutopilotResult has the best settings found within a limit of error or time.
using AdviceFound = std::variant<AdviceReport, AutopilotResult>;

/// Result of a shimmer measurement: flips of shadow-edge pixels while camera or light moves, under each compared
/// variant of the settings.
struct ShimmerFound {
    std::vector<ShimmerShown> variants;
    ShimmerOptions options;
};

/// Owner of the editor's background measurements: sweeps over settings, searches for bias, fixes and advice, and
/// timings. Starts a measurement when a panel requests it, and passes its results to the panels.
class BackgroundWork {
    /// Returns references to all background measurements, for calls to each of them.
    auto all() const {
        return std::tie(sweep_, bias_search_, fixes_, pixel_fixes_, optimisation_times_, advice_, waste_, pipelines_,
                        shimmer_, conversion_, light_path_);
    }

public:
    /// Makes the owner; nothing is measured yet. @param state the editor's state, which must outlive this object
    /// @param state_folder folder for results of sweeps, kept between runs; empty: a temporary folder
    BackgroundWork(EditorState& state, const std::filesystem::path& state_folder)
        : state_(state), sweep_(state_folder) {}

    /// Collects the results of background searches that have ended. A found bias is shown beside the present picture;
    /// errors and summaries go to the log. Call once a frame. Returns true if a search has ended.
    /// @param scene the shown scene; null: none
    bool poll(const Scene* scene);
    /// Starts and cancels the background measurements that panels request. Errors go to the log. Returns true if the
    /// editor has to be drawn again.
    /// @param shown last drawn frame, whose size and diagnoses the measurements use
    bool fulfil(const SceneLoader& scenes, const FrameFacts& shown, const EditorRequests& requests);
    /// Updates the data that the panel Frontier shows about the running sweep (a measurement of many settings).
    /// Measures the present settings while a panel requests it (EditorRequests::want_present). Call once a frame.
    /// Returns true if the data have changed.
    bool update(const Scene* scene, const EditorRequests& requests);
    /// Shows the results in the folder of a sweep (measurement of many settings) in the panel Frontier. @throws Error
    /// if the folder cannot be read
    void open_sweep(const std::filesystem::path& folder) { sweep_.open(folder, state_.sweep); }
    /// Writes progress and results of all background measurements into `frame`, the data that panels show. A result is
    /// marked as current only if scene, settings and picture size are those that it was measured with. Pointers in
    /// `frame` stay valid until the next call of a non-const member. @param size scene picture, pixels
    void fill(EditorFrame& frame, const Scene* scene, glm::ivec2 size) const;

    /// Returns the progress of measuring error and time for a conversion (shadow settings as code for another engine);
    /// none: no such measurement runs.
    std::optional<SearchProgress> conversion_progress() const { return conversion_.progress(); }
    /// Returns error and time as measured for a conversion (shadow settings as code for another engine). Returns null
    /// if they were not measured for the present settings and size.
    /// @param scene the shown scene; null: none @param size scene picture, pixels
    const MeasuredConversion* measured_conversion(const Scene* scene, glm::ivec2 size) const;

    /// Returns true while something is being measured in the background.
    bool busy() const {
        return std::apply([](const auto&... work) { return (work.busy() || ...); }, all());
    }
    /// Returns true if results or progress of background measurements have changed since the last poll() and update().
    bool has_news() const {
        return std::apply([](const auto&... work) { return (work.has_news() || ...); }, all());
    }
    /// Waits until nothing is being measured in the background.
    void finish() const {
        std::apply([](const auto&... work) { (work.wait(), ...); }, all());
    }

private:
    /// Collects the result of a finished bias search, logs it, and shows the found settings beside the present picture.
    /// Shows nothing if scene or settings have changed since the search began. Returns true if the search has ended.
    bool poll_tuning(const Scene* scene);
    /// Polls one background search (EditorSearch), and logs why it has failed or was cancelled. Returns true if the
    /// search has ended.
    bool poll_found(auto& search);
    /// Replaces the present settings by those that all cases of the shown sweep (measurement of many settings) share,
    /// so that the picture is comparable with the sweep. One step of undo; view settings stay, except the shown light
    /// (view.light).
    void apply_sweep_base();

    EditorState& state_;
    EditorSweep sweep_;
    EditorSearch<Tuned> bias_search_{"The search for the smallest bias was cancelled; its results so far stay"};
    EditorSearch<FixesFound> fixes_{"The search for fixes was cancelled; its results so far stay"};
    EditorSearch<FixesFound> pixel_fixes_{"The search for the pixel's fix was cancelled; its results so far stay"};
    EditorSearch<SavedTimes> optimisation_times_{
        "The measurement of optimisations was cancelled; its results so far stay"};
    EditorSearch<AdviceFound> advice_{"The search for advice was cancelled; its results so far stay"};
    EditorSearch<Waste> waste_{"The search for waste was cancelled; its results so far stay"};
    EditorSearch<std::vector<PipelineError>> pipelines_{"The comparison of precision was cancelled"};
    EditorSearch<ShimmerFound> shimmer_{"The measurement of shimmer was cancelled; its results so far stay"};
    EditorSearch<MeasuredConversion> conversion_{"The measurement for the conversion was cancelled"};
    EditorSearch<LightPathResult> light_path_{
        "The measurement along the light's path was cancelled; its results so far stay"};
};

}  // namespace si
