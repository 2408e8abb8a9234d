// The editor's search for the least bias.
#pragma once

#include <memory>

#include "app/base/job.h"
#include "app/sweep/tuning.h"
#include "ui/state/editor_ui.h"

namespace si {

struct TuningOutcome {
    std::optional<Settings> found;
    std::vector<TunedFamily> families;  ///< all that were tried, side by side
    std::string text;                   ///< what it is and costs, or why there is none
    bool failed = false;                ///< `text` is an error
    std::uint64_t scene = 0;
    Settings settings;  ///< that were searched from
    int width = 0, height = 0;
    /// Whether the families are what these settings would give, whichever bias they have now.
    bool is_about(const Settings& now, int now_width, int now_height) const;
};

class EditorTuner {
public:
    /// In place of one that is under way.
    void start(const Scene& scene, const Settings& settings, int width, int height, const TuneRequest& request);
    void cancel() { job_.cancel(); }
    bool running() const { return job_.busy(); }
    bool moved() const { return job_.moved(); }
    std::optional<SearchProgress> facts() const { return job_.progress(); }
    void wait() const { job_.wait(); }
    /// What became of it, once.
    std::optional<TuningOutcome> end();

private:
    TuningOutcome about_;  ///< what is searched for, and not yet what was found
    Job<TuningOutcome, SearchProgress> job_;
};

}  // namespace si
