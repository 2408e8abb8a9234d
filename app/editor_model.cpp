#include "app/editor_model.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "app/output.h"
#include "app/presets.h"
#include "app/session.h"
#include "app/views.h"
#include "renderer/error.h"
#include "renderer/param.h"
#include "renderer/scenes/builtin.h"
#include "ui/panels.h"

namespace si {
namespace {

/// Quoted for a POSIX shell where it needs to be.
std::string shell_word(const std::string& text) {
    const auto plain = [](unsigned char c) {
        return std::isalnum(c) || std::string_view("-_./=+:,@%").find(char(c)) != std::string_view::npos;
    };
    if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

int percent(double fraction) {
    return int(fraction * 100);
}

BottomTab tab_named(const std::string& name) {
    if (name.empty() || name == "passes") return BottomTab::Passes;
    if (name == "probe") return BottomTab::Probe;
    if (name == "objects") return BottomTab::Objects;
    if (name == "log") return BottomTab::Log;
    throw UsageError(fmt::format("no tab '{}' in the editor; there are passes, probe, objects and log", name));
}

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

Settings base_settings(const Scene& scene) {
    Settings s;
    apply_suggested(scene, s);
    return s;
}

std::string command_line(const Scene& scene, const Settings& settings, int width, int height) {
    const Settings base = base_settings(scene);
    std::string text =
        fmt::format("shadow-inspector render {} -o out.png --size {}x{}", shell_word(scene.name), width, height);
    for (const SettingRef& ref : all_settings(settings)) {
        const Value value = get_value(settings, ref);
        if (value != get_value(base, ref))
            text += " --set " + shell_word(setting_key(ref) + "=" + value_text(*ref.param, value));
    }
    return text;
}

EditorModel::EditorModel(const EditorOptions& options, SceneReader read) : loading_(std::move(read)) {
    const std::string scene = options.scene.empty() ? std::string(builtin_scenes().front().key) : options.scene;
    scene_ = si::load_scene(scene);
    posed_ = options.settings.scene;
    if (const std::string remark = pose_scene(scene_, posed_); !remark.empty()) state.log.add(LogKind::Warning, remark);
    base_ = options.use_suggested ? base_settings(scene_) : Settings{};
    state.scene_name = scene;
    state.settings = options.settings;
    state.history.reset(state.settings);
    if (!options.preset.empty()) state.preset_path = options.preset.string();
    if (options.probe_x >= 0 && options.probe_y >= 0) {
        state.probe_pixel = glm::ivec2(options.probe_x, options.probe_y);
        state.open_tab = BottomTab::Probe;
    }
    if (!options.tab.empty()) state.open_tab = tab_named(options.tab);
    state.log.add(LogKind::Info,
                  fmt::format("{}: {} objects, {} triangles", scene, scene_.objects.size(), scene_.triangle_count()));
    for (const std::string& warning : scene_.warnings) state.log.add(LogKind::Warning, warning);
}

EditorFrame EditorModel::facts() const {
    EditorFrame f;
    f.scene = &scene_;
    f.driver = drawn_ ? &renderer_.driver() : nullptr;
    f.result = drawn_ ? &result_ : nullptr;
    readings_.fill(f);
    f.presets = presets_;
    f.shader_log = shader_log_;
    f.problem = problem_;
    if (const std::string name = loading_.wanted(); !name.empty()) {
        f.loading = LoadingFacts{name, loading_.progress()};
        shown_percent_ = percent(f.loading->progress);
    } else {
        shown_percent_ = -1;
    }
    return f;
}

void EditorModel::report(const std::string& error) {
    state.log.add(LogKind::Error, error);
    state.open_tab = BottomTab::Log;
}

bool EditorModel::loading_moved() const {
    return loading_.ended() || (!loading_.wanted().empty() && percent(loading_.progress()) != shown_percent_);
}

void EditorModel::finish_loading() {
    while (loading_.busy()) {
        loading_.wait();
        poll_loading();
    }
}

void EditorModel::cancel_loading() {
    if (const std::string name = loading_.wanted(); !name.empty())
        state.log.add(LogKind::Info, fmt::format("Cancelled: {} was not loaded", name));
    loading_.cancel();
    arrival_.reset();
}

void EditorModel::start_loading(const std::string& name_or_path, std::optional<Arrival> arrival) {
    cancel_loading();
    loading_.start(name_or_path);
    arrival_ = std::move(arrival);
}

bool EditorModel::poll_loading() {
    if (!loading_.ended()) return false;
    std::optional<SceneLoading::Outcome> outcome = loading_.poll();
    if (!outcome) return true;
    const std::optional<Arrival> arrival = std::exchange(arrival_, {});
    try {
        if (!outcome->scene) throw Error(outcome->error);
        show_scene(std::move(*outcome->scene), outcome->name);
        if (arrival) {
            state.settings = arrival->settings;
            state.log.add(LogKind::Info, arrival->remark);
        }
    } catch (const std::exception& e) {
        report(e.what());
    }
    return true;
}

void EditorModel::show_scene(Scene loaded, const std::string& name_or_path) {
    const Settings base = base_settings(loaded);
    posed_ = {};
    state.settings = rebased(state.settings, base_, base);
    scene_ = std::move(loaded);
    base_ = base;
    state.scene_name = name_or_path;
    state.probe_pixel.reset();
    state.map_window = {};
    state.log.add(LogKind::Info, fmt::format("{}: {} objects, {} triangles", name_or_path, scene_.objects.size(),
                                             scene_.triangle_count()));
    for (const std::string& warning : scene_.warnings) state.log.add(LogKind::Warning, warning);
}

void EditorModel::load_preset_file(const std::string& name_or_path) {
    const Preset preset = si::load_preset(name_or_path);
    const std::string remark =
        preset.about.empty() ? "Opened " + name_or_path : fmt::format("Opened {}: {}", name_or_path, preset.about);
    if (!preset.scene.empty() && preset.scene != state.scene_name) {
        start_loading(preset.scene, Arrival{preset.settings, remark});
        return;
    }
    if (!preset.scene.empty()) cancel_loading();  // it belongs to the scene that is shown
    state.settings = preset.settings;
    state.log.add(LogKind::Info, remark);
}

void EditorModel::save_preset_file(const std::filesystem::path& path) {
    si::save_preset({.about = {}, .scene = state.scene_name, .settings = state.settings}, path);
    state.log.add(LogKind::Info, "Saved " + path.string());
}

void EditorModel::open(const std::filesystem::path& path) {
    try {
        if (path.extension() == ".json")
            load_preset_file(path.string());
        else
            start_loading(path.string());
    } catch (const std::exception& e) {
        report(e.what());
    }
}

bool EditorModel::poll_shaders() {
    return shaders_changed_ = renderer_.shaders_changed() || shaders_changed_;
}

void EditorModel::follow_time() {
    if (state.settings.scene == posed_) return;
    posed_ = state.settings.scene;
    if (const std::string remark = pose_scene(scene_, posed_); !remark.empty()) state.log.add(LogKind::Warning, remark);
    const Settings base = base_settings(scene_);
    for (const SettingRef& ref : all_settings(base))
        if (ref.param->scope == Scope::Light && get_value(state.settings, ref) == get_value(base_, ref))
            set_value(state.settings, ref, get_value(base, ref));
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
    wanted.timing = actions.want_timing;
    const bool same = drawn_ && !shaders_changed_ && wanted.width == request_.width &&
                      wanted.height == request_.height && wanted.outputs == request_.outputs &&
                      wanted.timing == request_.timing && drawn_settings_ == state.settings &&
                      drawn_scene_ == scene_.id;
    if (same || actions.scene_width < 1) return false;
    request_ = wanted;
    drawn_settings_ = state.settings;
    drawn_scene_ = scene_.id;
    shaders_changed_ = false;
    try {
        result_ = renderer_.render(scene_, state.settings, request_);
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

void EditorModel::save_map(const std::string& path) {
    require_writable(path);
    const bool camera = state.settings.view.map_source == int(MapSource::Camera);
    const View view = find_view(camera ? "camera-depth" : "shadow-map");
    check_view_file(view, path);
    FrameRequest request = request_;
    request.timing = false;
    write_view(renderer_, scene_, state.settings, request, view, path);
    drawn_scene_ = 0;  // the passes of another request ran: draw anew
    state.log.add(LogKind::Info, "Saved " + path);
}

bool EditorModel::fulfil(const EditorActions& actions) {
    bool changed = poll_loading();
    const auto attempt = [&](const auto& wish) {
        try {
            wish();
        } catch (const std::exception& e) {
            report(e.what());
        }
        changed = true;
    };
    if (actions.cancel_load) attempt([&] { cancel_loading(); });
    if (actions.load_scene) attempt([&] { start_loading(*actions.load_scene); });
    if (actions.load_preset) attempt([&] { load_preset_file(*actions.load_preset); });
    if (actions.save_preset) attempt([&] { save_preset_file(*actions.save_preset); });
    if (actions.save_map) attempt([&] { save_map(*actions.save_map); });
    if (actions.copy_command_line) {
        const std::string text = command_line(scene_, state.settings, request_.width, request_.height);
        ImGui::SetClipboardText(text.c_str());
        state.log.add(LogKind::Info, "Copied: " + text);
        changed = true;
    }
    if (state.settings.scene != posed_) attempt([&] { follow_time(); });
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
    return changed || drawn;
}

}  // namespace si
