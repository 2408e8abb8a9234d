#include "app/editor/model.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "app/base/output.h"
#include "app/report/views.h"
#include "app/session/presets.h"
#include "app/session/session.h"
#include "renderer/base/error.h"
#include "renderer/settings/param.h"
#include "ui/state/panels.h"

namespace si {
namespace {

/// `settings`, with what still is as `from` has it replaced by what `to` has: a person's changes survive a change of
/// scene, the scene's own suggestions do not.
Settings rebased(const Settings& settings, const Settings& from, const Settings& to) {
    Settings out = settings;
    for (const SettingRef& ref : all_settings(to))
        if (ref.param->scope != Scope::Object && get_value(settings, ref) == get_value(from, ref))
            set_value(out, ref, get_value(to, ref));
    out.camera = to.camera;
    out.scene = to.scene;
    out.objects = to.objects;
    return out;
}

}  // namespace

BottomTab tab_named(const std::string& name) {
    static const std::vector<std::pair<std::string, BottomTab>> kTabs = {
        {"passes", BottomTab::Passes},   {"probe", BottomTab::Probe},     {"error", BottomTab::Error},
        {"objects", BottomTab::Objects}, {"compare", BottomTab::Compare}, {"frontier", BottomTab::Frontier},
        {"log", BottomTab::Log}};
    std::string names;
    for (const auto& [key, tab] : kTabs) {
        if (key == name || name.empty()) return tab;
        names += (names.empty() ? "" : ", ") + key;
    }
    throw UsageError(fmt::format("--tab {}: it is one of {}", name, names));
}

EditorModel::EditorModel(const EditorOptions& options, SceneReader read)
    : strict_(options.headless),
      memory_(options.state_folder),
      loading_(std::move(read)),
      sweep_(options.state_folder) {
    SessionPlan plan = plan_session(options.session);
    state.settings = base_ = plan.settings;
    state.history.reset(state.settings);
    state.layout = memory_.workspace().layout;
    if (!options.preset.empty()) state.preset_path = options.preset.string();
    if (options.probe_x >= 0 && options.probe_y >= 0) {
        state.probe_pixel = glm::ivec2(options.probe_x, options.probe_y);
        state.open_tab = BottomTab::Probe;
    }
    if (!options.tab.empty()) state.open_tab = tab_named(options.tab);
    if (!options.sweep.empty()) {
        state.sweep.folder = options.sweep.string();
        sweep_.open(options.sweep, state.sweep);
        state.open_tab = BottomTab::Frontier;
    }
    start_loading(std::move(plan), {});
}

void EditorModel::require_scene() const {
    if (failure_) std::rethrow_exception(failure_);
    if (!has_scene_) throw Error("there is no scene");
}

EditorFrame EditorModel::facts() const {
    EditorFrame f;
    f.scene = has_scene_ ? &scene_ : nullptr;
    f.driver = drawn_ ? &renderer_.driver() : nullptr;
    f.result = drawn_ ? &result_ : nullptr;
    readings_.fill(f);
    f.tuning = tuner_.facts();
    if (tuned_ && tuned_->scene == scene_.id) {
        f.tuned = tuned_->families;
        f.tuned_current = tuned_->is_about(state.settings, request_.width, request_.height);
    }
    f.cures = cures_.facts(scene_, state.settings, request_.width, request_.height);
    if (drawn_) {
        f.truth = truth_.facts(result_);
        f.error = result_.error.get();
    }
    f.against = against_.facts();
    f.presets = desk_.entries();
    f.comparison = comparison_;
    f.unsaved = unsaved_;
    memory_.fill(f);
    f.shader_log = shader_log_;
    f.problem = problem_;
    f.sweep = &sweep_.facts();
    if (const std::string name = loading_.wanted(); !name.empty())
        f.loading = LoadingFacts{name, loading_.progress(), loading_.seconds_left()};
    return f;
}

void EditorModel::report(const std::string& error) {
    state.log.add(LogKind::Error, error);
    state.open_tab = BottomTab::Log;
}

bool EditorModel::loading_moved() const {
    return loading_.moved();
}

void EditorModel::finish_loading() {
    while (loading_.busy()) {
        loading_.wait();
        poll_loading();
    }
}

void EditorModel::cancel_loading() {
    if (const std::string name = loading_.wanted(); !name.empty()) {
        const std::string text = fmt::format("Cancelled: {} was not loaded", name);
        state.log.add(LogKind::Info, text);
        if (!has_scene_) problem_ = text;
    }
    loading_.cancel();
    give_up_step();
}

void EditorModel::give_up_step() {
    if (std::exchange(arrival_.step, false)) state.history.stay();
    state.between_steps = false;
}

void EditorModel::keep_scene() {
    if (!has_scene_ || state.settings.scene.index == file_scene_) return;
    const Settings before = state.settings;
    state.settings.scene.index = seen_index_ = file_scene_;
    state.history.follow(before, state.settings);
}

void EditorModel::start_loading(Arrival arrival) {
    cancel_loading();
    if (!has_scene_) problem_.clear();
    loading_.start(arrival.scene_name, arrival.file_scene);
    arrival_ = std::move(arrival);
    state.between_steps = arrival_.step;
}

void EditorModel::start_loading(SessionPlan plan, std::string remark) {
    Arrival arrival{
        .scene_name = plan.scene_name, .file_scene = plan.settings.scene.index, .remark = std::move(remark)};
    if (plan.preset) arrival.guide = note_preset(plan.preset_path, *plan.preset, plan.scene_name);
    arrival.plan = std::move(plan);
    start_loading(std::move(arrival));
}

bool EditorModel::poll_loading() {
    if (!loading_.ended()) return false;
    std::optional<SceneLoading::Outcome> outcome = loading_.poll();
    if (!outcome) return true;
    try {
        if (!outcome->scene) throw Error(outcome->error);
        show_scene(std::move(*outcome->scene), arrival_);
    } catch (const std::exception& e) {
        if (!has_scene_) {
            problem_ = e.what();
            failure_ = std::current_exception();
        }
        keep_scene();
        give_up_step();
        report(e.what());
        if (std::error_code error; !std::filesystem::exists(arrival_.scene_name, error))
            memory_.drop(arrival_.scene_name);
    }
    return true;
}

Settings EditorModel::base_of_scene() const {
    return suggests_ ? base_settings(scene_) : Settings{};
}

void EditorModel::show_scene(Scene loaded, const Arrival& arrival) {
    const bool first = !has_scene_;
    std::vector<std::string> left_out, notes;
    if (arrival.plan) {
        Session session = compose_session(*arrival.plan, std::move(loaded), first && strict_ ? nullptr : &left_out);
        // What was changed by hand while the first scene was being read is kept.
        state.settings = first ? rebased(state.settings, base_, session.settings) : session.settings;
        suggests_ = !arrival.plan->preset;
        scene_ = std::move(session.scene);
        notes = std::move(session.notes);
        base_ = base_of_scene();
    } else {
        if (arrival.settings) pose_scene(loaded, arrival.settings->scene);
        const Settings base = base_settings(loaded);
        state.settings = arrival.settings ? *arrival.settings : rebased(state.settings, base_, base);
        if (arrival.settings) check_objects(loaded, state.settings, arrival.scene_name, &left_out);
        suggests_ = true;
        scene_ = std::move(loaded);
        for (const std::string& warning : scene_.warnings) notes.push_back(warning);
        base_ = base;
    }
    state.settings.scene.index = file_scene_ = seen_index_ = arrival.file_scene;
    posed_ = state.settings.scene;
    given_ = state.settings;
    has_scene_ = true;
    failure_ = nullptr;
    problem_.clear();
    state.scene_name = arrival.scene_name;
    state.playback.playing = false;
    state.guide = arrival.guide;
    arrival_.step = state.between_steps = false;
    memory_.note_scene(state.scene_name);
    if (arrival.lost) memory_.forget_lost();
    if (first) {
        state.history.set_place({state.scene_name, state.guide});
        state.history.reset(state.settings);
        notes_ = notes;
    } else {
        state.probe_pixel.reset();
        state.selected_object.clear();
        state.camera_before_light.reset();
        state.frozen.reset();
        state.map_window = {};
    }
    state.log.add(LogKind::Info, fmt::format("{}: {} objects, {} triangles", state.scene_name, scene_.objects.size(),
                                             scene_.triangle_count()));
    for (const std::string& note : notes) state.log.add(LogKind::Warning, note);
    for (const std::string& text : left_out) report(text);
    if (!arrival.remark.empty()) state.log.add(LogKind::Info, arrival.remark);
}

void EditorModel::open(const std::filesystem::path& path) {
    try {
        if (path.extension() == ".json")
            load_preset_file(path.string());
        else
            start_loading({.scene_name = path.string()});
    } catch (const std::exception& e) {
        report(e.what());
    }
}

bool EditorModel::poll_shaders() {
    return shaders_changed_ = renderer_.shaders_changed() || shaders_changed_;
}

void EditorModel::follow_file_scene() {
    const int wanted = seen_index_ = state.settings.scene.index;
    if (wanted == file_scene_)
        cancel_loading();
    else
        start_loading({.scene_name = state.scene_name, .file_scene = wanted});
}

void EditorModel::follow_time() {
    posed_ = state.settings.scene;
    if (const std::string remark = pose_scene(scene_, posed_); !remark.empty()) state.log.add(LogKind::Warning, remark);
    const Settings base = base_of_scene();
    const Settings before = state.settings;
    for (const SettingRef& ref : all_settings(base))
        if (ref.param->scope == Scope::Light && get_value(state.settings, ref) == get_value(base_, ref))
            set_value(state.settings, ref, get_value(base, ref));
    if (state.settings != before) state.history.follow(before, state.settings);
    base_ = base;
}

bool EditorModel::draw_scene(const EditorActions& actions) {
    FrameRequest wanted;
    wanted.width = std::max(1, actions.scene_width);
    wanted.height = std::max(1, actions.scene_height);
    wanted.outputs.colour = true;
    wanted.outputs.shadow_map = actions.want_map;
    wanted.outputs.overlay = true;
    wanted.outputs.map_coordinates = actions.want_links;
    wanted.outputs.error = actions.want_error;
    wanted.outputs.true_colour = state.against.view != AgainstView::Off && state.against.truth;
    wanted.timing = actions.want_timing;
    wanted.truth = truth_.picture();
    if (!has_scene_) return false;
    // Held against another, the picture is one pane.
    Settings settings = state.settings;
    if (state.against.view != AgainstView::Off) settings.view.panes = int(Panes::One);
    const bool same = drawn_ && renderer_.holds(result_) && !shaders_changed_ && wanted.width == request_.width &&
                      wanted.height == request_.height && wanted.outputs == request_.outputs &&
                      wanted.timing == request_.timing && wanted.truth == request_.truth &&
                      drawn_settings_ == settings && drawn_scene_ == scene_.id;
    if (same || actions.scene_width < 1) return false;
    request_ = wanted;
    drawn_settings_ = settings;
    drawn_scene_ = scene_.id;
    shaders_changed_ = false;
    try {
        result_ = renderer_.render(scene_, drawn_settings_, request_);
        drawn_ = true;
        problem_.clear();
    } catch (const std::exception& e) {
        drawn_ = false;
        if (problem_ != e.what()) report(e.what());
        problem_ = e.what();
    }
    shader_log_ = renderer_.shader_log();
    for (const std::string& message : renderer_.take_gl_messages()) state.log.add(LogKind::Warning, message);
    return true;
}

void EditorModel::take_sweep_base() {
    if (!sweep_.base()) return;
    const ViewSettings view = state.settings.view;
    const int light = sweep_.base()->view.light;
    state.settings = *sweep_.base();
    state.settings.view = view;
    state.settings.view.light = light;
}

bool EditorModel::follow_measuring(const EditorActions& actions) {
    if (actions.want_present && has_scene_)
        sweep_.follow(scene_, state.scene_name, state.settings, state.sweep);
    else
        sweep_.unfollow();
    const bool had_problem = !sweep_.facts().problem.empty();
    const bool changed = sweep_.update(state);
    if (!had_problem && !sweep_.facts().problem.empty()) report("The sweep ended: " + sweep_.facts().problem);
    return changed;
}

bool EditorModel::follow_truth(const EditorActions& actions, bool drawn) {
    if (!drawn_) {
        truth_.clear();
        against_.clear();
        return false;
    }
    const EditorTruth::Wishes wishes{actions.cancel_truth, actions.save_error};
    bool changed = truth_.update(renderer_, scene_, drawn_settings_, request_, result_, drawn, wishes);
    if (const std::string remark = truth_.take_remark(); !remark.empty()) state.log.add(LogKind::Info, remark);
    changed |= against_.update(renderer_, scene_, state, request_, result_, drawn, comparison_);
    return changed;
}

void EditorModel::save_map(const std::string& path) {
    require_scene();
    require_writable(path);
    const bool camera = state.settings.view.map_source == int(MapSource::Camera);
    const View view = find_view(camera ? "camera-depth" : "shadow-map");
    check_view_file(view, path);
    FrameRequest request = request_;
    request.timing = false;
    write_view(renderer_, scene_, state.settings, request, view, path);
    state.log.add(LogKind::Info, "Saved " + path);
}

void EditorModel::start_tuning(const TuneWish& wish) {
    require_scene();
    // A kernel must be drawn to be judged: a picture that is not shown has no size.
    tuner_.start(scene_, state.settings, request_.width, request_.height, wish);
}

bool EditorModel::poll_tuning() {
    const auto outcome = tuner_.end();
    if (!outcome) return false;
    if (!outcome->families.empty()) tuned_ = *outcome;
    if (!outcome->found) {
        if (outcome->failed)
            report(outcome->text);
        else
            state.log.add(LogKind::Info, outcome->text);
        return true;
    }
    // What was searched for is right for that scene, camera and light only.
    Settings now = state.settings;
    apply_tuning(now, outcome->settings);
    now.view = outcome->settings.view;
    if (scene_.id != outcome->scene || !(now == outcome->settings)) {
        state.log.add(LogKind::Warning, "Not applied, as scene or settings changed meanwhile: " + outcome->text);
        return true;
    }
    apply_tuning(state.settings, *outcome->found);
    state.log.add(LogKind::Info, outcome->text);
    return true;
}

void EditorModel::start_cures(const CureWish& wish) {
    require_scene();
    std::vector<CureIdea> own;
    const auto light = std::size_t(std::max(state.settings.view.light, 0));
    const EditorFrame f = facts();
    if (wish.pixel && light < f.dossiers.size() && f.dossiers[light].remedy)
        own.push_back(idea_of(*f.dossiers[light].remedy, state.settings));
    cures_.start(scene_, state.settings, request_.width, request_.height, wish.pixel, std::move(own));
}

bool EditorModel::poll_cures() {
    std::string problem;
    if (!cures_.poll(problem)) return false;
    if (!problem.empty()) state.log.add(LogKind::Warning, problem);
    return true;
}

bool EditorModel::fulfil(const EditorActions& actions) {
    bool changed = poll_loading();
    changed |= poll_tuning();
    changed |= poll_cures();
    const auto attempt = [&](const auto& wish) {
        try {
            wish();
        } catch (const std::exception& e) {
            report(e.what());
        }
        changed = true;
    };
    if (actions.cancel_load) attempt([&] { cancel_loading(), keep_scene(); });
    if (actions.load_scene) attempt([&] { start_loading({.scene_name = *actions.load_scene}); });
    if (actions.load_preset) attempt([&] { load_preset_file(*actions.load_preset); });
    if (actions.open_file) attempt([&] { open(*actions.open_file); });
    if (actions.save_preset)
        attempt([&] { save_preset_file(*actions.save_preset, actions.save_about, actions.replace); });
    if (actions.restore_lost) attempt([&] { restore_lost(); });
    if (actions.discard_lost) attempt([&] { memory_.forget_lost(); });
    if (actions.reset_all && has_scene_)
        attempt([&] { given_ = state.settings = base_settings(scene_), state.guide = {}; });
    if (state.between_steps && !arrival_.step) attempt([&] { follow_step(); });
    if (actions.tune) attempt([&] { start_tuning(*actions.tune); });
    if (actions.cancel_tune) tuner_.cancel();
    if (actions.find_cures) attempt([&] { start_cures(*actions.find_cures); });
    if (actions.cancel_cures) cures_.cancel();
    if (actions.forget_cures) cures_.forget(), changed = true;
    if (actions.save_map) attempt([&] { save_map(*actions.save_map); });
    if (actions.start_sweep)
        attempt([&] { require_scene(), sweep_.start(scene_, state.scene_name, state.settings, *actions.start_sweep); });
    if (actions.cancel_sweep) attempt([&] { sweep_.cancel(); });
    if (actions.open_sweep) attempt([&] { sweep_.open(*actions.open_sweep, state.sweep); });
    if (actions.save_sweep)
        attempt([&] {
            sweep_.save(*actions.save_sweep);
            state.log.add(LogKind::Info, "Saved " + *actions.save_sweep + "/report.html and the tables beside it");
        });
    if (actions.take_sweep_base) attempt([&] { take_sweep_base(); });
    if (actions.copy_command_line && has_scene_) {
        const std::string text =
            command_line(state.scene_name, scene_, state.settings, request_.width, request_.height);
        ImGui::SetClipboardText(text.c_str());
        state.log.add(LogKind::Info, "Copied: " + text);
        changed = true;
    }
    if (has_scene_ && state.settings.scene.index != seen_index_) attempt([&] { follow_file_scene(); });
    if (has_scene_ && state.settings.scene != posed_) attempt([&] { follow_time(); });
    changed |= compare();
    changed |= follow_measuring(actions);
    if (has_scene_) {
        try {
            changed |= readings_.update_frozen(renderer_, scene_, state, actions);
        } catch (const std::exception& e) {
            report(e.what());
            state.frozen.reset();
        }
    }
    const bool drawn = draw_scene(actions);
    try {
        if (drawn_)
            changed |= readings_.update(renderer_, scene_, state, actions, request_, result_, drawn);
        else
            readings_.clear();
    } catch (const std::exception& e) {
        readings_.clear();
        report(e.what());
        changed = true;
    }
    try {
        changed |= follow_truth(actions, drawn);
    } catch (const std::exception& e) {
        report(e.what());
        changed = true;
    }
    return changed || drawn;
}

}  // namespace si
