#include "app/editor/scene_loader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>
#include <variant>

#include "app/editor/requests.h"
#include "renderer/base/error.h"
#include "renderer/scene/animation.h"
#include "renderer/scene/placement.h"
#include "renderer/settings/param.h"
#include "renderer/view/cameras/make_camera.h"
#include "ui/state/selection.h"

namespace si {
namespace {

/// Returns true when two values of a setting are equal. Numbers may differ by rounding, because a drag of scene.scale
/// multiplies a length many times.
bool is_same_value(const Value& a, const Value& b) {
    constexpr double kMaxRounding = 1e-9;  // share of the value
    const double *x = std::get_if<double>(&a), *y = std::get_if<double>(&b);
    if (!x || !y) return a == b;
    return *x == *y || std::abs(*x - *y) <= kMaxRounding * std::max(std::abs(*x), std::abs(*y));
}

/// Returns settings with the placement of `scene`, and with their lengths scaled to it.
Settings placed_at(Settings settings, const SceneSettings& scene) {
    carry_settings(settings, settings.scene, scene);
    settings.scene = scene;
    return settings;
}

/// Returns the program's defaults as a preset means them: a preset leaves out lengths that equal the defaults at its
/// own scale. @param scene the preset's scene settings
Settings defaults_of_preset(const SceneSettings& scene) {
    Settings settings;
    settings.scene = scene;
    return settings;
}

/// Returns `settings` with the values that equal those of `from` replaced by those of `to`. The user's changes survive
/// a change of scene; the scene's suggestions do not. Lengths are compared at the scale of `settings`, and the user's
/// are scaled to that of `to`.
Settings rebased(const Settings& settings, const Settings& from, const Settings& to) {
    const Settings unchanged = placed_at(from, settings.scene);
    Settings out = placed_at(settings, to.scene);
    for (const SettingRef& ref : all_settings(to))
        if (ref.param->scope != Scope::Object && is_same_value(get_value(settings, ref), get_value(unchanged, ref)))
            set_value(out, ref, get_value(to, ref));
    out.camera = to.camera;
    out.scene = to.scene;
    out.objects = to.objects;
    return out;
}

}  // namespace

SceneLoader::SceneLoader(EditorState& state, EditorPersistence& memory, SceneReader read, bool strict)
    : state_(state), persistence_(memory), strict_(strict), loading_(std::move(read)) {}

void SceneLoader::set_initial_settings(const Settings& settings) {
    state_.settings = base_ = given_ = settings;
    state_.history.reset(settings);
}

const Scene& SceneLoader::require() const {
    if (failure_) std::rethrow_exception(failure_);
    if (!has_scene_) throw Error("there is no scene");
    return scene_;
}

void SceneLoader::load(Arrival arrival) {
    cancel_loading();
    if (!has_scene_) problem_.clear();
    loading_.start(arrival.scene_name, arrival.file);
    arrival_ = std::move(arrival);
    state_.between_steps = arrival_.step;
}

void SceneLoader::show(Arrival arrival) {
    arrival.scene_name = known_name(arrival.scene_name);
    if (!is_shown(arrival.scene_name, arrival.file)) return load(std::move(arrival));
    cancel_loading();
    std::vector<std::string> left_out;
    state_.settings = *arrival.settings;
    check_objects(scene_, state_.settings, arrival.scene_name, &left_out);
    state_.files.guide = arrival.guide;
    if (arrival.lost) persistence_.adopt_lost();
    if (!arrival.remark.empty()) state_.log.add(LogKind::Info, arrival.remark);
    for (const std::string& text : left_out) report(state_, text);
}

void SceneLoader::cancel_loading() {
    if (const std::string name = loading_.wanted(); !name.empty()) {
        const std::string text = fmt::format("Cancelled: {} was not loaded", name);
        state_.log.add(LogKind::Info, text);
        if (!has_scene_) problem_ = text;
    }
    loading_.cancel();
    drop_undo_step();
}

void SceneLoader::drop_undo_step() {
    if (std::exchange(arrival_.step, false)) state_.history.cancel_move();
    state_.between_steps = false;
}

void SceneLoader::reset_file_choices() {
    if (!has_scene_ || file_choices(state_.settings.scene) == file_) return;
    const Settings before = state_.settings;
    seen_file_ = file_;
    set_file_choices(state_.settings.scene, file_);
    state_.history.amend_step(before, state_.settings);
}

bool SceneLoader::poll() {
    if (!loading_.ended()) return false;
    std::optional<SceneLoading::Outcome> outcome = loading_.poll();
    if (!outcome) return true;
    try {
        if (!outcome->scene) throw Error(outcome->error);
        if (arrival_.reload)
            show_reloaded(std::move(*outcome->scene), arrival_);
        else
            show_scene(std::move(*outcome->scene), arrival_);
    } catch (const std::exception& e) {
        if (!has_scene_) {
            problem_ = e.what();
            failure_ = std::current_exception();
        }
        reset_file_choices();
        drop_undo_step();
        report(state_, arrival_.reload ? fmt::format("{}. The scene that was read before is shown", e.what())
                                       : std::string(e.what()));
        if (arrival_.reload) watch_.accept();
        if (std::error_code error; !std::filesystem::exists(arrival_.scene_name, error))
            persistence_.drop_recent(arrival_.scene_name);
    }
    return true;
}

void SceneLoader::reload(double aspect) {
    if (!has_scene_ || scene_.files.empty())
        throw Error(fmt::format("{}: is built in, so there is no file to read again", state_.scene_name));
    load({.scene_name = state_.scene_name,
          .file = file_,
          .guide = state_.files.guide,
          .reload = true,
          .aspect = aspect});
}

void SceneLoader::show_reloaded(Scene loaded, const Arrival& arrival) {
    if (std::ranges::any_of(loaded.files, differs_now))
        throw Error(fmt::format("{}: has changed while it was read; reload it when it is written", arrival.scene_name));
    std::vector<std::string> left_out;
    const Settings before = state_.settings;
    Settings kept = before;
    try {
        pose_scene(loaded, kept.scene);
    } catch (const UsageError& e) {
        left_out.emplace_back(e.what());
        kept.scene.animation = SceneSettings{}.animation;
        kept.scene.time = SceneSettings{}.time;
        pose_scene(loaded, kept.scene);
    }
    const Settings base = base_of(loaded);
    const auto follow = [&](const Settings& settings) {
        Settings out = rebased(settings, base_, placed_at(base, settings.scene));
        out.camera = settings.camera;
        out.scene = kept.scene;
        out.objects = settings.objects;
        return out;
    };
    given_ = follow(given_);
    kept = follow(kept);
    check_objects(loaded, kept, arrival.scene_name, &left_out);
    // A camera that frames the scene would move with its bounds.
    const bool automatic = kept.camera.source == CameraSource::Automatic;
    const CameraSettings camera = manual_camera(scene_, before, arrival.aspect);
    if (automatic && !(manual_camera(loaded, kept, arrival.aspect) == camera)) kept.camera = camera;
    scene_ = std::move(loaded);
    base_ = base;
    state_.settings = kept;
    if (kept != before) state_.history.amend_step(before, kept);
    posed_ = kept.scene;
    given_at_[{arrival.scene_name, arrival.guide.key, arrival.file}] = given_;
    follow_objects();
    watch_.watch_files(scene_.files);
    std::set<std::string> selected = selected_objects(state_);
    std::erase_if(selected, [&](const std::string& path) {
        return std::ranges::find(scene_.nodes, path, &Node::path) == scene_.nodes.end();
    });
    select_objects(state_, std::vector(selected.begin(), selected.end()));
    if (!scene_.rig || scene_.rig->animations.empty()) state_.playback.playing = false;
    state_.log.add(LogKind::Info, fmt::format("Read {} again: {} objects, {} triangles", state_.scene_name,
                                              scene_.object_count(), scene_.triangle_count()));
    for (const std::string& warning : scene_.warnings) state_.log.add(LogKind::Warning, warning);
    for (const std::string& text : left_out) state_.log.add(LogKind::Warning, text);
}

void SceneLoader::finish() {
    while (loading_.busy()) {
        loading_.wait();
        poll();
    }
}

void SceneLoader::show_scene(Scene loaded, const Arrival& arrival) {
    const bool first = !has_scene_;
    std::vector<std::string> left_out, notes;
    if (arrival.plan) {
        Session session = compose_session(*arrival.plan, std::move(loaded), first && strict_ ? nullptr : &left_out);
        // The user's changes during the loading of the first scene are kept.
        state_.settings = first ? rebased(state_.settings, base_, session.settings) : session.settings;
        given_ = session.settings;
        suggests_ = !arrival.plan->preset;
        scene_ = std::move(session.scene);
        notes = std::move(session.notes);
        base_ = suggests_ ? base_settings(scene_) : defaults_of_preset(arrival.plan->preset->settings.scene);
    } else {
        if (arrival.settings) pose_scene(loaded, arrival.settings->scene);
        const Settings base = base_settings(loaded);
        state_.settings = arrival.settings ? *arrival.settings : rebased(state_.settings, base_, base);
        if (arrival.settings) check_objects(loaded, state_.settings, arrival.scene_name, &left_out);
        // Earlier changes stay unsaved in the new scene.
        const auto was_here = given_at_.find({arrival.scene_name, arrival.guide.key, arrival.file});
        given_ = !arrival.settings                             ? rebased(given_, base_, base)
                 : arrival.step && was_here != given_at_.end() ? was_here->second
                                                               : base;
        suggests_ = true;
        scene_ = std::move(loaded);
        for (const std::string& warning : scene_.warnings) notes.push_back(warning);
        base_ = base;
    }
    file_ = seen_file_ = arrival.file;
    set_file_choices(state_.settings.scene, file_);
    posed_ = state_.settings.scene;
    set_file_choices(given_.scene, file_);
    given_at_[{arrival.scene_name, arrival.guide.key, arrival.file}] = given_;
    follow_objects();
    watch_.watch_files(scene_.files);
    has_scene_ = true;
    failure_ = nullptr;
    problem_.clear();
    state_.scene_name = arrival.scene_name;
    state_.playback.playing = false;
    state_.files.guide = arrival.guide;
    arrival_.step = state_.between_steps = false;
    persistence_.note_scene(state_.scene_name);
    if (arrival.when_shown) arrival.when_shown();
    if (arrival.lost) persistence_.adopt_lost();
    if (first) {
        state_.history.set_place({state_.scene_name, state_.files.guide});
        state_.history.reset(state_.settings);
        notes_ = notes;
    } else {
        state_.probe_pixel.reset();
        select_objects(state_, {});
        state_.objects.closed_nodes.clear();
        state_.viewport.camera_before_light.reset();
        state_.frozen.reset();
        state_.map.window = {};
    }
    const std::string hidden = scene_.hidden.empty() ? "" : fmt::format(", {} hidden", scene_.hidden.size());
    const std::size_t objects = scene_.object_count();
    state_.log.add(LogKind::Info, fmt::format("{}: {} object{}, {} triangles{}", state_.scene_name, objects,
                                              objects == 1 ? "" : "s", scene_.triangle_count(), hidden));
    for (const std::string& note : notes) state_.log.add(LogKind::Warning, note);
    for (const std::string& text : left_out) report(state_, text);
    if (!arrival.remark.empty()) state_.log.add(LogKind::Info, arrival.remark);
}

void SceneLoader::show_undo_step() {
    const Place place = state_.history.place();
    const Settings settings = state_.history.settings();
    show({.scene_name = place.scene,
          .file = file_choices(settings.scene),
          .settings = settings,
          .guide = place.guide,
          .step = true});
}

bool SceneLoader::scene_settings_changed() const {
    return has_scene_ && (file_choices(state_.settings.scene) != seen_file_ || state_.settings.scene != posed_ ||
                          state_.settings.objects != followed_objects_);
}

void SceneLoader::follow_scene_settings() {
    if (file_choices(state_.settings.scene) != seen_file_) follow_file_choices();
    if (state_.settings.scene != posed_) follow_time();
    follow_objects();
}

void SceneLoader::follow_objects() {
    followed_objects_ = state_.settings.objects;
    hide_objects(scene_, hidden_paths(state_.settings));
}

void SceneLoader::follow_file_choices() {
    seen_file_ = file_choices(state_.settings.scene);
    if (seen_file_ == file_)
        cancel_loading();
    else
        load({.scene_name = state_.scene_name, .file = seen_file_});
}

void SceneLoader::follow_time() {
    posed_ = state_.settings.scene;
    if (const std::string remark = pose_scene(scene_, posed_); !remark.empty())
        state_.log.add(LogKind::Warning, remark);
    const Settings base = base_of(scene_);
    const Settings before = state_.settings;
    const Settings unchanged = placed_at(base_, posed_), now = placed_at(base, posed_);
    for (const SettingRef& ref : all_settings(base))
        if (ref.param->scope == Scope::Light && get_value(base, ref) != get_value(base_, ref) &&
            is_same_value(get_value(before, ref), get_value(unchanged, ref)))
            set_value(state_.settings, ref, get_value(now, ref));
    if (state_.settings != before) state_.history.amend_step(before, state_.settings);
    base_ = base;
}

std::string SceneLoader::known_name(const std::string& name) const {
    std::error_code error;
    return std::filesystem::equivalent(name, state_.scene_name, error) ? state_.scene_name : name;
}

std::vector<std::string> SceneLoader::apply_settings(const Settings& settings, const std::string& what) {
    std::vector<std::string> left_out;
    Settings taken = settings;
    if (has_scene_) check_objects(scene_, taken, what, &left_out);
    given_ = state_.settings = taken;
    suggests_ = false;
    base_ = defaults_of_preset(settings.scene);
    return left_out;
}

void SceneLoader::reset() {
    if (has_scene_) {
        given_ = state_.settings = base_settings(scene_);
        state_.files.guide = {};
    }
}

}  // namespace si
