#include "app/session/scene_loading.h"

#include <utility>

#include "app/session/session.h"
#include "renderer/scenes/builtin.h"

namespace si {

SceneLoading::SceneLoading(SceneReader read) : read_(std::move(read)) {
    if (!read_) read_ = [](const std::string& name, const GltfOptions& options) { return load_scene(name, options); };
}

void SceneLoading::start(const std::string& name_or_path, const FileChoices& file) {
    name_ = name_or_path;
    left_ = {};
    Job::start([read = read_, name = name_or_path, file](const Workers& workers, const auto& report) {
        GltfOptions options;
        options.file = file;
        options.progress = [&](double fraction) {
            report(fraction);
            return !workers.stop.stop_requested();
        };
        const StampedFile read_file = stamped(name);
        Scene scene = read(name, options);
        if (scene.files.empty() && read_file.stamp && !is_builtin_scene(name)) scene.files = {read_file};
        pose_scene(scene, {});
        return scene;
    });
}

double SceneLoading::seconds_left() const {
    return Job::wanted() ? left_.seconds(progress()) : 0;
}

std::optional<SceneLoading::Outcome> SceneLoading::poll() {
    auto ended = Job::poll();
    if (!ended || ended->cancelled) return {};
    return Outcome{.scene = std::move(ended->value), .error = exception_message(ended->problem)};
}

}  // namespace si
