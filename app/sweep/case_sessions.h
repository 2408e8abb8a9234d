// Sessions of the cases of a sweep: each axis value is applied like one more --set.
#pragma once

#include <map>

#include "app/session/session.h"
#include "renderer/measure/axes.h"

namespace si {

/// Loader of scenes and composer of settings for the cases of a sweep (combinations of settings). Scenes stay loaded
/// between cases.
class CaseSessions {
public:
    using Values = std::vector<std::pair<std::string, std::string>>;  ///< SweepCase::values

    /// Makes the loader for a sweep's cases, which loads nothing yet. @param plan scene and settings that all cases
    /// share
    explicit CaseSessions(SessionPlan plan) : plan_(std::move(plan)) {}

    /// Adds a scene that is loaded already, so that prepare() need not read its file. @param as scene settings with
    /// which the scene was loaded and posed: index in the file, up axis, unit, animation, time, placement
    void add_scene(Scene scene, const SceneSettings& as) {
        loaded_.insert_or_assign(file_choices(as), Loaded{std::move(scene), as, {}});
    }

    /// Scene and settings with which one case (combination of settings) of a sweep is drawn.
    struct Prepared {
        const Scene& scene;  ///< valid until the next call of prepare()
        Settings settings;
        std::vector<std::string> notes;
    };
    /// Prepares one case of a sweep for drawing: poses the scene and composes the settings. Reads the scene's file only
    /// at the first use of each combination of scene.index, scene.up and scene.unit.
    /// @param values key and value of each varied setting @throws UsageError, Error as open_session()
    Prepared prepare(const Values& values);

    /// Checks that the scene has what the axes vary, such as animations, cameras and objects, so that errors appear
    /// before a sweep's first measurement. @throws UsageError, Error
    void check(const std::vector<SweepAxis>& axes);

private:
    /// Loaded scene of a sweep with the scene settings under which it is posed.
    struct Loaded {
        Scene scene;
        SceneSettings posed;
        std::string remark;  ///< note of pose_scene()
    };
    SessionPlan plan_;
    std::map<FileChoices, Loaded> loaded_;  ///< by scene.index, scene.up and scene.unit
};

}  // namespace si
