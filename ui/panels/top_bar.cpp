// Top bar: file menu, scene, guided presets, open preset, undo.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "renderer/scenes/builtin.h"
#include "ui/state/panels.h"
#include "ui/state/playback.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/combo.h"
#include "ui/widgets/free_name.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/toolbar.h"

namespace si {
namespace {

void recent_menu(const char* label, std::span<const std::string> paths, std::optional<std::string>& request) {
    if (!ImGui::BeginMenu(label, !paths.empty())) return;
    for (const std::string& path : paths) {
        if (ImGui::MenuItem((scene_label(path) + "##" + path).c_str())) request = path;
        plain_tooltip(path);
    }
    ImGui::EndMenu();
}

void file_menu(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    menu_button("File", "file", "Open, save, compare, copy the command line", ImGui::GetFontSize() * 20);
    if (!ImGui::BeginPopup("file")) return;
    const auto item = [&](const char* label, Command command) {
        if (ImGui::MenuItem(label, key_text(command))) run_command(command, state, frame, requests);
    };
    item("Open…", Command::OpenFile);
    recent_menu("Recent scenes", frame.recent_scenes, requests.load_scene);
    recent_menu("Recent presets", frame.recent_presets, requests.load_preset);
    item("Reload the scene", Command::ReloadScene);
    plain_tooltip(fmt::format("Reads {} again; camera, settings and selection stay", state.scene_name));
    ImGui::Separator();
    item("Save the preset", Command::SavePreset);
    plain_tooltip(state.files.preset_path);
    item("Save the preset as…", Command::SavePresetAs);
    item("Back to the saved preset", Command::RevertPreset);
    plain_tooltip(fmt::format("Reads {} again; undo gives all back", state.files.preset_path));
    ImGui::Separator();
    if (ImGui::MenuItem("Compare with a preset…")) state.window.open_page = Page::Compare;
    if (ImGui::MenuItem("Reset all to the scene's own settings")) requests.reset_all = true;
    plain_tooltip("The program's defaults with what the scene suggests over them; undo gives all back");
    item("Copy command line", Command::CopyCommandLine);
    plain_tooltip("The command that renders this picture without a window");
    if (ImGui::MenuItem("Save map, matrices and picture"))
        requests.export_file = ExportRequest{
            ExportKind::Bundle, free_bundle_path(std::filesystem::path(state.files.preset_path).parent_path(),
                                                 scene_label(state.scene_name))
                                    .string()};
    plain_tooltip("This frame as a bundle in the preset's folder, under a free name that the log prints");
    item("Export…", Command::Export);
    plain_tooltip(
        "This frame as a bundle (scene, camera, shadow maps and matrices), picture, map, or an engine's code");
    if (ImGui::MenuItem("Convert…")) state.convert.asked = true;
    plain_tooltip("The shadow settings as code of an engine, a graphics API, C++ or GLSL, to copy or save");
    if (ImGui::MenuItem("Report…")) state.report.asked = true;
    plain_tooltip("A page that compares the present settings with pinned ones and presets, to attach to a bug");
    if (ImGui::BeginMenu("Screenshot")) {
        item("of the scene", Command::SceneScreenshot);
        item("of the map", Command::MapScreenshot);
        item("of the window", Command::WindowScreenshot);
        if (ImGui::MenuItem("of the probe's drawing")) state.shots.next = Shot::Drawing;
        plain_tooltip("As a PNG, and as an SVG of any size");
        ImGui::EndMenu();
    }
    plain_tooltip(
        "A PNG in the preset's folder under a free name, which the log prints, and in the clipboard to paste");
    ImGui::Separator();
    item("Quit", Command::Quit);
    ImGui::EndPopup();
}

void scene_combo(EditorState& state, EditorRequests& requests, float width) {
    ImGui::SetNextItemWidth(width);
    if (!begin_combo("##scene", scene_label(state.scene_name), ImGuiComboFlags_HeightLarge)) return;
    for (const BuiltinScene& scene : builtin_scenes()) {
        const std::string key(scene.key), label(scene.label);
        if (ImGui::Selectable((label + "##" + key).c_str(), key == state.scene_name)) requests.load_scene = key;
        if (!scene.help.empty()) plain_tooltip(std::string(scene.help));
    }
    ImGui::Separator();
    if (path_input("##path", "path of a model", state.files.scene_input, "Open"))
        requests.load_scene = state.files.scene_input;
    ImGui::EndCombo();
}

void guided_presets(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    const auto before = neighbour_preset(state, frame, -1), after = neighbour_preset(state, frame, +1);
    if (ImGui::ArrowButton("previous preset", ImGuiDir_Left) && before) requests.load_preset = before;
    plain_tooltip(with_key("The guided preset before", Command::PreviousPreset));
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    menu_button("Guided presets", "guided presets",
                "Artefacts and their fixes, each with a sentence on what to look at", gallery_width());
    draw_gallery("guided presets", state.gallery, frame.presets, state.files.guide.key, requests);
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    if (ImGui::ArrowButton("next preset", ImGuiDir_Right) && after) requests.load_preset = after;
    plain_tooltip(with_key("The guided preset after", Command::NextPreset));
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    menu_button("Hard cases", "hard cases", "Scenes in which shadow maps fail, each with and without the fix",
                gallery_width());
    draw_gallery("hard cases", state.gallery, frame.hard_cases, state.files.guide.key, requests);
}

/// Draws the menu of theme and layout.
void view_menu(EditorState& state, const char* label) {
    menu_button(label, "view", "Theme and panels", ImGui::GetFontSize() * 18);
    if (!ImGui::BeginPopup("view")) return;
    EditorLayout& layout = state.layout;
    if (ImGui::MenuItem("Dark theme", nullptr, !layout.light_theme)) layout.light_theme = false;
    if (ImGui::MenuItem("Light theme", nullptr, layout.light_theme)) layout.light_theme = true;
    ImGui::Separator();
    constexpr std::pair<const char*, MapSpot> kSpots[] = {{"Map above the inspector", MapSpot::AboveSettings},
                                                          {"Map beside the scene", MapSpot::NextToScene},
                                                          {"Map in the scene's corner", MapSpot::Inset},
                                                          {"No map", MapSpot::Hidden}};
    for (const auto& [name, spot] : kSpots)
        if (ImGui::MenuItem(name, layout.map_place == spot ? key_text(Command::NextMapPlace) : nullptr,
                            layout.map_place == spot))
            layout.map_place = spot;
    ImGui::Separator();
    constexpr std::pair<const char*, Panel> kPanels[] = {{"Scene alone", Panel::Scene},
                                                         {"Map alone", Panel::Map},
                                                         {"Strip alone", Panel::Strip},
                                                         {"Inspector alone", Panel::Inspector}};
    for (const auto& [name, which] : kPanels)
        if (ImGui::MenuItem(name, key_text(Command::MaximisePanel))) toggle_maximised(state, which);
    ImGui::Separator();
    ImGui::MenuItem("Strip of plots and tables", key_text(Command::ToggleStrip), &layout.strip_open);
    ImGui::MenuItem("Desktop's file dialogs", nullptr, &layout.desktop_dialogs);
    plain_tooltip("Files are chosen in the desktop's own dialog where it has one, else in the editor's");
    if (ImGui::MenuItem("Reset layout"))
        layout = {.map_place = layout.map_place,
                  .map_plots = layout.map_plots,
                  .light_theme = layout.light_theme,
                  .desktop_dialogs = layout.desktop_dialogs};
    if (ImGui::MenuItem("Welcome")) state.window.show_welcome = true;
    ImGui::EndPopup();
}

/// Draws the menu of all steps of undo; a click goes to a step.
void steps_menu(EditorState& state) {
    const float em = ImGui::GetFontSize();
    menu_button("History", "steps", "What was changed, step by step; a click goes there", em * 24);
    ImGui::SetNextWindowSizeConstraints({em * 12, 0}, {em * 24, em * 30});
    if (!ImGui::BeginPopup("steps")) return;
    const std::vector<std::string> names = state.history.names();
    for (std::size_t i = names.size(), here = state.history.index(); i-- > 0;) {
        ImGui::PushStyleColor(ImGuiCol_Text, i > here ? theme::muted() : theme::text());
        if (ImGui::Selectable(fmt::format("{}##{}", names[i], i).c_str(), i == here)) go_to_step(state, i);
        ImGui::PopStyleColor();
    }
    ImGui::EndPopup();
}

/// Draws the name of the file that SavePreset writes, with a dot while the settings differ from it.
void preset_name(const EditorState& state, const EditorFrame& frame, float width) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", end_that_fits(scene_label(state.files.preset_path), width, ImGui::GetFont()).c_str());
    plain_tooltip(state.files.preset_path + "\n" +
                  (frame.unsaved ? fmt::format("{} saves the present settings there", key_text(Command::SavePreset))
                                 : "It holds the present settings"));
    if (!frame.unsaved) return;
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float em = ImGui::GetFontSize();
    ImGui::GetWindowDrawList()->AddCircleFilled({at.x + em * 0.17f, at.y + ImGui::GetFrameHeight() * 0.5f}, em * 0.17f,
                                                theme::accent(), 12);
    ImGui::Dummy({em * 0.34f, ImGui::GetFrameHeight()});
}

}  // namespace

void draw_top_bar(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    const float em = ImGui::GetFontSize(), close = ImGui::GetStyle().ItemInnerSpacing.x;
    const char *help = "Help", *view = "View";
    const float right = button_width(view) + close + button_width(help);
    const float edge = ImGui::GetWindowWidth() - right - ImGui::GetStyle().WindowPadding.x;
    Toolbar bar("top bar", right + em * 0.5f);
    bar.item("", button_width("File"), [&](float) { file_menu(state, frame, requests); });
    bar.space(em);
    bar.item("", em * 11, [&](float room) { scene_combo(state, requests, room); });
    bar.space(em);
    const float arrows = 2 * (ImGui::GetFrameHeight() + close) + button_width("Guided presets") + close;
    bar.item("", arrows + button_width("Hard cases"), [&](float) { guided_presets(state, frame, requests); });
    bar.space(em);
    bar.item("", button_width("Undo"), [&](float) {
        if (hint_button("Undo", key_text(Command::Undo), state.history.can_undo() || state.playback.playing))
            undo(state);
    });
    bar.item("", button_width("Redo"), [&](float) {
        if (hint_button("Redo", key_text(Command::Redo), state.history.can_redo())) redo(state);
    });
    bar.space(close);
    bar.item("", button_width("History"), [&](float) { steps_menu(state); });
    bar.space(em);
    bar.item("", button_width("Settings diff"), [&](float) {
        if (hint_button("Settings diff", "What differs from the scene's own settings, the defaults or a preset"))
            state.window.open_page = Page::Compare;
    });
    bar.space(em);
    bar.item("", button_width("Save"), [&](float) {
        if (hint_button("Save", with_key("Writes " + state.files.preset_path, Command::SavePreset)))
            requests.save_preset = state.files.preset_path;
    });
    bar.end();
    ImGui::SameLine();
    if (const float room = edge - ImGui::GetCursorPosX() - 2 * em; room > em * 3) preset_name(state, frame, room);
    ImGui::SameLine(std::max(edge, 0.0f));
    view_menu(state, view);
    ImGui::SameLine(0, close);
    if (hint_button(help, with_key("Mouse and keyboard", Command::ToggleOverview))) state.window.show_shortcuts = true;
}

}  // namespace si
