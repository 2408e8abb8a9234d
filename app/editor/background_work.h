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

/// Result of a finished search for fixes.
struct FixesFound {
    FixTable table;
    std::optional<glm::ivec2> pixel;  ///< none: the whole picture
};

/// Result of a finished search for advice, or of the autopilot.
using AdviceFound = std::variant<AdviceReport, AutopilotResult>;

/// Shimmer of shadow edges under each variant of the settings.
struct ShimmerFound {
    std::vector<ShimmerShown> variants;
    ShimmerOptions options;
};

/// Background measurements of one editor (sweeps, searches, Lab), connected with the panels that show them.
class BackgroundWork {
    /// Returns references to all background measurements, for calls to each of them.
    auto all() const {
        return std::tie(sweep_, bias_search_, fixes_, pixel_fixes_, optimisation_times_, advice_, waste_, pipelines_,
                        shimmer_, conversion_, light_path_);
    }

public:
    /// @param state of the editor, which lives longer @param state_folder see EditorSweep
    BackgroundWork(EditorState& state, const std::filesystem::path& state_folder)
        : state_(state), sweep_(state_folder) {}

    /// Moves results of finished background searches into the settings and the log. Returns true if a search has ended.
    /// @param scene the shown scene; null: none
    bool poll(const Scene* scene);
    /// Starts and cancels background measurements that panels request. Errors go to the log. Returns true if there was
    /// a request. @param shown last drawn frame
    bool fulfil(const SceneLoader& scenes, const FrameFacts& shown, const EditorRequests& requests);
    /// Updates the facts of the running sweep, and measures the present settings while a panel shows them. Returns true
    /// if the facts have changed. Call once a frame.
    bool update(const Scene* scene, const EditorRequests& requests);
    /// Shows the results in a sweep's folder in the panel Frontier. @throws Error if the folder cannot be read
    void open_sweep(const std::filesystem::path& folder) { sweep_.open(folder, state_.sweep); }
    /// Writes the facts of all background measurements into `frame`. Pointers in it stay valid until the next call of a
    /// non-const member. @param size scene picture, pixels
    void fill(EditorFrame& frame, const Scene* scene, glm::ivec2 size) const;

    /// Returns the progress of the measurement for a conversion; none: it does not run.
    std::optional<SearchProgress> conversion_progress() const { return conversion_.progress(); }
    /// Returns the measurement for a conversion of the present settings; null: there is none. @param size scene
    /// picture, pixels
    const MeasuredConversion* measured_conversion(const Scene* scene, glm::ivec2 size) const;

    /// Returns true while something is being measured.
    bool busy() const {
        return std::apply([](const auto&... work) { return (work.busy() || ...); }, all());
    }
    /// Returns true if results or progress have changed since the last poll() and update().
    bool moved() const {
        return std::apply([](const auto&... work) { return (work.moved() || ...); }, all());
    }
    /// Waits until nothing is being measured.
    void finish() const {
        std::apply([](const auto&... work) { (work.wait(), ...); }, all());
    }

private:
    /// Shows the result of a finished bias search beside the present picture, and logs it. Returns true if a search has
    /// ended.
    bool poll_tuning(const Scene* scene);
    /// Polls one background search (EditorSearch) and logs the error of a failed one. Returns true if the search has
    /// ended.
    bool poll_found(auto& search);
    /// Applies the settings that all cases of the shown sweep share, as one step of undo.
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
