#include "app/editor/model.h"

#include <fmt/format.h>
#include <imgui.h>

#include <chrono>
#include <limits>
#include <utility>

#include "app/base/output.h"
#include "app/editor/clipboard.h"
#include "app/editor/requests.h"
#include "app/editor/screenshot.h"
#include "app/report/section_svg.h"
#include "app/session/command_line.h"
#include "renderer/base/error.h"
#include "renderer/base/lower_case.h"
#include "renderer/bundle/bundle_files.h"
#include "renderer/importers/importers.h"
#include "ui/panels/section_view.h"

namespace si {

namespace {

double steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Returns true if the requests start work that draws the shown scene, or a copy of it, under the present settings.
bool draws_scene(const EditorRequests& requests) {
    return requests.export_file || requests.write_report || requests.tune || requests.find_fixes ||
           requests.find_advice || requests.find_waste || requests.compare_pipelines || requests.measure_shimmer ||
           requests.measure_along || requests.measure_day || requests.measure_conversion ||
           requests.measure_saved_times || requests.start_sweep;
}

}  // namespace

Page page_named(const std::string& name) {
    std::string names;
    for (const PageRow& row : kPageTable) {
        if (name.empty() || row.key == name || row.other_key == name) return row.page;
        names += (names.empty() ? "" : ", ") + std::string(row.key);
    }
    throw UsageError(fmt::format("--tab {}: it is one of {}", name, names));
}

EditorModel::EditorModel(const EditorOptions& options, SceneReader read, FrameThread thread)
    : check_numeric_(options.check_numeric),
      offers_pictures_(!options.headless),
      session_(options.report),
      persistence_(options.state_folder),
      scenes_(state, persistence_, std::move(read), options.headless),
      presets_(state, persistence_, scenes_),
      frames_(state, std::move(thread), session_),
      work_(state, options.state_folder),
      import_(state, persistence_, scenes_),
      export_(state),
      report_(state),
      conversion_(state) {
    SessionPlan plan = plan_session(options.session);
    scenes_.set_initial_settings(plan.settings);
    state.engine_panel.profile = plan.engine.profile;
    if (plan.engine.angle_deg) state.engine_panel.angle_deg = *plan.engine.angle_deg;
    state.layout = persistence_.workspace().layout;
    if (!options.theme.empty()) state.layout.light_theme = options.theme == "light";
    state.window.show_welcome = options.welcome && !options.headless && !options.state_folder.empty() &&
                                !persistence_.workspace().welcomed && !persistence_.lost();
    if (!options.preset.empty()) state.files.preset_path = options.preset.string();
    if (options.probe_x >= 0 && options.probe_y >= 0) {
        state.probe_pixel = glm::ivec2(options.probe_x, options.probe_y);
        state.window.open_page = Page::Pixel;
    }
    if (!options.tab.empty()) state.window.open_page = page_named(options.tab);
    if (!options.sweep.empty()) {
        state.sweep.folder = options.sweep.string();
        work_.open_sweep(options.sweep);
        state.window.open_page = Page::Frontier;
    }
    presets_.start(std::move(plan), {});
}

glm::ivec2 EditorModel::picture_size() const {
    const FrameRequest& shown = frames_.facts().request;
    return {shown.width, shown.height};
}

EditorFrame EditorModel::facts() const {
    EditorFrame f;
    f.scene = scenes_.scene();
    frames_.facts().fill(f);
    f.verdict_follows = frames_.busy();
    work_.fill(f, scenes_.scene(), picture_size());
    presets_.fill(f);
    f.importing = import_.facts();
    f.conversion = conversion_.facts();
    f.report = report_.facts();
    persistence_.fill(f);
    f.memory = held_ ? &*held_ : nullptr;
    f.desktop_dialogs = has_desktop_dialog;
    f.scene_saved = scenes_.files_changed();
    f.problem = scenes_.scene() ? frames_.facts().problem : scenes_.problem();
    const SceneLoading& loading = scenes_.loading();
    if (const std::string name = loading.wanted(); !name.empty())
        f.loading = LoadingFacts{name, loading.progress(), loading.seconds_left()};
    if (scenes_.scene() && f.problem.empty()) f.drawing = frames_.first_picture();
    return f;
}

void EditorModel::open(const std::filesystem::path& path) {
    attempt(state, [&] {
        if (lower_extension(path) == ".json" && !is_bundle_path(path))
            presets_.open(path.string());
        else
            open_scene(path.string());
    });
}

void EditorModel::export_file(const ExportRequest& wanted, bool replace) {
    const Scene& scene = scenes_.require();
    if (wanted.kind == ExportKind::Bundle) return export_.start(scene, picture_size(), wanted.path, replace);
    require_outputs_not_read(std::vector<std::filesystem::path>{wanted.path}, scene, {});
    const View view = shown_view(wanted.kind);
    check_view_file(view, wanted.path);
    require_writable(wanted.path);
    if (!replace && is_taken(wanted.path)) {
        state.files.replace = Replacement{.path = wanted.path, .exported = wanted.kind};
        return;
    }
    frames_.save_view(scene, view, wanted.path);
}

View EditorModel::shown_view(ExportKind kind) const {
    if (kind == ExportKind::Picture) return find_view("shaded");
    return find_view(state.settings.view.map_source == MapSource::Camera ? "camera-depth" : "shadow-map");
}

void EditorModel::open_scene(const std::string& name) {
    if (const FrameFile* row = find_frame_file(name))
        import_.open(name, row->kind);
    else
        scenes_.load({.scene_name = name});
}

void EditorModel::save_as(const std::filesystem::path& path) {
    attempt(state, [&] { presets_.save(with_preset_extension(path).string(), state.files.dialog.about, false); });
}

void EditorModel::save_shot(const ShotRequest& request, const ByteImage& window, float pixels) {
    attempt(state, [&] {
        const std::filesystem::path folder = std::filesystem::path(state.files.preset_path).parent_path();
        std::string svg;
        if (const Section* const section = shown_section(); request.of == Shot::Drawing && section)
            svg = section_svg(*section);
        const auto path =
            save_screenshot(cut_out(window, request.rect, pixels), request.of, state.scene_name, folder, svg);
        std::error_code error;
        const auto whole = std::filesystem::absolute(path, error);
        const std::string saved =
            fmt::format("Saved {}{}", (error ? path : whole).string(), svg.empty() ? "" : " and the same as .svg");
        const std::string problem = offers_pictures_ ? copy_png(path) : std::string();
        state.log.add(LogKind::Info, !offers_pictures_ ? saved
                                     : problem.empty() ? saved + ", and copied the picture"
                                                       : fmt::format("{}; not copied: {}", saved, problem));
    });
}

const Section* EditorModel::shown_section() const {
    const Sections& sections = frames_.facts().readings.sections;
    const auto light = std::size_t(std::max(state.settings.view.light, 0));
    return sections && light < sections->size() ? &(*sections)[light] : nullptr;
}

bool EditorModel::save_drawing(const ShotRequest& request, ImGuiSession& imgui) {
    const Section* const section = shown_section();
    if (request.of != Shot::Drawing || !section) return false;
    const SectionSheet sheet = section_sheet(*section);
    const ByteImage drawn = imgui.render_list(*sheet.list, sheet.width, sheet.height);
    save_shot({Shot::Drawing, {{0, 0}, {float(sheet.width), float(sheet.height)}}}, drawn, 1);
    return true;
}

void EditorModel::copy_command_line() {
    const glm::ivec2 size = picture_size();
    const std::string text = command_line(state.scene_name, scenes_.require(), state.settings, size.x, size.y);
    ImGui::SetClipboardText(text.c_str());
    state.log.add(LogKind::Info, "Copied: " + text);
}

bool EditorModel::follow_scene_files() {
    return follow_scene_files(steady_seconds());
}

void EditorModel::write_when_due() {
    persistence_.write_when_due(state, steady_seconds());
    try {
        session_.write_when_due(steady_seconds(), state.log);
    } catch (const std::exception& e) {
        session_.stop_writing();
        report(state, e.what());
    }
}

void EditorModel::save_before_crash() {
    persistence_.write_when_due(state, std::numeric_limits<double>::infinity());
    attempt(state, [&] { session_.write(state.log); });
}

void EditorModel::follow_memory(bool wanted) {
    constexpr double kFreshSeconds = 0.5;
    if (!wanted) held_.reset();
    if (!wanted || (held_ && steady_seconds() < held_at_s_ + kFreshSeconds)) return;
    held_ = memory_report();
    held_at_s_ = steady_seconds();
}

bool EditorModel::fulfil(const EditorRequests& asked) {
    EditorRequests requests = asked;
    requests.search_all = check_numeric_;
    session_.note_frame();
    if (requests.welcomed) persistence_.note_welcome();
    follow_memory(requests.want_memory);
    bool changed = frames_.poll();
    // Work starts on the scene as the settings pose it, which must not change while a frame of it is drawn.
    const bool poses_first = draws_scene(requests) && scenes_.scene_settings_changed();
    if (poses_first) {
        frames_.wait();
        changed |= frames_.poll();
    }
    const std::optional<ReferenceFacts>& reference = frames_.facts().reference;
    session_.note_tracing(reference && reference->doing == "Tracing rays" ? std::optional(reference->progress)
                                                                          : std::nullopt);
    // The scene must not change while a frame of it is drawn.
    if (!frames_.under_way()) changed |= scenes_.poll();
    changed |= work_.poll(scenes_.scene());
    changed |= import_.poll();
    changed |= export_.poll();
    changed |= report_.poll();
    const auto request = [&](bool requested, const auto& what) {
        if (requested) changed |= attempt(state, what);
    };
    request(poses_first, [&] { scenes_.follow_scene_settings(); });
    request(requests.cancel_load, [&] {
        scenes_.cancel_loading();
        scenes_.reset_file_choices();
    });
    request(requests.load_scene.has_value(), [&] { open_scene(*requests.load_scene); });
    request(requests.reload_scene, [&] {
        const glm::ivec2 size = picture_size();
        scenes_.reload(double(std::max(size.x, 1)) / std::max(size.y, 1));
    });
    request(requests.keep_scene, [&] { scenes_.keep_scene(); });
    request(requests.load_preset.has_value(), [&] { presets_.open(*requests.load_preset); });
    request(requests.open_file.has_value(), [&] { open(*requests.open_file); });
    request(requests.save_preset.has_value(),
            [&] { presets_.save(*requests.save_preset, requests.save_about, requests.replace); });
    changed |= import_.fulfil(requests);
    request(requests.export_file.has_value(), [&] { export_file(*requests.export_file, requests.replace); });
    request(requests.write_report.has_value(),
            [&] { report_.start(scenes_.require(), picture_size(), *requests.write_report); });
    if (requests.cancel_report) report_.cancel();
    if (requests.save_conversion) {
        conversion_.save(*requests.save_conversion, scenes_.scene(), requests.replace_conversion);
        changed = true;
    }
    request(requests.restore_lost, [&] { presets_.restore_lost(); });
    request(requests.discard_lost, [&] { persistence_.forget_lost(); });
    request(requests.reset_all && scenes_.scene(), [&] { scenes_.reset(); });
    request(scenes_.undo_step_waits(), [&] { scenes_.show_undo_step(); });
    changed |= work_.fulfil(scenes_, frames_.facts(), requests);
    request(requests.save_error.has_value(), [&] {
        const std::string path = *std::exchange(requests.save_error, {});
        if (const Scene* scene = scenes_.scene())
            require_outputs_not_read(std::vector<std::filesystem::path>{path}, *scene, state.files.preset_path);
        require_writable(path);
        if (!requests.replace && is_taken(path))
            state.files.replace = Replacement{.path = path, .errors = true};
        else
            requests.save_error = path;
    });
    request(requests.copy_command_line && scenes_.scene(), [&] { copy_command_line(); });
    request(scenes_.scene_settings_changed() && !frames_.under_way(), [&] { scenes_.follow_scene_settings(); });
    changed |= presets_.update_comparisons();
    changed |= presets_.update_pictures(requests.want_pictures);
    changed |= work_.update(scenes_.scene(), requests);
    changed |= conversion_.update(facts(), work_.conversion_progress(),
                                  work_.measured_conversion(scenes_.scene(), picture_size()));
    requests.at_rest &= smooths && !measuring();
    if (const Scene* scene = scenes_.scene())
        changed |= frames_.update(*scene, requests, presets_.comparison());
    else
        frames_.clear();
    return changed;
}

}  // namespace si
