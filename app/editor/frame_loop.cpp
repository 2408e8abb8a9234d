#include "app/editor/frame_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/base/output.h"
#include "app/editor/panel_effects.h"
#include "renderer/advise/fixes.h"
#include "renderer/base/command_text.h"
#include "renderer/gl/driver_failure.h"
#include "renderer/measure/measured_error.h"
#include "renderer/scene/proxy_scene.h"

namespace si {
namespace {

constexpr std::size_t kMaxSpots = 100;  ///< number of clusters in a tour

/// Finds clusters of wrong pixels of one cause in the editor's picture. Draws the frame of `request` once more, so that
/// the renderer drops the images of other frames (Renderer::has_images_of()). @param request frame with its ray-traced
/// reference @param wanted cause to look for @throws Error
ArtefactSpots find_artefact_spots(Renderer& renderer, const Scene& scene, const Settings& settings,
                                  const FrameRequest& request, const ArtefactRequest& wanted) {
    FrameRequest classified = request;
    classified.outputs = {.colour = false, .classified = true};
    classified.timing = classified.force = false;
    const FrameResult frame = renderer.render(scene, settings, classified);
    const MeasuredError measured = read_classified_pixels(renderer, frame, *request.reference, settings);
    const Receivers& receivers = *measured.traced.receivers;
    const int step = request.reference->step;
    ArtefactSpots out{.number = wanted.number, .spots = {}, .camera = frame.camera, .height = request.height};
    for (const ArtefactCluster& found :
         artefact_clusters(measured.classified, receivers.width, wanted.cause, kMaxSpots)) {
        ArtefactSpot spot{found};
        const Receiver& middle = receivers.at(found.pixel.x, found.pixel.y);
        spot.position_ws = middle.position_ws;
        spot.normal_ws = middle.normal_ws;
        spot.pixel *= step;
        spot.first *= step;
        spot.last = (spot.last + 1) * step - 1;
        out.spots.push_back(spot);
    }
    return out;
}

}  // namespace

FrameFacts FrameLoop::facts() const {
    FrameFacts f = facts_;
    f.settings = drawn_settings_;
    if (drawn_) {
        f.driver = renderer_.driver();
        if (facts_.result.smooth.texture != 0 && !picture_comparison_.facts() &&
            !pinned_)  // the other side of a comparison is not smoothed
            for (Pane& pane : f.result.panes)
                if (pane.overlay == 0) pane.picture = f.result.smooth;
        f.reference = reference_.facts(facts_.result, drawn_settings_.view.light);
        f.traced_so_far = preview_.image();
    } else {
        f.result = {};
    }
    f.readings = read_back_.facts();
    f.picture_comparison = picture_comparison_.facts();
    f.map_comparison = map_comparison_.facts();
    return f;
}

void FrameLoop::clear() {
    drawn_ = false;
    read_back_.clear();
    reference_.clear();
    picture_comparison_.clear();
    map_comparison_.clear();
    frame_effects_.clear();
    facts_.effects.clear();
    facts_.health.reset();
    facts_.earlier_error.reset();
}

FrameNews FrameLoop::update(const Scene& scene, const PictureState& state, const EditorRequests& requests,
                            const ComparisonFacts* comparison) {
    news_ = {};
    pinned_ = state.pinned.has_value();
    try {
        news_.changed |= read_back_.update_frozen(renderer_, scene, state, requests);
    } catch (const std::exception& e) {
        report(e.what());
        news_.release_frozen_camera = true;
    }
    const bool drawn = draw(scene, state, requests);
    news_.changed |= drawn;
    if (!drawn) news_.changed |= add_sample(scene, state, requests);
    news_.changed |= follow_read_back(scene, state, requests, drawn);
    try {
        news_.changed |= follow_reference(scene, state, requests, drawn, comparison);
    } catch (const std::exception& e) {
        report(e.what());
        news_.changed = true;
    }
    news_.changed |= follow_map_comparison(scene, state, requests);
    news_.changed |= follow_health();
    news_.changed |= follow_effects(scene, state, requests, drawn);
    return std::move(news_);
}

bool FrameLoop::follow_map_comparison(const Scene& scene, const PictureState& state, const EditorRequests& requests) {
    if (!drawn_) {
        map_comparison_.clear();
        return false;
    }
    try {
        return map_comparison_.update(scene, state, requests, facts_.result);
    } catch (const std::exception& e) {
        map_comparison_.clear();
        report(e.what());
        return true;
    }
}

bool FrameLoop::follow_health() {
    std::shared_ptr<const NumericHealth> health;
    bool waits = false;
    if (drawn_ && facts_.request.outputs.health && renderer_.has_images_of(facts_.result)) {
        health = renderer_.numeric_health(facts_.result, false);
        waits = !health;
    }
    return std::exchange(facts_.health, health) != health || waits;
}

bool FrameLoop::follow_effects(const Scene& scene, const PictureState& state, const EditorRequests& requests,
                               bool drawn) {
    if (drawn) frame_effects_.clear();
    const bool posed = drawn && std::exchange(posed_scene_, scene.id) != scene.id;
    if (!requests.want_effects || !drawn_) {
        const bool had = !facts_.effects.empty();
        facts_.effects.clear();
        return had;
    }
    if (frame_effects_.empty()) {
        frame_effects_ = frame_effects(scene, drawn_settings_, facts_.result, facts_.request.forced);
        frame_effects_.push_back(posing_effect(scene, drawn_settings_.scene, posed));
    }
    std::vector<Effect> effects = frame_effects_;
    for (Effect& effect : panel_effects(state, requests)) effects.push_back(std::move(effect));
    effects.push_back(artefact_effect(state.artefacts, facts_.artefacts, artefacts_found_));
    effects.push_back(reference_effect(reference_.facts(facts_.result, drawn_settings_.view.light)));
    if (effects == facts_.effects) return false;
    facts_.effects = std::move(effects);
    return true;
}

bool FrameLoop::draw(const Scene& scene, const PictureState& state, const EditorRequests& requests) {
    FrameRequest wanted;
    // A map that fills the window belongs to the hidden picture's size.
    const bool scene_shown = requests.scene_width >= 1;
    wanted.width = scene_shown ? requests.scene_width : facts_.request.width;
    wanted.height = scene_shown ? std::max(1, requests.scene_height) : facts_.request.height;
    wanted.outputs.colour = true;
    wanted.outputs.shadow_map = requests.want_map;
    wanted.outputs.overlay = true;
    wanted.outputs.visibility = state.loupe == LoupeMode::Mouse;  // the probe already has the probed pixel's visibility
    wanted.outputs.map_coordinates = requests.want_links;
    wanted.outputs.texels_read = requests.want_exact_texels;
    wanted.outputs.error = requests.want_error;
    wanted.outputs.health = requests.want_health || requests.search_all;
    wanted.outputs.true_colour = state.comparison.view != ComparisonView::Off && state.comparison.reference;
    // Compared pictures are plain. A picture that replaces another while a key is held has the look of that one.
    const bool replaces = state.comparison.view == ComparisonView::Alone && !state.comparison.reference;
    wanted.with_look = replaces ? facts_.request.with_look : state.comparison.view == ComparisonView::Off;
    wanted.timing = requests.want_timing;
    wanted.forced = state.effects.forced;
    if (state.frozen) wanted.map_camera = MapCamera{state.frozen->camera, state.frozen->seen_m};
    wanted.reference = reference_.picture(state.settings.view.light);
    wanted.traced = reference_.pictures();
    wanted.light_maps = reference_.light_maps();
    // A compared picture has one pane.
    Settings settings = state.settings;
    if (state.comparison.view != ComparisonView::Off) settings.view.panes = Panes::One;
    const bool same = drawn_ && renderer_.has_images_of(facts_.result) && !shaders_changed_ &&
                      same_inputs(wanted, facts_.request) && wanted.outputs == facts_.request.outputs &&
                      wanted.with_look == facts_.request.with_look && wanted.timing == facts_.request.timing &&
                      wanted.forced == facts_.request.forced && drawn_settings_ == settings && drawn_scene_ == scene.id;
    if (same || (!scene_shown && !requests.want_map)) return false;
    if (warmup_ && (shaders_changed_ || (drawn_scene_ != scene.id && !(scene.rig && scene.rig == drawn_rig_)))) {
        warmup_->forget();
        warmed_programs_.clear();
        drawn_rig_ = scene.rig;
    }
    if (drawn_scene_ != scene.id || drawn_settings_.view.light != settings.view.light) facts_.earlier_error.reset();
    facts_.request = wanted;
    drawn_settings_ = settings;
    drawn_scene_ = scene.id;
    shaders_changed_ = false;
    smoothed_ = 0;
    try {
        facts_.result = renderer_.render(scene, drawn_settings_, facts_.request);
        drawn_ = true;
        if (facts_.result.error) facts_.earlier_error = facts_.result.error;
        facts_.driver_reset = false;
        facts_.problem.clear();
        if (requests.search_all) require_sound_numbers(scene);
        queue_likely_shaders(scene);
    } catch (const std::exception& e) {
        drawn_ = false;
        facts_.driver_reset = dynamic_cast<const gl::ContextLost*>(&e) != nullptr;
        if (facts_.problem != e.what()) report(e.what());
        facts_.problem = e.what();
    }
    facts_.shader_log = renderer_.shader_log();
    for (std::string& message : renderer_.take_gl_messages()) {
        news_.remarks.push_back({.kind = LogKind::Warning, .text = message});
        news_.driver.push_back(std::move(message));
    }
    return true;
}

void FrameLoop::require_sound_numbers(const Scene& scene) {
    const auto health = renderer_.numeric_health(facts_.result);
    if (health->sound()) return;
    news_.unsound = fmt::format("{} {}x{} {}: {}", scene.name, facts_.request.width, facts_.request.height,
                                set_options_text(setting_changes({}, drawn_settings_)), health_text(*health));
    report(news_.unsound);
}

bool FrameLoop::add_sample(const Scene& scene, const PictureState& state, const EditorRequests& requests) {
    const ViewSettings& view = drawn_settings_.view;
    if (!drawn_ || !requests.at_rest || smoothed_ >= kMaxSmoothedShadings || !view.smooth) return false;
    if (view.slabs != Slabs::None || state.comparison.view != ComparisonView::Off || state.pinned) return false;
    if (std::ranges::none_of(facts_.result.panes, [](const Pane& pane) { return pane.overlay == 0; })) return false;
    FrameRequest request = facts_.request;
    request.timing = false;
    request.smoothed = ++smoothed_;
    try {
        const FrameResult more = renderer_.render(scene, drawn_settings_, request);
        if (more.smooth.texture == 0) return smoothed_ = kMaxSmoothedShadings, false;
        facts_.result.smooth = more.smooth;
        report_smoothing(more);
        return true;
    } catch (const std::exception& e) {
        smoothed_ = kMaxSmoothedShadings;
        facts_.result.smooth = {};
        report(e.what());
        return true;
    }
}

void FrameLoop::report_smoothing(const FrameResult& more) {
    const PassInfo* const did = more.pass(kSmoothingPass);
    const auto shown = std::ranges::find(facts_.result.passes, kSmoothingPass, &PassInfo::name);
    if (!did || shown == facts_.result.passes.end() || shown->reason == did->reason) return;
    // Other passes keep the states and times of the frame.
    shown->state = did->state;
    shown->reason = did->reason;
    frame_effects_.clear();
}

void FrameLoop::queue_likely_shaders(const Scene& scene) {
    if (!warmup_) return;
    if (!warmed_programs_.insert(renderer_.programs_key(scene, drawn_settings_, facts_.request)).second) return;
    // A hover needs map coordinates, a click a probe, the map viewer its picture.
    WarmupFrame next{.scene = {}, .settings = drawn_settings_, .request = facts_.request};
    next.request.outputs.shadow_map = next.request.outputs.map_coordinates = next.request.outputs.texels_read = true;
    next.scene = std::make_shared<const Scene>(make_proxy_scene(scene, drawn_settings_));
    warmup_->enqueue(std::move(next));
}

bool FrameLoop::follow_read_back(const Scene& scene, const PictureState& state, const EditorRequests& requests,
                                 bool drawn) {
    if (!drawn_) {
        read_back_.clear();
        return false;
    }
    try {
        return read_back_.update(renderer_, scene, state, requests, facts_.request, facts_.result, drawn);
    } catch (const std::exception& e) {
        read_back_.clear();
        report(e.what());
        return true;
    }
}

bool FrameLoop::follow_reference(const Scene& scene, const PictureState& state, const EditorRequests& requests,
                                 bool drawn, const ComparisonFacts* comparison) {
    if (!drawn_) {
        reference_.clear();
        picture_comparison_.clear();
        return false;
    }
    bool changed = reference_.update(renderer_, scene, drawn_settings_, facts_.request, facts_.result, drawn, requests);
    changed |= preview_.update(reference_.so_far(facts_.result));
    if (drawn) artefacts_found_ = false;
    if (state.artefacts.number != facts_.artefacts.number && facts_.result.error && facts_.result.reference.met &&
        facts_.request.reference) {
        facts_.artefacts = {.number = state.artefacts.number};  // on an error there are no clusters
        facts_.artefacts = find_artefact_spots(renderer_, scene, drawn_settings_, facts_.request, state.artefacts);
        artefacts_found_ = changed = true;
    }
    if (const std::string remark = reference_.take_remark(); !remark.empty()) news_.remarks.push_back({.text = remark});
    changed |= picture_comparison_.update(renderer_, scene, state, facts_.request, facts_.result, drawn, comparison);
    return changed;
}

void FrameLoop::save_view(const Scene& scene, const Settings& settings, const View& view, const std::string& path) {
    FrameRequest request = facts_.request;
    request.timing = request.with_look = false;
    Settings shown = settings;
    shown.view.map_fit |= facts_.result.map_fitted;  // the contrast that the map viewer shows
    write_view(renderer_, scene, shown, request, view, path);
}

}  // namespace si
