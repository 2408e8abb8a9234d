// The editor's search for the least bias: a thread with an OpenGL context of its own, so that the editor never waits.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "app/tuning.h"
#include "ui/editor_ui.h"

namespace si {

class EditorTuner {
public:
    EditorTuner() = default;
    /// Cancels and joins.
    ~EditorTuner() = default;
    EditorTuner(const EditorTuner&) = delete;
    EditorTuner& operator=(const EditorTuner&) = delete;

    /// In place of one that is under way.
    void start(const Scene& scene, const Settings& settings, int width, int height, const TuneWish& wish);
    void cancel();

    bool running() const { return thread_.joinable(); }
    /// facts() differ from those last asked for, or end() has something.
    bool moved() const;
    /// Nothing unless a search is under way.
    std::optional<TuneFacts> facts() const;

    struct Outcome {
        std::optional<Settings> found;
        std::string text;     ///< what it is and costs, or why there is none
        bool failed = false;  ///< `text` is an error
        std::uint64_t scene = 0;
        Settings settings;    ///< that were searched from
    };
    /// What became of the search, once; joins its thread.
    std::optional<Outcome> end();
    void wait() const;

private:
    struct Shared {
        std::mutex mutex;
        TuneFacts facts{"the present bias", 0};
        std::optional<Outcome> outcome;
        bool moved = true;
    };
    std::shared_ptr<Shared> shared_;
    std::jthread thread_;  ///< last: ends before what it uses
};

}  // namespace si
