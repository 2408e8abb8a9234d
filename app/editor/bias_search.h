// Background search for the smallest bias without acne.
#pragma once

#include <memory>

#include "app/base/job.h"
#include "app/sweep/tuning.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Result of a finished search for the least bias, with the settings that it started from.
struct BiasSearchResult {
    std::optional<Settings> found;
    std::vector<TunedFamily> families;  ///< result of each kind of bias
    std::string text;                   ///< the bias and its cost, or the reason why there is none
    bool failed = false;                ///< `text` is an error
    std::uint64_t scene = 0;
    Settings settings;  ///< settings that the search started from
    int width = 0, height = 0;
    /// Returns true if a bias search from these settings and this size would give the same result. The bias in `now`
    /// does not matter, since the search replaces it.
    bool is_about(const Settings& now, int now_width, int now_height) const;
};

/// Background search for the least bias without acne: one at a time, on a thread of its own.
class EditorBiasSearch {
public:
    /// Starts a search for the least bias and cancels the search under way. @param width, height picture, pixels
    void start(const Scene& scene, const Settings& settings, int width, int height, const TuneRequest& request);
    void cancel() { job_.cancel(); }
    bool running() const { return job_.busy(); }
    bool moved() const { return job_.moved(); }
    std::optional<SearchProgress> facts() const { return job_.progress(); }
    void wait() const { job_.wait(); }
    /// Returns the result of a bias search that has ended, once; nothing while the search runs.
    std::optional<BiasSearchResult> poll();

private:
    BiasSearchResult about_;  ///< arguments of the search under way
    Job<BiasSearchResult, SearchProgress> job_;
};

}  // namespace si
