// Sweeps and the measurement of the present settings, for the panel Frontier.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/sweep/measuring_thread.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Runner of the sweeps of the panel Frontier, one at a time on a thread of its own. Measures the present settings on
/// that thread, too.
class EditorSweep {
public:
    /// Makes the runner without a sweep. @param state_folder folder for sweeps, which later runs continue; empty: a
    /// temporary folder
    explicit EditorSweep(const std::filesystem::path& state_folder);
    /// Cancels the sweep and waits for its thread.
    ~EditorSweep();

    /// Starts the requested sweep, or continues an interrupted sweep with the same specification.
    /// @throws UsageError, Error
    void start(const Scene& scene, const EditorState& state, const SweepRequest& request);
    /// Cancels the running sweep. Measured cases stay.
    void cancel() {
        if (thread_) thread_->cancel_sweep();
    }
    /// Measures error and time of the present settings for the panel Frontier in the background, unless they were
    /// measured already. Cancels a measurement of other settings. Then measures the pinned settings, and the defaults
    /// of the chosen engine. Call it each frame.
    void measure_present(const Scene& scene, const EditorState& state);
    /// Stops measuring the present settings and the marks beside them. Call when no panel shows them.
    void stop_measuring_present();
    /// Shows the results in a sweep's folder, and sets the panel to the sweep's axes. @throws Error
    void open(const std::filesystem::path& folder, SweepPanel& panel);
    /// Writes journal, pictures, tables and report of the shown sweep into a folder. @throws Error
    void save(const std::filesystem::path& folder) const;

    /// Returns true while a sweep or the present settings are measured, or wait in the queue.
    bool busy() const { return thread_ && thread_->busy(); }
    /// Returns true if update() has new results of the measuring thread.
    bool moved() const { return thread_ && thread_->version() != seen_; }
    /// Waits until the measuring thread has no work.
    void wait() const {
        if (thread_) thread_->wait();
    }
    /// Fetches results of the measuring thread and applies the axes that the panel chose. Returns true if facts() have
    /// changed.
    bool update(const EditorState& state);
    const SweepFacts& facts() const { return facts_; }
    /// Returns the settings that all cases of the shown sweep share; null: no sweep is shown.
    const Settings* base() const { return shown_ ? &shown_->spec.base : nullptr; }

private:
    /// Sweep that the panel shows: specification, plan and folder.
    struct Shown {
        SweepSpec spec;
        SweepPlan plan;
        std::filesystem::path folder;
    };
    /// Returns the measuring thread; starts it at the first call.
    MeasuringThread& thread();
    /// Returns a copy of the scene for the measuring thread; copies a scene only once.
    std::shared_ptr<const Scene> copy_of(const Scene& scene);
    /// Shows another sweep in the panel Frontier, in place of the shown one.
    void show(Shown shown);
    /// Complete measurement of one set of settings.
    struct Finished {
        MeasuringThread::Picture of;
        CaseNumbers numbers;
    };
    /// Fetches new results from the measuring thread.
    void fetch_results();
    /// Adds a finished measurement to a list of the last ones.
    static void note_finished(std::vector<Finished>& list, const Finished& finished);
    /// Measures the next of the settings that are marked beside the present ones.
    void measure_marks(const Scene& scene, const EditorState& state);
    /// Returns the present picture under other settings; none if they show another picture, or shadows alike.
    std::optional<MeasuringThread::Picture> present_picture_under(const Settings& settings) const;
    /// Computes the defaults of the chosen engine over the present settings; null: no engine, or none can be given.
    const Settings* engine_defaults(const Scene& scene, const EditorState& state);
    /// Returns the finished measurement of a picture; null: there is none.
    const Finished* finished(const std::optional<MeasuringThread::Picture>& picture) const;
    /// Earlier measurement of the same picture, which the present settings' measurement is compared with.
    struct Earlier {
        const Finished* is = nullptr;  ///< measurement; null: the same picture was not measured before
        bool pinned = false;
    };
    /// Returns the measurement to compare with: of the pinned settings, else of those measured last.
    Earlier earlier(const EditorState& state) const;
    /// Collects in facts_.other_settings the settings that differ from the shown sweep's and that it does not vary, and
    /// notes in facts_.other_scene whether the scene differs. The panel warns of both.
    void compare_settings(const EditorState& state);
    /// Removes the folders that this run made for sweeps and in which no case was finished. A folder that cannot be
    /// removed yet, such as one whose sweep still holds its lock, is tried again at the next call.
    void drop_empty();

    std::filesystem::path parent_;
    bool temporary_ = false;
    std::set<std::filesystem::path> made_;  ///< folders that this run has made
    std::shared_ptr<const Scene> scene_;    ///< the last one that was handed over
    std::optional<MeasuringThread::Picture> followed_;
    std::unique_ptr<const Shown> shown_;
    std::optional<SweepResults> results_;
    std::optional<CaseNumbers> present_;
    std::vector<Finished> finished_;                 ///< the last ones, the present one at the end
    std::optional<MeasuringThread::Picture> mark_;   ///< marked settings that are being measured
    std::vector<Finished> marks_;                    ///< measured settings that were never the present ones
    std::vector<MeasuringThread::Picture> refused_;  ///< marked settings that cannot be measured
    /// Defaults of an engine over settings.
    struct EngineDefaults {
        const EngineProfile* profile = nullptr;
        double angle_deg = 0;
        Settings over;
        std::uint64_t scene = 0;
        std::optional<Settings> are;  ///< none: they cannot be given
    };
    EngineDefaults engine_;
    SweepFacts facts_;
    std::uint64_t seen_ = 0;        ///< version of the measuring thread's status as last seen
    std::uint64_t seen_sweep_ = 0;  ///< News::sweep as last seen
    bool opened_ = false;           ///< the shown sweep was read from a folder
    std::string seen_cost_, seen_error_;
    CostCase seen_timed_ = kFrontierCost;
    CostCase swept_cost_ = kFrontierCost;  ///< kind of frames timed by the shown sweep
    std::optional<PinnedSettings> seen_pinned_;
    const EngineProfile* seen_engine_ = nullptr;
    double seen_angle_deg_ = 0;     ///< reference angle of the engine's numbers
    bool marks_are_known_ = false;  ///< nothing that is marked beside the present settings is left to measure
    Settings compared_;             ///< settings last compared with the sweep's
    std::string compared_scene_;
    bool fresh_ = true;  ///< results have arrived since facts_ was made
    std::unique_ptr<MeasuringThread> thread_;
};

}  // namespace si
