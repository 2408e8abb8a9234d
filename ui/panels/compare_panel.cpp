#include "ui/panels/compare_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <vector>

#include "renderer/settings/idle_reason.h"
#include "renderer/settings/param.h"
#include "ui/panels/presets.h"
#include "ui/state/scene_choices.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/combo.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {

std::string compared_settings_name(const CompareWith& with) {
    if (with.kind == CompareKind::Preset) return with.preset;
    return with.kind == CompareKind::Scene      ? "the scene's own settings"
           : with.kind == CompareKind::Defaults ? "the program's defaults"
           : with.kind == CompareKind::Tried    ? "the tried settings"
                                                : "pinned A";
}

std::string shown_label(const CompareWith& with, std::span<const PresetEntry> presets) {
    if (with.kind != CompareKind::Preset) return compared_settings_name(with);
    for (const PresetEntry& p : presets)
        if (p.key == with.preset) return p.title.empty() ? p.key : p.title;
    return scene_label(with.preset);
}

namespace {

void reference_combo(CompareWith& compare, bool pinned, const PresetsFacts& presets) {
    if (!begin_combo("##reference", shown_label(compare, presets.presets), ImGuiComboFlags_HeightLarge)) return;
    const auto item = [&](const std::string& label, const CompareWith& with, const std::string& hint) {
        if (ImGui::Selectable(label.c_str(), compare == with)) compare = with;
        if (!hint.empty()) plain_tooltip(hint);
    };
    const auto own = [&](CompareKind kind, const std::string& hint) {
        const CompareWith with{kind, {}};
        item(compared_settings_name(with), with, hint);
    };
    own(CompareKind::Scene, "Defaults with what the scene suggests over them");
    own(CompareKind::Defaults, {});
    if (pinned)
        own(CompareKind::Pinned, fmt::format("The settings that {} has pinned", key_text(Command::PinSettings)));
    if (!presets.recent_presets.empty()) ImGui::TextDisabled("Recent presets");
    for (const std::string& path : presets.recent_presets)
        item(scene_label(path) + "##" + path, {CompareKind::Preset, path}, path);
    if (!presets.presets.empty()) ImGui::TextDisabled("Guided presets");
    for (const PresetEntry& p : presets.presets)
        item((p.title.empty() ? p.key : p.title) + "##" + p.key, {CompareKind::Preset, p.key}, p.about);
    ImGui::EndCombo();
}

/// Returns the owner of a setting: "Bias", "Light 2", "Root/Box".
std::string owner(const Settings& settings, const SettingRef& ref) {
    if (ref.param->scope == Scope::Object) return ref.object;
    if (ref.param->scope == Scope::Light) return light_title(settings, ref.light);
    return std::string(setting_group_label(ref.param->key.substr(0, ref.param->key.find('.'))));
}

void cell(const std::string& text, ImU32 colour) {
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    coloured_text(text, colour);
    // The column cuts long names; the tooltip shows the whole name.
    if (ImGui::GetItemRectSize().x > ImGui::GetContentRegionAvail().x) plain_tooltip(text);
}

void setting_line(Settings& settings, const Settings& reference, const SettingRef& ref) {
    const Param& p = *ref.param;
    const bool idle = !idle_reason(settings, ref).empty() && !idle_reason(reference, ref).empty();
    const ImU32 colour = idle ? theme::faint() : theme::text();
    cell(owner(settings, ref), colour);
    cell(std::string(p.label), colour);
    plain_tooltip(setting_key(ref));
    cell(shown_value(settings, ref, get_value(settings, ref)), idle ? theme::faint() : theme::accent());
    cell(shown_value(reference, ref, get_value(reference, ref)), colour);
    ImGui::TableNextColumn();
    ImGui::PushID(setting_key(ref).c_str());
    if (ImGui::Button("Use")) set_value(settings, ref, get_value(reference, ref));
    ImGui::PopID();
    plain_tooltip(idle ? "Without effect on both sides"
                       : fmt::format("Sets this value; {} takes it back", key_text(Command::Undo)));
}

}  // namespace

void draw_compare(CompareWith& compare, Settings& settings, const std::optional<PinnedSettings>& pinned,
                  const std::string& scene_name, const ComparisonFacts* other, const PresetsFacts& presets,
                  PresetRequests& requests) {
    const float em = ImGui::GetFontSize();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Compared with");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(em * 18);
    reference_combo(compare, pinned.has_value(), presets);
    ImGui::SameLine();
    if (!other || other->with != compare) return ImGui::TextDisabled("not read yet");
    if (!other->problem.empty()) {
        ImGui::TextDisabled("cannot be read");
        coloured_wrapped(other->problem, theme::error());
        return;
    }
    const Settings& reference = other->settings;
    const std::string& scene = other->scene;
    const bool other_scene = !scene.empty() && scene != scene_name;
    const std::vector<SettingRef> rows = differing_settings(settings, reference);
    const std::size_t count = rows.size() + other_scene;
    ImGui::TextDisabled("%s",
                        count == 0 ? "equal" : fmt::format("{} difference{}", count, count == 1 ? "" : "s").c_str());
    if (count == 0) return;
    ImGui::SameLine(0, em);
    if (ImGui::Button("Use all settings")) {
        settings = reference;
        return;
    }
    if (!begin_table("differences", ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingStretchProp,
                     {{.heading = "Group", .share = 2},
                      {.heading = "Setting", .share = 2.4f},
                      {.heading = "Shown", .share = 2.4f},
                      {.heading = "Reference", .share = 2.4f},
                      {"", 3.2f}}))
        return;
    if (other_scene) {
        ImGui::TableNextRow();
        cell("Scene", theme::text());
        cell("Scene", theme::text());
        cell(scene_label(scene_name), theme::accent());
        cell(scene_label(scene), theme::text());
        ImGui::TableNextColumn();
        if (ImGui::Button("Use")) requests.load_scene = scene;
        plain_tooltip("Opens this scene under the present settings");
    }
    ImGuiListClipper clipper;
    clipper.Begin(int(rows.size()));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            ImGui::TableNextRow();
            setting_line(settings, reference, rows[std::size_t(i)]);
        }
    ImGui::EndTable();
}

}  // namespace si
