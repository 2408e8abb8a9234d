// Reads a scene on a thread of its own, while the editor goes on with the one that it has.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "app/base/job.h"
#include "renderer/gltf/gltf.h"

namespace si {

/// Makes a scene of a name or path, as load_scene() does; called on another thread. It reports progress through the
/// options and throws when that returns false.
using SceneReader = std::function<Scene(const std::string&, const GltfOptions&)>;

/// Of something that has come so far (0..1) in `passed` seconds; 0 while it is too early to say.
double remaining_seconds(double passed, double progress);

/// One scene is wanted at a time, as Job has it.
class SceneLoading {
public:
    /// Empty: load_scene().
    explicit SceneLoading(SceneReader read = {});

    /// In place of what was wanted before. @throws std::system_error when there is no thread to be had.
    /// @param file_scene which scene of a glTF file; -1: its default
    void start(const std::string& name_or_path, int file_scene = -1);
    /// Nothing is wanted any more.
    void cancel() { job_.drop(); }

    /// What is wanted and not there yet; empty: nothing.
    std::string wanted() const { return job_.wanted() ? name_ : std::string(); }
    /// Of the wanted scene, 0..1.
    double progress() const { return job_.progress().value_or(0); }
    /// Until the wanted scene is there, as it went so far; 0: too early to say.
    double seconds_left() const;
    /// A thread is reading, wanted or not.
    bool busy() const { return job_.busy(); }
    /// poll() has something to do.
    bool ended() const { return job_.ended(); }
    /// The progress differs from that last asked for, or poll() has something to do.
    bool moved() const { return job_.moved(); }

    struct Outcome {
        std::string name;            ///< as given to start()
        std::optional<Scene> scene;  ///< posed at its start; none: it failed
        std::string error;
    };
    /// The wanted scene or why there is none, once.
    std::optional<Outcome> poll();
    /// Until ended(), or nothing runs.
    void wait() const { job_.wait(); }

private:
    SceneReader read_;
    std::string name_;  ///< of what was started last
    std::chrono::steady_clock::time_point began_;
    Job<Scene> job_;
};

}  // namespace si
