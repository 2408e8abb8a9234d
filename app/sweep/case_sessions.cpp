#include "app/sweep/case_sessions.h"

#include "renderer/scenes/builtin.h"

namespace si {
namespace {

/// Returns true if the scene may reject a value of this setting (an unknown camera, object, animation).
bool depends_on_scene(const std::string& key) {
    return key == "scene.index" || key == "scene.animation" || key == "camera.index" || key.starts_with("object.");
}

}  // namespace

CaseSessions::Prepared CaseSessions::prepare(const Values& values) {
    SessionPlan plan = plan_;
    for (const auto& [key, value] : values) {
        plan.sets.push_back(key + "=" + value);
        apply_set(plan.settings, plan.sets.back());
    }
    const SceneSettings& moment = plan.settings.scene;
    auto known = loaded_.find(file_choices(moment));
    if (known == loaded_.end()) {
        Scene scene = load_scene(plan.scene_name, scene_options(plan));
        std::string remark = pose_scene(scene, moment);
        known = loaded_.emplace(file_choices(moment), Loaded{std::move(scene), moment, std::move(remark)}).first;
    }
    Loaded& loaded = known->second;
    if (loaded.posed != moment) {
        loaded.remark = pose_scene(loaded.scene, moment);
        loaded.posed = moment;
    }
    ComposedSettings composed = compose_settings(plan, loaded.scene, moment);
    hide_objects(loaded.scene, hidden_paths(composed.settings));
    if (!loaded.remark.empty()) composed.notes.push_back(loaded.remark);
    return {loaded.scene, std::move(composed.settings), std::move(composed.notes)};
}

void CaseSessions::check(const std::vector<SweepAxis>& axes) {
    std::vector<Values> cases(1);
    for (const SweepAxis& axis : axes) {
        const std::size_t taken = depends_on_scene(axis.key) ? axis.values.size() : 1;
        std::vector<Values> more;
        for (const Values& values : cases)
            for (std::size_t i = 0; i < taken; ++i) {
                more.push_back(values);
                more.back().emplace_back(axis.key, axis.values[i]);
            }
        cases = std::move(more);
    }
    for (const Values& values : cases) prepare(values);
}

}  // namespace si
