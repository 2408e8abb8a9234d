// Background search for the smallest bias without acne.
#pragma once

#include <memory>

#include "app/base/job.h"
#include "app/sweep/tuning.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Result of a finished search.
struct BiasSearchResult {
    std::optional<Settings> found;
    std::vector<TunedFamily> families;  ///< result of each kind of bias
    std::string text;                   ///< the bias and its cost, or the reason why there is none
    bool failed = false;                ///< `text` is an error
    std::uint64_t scene = 0;
    Settings settings;  ///< settings that the search started from
    int width = 0, height = 0;
    /// Returns true if a search from these settings would give the same families. Their bias does not matter.
    bool is_about(const Settings& now, int now_width, int now_height) const;
};

/// One search for a bias at a time, on a thread of its own.
class EditorBiasSearch {
public:
    /// Starts a search and cancels the one under way.
    void start(const Scene& scene, const Settings& settings, int width, int height, const TuneRequest& request);
    void cancel() { job_.cancel(); }
    bool running() const { return job_.busy(); }
    bool moved() const { return job_.moved(); }
    std::optional<SearchProgress> facts() const { return job_.progress(); }
    void wait() const { job_.wait(); }
    /// Returns the result of a search that has ended, once.
    std::optional<BiasSearchResult> end();

private:
    BiasSearchResult about_;  ///< arguments of the search under way
    Job<BiasSearchResult, SearchProgress> job_;
};

}  // namespace si
