// What the editor's searches in the background have in common.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "app/base/job.h"
#include "ui/panels/tune.h"

namespace si {

/// One search at a time, and what the last one found. @tparam Found what it ends with
template <typename Found>
class EditorSearch {
public:
    void cancel() { job_.cancel(); }
    bool running() const { return job_.busy(); }
    bool moved() const { return job_.moved(); }
    void wait() const { job_.wait(); }
    /// Takes what is done. Returns whether there was something; why it failed goes to `problem`.
    bool poll(std::string& problem) {
        auto outcome = job_.poll();
        if (!outcome) return false;
        if (outcome->cancelled) problem = cancelled_;
        if (outcome->problem) problem = exception_message(outcome->problem);
        if (outcome->value) found_ = std::move(outcome->value);
        return true;
    }

protected:
    /// @param cancelled what is said where it was
    explicit EditorSearch(std::string cancelled) : cancelled_(std::move(cancelled)) {}
    ~EditorSearch() = default;

    Job<Found, TuneFacts> job_;
    std::optional<Found> found_;

private:
    std::string cancelled_;
};

}  // namespace si
