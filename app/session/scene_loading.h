// Reads a scene on a thread of its own, while the editor goes on with the one that it has.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "renderer/gltf/gltf.h"

namespace si {

/// Makes a scene of a name or path, as load_scene() does; called on another thread. It reports progress through the
/// options and throws when that returns false.
using SceneReader = std::function<Scene(const std::string&, const GltfOptions&)>;

/// Of something that has come so far (0..1) in `passed` seconds; 0 while it is too early to say.
double remaining_seconds(double passed, double progress);

/// One scene is wanted at a time, and one thread reads at a time: what is no longer wanted is cancelled, and the next
/// one starts when it has ended. Nothing but wait() and the destructor blocks.
class SceneLoading {
public:
    /// Empty: load_scene().
    explicit SceneLoading(SceneReader read = {});
    /// Cancels and joins.
    ~SceneLoading();
    SceneLoading(const SceneLoading&) = delete;
    SceneLoading& operator=(const SceneLoading&) = delete;

    /// In place of what was wanted before. @throws std::system_error when there is no thread to be had.
    /// @param file_scene which scene of a glTF file; -1: its default
    void start(const std::string& name_or_path, int file_scene = -1);
    /// Nothing is wanted any more.
    void cancel();

    /// What is wanted and not there yet; empty: nothing.
    std::string wanted() const;
    /// Of the wanted scene, 0..1.
    double progress() const;
    /// Until the wanted scene is there, as it went so far; 0: too early to say.
    double seconds_left() const;
    /// A thread is reading, wanted or not.
    bool busy() const { return job_ != nullptr; }
    /// A thread is done: poll() has something to do.
    bool ended() const;

    struct Outcome {
        std::string name;            ///< as given to start()
        std::optional<Scene> scene;  ///< posed at its start; none: it failed
        std::string error;
    };
    /// The wanted scene or why there is none, once.
    std::optional<Outcome> poll();
    /// Until ended(), or nothing runs.
    void wait() const;

private:
    struct Job;
    struct Wish {
        std::string name;
        int file_scene = -1;
    };
    void launch(const Wish& wish);

    SceneReader read_;
    std::unique_ptr<Job> job_;
    std::optional<Wish> next_;  ///< wanted as soon as the cancelled job has ended
};

}  // namespace si
