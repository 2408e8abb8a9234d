// Loading of a scene on a background thread while the editor shows the present one.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "app/base/job.h"
#include "app/base/time_left.h"
#include "renderer/gltf/gltf.h"

namespace si {

/// Function that reads a scene by name or path, like load_scene(). Runs on another thread, reports progress through the
/// options, and throws when the progress callback returns false.
using SceneReader = std::function<Scene(const std::string&, const GltfOptions&)>;

/// Background job that loads a scene while the editor shows another one. It loads one scene at a time.
class SceneLoading : public Job<Scene> {
public:
    /// Makes a loader that loads nothing yet. @param read function that reads a scene; empty: load_scene()
    explicit SceneLoading(SceneReader read = {});

    /// Starts loading a scene in the background; an earlier load is cancelled. @param file choices for the scene's
    /// file: index of its scene, up axis and unit @throws std::system_error when the system has no thread left
    void start(const std::string& name_or_path, const FileChoices& file = {});
    /// Cancels the loading of the scene; poll() then returns nothing.
    void cancel() { drop(); }

    /// Returns the name of the scene that is being loaded; empty: none.
    std::string wanted() const { return Job::wanted() ? name_ : std::string(); }
    /// Returns the progress of the scene that is being loaded, 0..1.
    double progress() const { return Job::progress().value_or(0); }
    /// Returns the estimated seconds until the scene is loaded; 0: too early to estimate, or nothing is loading.
    double seconds_left() const;

    /// Outcome of loading a scene in the background: the scene, or the reason of the failure.
    struct Outcome {
        std::optional<Scene> scene;  ///< posed at the start of its animation; none: loading failed
        std::string error;
    };
    /// Returns the loaded scene or the failure, once; nothing while the scene is loading or after a cancellation.
    std::optional<Outcome> poll();

private:
    SceneReader read_;
    std::string name_;  ///< name or path given to the last start()
    TimeLeft left_;
};

}  // namespace si
