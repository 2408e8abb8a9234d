// What single objects do differently from the scene: culling, casting, receiving.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <string>
#include <vector>

#include "ui/panels.h"
#include "ui/setting_widgets.h"
#include "ui/theme.h"

namespace si {
namespace {

/// Paths of the nodes that place a mesh, and of overrides whose node is not in this scene, matching `search`.
std::vector<std::string> object_paths(const EditorState& state, const Scene& scene) {
    std::vector<char> placed(scene.nodes.size(), 0);
    for (const Object& o : scene.objects) placed[std::size_t(o.node)] = 1;
    std::vector<std::string> paths;
    const auto matches = [&](const std::string& path) {
        return state.object_search.empty() || path.find(state.object_search) != std::string::npos;
    };
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (placed[i] && matches(scene.nodes[i].path)) paths.push_back(scene.nodes[i].path);
    return paths;
}

bool has_override(const Settings& s, const std::string& path) {
    return s.objects.count(path) > 0;
}

}  // namespace

void draw_objects(EditorState& state, const EditorFrame& frame) {
    if (!frame.scene) {
        ImGui::TextDisabled("No scene.");
        return;
    }
    std::vector<const Param*> rows;
    for (const Param& p : params())
        if (p.scope == Scope::Object) rows.push_back(&p);
    const float em = ImGui::GetFontSize();
    ImGui::SetNextItemWidth(em * 18);
    ImGui::InputTextWithHint("##objects", "Search objects", &state.object_search);
    const std::vector<std::string> paths = object_paths(state, *frame.scene);
    ImGui::SameLine();
    ImGui::TextDisabled("%zu objects, %zu with settings of their own", paths.size(), state.settings.objects.size());
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY |
                                      ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_NoSavedSettings;
    if (!ImGui::BeginTable("objects", int(rows.size()) + 1, flags)) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("Object", ImGuiTableColumnFlags_WidthStretch, 3);
    for (const Param* p : rows)
        ImGui::TableSetupColumn(std::string(p->label).c_str(), ImGuiTableColumnFlags_WidthFixed,
                                p->choices ? em * 9 : em * 5);
    ImGui::TableHeadersRow();
    ImGuiListClipper clipper;
    clipper.Begin(int(paths.size()));
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const std::string& path = paths[std::size_t(i)];
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::AlignTextToFramePadding();
            ImGui::PushStyleColor(ImGuiCol_Text, has_override(state.settings, path) ? theme::kAccent : theme::kText);
            ImGui::TextUnformatted(path.c_str());
            ImGui::PopStyleColor();
            for (const Param* p : rows) {
                ImGui::TableNextColumn();
                // Editing a copy keeps objects without overrides out of the settings.
                Settings edited = state.settings;
                if (setting_widget(edited, SettingRef{p, 0, path})) {
                    if (const auto it = edited.objects.find(path);
                        it != edited.objects.end() && it->second == ObjectSettings{})
                        edited.objects.erase(it);
                    state.settings = std::move(edited);
                }
            }
        }
    }
    ImGui::EndTable();
}

}  // namespace si
