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

/// Runner of sweeps for the panel Frontier: measures error and cost of many settings, one sweep at a time, on a thread
/// of its own. Measures the present settings on that thread, too.
class EditorSweep {
public:
    /// Makes the runner of sweeps, with no sweep yet; start() or open() gives it one.
    /// @param state_folder folder for results of sweeps. A later run of the program continues an interrupted sweep from
    /// there. Empty: a temporary folder
    explicit EditorSweep(const std::filesystem::path& state_folder);
    /// Cancels the sweep and waits for its thread.
    ~EditorSweep();

    /// Starts the requested sweep (measurement of many settings), or continues an interrupted one with the same
    /// specification.
    /// @throws UsageError, Error
    void start(const Scene& scene, const EditorState& state, const SweepRequest& request);
    /// Cancels the running sweep (measurement of many settings). Measured cases stay.
    void cancel() {
        if (thread_) thread_->cancel_sweep();
    }
    /// Measures error and time of the present settings in the background, for the panel Frontier, unless they are
    /// measured already. Then measures the pinned settings and the defaults of the chosen engine, which the frontier
    /// plot (error against cost) marks beside the present settings. Cancels a measurement of other settings. Call each
    /// frame.
    void measure_present(const Scene& scene, const EditorState& state);
    /// Stops measuring the present settings, the pinned ones and the chosen engine's defaults. Call when no panel shows
    /// them.
    void stop_measuring_present();
    /// Reads a sweep (measurement of many settings) from its folder and shows the results in the panel Frontier.
    /// @param panel state of the panel; gets axes and size of the sweep @throws Error
    void open(const std::filesystem::path& folder, SweepPanel& panel);
    /// Writes the shown sweep (measurement of many settings) into a folder: journal of the measured cases, pictures,
    /// tables and report. Replaces an earlier save of the same sweep. @throws Error, also when the folder holds another
    /// sweep
    void save(const std::filesystem::path& folder) const;

    /// Returns true while a sweep or the present settings are measured, or wait in the queue.
    bool busy() const { return thread_ && thread_->busy(); }
    /// Returns true if the next update() will have new results of the measuring thread.
    bool has_news() const { return thread_ && thread_->version() != seen_; }
    /// Waits until the measuring thread has no work.
    void wait() const {
        if (thread_) thread_->wait();
    }
    /// Fetches new results of the measuring thread, and updates the frontier plot (error against cost) for the axes
    /// that the panel Frontier has chosen. Call each frame. Returns true if facts() have changed.
    bool update(const EditorState& state);
    const SweepFacts& facts() const { return facts_; }
    /// Returns the settings that all cases of the shown sweep share; null: no sweep is shown.
    const Settings* base() const { return shown_ ? &shown_->spec.base : nullptr; }

private:
    /// Sweep (measurement of many settings) that the panel Frontier shows: specification, list of cases, folder of the
    /// results.
    struct Shown {
        SweepSpec spec;
        SweepPlan plan;
        std::filesystem::path folder;
    };
    /// Returns the thread that measures sweeps and the present settings. Starts it at the first call.
    MeasuringThread& thread();
    /// Returns a copy of the scene that the measuring thread may keep. The same scene is copied only once.
    std::shared_ptr<const Scene> copy_of(const Scene& scene);
    /// Shows another sweep (measurement of many settings) in the panel Frontier. Results of the sweep before are
    /// dropped.
    void show(Shown shown);
    /// Finished measurement that the editor keeps: the measured picture (scene, settings, size) and its numbers. The
    /// same picture is then not measured again.
    struct Finished {
        MeasuringThread::Picture of;
        CaseNumbers numbers;
    };
    /// Fetches new results of the sweep (measurement of many settings) and of the present settings from the measuring
    /// thread.
    void fetch_results();
    /// Adds a finished measurement to a list of the last 16 ones. Replaces an earlier measurement of the same settings.
    static void note_finished(std::vector<Finished>& list, const Finished& finished);
    /// Starts to measure the settings that the frontier plot (error against cost) marks beside the present ones: the
    /// pinned settings, then the defaults of the chosen engine. Does nothing while another measurement runs.
    void measure_marks(const Scene& scene, const EditorState& state);
    /// Returns the present picture under other settings, as a task for the measuring thread. Returns nothing if the
    /// settings change scene or camera, or do not change the shadows.
    std::optional<MeasuringThread::Picture> present_picture_under(const Settings& settings) const;
    /// Returns the present settings with the defaults of the chosen engine applied. Returns null if no engine is
    /// chosen, or its defaults cannot be applied.
    const Settings* engine_defaults(const Scene& scene, const EditorState& state);
    /// Returns the stored measurement of a picture; null: the picture was not measured.
    const Finished* finished(const std::optional<MeasuringThread::Picture>& picture) const;
    /// Earlier measurement of the same picture under other settings, which the frontier plot (error against cost) shows
    /// beside the present one.
    struct Earlier {
        const Finished* is = nullptr;  ///< measurement; null: the same picture was not measured before
        bool pinned = false;
    };
    /// Returns the measurement with which that of the present settings is compared: the one of the pinned settings,
    /// else the latest one of other settings. Earlier::is is null if there is none.
    Earlier earlier(const EditorState& state) const;
    /// Finds differences between the present settings and the shown sweep (measurement of many settings). The panel
    /// Frontier warns of them. Writes facts_.other_settings (settings that differ and that the sweep does not vary) and
    /// facts_.other_scene.
    void compare_settings(const EditorState& state);
    /// Removes folders that this run made for results of sweeps, if no case was measured in them. A folder that cannot
    /// be removed yet, for example because its sweep holds the lock, is tried again at the next call.
    void drop_empty();

    std::filesystem::path parent_;
    bool temporary_ = false;
    std::set<std::filesystem::path> made_;  ///< folders that this run has made
    std::shared_ptr<const Scene> scene_;    ///< scene that the measuring thread got last
    std::optional<MeasuringThread::Picture> followed_;
    std::unique_ptr<const Shown> shown_;
    std::optional<SweepResults> results_;
    std::optional<CaseNumbers> present_;
    std::vector<Finished> finished_;                 ///< last measurements of present settings, newest last
    std::optional<MeasuringThread::Picture> mark_;   ///< marked settings that are being measured
    std::vector<Finished> marks_;                    ///< measurements of marked settings
    std::vector<MeasuringThread::Picture> refused_;  ///< marked settings that cannot be measured
    /// Cached result of engine_defaults(), with the settings, engine and scene that it belongs to.
    struct EngineDefaults {
        const EngineProfile* profile = nullptr;
        double angle_deg = 0;
        Settings over;
        std::uint64_t scene = 0;
        std::optional<Settings> are;  ///< defaults of the engine; none: they cannot be applied
    };
    EngineDefaults engine_;
    SweepFacts facts_;
    std::uint64_t seen_ = 0;        ///< version of the measuring thread's status as last seen
    std::uint64_t seen_sweep_ = 0;  ///< Status::sweep of the measuring thread as last seen
    bool opened_ = false;           ///< the shown sweep was read from a folder
    std::string seen_cost_, seen_error_;
    CostCase seen_timed_ = kFrontierCost;
    CostCase swept_cost_ = kFrontierCost;  ///< kind of frames timed by the shown sweep
    std::optional<PinnedSettings> seen_pinned_;
    const EngineProfile* seen_engine_ = nullptr;
    double seen_angle_deg_ = 0;     ///< reference angle of the engine's numbers
    bool marks_are_known_ = false;  ///< all marked settings are measured, or cannot be measured
    bool measures_mark_ = false;    ///< the measurement started last is of marked settings
    Settings compared_;             ///< settings last compared with the sweep's
    std::string compared_scene_;
    bool fresh_ = true;  ///< results have arrived since facts_ was made
    std::unique_ptr<MeasuringThread> thread_;
};

}  // namespace si
