// Background searches and measurements of the editor. Each has a copy of the scene, an OpenGL context and a renderer.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "app/base/job.h"
#include "app/base/time_left.h"
#include "app/context/headless_context.h"
#include "renderer/advise/trial.h"
#include "renderer/measure/axes.h"
#include "renderer/reference/reference_task.h"
#include "renderer/render/renderer.h"
#include "ui/panels/tune_controls.h"

namespace si {

/// Subject of a background search: scene, settings, picture size, and the engine that is to draw the found settings. A
/// result is valid for its subject only.
struct SearchSubject {
    std::uint64_t scene = 0;  ///< Scene::id
    Settings settings;
    int width = 0;                          ///< pixels of the picture
    int height = 0;                         ///< pixels of the picture
    const EngineProfile* engine = nullptr;  ///< engine that is to draw the found settings; null: none
    /// Returns true if measurements of this subject (scene, settings, picture size) and of `other` give the same
    /// result.
    bool measures_like(const SearchSubject& other) const {
        return scene == other.scene && width == other.width && height == other.height &&
               measured_settings(settings) == measured_settings(other.settings);
    }
    /// Returns true if searches about this subject (scene, settings, picture size, engine) and about `other` try the
    /// same changes and give the same result.
    bool searches_like(const SearchSubject& other) const { return engine == other.engine && measures_like(other); }
    /// Returns true if frames of this subject (scene, settings, picture size) and of `other` are the same, overlays
    /// included.
    bool draws_like(const SearchSubject& other) const {
        return scene == other.scene && width == other.width && height == other.height && settings == other.settings;
    }
};

/// Background search, one at a time, which keeps the last result with its subject (scene, settings, picture size).
/// Results so far appear while a search runs, and stay when it is cancelled. @tparam T result of a search
template <typename T>
class EditorSearch : public Job<T, SearchProgress> {
    using Base = Job<T, SearchProgress>;

public:
    /// Function that shows the results of a search so far.
    using Show = std::function<void(T)>;

    /// Outcome of a background search that has ended: a result, or the reason why there is none.
    struct End {
        bool failed = false;  ///< true: the search ended with an exception
        std::string problem;  ///< error, or message after cancel(); empty: there is a result
    };

    /// Makes a background search that does not run yet. @param cancelled message after cancel()
    explicit EditorSearch(std::string cancelled) : cancelled_(std::move(cancelled)) {}
    /// Starts a background search with a copy of the scene, and cancels the search under way. `work` gets an OpenGL
    /// context and a renderer of its own, and the settings of the subject. @param first name of the first step, for the
    /// progress bar
    void start(const Scene& scene, const SearchSubject& of, const char* first,
               std::function<T(const SearchTools&, const Settings&, const Show&)> work) {
        started_ = of;
        partial_ = std::make_shared<Partial>();
        Base::start(
            [copy = std::make_shared<const Scene>(scene), of, work = std::move(work), partial = partial_](
                const Workers& workers, const auto& report) {
                const HeadlessContext context;
                Renderer renderer;
                ReferenceCache cache;
                const TimeLeft left;
                const auto report_step = [&](double share, const std::string& about) {
                    report({about, share, left.seconds(share)});
                };
                const Show show = [&](T so_far) {
                    const std::lock_guard lock(partial->mutex);
                    partial->value = std::move(so_far);
                };
                T result = work({renderer, *copy, of.width, of.height, cache, workers, report_step, of.engine},
                                of.settings, show);
                if (workers.stop.stop_requested()) show(result);  // cancelled work has no outcome
                return result;
            },
            {first, 0});
    }
    /// Stores the result of a background search that has ended, or its results so far. Returns the outcome of an ended
    /// search once; nothing while it runs.
    std::optional<End> poll() {
        take_partial();
        auto outcome = Base::poll();
        if (!outcome) return {};
        if (outcome->value) {
            found_ = std::move(outcome->value);
            of_ = started_;
        }
        const bool failed = outcome->problem != nullptr;
        return End{failed, failed               ? exception_message(outcome->problem)
                           : outcome->cancelled ? cancelled_
                                                : std::string()};
    }
    /// Cancels the background search under way, and drops the last result.
    void forget() {
        Base::cancel();
        found_.reset();
        partial_ = std::make_shared<Partial>();
    }

    /// Returns the latest result, also of a background search that still runs or was cancelled; null: none.
    const T* found() const { return found_ ? &*found_ : nullptr; }
    /// Returns the result of the last background search if it is about this scene, else null. @param scene Scene::id
    const T* found_in(std::uint64_t scene) const { return of_.scene == scene ? found() : nullptr; }
    /// Returns the subject (scene, settings, picture size) of the result that found() returns.
    const SearchSubject& subject() const { return of_; }

private:
    /// Results so far of the background search under way, which its thread writes and poll() reads.
    struct Partial {
        std::mutex mutex;
        std::optional<T> value;
    };
    void take_partial() {
        const std::lock_guard lock(partial_->mutex);
        if (!partial_->value) return;
        found_ = std::exchange(partial_->value, std::nullopt);
        of_ = started_;
    }

    std::string cancelled_;
    std::shared_ptr<Partial> partial_ = std::make_shared<Partial>();
    SearchSubject started_;  ///< subject of the search under way
    SearchSubject of_;
    std::optional<T> found_;
};

}  // namespace si
