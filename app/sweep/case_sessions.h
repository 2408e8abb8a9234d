// The cases of a sweep as the command line would open them: each axis' value as one more --set.
#pragma once

#include <map>

#include "app/session/session.h"
#include "renderer/measure/axes.h"

namespace si {

class CaseSessions {
public:
    using Values = std::vector<std::pair<std::string, std::string>>;  ///< SweepCase::values

    explicit CaseSessions(SessionPlan plan) : plan_(std::move(plan)) {}

    /// A scene that is read already. @param as how it was chosen and stands
    void keep(Scene scene, const SceneSettings& as) {
        loaded_.insert_or_assign(as.index, Loaded{std::move(scene), as, {}});
    }

    struct Prepared {
        const Scene& scene;  ///< until the next call
        Settings settings;
        std::vector<std::string> notes;
    };
    /// Reads the scene where scene.index calls for another one, and poses it. @throws UsageError, Error as
    /// open_session()
    Prepared prepare(const Values& values);

    /// Prepares what differs in scene, camera or objects among the cases of `axes`, so that what --set would refuse is
    /// refused before anything is measured. @throws UsageError, Error
    void check(const std::vector<SweepAxis>& axes);

private:
    struct Loaded {
        Scene scene;
        SceneSettings posed;
        std::string remark;  ///< of pose_scene()
    };
    SessionPlan plan_;
    std::map<int, Loaded> loaded_;  ///< by scene.index
};

}  // namespace si
