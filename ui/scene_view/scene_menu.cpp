// Context menu of the object under the mouse in the scene picture.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>

#include "renderer/settings/param.h"
#include "ui/scene_view/camera_steering.h"
#include "ui/scene_view/pick.h"
#include "ui/scene_view/scene_marks.h"
#include "ui/state/selection.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr const char* kMenu = "scene menu";

/// Returns the reference to one setting of each object.
std::vector<SettingRef> refs_of(const Param& p, const std::set<std::string>& paths) {
    std::vector<SettingRef> refs;
    for (const std::string& path : paths) refs.push_back({&p, 0, path});
    return refs;
}

/// Returns the help of an object's setting with its key; "<path>" stands for several selected objects.
std::string tooltip_text(const Param& p, const std::vector<SettingRef>& refs) {
    const std::string path = refs.size() == 1 ? refs.front().object : std::string("<path>");
    return fmt::format("{}\n{}", p.help, setting_key({&p, 0, path}));
}

/// Draws a menu item that switches a setting of all selected objects: on, or off if all have it on already.
void object_switch(Settings& s, const Param& p, const std::set<std::string>& paths) {
    const std::vector<SettingRef> refs = refs_of(p, paths);
    const bool all = std::ranges::all_of(refs, [&](const auto& r) { return std::get<bool>(get_value(s, r)); });
    if (ImGui::MenuItem(std::string(p.label).c_str(), nullptr, all))
        for (const SettingRef& r : refs) set_value(s, r, !all);
    wrapped_tooltip(tooltip_text(p, refs));
}

void object_choice(Settings& s, const Param& p, const std::set<std::string>& paths) {
    const std::vector<SettingRef> refs = refs_of(p, paths);
    const bool open = ImGui::BeginMenu(std::string(p.label).c_str());
    wrapped_tooltip(tooltip_text(p, refs));
    if (!open) return;
    const auto choices = p.choices();
    for (std::size_t i = 0; i < choices.size(); ++i) {
        const bool all =
            std::ranges::all_of(refs, [&](const auto& r) { return std::get<int>(get_value(s, r)) == int(i); });
        if (ImGui::MenuItem(std::string(choices[i].label).c_str(), nullptr, all))
            for (const SettingRef& r : refs) set_value(s, r, int(i));
        wrapped_tooltip(std::string(choices[i].help));
    }
    ImGui::EndMenu();
}

void object_items(EditorState& state, const EditorFrame& frame, const std::set<std::string>& paths) {
    Settings& s = state.settings;
    for (const Param& p : params()) {
        if (p.scope != Scope::Object) continue;
        if (p.choices)
            object_choice(s, p, paths);
        else
            object_switch(s, p, paths);
    }
    ImGui::Separator();
    if (ImGui::MenuItem("Hide", key_text(Command::HideSelected))) hide(s, paths);
    wrapped_tooltip("Not there: neither drawn nor in any shadow");
    if (ImGui::MenuItem("Isolate", key_text(Command::IsolateSelected))) isolate(s, *frame.scene, paths);
    wrapped_tooltip("Hides all else");
    if (ImGui::MenuItem("Let only this cast")) cast_alone(s, *frame.scene, paths);
    wrapped_tooltip("Isolates its shadow: nothing else casts");
}

}  // namespace

void open_scene_menu(EditorState& state, const EditorFrame& frame, const PictureView& view) {
    const ImGuiIO& io = ImGui::GetIO();
    if (!frame.scene || !ImGui::IsItemDeactivated() || !ImGui::IsMouseReleased(ImGuiMouseButton_Right)) return;
    if (state.viewport.camera_flew || io.MouseDragMaxDistanceSqr[ImGuiMouseButton_Right] > kClickPixels * kClickPixels)
        return;
    const ImVec2 at = io.MouseClickedPos[ImGuiMouseButton_Right];
    if (!view.contains({at.x, at.y})) return;
    state.viewport.menu_object = object_at(*frame.scene, view.ray({at.x, at.y}));
    if (!state.viewport.menu_object.empty() && !is_selected(state, state.viewport.menu_object))
        select_objects(state, std::array{state.viewport.menu_object});
    ImGui::SetNextWindowPos(at);
    ImGui::OpenPopup(kMenu);
}

void draw_scene_menu(EditorState& state, const EditorFrame& frame) {
    if (!frame.scene || !ImGui::BeginPopup(kMenu)) return;
    const std::set<std::string> paths = selected_objects(state);
    const bool object = !state.viewport.menu_object.empty() && !paths.empty();
    strong_text(!object ? "Background" : paths.size() == 1 ? *paths.begin() : fmt::format("{} objects", paths.size()));
    ImGui::Separator();
    if (object) {
        if (ImGui::MenuItem("Frame", key_text(Command::FrameSelection))) frame_selection(state, frame);
        if (ImGui::MenuItem("Show in the list")) state.window.open_page = Page::Objects;
        ImGui::Separator();
        object_items(state, frame, paths);
    } else if (ImGui::MenuItem("Frame the whole scene")) {
        select_objects(state, {});
        frame_selection(state, frame);
    }
    if (ImGui::MenuItem("Show all", key_text(Command::ShowAllObjects), false, !all_shown(state.settings)))
        show_all(state.settings);
    const auto silent = [](const auto& own) { return !own.second.cast; };
    if (ImGui::MenuItem("Let all cast", nullptr, false, std::ranges::any_of(state.settings.objects, silent)))
        cast_all(state.settings);
    ImGui::EndPopup();
}

}  // namespace si
