// Column of all settings, grouped by the first part of their key.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <vector>

#include "renderer/advise/least_bias.h"
#include "renderer/base/words_match.h"
#include "renderer/profiles/engine_wording.h"
#include "renderer/scene/placement.h"
#include "renderer/settings/idle_reason.h"
#include "ui/panels/engine_panel.h"
#include "ui/panels/lights_panel.h"
#include "ui/state/panels.h"
#include "ui/state/quick_changes.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

struct Group {
    std::string_view prefix, label;
    bool open;  ///< unfolded at the start
};

// Headings of groups, the most used first. A group without a row here has its prefix as heading.
constexpr Group kGroups[] = {
    {"bias", "Bias", true},
    {"filter", "Filter", true},
    {"map", "Shadow map", true},
    {"caster", "Casters", true},
    {"light", "Lights", true},
    {"volumes", "Volumes", false},
    {"contact", "Contact shadows", false},
    {"blob", "Blobs", false},
    {"light_map", "Light maps", false},
    {"camera", "Camera", false},
    {"scene", "Scene, time and place", false},
    {"shading", "Shading", false},
    {"view", "View", false},
    {"truth", "Reference", false},
};

// Rarely used settings. Their groups fold them away while they have their defaults, until the user unfolds the group or
// searches.
constexpr std::string_view kRare[] = {
    "bias.normal_unit",  "bias.normal_by",    "bias.normal_source", "bias.raster_slope",
    "bias.raster_units", "bias.raster_clamp", "filter.method",      "filter.point",
    "filter.bilinear",   "map.wrap",          "map.outside",        "map.far_guard",
    "map.face_guard",    "map.compare",       "map.blur_texels",    "map.samples",
    "map.transform",     "map.origin",        "light.red",          "light.green",
    "light.blue",        "light.snap",        "light.stretch",      "light.cascade_choice",
};

std::string_view prefix_of(std::string_view key) {
    return key.substr(0, key.find('.'));
}

/// Returns the prefixes of all groups in the order in which the panel shows them.
std::vector<Group> groups() {
    std::vector<Group> list(std::begin(kGroups), std::end(kGroups));
    for (const Param& p : params()) {
        const auto prefix = prefix_of(p.key);
        if (p.scope == Scope::Object) continue;  // objects' settings are in the panel Objects
        if (std::ranges::find(list, prefix, &Group::prefix) == list.end()) list.push_back({prefix, prefix, false});
    }
    return list;
}

/// Rows of a group: listed ones, and rarely used ones that are folded away.
struct Rows {
    std::vector<SettingRef> shown, folded;
};

Rows rows_of(const EditorState& state, std::string_view prefix) {
    Rows rows;
    const bool all = !state.settings_panel.search.empty() || state.settings_panel.only_changed ||
                     state.settings_panel.unfolded.contains(prefix);
    const int light = std::max(0, shown_light(state.settings));
    for (const Param& p : params()) {
        if (p.scope == Scope::Object || prefix_of(p.key) != prefix) continue;
        if (p.scope == Scope::Light && state.settings.light_count <= 0) continue;
        SettingRef ref{&p, p.scope == Scope::Light ? light : 0, {}};
        if (state.settings_panel.search.empty() && !unused_setting_reason(state.settings, ref).empty())
            continue;  // matched by its name alone
        if (!setting_matches(ref, state.settings_panel.search) &&
            !engine_name_matches(ref, state.settings_panel.search))
            continue;
        if (state.settings_panel.only_changed && !setting_changed(state.settings, ref)) continue;
        const bool folds =
            !all && std::ranges::find(kRare, p.key) != std::end(kRare) && !setting_changed(state.settings, ref);
        (folds ? rows.folded : rows.shown).push_back(std::move(ref));
    }
    return rows;
}

/// Sorts groups for a search: those whose label matches first, then those with a setting whose label matches.
void sort_front_to_back(std::vector<Group>& list, const EditorState& state) {
    if (state.settings_panel.search.empty()) return;
    const auto rank = [&](const Group& group) {
        if (matches_all_words(state.settings_panel.search, {group.label, group.prefix})) return 0;
        const std::vector<SettingRef> rows = rows_of(state, group.prefix).shown;
        const bool called = std::ranges::any_of(rows, [&](const SettingRef& ref) {
            return matches_all_words(state.settings_panel.search, {ref.param->label, ref.param->key});
        });
        return called ? 1 : 2;
    };
    std::vector<std::pair<int, Group>> ranked;
    for (const Group& group : list) ranked.emplace_back(rank(group), group);
    std::ranges::stable_sort(ranked, {}, [](const auto& r) { return r.first; });
    std::ranges::transform(ranked, list.begin(), [](const auto& r) { return r.second; });
}

/// Returns true when a search finds the group of the engine's parameters: by its name, by that of an engine, or by a
/// parameter of the chosen engine.
bool engine_group_matches(const std::string& search, const EngineProfile* chosen) {
    if (search.empty() || matches_all_words(search, {"Engine profile"})) return true;
    const auto has_name = [&](const EngineProfile& p) { return matches_all_words(search, {p.title, p.name}); };
    const auto has_key = [&](const EngineParameter& p) { return matches_all_words(search, {p.key}); };
    return std::ranges::any_of(engine_profiles(), has_name) ||
           (chosen && std::ranges::any_of(chosen->parameters, has_key));
}

/// Draws the group of the engine's parameters, if it is searched for. Returns false if it is not shown.
bool draw_engine_group(EditorState& state, const EditorFrame& frame) {
    const std::string& search = state.settings_panel.search;
    const EngineProfile* const chosen = state.engine_panel.profile;
    if (state.settings_panel.only_changed || !engine_group_matches(search, chosen)) return false;
    if (!search.empty())
        ImGui::SetNextItemOpen(true);
    else if (chosen)
        ImGui::SetNextItemOpen(true, ImGuiCond_Once);
    ImGui::PushFont(theme::strong());
    const bool open = ImGui::CollapsingHeader("Engine");
    ImGui::PopFont();
    if (open) draw_engine_panel(state.engine_panel, state.settings, frame.result);
    return true;
}

bool begin_rows(const char* id) {
    const ImVec2 padding = ImGui::GetStyle().CellPadding;
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {padding.x, padding.y * 0.5f});
    const bool begun = ImGui::BeginTable(id, 2, ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_NoSavedSettings);
    ImGui::PopStyleVar();
    if (!begun) return false;
    ImGui::TableSetupColumn("label", ImGuiTableColumnFlags_WidthStretch, 0.44f);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.56f);
    return true;
}

/// Draws, at the right end of a group's heading, the number of changed settings and a button that unfolds the rarely
/// used ones. @param label width of the heading's text, pixels
void heading_end(EditorState& state, const Group& group, const Rows& rows, bool open, ImVec2 corner, float width,
                 float label) {
    const float em = ImGui::GetFontSize(), padding = ImGui::GetStyle().FramePadding.y;
    float right = corner.x + width - em * 0.4f;
    const bool unfolded = state.settings_panel.unfolded.contains(group.prefix) && state.settings_panel.search.empty() &&
                          !state.settings_panel.only_changed;
    if (open && (unfolded || !rows.folded.empty())) {
        const std::string more = unfolded ? "less" : fmt::format("{} more", rows.folded.size());
        const ImVec2 after = ImGui::GetCursorPos();
        right -= button_width(more.c_str());
        ImGui::SetCursorScreenPos({right, corner.y + padding});
        ImGui::PushID(std::string(group.prefix).c_str());
        if (ImGui::SmallButton((more + "###more").c_str())) {
            if (unfolded)
                state.settings_panel.unfolded.erase(std::string(group.prefix));
            else
                state.settings_panel.unfolded.emplace(group.prefix);
        }
        ImGui::PopID();
        std::string names = unfolded ? "Only frequently used and changed settings" : "Rarely used:";
        for (const SettingRef& ref : rows.folded)
            names += fmt::format("{} {}", &ref == &rows.folded.front() ? "" : ",", ref.param->label);
        wrapped_tooltip(names);
        ImGui::SetCursorPos(after);
        right -= em * 0.6f;
    }
    const auto changed =
        std::ranges::count_if(rows.shown, [&](const SettingRef& r) { return setting_changed(state.settings, r); });
    if (changed == 0) return;
    const std::string text = fmt::format("{} changed", changed);
    const float from = right - ImGui::CalcTextSize(text.c_str()).x;
    if (from < corner.x + label + em * 0.4f) return;
    ImGui::GetWindowDrawList()->AddText({from, corner.y + padding}, theme::muted(), text.c_str());
}

/// Draws the buttons of the bias: both searches open in the panel Improve.
void bias_buttons(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    const std::string why_not = frame.result && frame.scene
                                    ? reason_without_bias(frame.result->lights, state.settings.view.light)
                                    : "there is no picture yet";
    const float room = ImGui::GetContentRegionAvail().x, gap = ImGui::GetStyle().ItemSpacing.x;
    const float others = button_width("No bias") + button_width("Tune...") + 2 * gap;
    const bool narrow = room - others < button_width("Auto bias");
    ImGui::BeginDisabled(!why_not.empty());
    ImGui::BeginGroup();
    if (ImGui::Button("Auto bias", {narrow ? room : room - others, 0})) {
        if (!frame.tuning) requests.tune = SearchRequest{};
        open_improve(state, ImproveMode::Picture);
    }
    wrapped_tooltip("Tries every kind of bias, and shows the best beside the picture before it is taken: tab Improve");
    if (!narrow) ImGui::SameLine();
    if (ImGui::Button("No bias")) remove_bias(state.settings);
    plain_tooltip(with_key("Sets all bias to 0, to see what needs how much", Command::RemoveBias));
    ImGui::SameLine();
    if (ImGui::Button("Tune...")) open_improve(state, ImproveMode::Limits);
    plain_tooltip("Kernel and resolution, too, within limits of error and time: tab Improve");
    ImGui::EndGroup();
    ImGui::EndDisabled();
    if (!why_not.empty()) plain_tooltip(why_not, ImGuiHoveredFlags_AllowWhenDisabled);
}

void draw_group(EditorState& state, const EditorFrame& frame, EditorRequests& requests, const Group& group) {
    const Rows rows = rows_of(state, group.prefix);
    if (rows.shown.empty() && rows.folded.empty()) return;
    const bool filtered = !state.settings_panel.search.empty() || state.settings_panel.only_changed;
    ImGui::SetNextItemOpen(filtered || group.open, filtered ? ImGuiCond_None : ImGuiCond_FirstUseEver);
    ImGui::PushFont(theme::strong());
    const std::string label = fmt::format("{}###{}", group.label, group.prefix);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const bool open = ImGui::CollapsingHeader(label.c_str(), ImGuiTreeNodeFlags_AllowItemOverlap);
    const float taken = ImGui::GetTreeNodeToLabelSpacing() + ImGui::CalcTextSize(label.c_str(), nullptr, true).x;
    ImGui::PopFont();
    heading_end(state, group, rows, open, at, width, taken);
    if (!open) return;
    ImGui::PushID(std::string(group.prefix).c_str());
    bool table = false;
    if (group.prefix == "light" && (!filtered || state.settings.light_count > 1))
        draw_lights(state.lights, state.settings, state.log, frame.result);
    for (const SettingRef& ref : rows.shown) {
        if (!table && !(table = begin_rows("rows"))) break;
        NamedValues names = view_choices(state.settings, frame.result, ref.param->key);
        if (names.empty()) names = scene_choices(frame.scene, ref.param->key);
        setting_row(state.settings, ref, names);
    }
    if (table) ImGui::EndTable();
    if (group.prefix == "bias" && !filtered) bias_buttons(state, frame, requests);
    ImGui::PopID();
}

}  // namespace

std::string_view setting_group_label(std::string_view prefix) {
    const auto at = std::ranges::find(kGroups, prefix, &Group::prefix);
    return at == std::end(kGroups) ? prefix : at->label;
}

void draw_lights_page(EditorState& state, const EditorFrame& frame) {
    draw_lights(state.lights, state.settings, state.log, frame.result);
    const int light = shown_light(state.settings);
    if (light < 0) return ImGui::TextDisabled("The scene has no light.");
    ImGui::Dummy({0, ImGui::GetFontSize() * 0.1f});
    ImGui::BeginChild("rows", {0, 0}, false, ImGuiWindowFlags_NavFlattened);
    strong_text(light_title(state.settings, light).c_str());
    if (begin_rows("light")) {
        for (const Param& p : params()) {
            const SettingRef ref{&p, light, {}};
            if (p.scope != Scope::Light || !unused_setting_reason(state.settings, ref).empty()) continue;
            NamedValues names = view_choices(state.settings, frame.result, p.key);
            if (names.empty()) names = scene_choices(frame.scene, p.key);
            setting_row(state.settings, ref, names);
        }
        ImGui::EndTable();
    }
    ImGui::EndChild();
}

void draw_settings(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    const float em = ImGui::GetFontSize();
    if (std::exchange(state.settings_panel.focus_search, false)) ImGui::SetKeyboardFocusHere();
    search_field("search", "Search settings", state.settings_panel.search, em * 7.2f,
                 "; other engines' names count too");
    ImGui::SameLine();
    ImGui::Checkbox("Changed", &state.settings_panel.only_changed);
    plain_tooltip("Only settings that differ from their defaults");
    ImGui::Dummy({0, em * 0.1f});
    ImGui::BeginChild("rows", {0, 0}, false, ImGuiWindowFlags_NavFlattened);
    bool any = draw_engine_group(state, frame);
    const SceneSettings placed = state.settings.scene;
    std::vector<Group> shown = groups();
    sort_front_to_back(shown, state);
    for (const Group& group : shown) {
        any |= !rows_of(state, group.prefix).shown.empty();
        draw_group(state, frame, requests, group);
    }
    carry_settings(state.settings, placed, state.settings.scene);
    if (!any)
        ImGui::TextDisabled(state.settings_panel.only_changed ? "Nothing is changed."
                                                              : "No setting matches. × clears the search.");
    if (frame.result && !frame.result->notes.empty()) {
        ImGui::Dummy({0, em * 0.3f});
        for (const std::string& note : frame.result->notes) coloured_wrapped(note, theme::warning());
    }
    ImGui::EndChild();
}

}  // namespace si
