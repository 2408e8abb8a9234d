// What single objects do differently from the scene: culling, casting, receiving; which of them culling loses.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "ui/state/panels.h"
#include "ui/widgets/search_field.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

/// What stands on one row: a node that places at least one mesh.
struct Row {
    const std::string* path;
    std::size_t triangles = 0;
    const LostCaster* lost = nullptr;  ///< one of its objects leaves nothing in the shown light's map
};

/// The nodes that place a mesh and match the search.
std::vector<Row> rows_of(const EditorState& state, const EditorFrame& frame) {
    const Scene& scene = *frame.scene;
    std::vector<std::size_t> triangles(scene.nodes.size(), 0);
    std::vector<char> placed(scene.nodes.size(), 0);
    std::vector<const LostCaster*> lost(scene.nodes.size(), nullptr);
    for (const Object& o : scene.objects) {
        placed[std::size_t(o.node)] = 1;
        triangles[std::size_t(o.node)] += scene.meshes[std::size_t(o.mesh)].indices.size() / 3;
    }
    for (const LostCaster& l : frame.lost_casters)
        if (std::size_t(l.object) < scene.objects.size())
            lost[std::size_t(scene.objects[std::size_t(l.object)].node)] = &l;
    std::vector<Row> rows;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (!placed[i] || (state.only_lost && !lost[i])) continue;
        const std::string& path = scene.nodes[i].path;
        if (words_match(state.object_search, {path})) rows.push_back({&path, triangles[i], lost[i]});
    }
    return rows;
}

/// A copy of all but the objects' settings.
Settings without_objects(Settings& s) {
    std::map<std::string, ObjectSettings> aside;
    aside.swap(s.objects);
    Settings out = s;
    s.objects.swap(aside);
    return out;
}

bool has_override(const Settings& s, const std::string& path) {
    return s.objects.count(path) > 0;
}

/// Lets the objects cast with all of their faces.
void keep(Settings& s, const std::vector<Row>& rows) {
    for (const Row& row : rows)
        if (row.lost) s.objects[*row.path].cull = int(ObjectCull::None);
}

void lost_line(EditorState& state, const EditorFrame& frame, const std::vector<Row>& rows) {
    if (frame.lost_casters.empty()) {
        state.only_lost = false;
        return;
    }
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Text, theme::kWarning);
    ImGui::TextUnformatted(fmt::format("{} lost to culling", frame.lost_casters.size()).c_str());
    ImGui::PopStyleColor();
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip(
            "Objects that are to cast a shadow but leave nothing in light %d's map: every one of their\n"
            "triangles faces the way that is culled. Floors and open meshes have no back.",
            shown_light(state.settings));
    ImGui::SameLine();
    ImGui::Checkbox("Show only lost", &state.only_lost);
    ImGui::SameLine();
    if (ImGui::Button("Cast from both sides")) keep(state.settings, rows);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Set object.<path>.cull to none for each, so that all faces cast");
}

/// The object's name, which selects it.
void name_cell(EditorState& state, const Row& row) {
    const bool chosen = state.selected_object == *row.path;
    const bool own = has_override(state.settings, *row.path);
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, row.lost ? theme::kWarning : own ? theme::kAccent : theme::kText);
    const std::string label = row.lost ? *row.path + "   lost by culling" : *row.path;
    if (ImGui::Selectable((label + "###" + *row.path).c_str(), chosen)) {
        if (chosen)
            state.selected_object.clear();
        else
            state.selected_object = *row.path;
    }
    ImGui::PopStyleColor();
    if (!ImGui::IsItemHovered()) return;
    if (row.lost)
        ImGui::SetTooltip("%s-face culling removes all %zu triangles.\nSet Cull to none to keep it.",
                          row.lost->cull == int(Cull::Front) ? "Front" : "Back", row.lost->triangles);
    else
        ImGui::SetTooltip("Click to select; F frames it");
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
    search_field("objects", "Search objects", state.object_search, ImGui::GetContentRegionAvail().x - em * 18);
    const std::vector<Row> list = rows_of(state, frame);
    ImGui::SameLine();
    ImGui::TextDisabled("%zu object%s, %zu with settings of their own", list.size(), list.size() == 1 ? "" : "s",
                        state.settings.objects.size());
    lost_line(state, frame, list);
    if (list.empty()) {
        ImGui::TextDisabled(state.object_search.empty() ? "No object casts or receives."
                                                        : "No object's path holds these words. × clears the search.");
        return;
    }
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY |
                                      ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_NoSavedSettings;
    if (!ImGui::BeginTable("objects", int(rows.size()) + 2, flags)) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("Object", ImGuiTableColumnFlags_WidthStretch, 3);
    ImGui::TableSetupColumn("Triangles", ImGuiTableColumnFlags_WidthFixed, em * 5);
    for (const Param* p : rows)
        ImGui::TableSetupColumn(std::string(p->label).c_str(), ImGuiTableColumnFlags_WidthFixed,
                                p->choices ? em * 9 : em * 5);
    ImGui::TableHeadersRow();
    // The settings with one object's at a time: a widget may leave an override equal to the defaults, which set_value()
    // does not; and copies of ten thousand overrides for each widget would be slow.
    Settings alone = without_objects(state.settings);
    ImGuiListClipper clipper;
    clipper.Begin(int(list.size()));
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const Row& row = list[std::size_t(i)];
            const std::string& path = *row.path;
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            name_cell(state, row);
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(fmt::format("{}", row.triangles).c_str());
            for (const Param* p : rows) {
                ImGui::TableNextColumn();
                const SettingRef ref{p, 0, path};
                set_value(alone, ref, get_value(state.settings, ref));
                if (setting_widget(alone, ref)) set_value(state.settings, ref, get_value(alone, ref));
                alone.objects.clear();
            }
        }
    }
    ImGui::EndTable();
}

}  // namespace si
