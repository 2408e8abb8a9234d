// Common base of the editor's background searches.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "app/base/job.h"
#include "ui/panels/tune.h"

namespace si {

/// Base of the editor's background searches: one search at a time, and the result of the last one.
/// @tparam Found result of a search
template <typename Found>
class EditorSearch {
public:
    /// Cancels the search under way.
    void cancel() { job_.cancel(); }
    /// Returns true while a search is under way.
    bool running() const { return job_.busy(); }
    /// Returns true if progress or result have changed since the last poll().
    bool moved() const { return job_.moved(); }
    /// Waits for the search under way.
    void wait() const { job_.wait(); }
    /// Stores the result of a search that has ended. Returns true if a search has ended. @param problem receives the
    /// reason of a failure
    bool poll(std::string& problem) {
        auto outcome = job_.poll();
        if (!outcome) return false;
        if (outcome->cancelled) problem = cancelled_;
        if (outcome->problem) problem = exception_message(outcome->problem);
        if (outcome->value) found_ = std::move(outcome->value);
        return true;
    }

protected:
    /// Makes a search that does not run yet. @param cancelled message after cancel()
    explicit EditorSearch(std::string cancelled) : cancelled_(std::move(cancelled)) {}
    ~EditorSearch() = default;

    Job<Found, SearchProgress> job_;
    std::optional<Found> found_;

private:
    std::string cancelled_;
};

}  // namespace si
