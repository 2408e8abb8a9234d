// Sweeps and the measuring of the present settings, as the frontier panel shows them.
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

class EditorSweep {
public:
    /// @param state_folder where the journal of a sweep is kept, so that it can go on in a later run; empty: nowhere
    explicit EditorSweep(const std::filesystem::path& state_folder);
    /// Cancels and joins.
    ~EditorSweep();
    EditorSweep(const EditorSweep&) = delete;
    EditorSweep& operator=(const EditorSweep&) = delete;

    /// Begins the sweep, or goes on with it when it is the one that was interrupted. @throws UsageError, Error
    void start(const Scene& scene, const std::string& scene_name, const Settings& settings,
               const SweepRequest& request);
    /// Ends the sweep under way; what is measured stays.
    void cancel();
    /// Measures these settings unless they are measured already; a change cancels what is under way.
    void follow(const Scene& scene, const std::string& scene_name, const Settings& settings, const SweepPanel& panel);
    /// Nobody looks at the present settings' dot any more.
    void unfollow();
    /// Shows what is in the folder of a sweep, and sets the panel to what it varies. @throws Error
    void open(const std::filesystem::path& folder, SweepPanel& panel);
    /// Writes journal, pictures, tables and report of the sweep that is shown. @throws Error
    void save(const std::filesystem::path& folder) const;

    /// Something is being measured, or will be.
    bool busy() const;
    /// update() has news.
    bool moved() const;
    /// Until nothing is being measured.
    void wait() const;
    /// Takes the news and follows the chosen axes. Returns whether facts() changed.
    bool update(const EditorState& state);
    const SweepFacts& facts() const { return facts_; }
    /// The settings that all cases of the shown sweep share; null when there is none.
    const Settings* base() const { return shown_ ? &shown_->spec.base : nullptr; }

private:
    struct Shown {
        SweepSpec spec;
        SweepPlan plan;
        std::filesystem::path folder;
    };
    MeasuringThread& thread();
    std::shared_ptr<const Scene> copy_of(const Scene& scene);
    void show(const SweepSpec& spec, const SweepPlan& plan, const std::filesystem::path& folder);
    /// What was measured of settings, in whole.
    struct Finished {
        MeasuringThread::Picture of;
        CaseNumbers numbers;
    };
    void take_news();
    void note_finished(const Finished& finished);
    struct Earlier {
        const Finished* is = nullptr;  ///< null: nothing of the same picture was measured before
        bool pinned = false;
    };
    /// What the present numbers are compared with: the pinned settings, else those measured last.
    Earlier earlier(const EditorState& state) const;
    void compare_settings(const EditorState& state);
    /// Removes folders that this run made and in which no case was finished; ones still in use stay for later.
    void drop_empty();

    std::filesystem::path parent_;
    bool temporary_ = false;
    std::set<std::filesystem::path> made_;  ///< by this run
    std::shared_ptr<const Scene> scene_;    ///< the last one that was handed over
    std::optional<MeasuringThread::Picture> followed_;
    std::unique_ptr<const Shown> shown_;
    std::optional<SweepResults> results_;
    std::optional<CaseNumbers> present_;
    std::vector<Finished> finished_;  ///< the last ones, the present one at the end
    SweepFacts facts_;
    std::uint64_t seen_ = 0;        ///< version of the thread's news
    std::uint64_t seen_sweep_ = 0;  ///< News::sweep as last seen
    bool opened_ = false;           ///< what is shown is from a folder, not from the thread
    std::string seen_cost_, seen_error_;
    CostCase seen_timed_ = kDefaultCost;
    CostCase swept_cost_ = kDefaultCost;  ///< of which frames the shown sweep has times
    std::optional<PinnedSettings> seen_pinned_;
    Settings compared_;  ///< as last held against the sweep's
    std::string compared_scene_;
    bool fresh_ = true;  ///< something came since facts_ was made
    std::unique_ptr<MeasuringThread> thread_;
};

}  // namespace si
