#include "app/editor/frame_loop.h"

#include <algorithm>
#include <utility>

#include "app/base/output.h"
#include "app/editor/panel_effects.h"
#include "app/editor/wishes.h"
#include "app/report/views.h"
#include "renderer/scene/stand_in.h"

namespace si {

void FrameLoop::fill(EditorFrame& f) const {
    f.driver = drawn_ ? &renderer_.driver() : nullptr;
    f.result = drawn_ ? &result_ : nullptr;
    readings_.fill(f);
    if (drawn_) {
        f.truth = truth_.facts(result_, drawn_settings_.view.light);
        f.error = result_.error.get();
    }
    f.against = against_.facts();
    f.shader_log = shader_log_;
    f.effects = effects_;
}

void FrameLoop::clear() {
    drawn_ = false;
    readings_.clear();
    truth_.clear();
    against_.clear();
    frame_effects_.clear(), effects_.clear();
}

bool FrameLoop::update(const Scene& scene, const EditorActions& actions, const ComparisonFacts* comparison) {
    bool changed = false;
    try {
        if (!rehearsing()) changed |= readings_.update_frozen(renderer_, scene, state_, actions);
    } catch (const std::exception& e) {
        report(state_, e.what());
        state_.frozen.reset();
    }
    const bool drawn = draw(scene, actions);
    // Numbers are of the picture shown, whose settings are no longer those of the state.
    if (!rehearsing()) changed |= follow_readings(scene, actions, drawn);
    try {
        changed |= follow_truth(scene, actions, drawn, comparison);
    } catch (const std::exception& e) {
        report(state_, e.what());
        changed = true;
    }
    changed |= follow_effects(scene, actions, drawn);
    return changed || drawn;
}

bool FrameLoop::follow_effects(const Scene& scene, const EditorActions& actions, bool drawn) {
    if (drawn) frame_effects_.clear();
    const bool posed = drawn && std::exchange(posed_scene_, scene.id) != scene.id;
    if (!actions.want_effects || !drawn_) {
        const bool had = !effects_.empty();
        effects_.clear();
        return had;
    }
    if (frame_effects_.empty()) {
        frame_effects_ = frame_effects(scene, drawn_settings_, result_, request_.forced);
        frame_effects_.push_back(posing_effect(scene, drawn_settings_.scene, posed));
    }
    std::vector<Effect> effects = frame_effects_;
    for (Effect& effect : panel_effects(state_, actions)) effects.push_back(std::move(effect));
    effects.push_back(truth_effect(truth_.facts(result_, drawn_settings_.view.light)));
    if (effects == effects_) return false;
    effects_ = std::move(effects);
    return true;
}

bool FrameLoop::draw(const Scene& scene, const EditorActions& actions) {
    FrameRequest wanted;
    wanted.width = std::max(1, actions.scene_width);
    wanted.height = std::max(1, actions.scene_height);
    wanted.outputs.colour = true;
    wanted.outputs.shadow_map = actions.want_map;
    wanted.outputs.overlay = true;
    wanted.outputs.map_coordinates = actions.want_links;
    wanted.outputs.texels_read = actions.want_exact_texels;
    wanted.outputs.error = actions.want_error;
    wanted.outputs.true_colour = state_.against.view != AgainstView::Off && state_.against.truth;
    wanted.timing = actions.want_timing;
    wanted.forced = state_.effects.forced;
    if (state_.frozen) wanted.map_camera = MapCamera{state_.frozen->camera, state_.frozen->seen_m};
    wanted.truth = truth_.picture(state_.settings.view.light);
    wanted.traced = truth_.pictures();
    wanted.light_maps = truth_.light_maps();
    // Held against another, the picture is one pane.
    Settings settings = state_.settings;
    if (state_.against.view != AgainstView::Off) settings.view.panes = int(Panes::One);
    const bool same = drawn_ && renderer_.holds(result_) && !shaders_changed_ && wanted.width == request_.width &&
                      wanted.height == request_.height && wanted.outputs == request_.outputs &&
                      wanted.timing == request_.timing && wanted.forced == request_.forced &&
                      wanted.truth == request_.truth && wanted.traced == request_.traced &&
                      wanted.light_maps == request_.light_maps && wanted.map_camera == request_.map_camera &&
                      drawn_settings_ == settings && drawn_scene_ == scene.id;
    if (actions.scene_width < 1 || (same && !rehearsing())) return false;
    if (same) rehearsals_->learn(0);  // settings are again those of the picture shown
    if (same || waits_for_programs(scene, settings, wanted)) return false;
    request_ = wanted;
    drawn_settings_ = settings;
    drawn_scene_ = scene.id;
    shaders_changed_ = false;
    try {
        result_ = renderer_.render(scene, drawn_settings_, request_);
        drawn_ = true;
        problem_.clear();
        learn_programs(scene);
    } catch (const std::exception& e) {
        drawn_ = false;
        if (problem_ != e.what()) report(state_, e.what());
        problem_ = e.what();
    }
    shader_log_ = renderer_.shader_log();
    for (const std::string& message : renderer_.take_gl_messages()) state_.log.add(LogKind::Warning, message);
    return true;
}

bool FrameLoop::waits_for_programs(const Scene& scene, const Settings& settings, const FrameRequest& wanted) {
    programs_ = 0;
    if (!rehearsals_) return false;
    if (drawn_scene_ != scene.id && !(scene.rig && scene.rig == drawn_rig_)) {
        rehearsals_->forget(), foreseen_.clear();
        drawn_rig_ = scene.rig;
        return false;
    }
    if (!drawn_ || drawn_scene_ != scene.id || shaders_changed_ || !renderer_.holds(result_)) return false;
    try {
        programs_ = renderer_.programs_key(scene, settings, wanted);
        if (rehearsals_->knows(programs_)) return false;
        if (rehearsals_->is_wanted(programs_)) return true;
        auto stage = std::make_shared<const Scene>(stand_in(scene, settings));
        rehearsals_->want({.key = programs_, .scene = std::move(stage), .settings = settings, .request = wanted});
        return true;
    } catch (const std::exception&) {
        return false;  // drawing it says what is wrong
    }
}

void FrameLoop::learn_programs(const Scene& scene) {
    if (!rehearsals_) return;
    if (programs_ == 0 && !foreseen_.empty()) return rehearsals_->learn(0);
    if (programs_ == 0) programs_ = renderer_.programs_key(scene, drawn_settings_, request_);
    rehearsals_->learn(programs_);
    if (!foreseen_.insert(programs_).second) return;
    // A hover asks for map coordinates, a click for a probe, the map viewer for its picture.
    Rehearsal next{.key = 0, .scene = {}, .settings = drawn_settings_, .request = request_, .probe = true};
    next.request.outputs.shadow_map = next.request.outputs.map_coordinates = next.request.outputs.texels_read = true;
    next.key = renderer_.programs_key(scene, drawn_settings_, next.request);
    next.scene = std::make_shared<const Scene>(stand_in(scene, drawn_settings_));
    rehearsals_->foresee(std::move(next));
}

bool FrameLoop::follow_readings(const Scene& scene, const EditorActions& actions, bool drawn) {
    if (!drawn_) {
        readings_.clear();
        return false;
    }
    try {
        return readings_.update(renderer_, scene, state_, actions, request_, result_, drawn);
    } catch (const std::exception& e) {
        readings_.clear();
        report(state_, e.what());
        return true;
    }
}

bool FrameLoop::follow_truth(const Scene& scene, const EditorActions& actions, bool drawn,
                             const ComparisonFacts* comparison) {
    if (!drawn_) {
        truth_.clear();
        against_.clear();
        return false;
    }
    const EditorTruth::Wishes wishes{actions.cancel_truth, actions.save_error};
    bool changed = truth_.update(renderer_, scene, drawn_settings_, request_, result_, drawn, wishes);
    if (const std::string remark = truth_.take_remark(); !remark.empty()) state_.log.add(LogKind::Info, remark);
    changed |= against_.update(renderer_, scene, state_, request_, result_, drawn, comparison);
    return changed;
}

void FrameLoop::save_map(const Scene& scene, const std::string& path) {
    require_writable(path);
    const bool camera = state_.settings.view.map_source == int(MapSource::Camera);
    const View view = find_view(camera ? "camera-depth" : "shadow-map");
    check_view_file(view, path);
    FrameRequest request = request_;
    request.timing = false;
    write_view(renderer_, scene, state_.settings, request, view, path);
    state_.log.add(LogKind::Info, "Saved " + path);
}

}  // namespace si
