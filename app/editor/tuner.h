// The editor's search for the least bias.
#pragma once

#include <memory>

#include "app/base/context_job.h"
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

class EditorTuner : public ContextJob<TuneFacts, TuningOutcome> {
public:
    /// In place of one that is under way.
    void start(const Scene& scene, const Settings& settings, int width, int height, const TuneWish& wish);
};

}  // namespace si
