#include "app/editor/frame_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/base/output.h"
#include "app/editor/artefact_spots.h"
#include "app/editor/panel_effects.h"
#include "app/report/number_watch.h"
#include "app/report/views.h"
#include "renderer/gl/trouble.h"
#include "renderer/scene/stand_in.h"

namespace si {

FrameFacts FrameLoop::facts() const {
    FrameFacts f;
    if (drawn_) {
        f.driver = renderer_.driver();
        f.result = result_;
        if (result_.smooth.texture != 0 && !against_.facts() && !pinned_)  // the other side is not smooth
            for (Pane& pane : f.result.panes)
                if (pane.overlay == 0) pane.picture = result_.smooth;
        f.reference = reference_.facts(result_, drawn_settings_.view.light);
    }
    f.request = request_;
    f.readings = readings_.facts();
    f.against = against_.facts();
    f.effects = effects_;
    f.health = health_;
    f.artefacts = artefacts_;
    f.shader_log = shader_log_;
    f.problem = problem_;
    f.driver_reset = driver_reset_;
    return f;
}

void FrameLoop::clear() {
    drawn_ = false;
    readings_.clear();
    reference_.clear();
    against_.clear();
    frame_effects_.clear();
    effects_.clear();
    health_.reset();
}

FrameNews FrameLoop::update(const Scene& scene, const PictureState& state, const EditorActions& actions,
                            const ComparisonFacts* comparison) {
    news_ = {};
    pinned_ = state.pinned.has_value();
    try {
        news_.changed |= readings_.update_frozen(renderer_, scene, state, actions);
    } catch (const std::exception& e) {
        report(e.what());
        news_.thaw = true;
    }
    const bool drawn = draw(scene, state, actions);
    news_.changed |= drawn;
    if (!drawn) news_.changed |= smooth(scene, state, actions);
    news_.changed |= follow_readings(scene, state, actions, drawn);
    try {
        news_.changed |= follow_reference(scene, state, actions, drawn, comparison);
    } catch (const std::exception& e) {
        report(e.what());
        news_.changed = true;
    }
    news_.changed |= follow_health();
    news_.changed |= follow_effects(scene, state, actions, drawn);
    return std::move(news_);
}

bool FrameLoop::follow_health() {
    std::shared_ptr<const NumericHealth> health;
    bool waits = false;
    if (drawn_ && request_.outputs.health && renderer_.holds(result_)) {
        health = renderer_.numeric_health(result_, false);
        waits = !health;
    }
    return std::exchange(health_, health) != health || waits;
}

bool FrameLoop::follow_effects(const Scene& scene, const PictureState& state, const EditorActions& actions,
                               bool drawn) {
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
    for (Effect& effect : panel_effects(state, actions)) effects.push_back(std::move(effect));
    effects.push_back(artefact_effect(state.artefacts, artefacts_, artefacts_found_));
    effects.push_back(reference_effect(reference_.facts(result_, drawn_settings_.view.light)));
    if (effects == effects_) return false;
    effects_ = std::move(effects);
    return true;
}

bool FrameLoop::draw(const Scene& scene, const PictureState& state, const EditorActions& actions) {
    FrameRequest wanted;
    // A map that fills the window belongs to the picture that is behind it.
    const bool scene_shown = actions.scene_width >= 1;
    wanted.width = scene_shown ? actions.scene_width : request_.width;
    wanted.height = scene_shown ? std::max(1, actions.scene_height) : request_.height;
    wanted.outputs.colour = true;
    wanted.outputs.shadow_map = actions.want_map;
    wanted.outputs.overlay = true;
    wanted.outputs.visibility = state.loupe == LoupeMode::Mouse;  // of the probed pixel the probe knows it
    wanted.outputs.map_coordinates = actions.want_links;
    wanted.outputs.texels_read = actions.want_exact_texels;
    wanted.outputs.error = actions.want_error;
    wanted.outputs.health = actions.want_health || actions.search_all;
    wanted.outputs.true_colour = state.against.view != AgainstView::Off && state.against.reference;
    wanted.timing = actions.want_timing;
    wanted.forced = state.effects.forced;
    if (state.frozen) wanted.map_camera = MapCamera{state.frozen->camera, state.frozen->seen_m};
    wanted.reference = reference_.picture(state.settings.view.light);
    wanted.traced = reference_.pictures();
    wanted.light_maps = reference_.light_maps();
    // Held against another, the picture is one pane.
    Settings settings = state.settings;
    if (state.against.view != AgainstView::Off) settings.view.panes = int(Panes::One);
    const bool same = drawn_ && renderer_.holds(result_) && !shaders_changed_ && wanted.width == request_.width &&
                      wanted.height == request_.height && wanted.outputs == request_.outputs &&
                      wanted.timing == request_.timing && wanted.forced == request_.forced &&
                      wanted.reference == request_.reference && wanted.traced == request_.traced &&
                      wanted.light_maps == request_.light_maps && wanted.map_camera == request_.map_camera &&
                      drawn_settings_ == settings && drawn_scene_ == scene.id;
    if (same || (!scene_shown && !actions.want_map)) return false;
    if (rehearsals_ && (shaders_changed_ || (drawn_scene_ != scene.id && !(scene.rig && scene.rig == drawn_rig_)))) {
        rehearsals_->forget();
        foreseen_.clear();
        drawn_rig_ = scene.rig;
    }
    request_ = wanted;
    drawn_settings_ = settings;
    drawn_scene_ = scene.id;
    shaders_changed_ = false;
    smoothed_ = 0;
    try {
        result_ = renderer_.render(scene, drawn_settings_, request_);
        drawn_ = true;
        driver_reset_ = false;
        problem_.clear();
        if (actions.search_all) require_sound_numbers(scene);
        foresee_programs(scene);
    } catch (const std::exception& e) {
        drawn_ = false;
        driver_reset_ = dynamic_cast<const gl::ContextLost*>(&e) != nullptr;
        if (problem_ != e.what()) report(e.what());
        problem_ = e.what();
    }
    shader_log_ = renderer_.shader_log();
    for (std::string& message : renderer_.take_gl_messages()) {
        news_.remarks.push_back({.kind = LogKind::Warning, .text = message});
        news_.driver.push_back(std::move(message));
    }
    return true;
}

void FrameLoop::require_sound_numbers(const Scene& scene) {
    const auto health = renderer_.numeric_health(result_);
    if (health->sound()) return;
    news_.unsound = fmt::format("{} {}x{} {}: {}", scene.name, request_.width, request_.height,
                                set_options({}, drawn_settings_), health_text(*health));
    report(news_.unsound);
}

bool FrameLoop::smooth(const Scene& scene, const PictureState& state, const EditorActions& actions) {
    const ViewSettings& view = drawn_settings_.view;
    if (!drawn_ || !actions.at_rest || smoothed_ >= kSmoothedMost || !view.smooth) return false;
    if (view.slabs != int(Slabs::None) || state.against.view != AgainstView::Off || state.pinned) return false;
    if (std::ranges::none_of(result_.panes, [](const Pane& pane) { return pane.overlay == 0; })) return false;
    FrameRequest request = request_;
    request.timing = false;
    request.smoothed = ++smoothed_;
    try {
        const FrameResult more = renderer_.render(scene, drawn_settings_, request);
        if (more.smooth.texture == 0) return smoothed_ = kSmoothedMost, false;
        result_.smooth = more.smooth;
        tell_of_smoothing(more);
        return true;
    } catch (const std::exception& e) {
        smoothed_ = kSmoothedMost;
        result_.smooth = {};
        report(e.what());
        return true;
    }
}

void FrameLoop::tell_of_smoothing(const FrameResult& more) {
    const PassInfo* const did = more.pass(kSmoothingPass);
    const auto told = std::ranges::find(result_.passes, kSmoothingPass, &PassInfo::name);
    if (!did || told == result_.passes.end() || told->reason == did->reason) return;
    // Of all else the frame itself is told of, and its times.
    told->state = did->state, told->reason = did->reason;
    frame_effects_.clear();
}

void FrameLoop::foresee_programs(const Scene& scene) {
    if (!rehearsals_) return;
    if (!foreseen_.insert(renderer_.programs_key(scene, drawn_settings_, request_)).second) return;
    // A hover asks for map coordinates, a click for a probe, the map viewer for its picture.
    Warmup next{.scene = {}, .settings = drawn_settings_, .request = request_};
    next.request.outputs.shadow_map = next.request.outputs.map_coordinates = next.request.outputs.texels_read = true;
    next.scene = std::make_shared<const Scene>(stand_in(scene, drawn_settings_));
    rehearsals_->foresee(std::move(next));
}

bool FrameLoop::follow_readings(const Scene& scene, const PictureState& state, const EditorActions& actions,
                                bool drawn) {
    if (!drawn_) {
        readings_.clear();
        return false;
    }
    try {
        return readings_.update(renderer_, scene, state, actions, request_, result_, drawn);
    } catch (const std::exception& e) {
        readings_.clear();
        report(e.what());
        return true;
    }
}

bool FrameLoop::follow_reference(const Scene& scene, const PictureState& state, const EditorActions& actions,
                                 bool drawn, const ComparisonFacts* comparison) {
    if (!drawn_) {
        reference_.clear();
        against_.clear();
        return false;
    }
    const EditorReference::Wishes wishes{actions.cancel_reference, actions.save_error};
    bool changed = reference_.update(renderer_, scene, drawn_settings_, request_, result_, drawn, wishes);
    if (drawn) artefacts_found_ = false;
    if (state.artefacts.number != artefacts_.number && result_.error && result_.reference.met && request_.reference) {
        artefacts_ = {.number = state.artefacts.number};  // where it cannot be told there are none
        artefacts_ = find_artefact_spots(renderer_, scene, drawn_settings_, request_, state.artefacts);
        artefacts_found_ = changed = true;
    }
    if (const std::string remark = reference_.take_remark(); !remark.empty()) news_.remarks.push_back({.text = remark});
    changed |= against_.update(renderer_, scene, state, request_, result_, drawn, comparison);
    return changed;
}

void FrameLoop::save_map(const Scene& scene, const Settings& settings, const std::string& path) {
    require_writable(path);
    const bool camera = settings.view.map_source == int(MapSource::Camera);
    const View view = find_view(camera ? "camera-depth" : "shadow-map");
    check_view_file(view, path);
    FrameRequest request = request_;
    request.timing = false;
    write_view(renderer_, scene, settings, request, view, path);
}

}  // namespace si
