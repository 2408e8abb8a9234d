#include "ui/panels/lights_panel.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "renderer/base/error.h"
#include "renderer/base/lengths_text.h"
#include "renderer/frame/frame.h"
#include "renderer/projection/view_choice.h"
#include "renderer/settings/param.h"
#include "ui/state/light_list.h"
#include "ui/state/log.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

// IEC 61966-2-1: settings are linear, the colour chooser shows screen colours (sRGB).
float shown(double linear) {
    const double v = std::clamp(linear, 0.0, 1.0);
    return float(v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055);
}
double linear(float shown) {
    const double v = std::clamp(double(shown), 0.0, 1.0);
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// Draws the widgets of a light's colour and intensity. @param number number of the light, for its setting keys
void swatch(LightSettings& light, int number) {
    float rgb[] = {shown(light.red), shown(light.green), shown(light.blue)};
    if (ImGui::ColorEdit3("##colour", rgb, ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoTooltip)) {
        // Unchanged channels keep all digits.
        double* parts[] = {&light.red, &light.green, &light.blue};
        for (int i = 0; i < 3; ++i)
            if (rgb[i] != shown(*parts[i])) *parts[i] = linear(rgb[i]);
    }
    wrapped_tooltip(fmt::format("Colour, as the screen shows it; linear {}, {}, {}\n{}, .green, .blue",
                                digits_text(light.red), digits_text(light.green), digits_text(light.blue),
                                setting_key(*find_setting(fmt::format("light.{}.red", number)))));
}

/// Draws the text field that renames a light. Enter or a click elsewhere accepts the name; Escape does not.
void rename_field(LightsPanel& panel, Settings& settings, Log& log) {
    LightRename& rename = *panel.rename;
    if (!rename.begun) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::InputTextWithHint("##name", "name", &rename.name, ImGuiInputTextFlags_AutoSelectAll);
    if (ImGui::IsItemActive()) rename.begun = true;
    if (!rename.begun || ImGui::IsItemActive()) return;
    if (ImGui::IsItemDeactivatedAfterEdit()) {
        try {
            set_setting(settings, fmt::format("light.{}.name", rename.light), rename.name);
        } catch (const UsageError& e) {
            log.add(LogKind::Error, e.what());
        }
    }
    panel.rename.reset();
}

void light_name(LightsPanel& panel, Settings& s, int i) {
    const LightSettings& light = s.lights[std::size_t(i)];
    SettingRef type_of = *find_setting("light.type");
    type_of.light = i;
    const std::string type = shown_value(s, type_of, get_value(s, type_of));
    const std::string text = fmt::format("{} {}###shown", i, light.name.empty() ? type : light.name);
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, light.on ? theme::text() : theme::muted());
    if (ImGui::Selectable(text.c_str(), i == shown_light(s), ImGuiSelectableFlags_AllowDoubleClick)) {
        s.view.light = i;
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) begin_light_rename(panel, s, i);
    }
    ImGui::PopStyleColor();
    wrapped_tooltip(
        fmt::format("{}. Its settings below, its map in the map viewer, its handles in the scene. {} changes "
                    "its type; double-click or {} renames it",
                    type, key_text(Command::NextLightType), key_text(Command::RenameLight)));
}

void light_row(LightsPanel& panel, Settings& s, Log& log, int i, bool intensities) {
    LightSettings& light = s.lights[std::size_t(i)];
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushID(i);
    if (panel.rename && panel.rename->light == i)
        rename_field(panel, s, log);
    else
        light_name(panel, s, i);
    ImGui::TableNextColumn();
    ImGui::Checkbox("##on", &light.on);
    wrapped_tooltip(fmt::format("On: it shines. Off it keeps its settings, and no map is drawn for it\n{}",
                                setting_key(*find_setting(fmt::format("light.{}.on", i)))));
    ImGui::TableNextColumn();
    ImGui::BeginDisabled(s.light_count < 2);
    if (toggle_button("Solo", s.light_count > 1 && is_solo(s, i))) solo_light(s, i);
    ImGui::EndDisabled();
    wrapped_tooltip("Switches all others off; again: all on");
    ImGui::TableNextColumn();
    swatch(light, i);
    if (intensities) {
        ImGui::TableNextColumn();
        setting_widget(s, fmt::format("light.{}.intensity", i));
    }
    ImGui::PopID();
}

/// Draws the buttons that change the list of lights, in as many lines as they need.
void list_buttons(Settings& s) {
    const int shown = shown_light(s);
    bool first = true;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing,
                        {ImGui::GetStyle().ItemInnerSpacing.x, ImGui::GetStyle().ItemSpacing.y});
    const auto button = [&](bool possible, const char* label, const std::string& tip) {
        if (!std::exchange(first, false)) same_line_if_fits(button_width(label));
        const bool pressed = button_if(possible, label);
        wrapped_tooltip(tip);
        return pressed;
    };
    if (button(can_add_light(s), "Add light", fmt::format("One more, apart from the others; at most {}", kMaxLights)))
        add_light(s);
    if (button(shown >= 0 && can_add_light(s), "Copy", "One more like the light shown")) copy_light(s, shown);
    if (button(shown >= 0, "Delete",
               fmt::format("Takes the light shown away ({} brings it back)", key_text(Command::Undo))))
        delete_light(s, shown);
    if (button(shown > 0, "<", "Moves the light shown one place ahead in the list")) move_light(s, shown, -1);
    if (button(shown >= 0 && shown + 1 < s.light_count, ">", "Moves the light shown one place back in the list"))
        move_light(s, shown, 1);
    ImGui::PopStyleVar();
}

/// Draws the six faces of a cube map as a cross; a click shows a face. Faces are numbered +x -x +y -y +z -z.
void cube_cross(Settings& s, const FrameResult& result) {
    const FittedLight* const light = shown_fitted_light(s, result);
    constexpr int kFaces = 6, kAcross = 4;
    constexpr int kColumn[kFaces] = {2, 0, 1, 1, 1, 3}, kRow[kFaces] = {1, 1, 0, 2, 1, 1};
    if (!light || light->chooser.choice != ViewChoice::Face || light->views.size() != kFaces) return;
    const float em = ImGui::GetFontSize(), gap = em * 0.15f;
    const ImVec2 size(em * 2.6f, ImGui::GetFrameHeight()), at = ImGui::GetCursorPos();
    const int now = shown_face(s, result);
    ImGui::PushID("cube");
    for (int face = 0; face < kFaces; ++face) {
        const std::string mark = view_short_name(ViewChoice::Face, std::size_t(face));
        ImGui::SetCursorPos({at.x + float(kColumn[face]) * (size.x + gap), at.y + float(kRow[face]) * (size.y + gap)});
        if (toggle_button(mark.c_str(), face == now, size)) s.view.face = face;
        wrapped_tooltip(fmt::format("The map viewer shows the face towards {}", mark));
    }
    ImGui::SetCursorPos({at.x + float(kAcross) * (size.x + gap) + em * 0.3f, at.y + size.y + gap});
    ImGui::AlignTextToFramePadding();
    constexpr const char* kCaption = "face shown";
    if (ImGui::CalcTextSize(kCaption).x <= ImGui::GetContentRegionAvail().x) ImGui::TextDisabled(kCaption);
    ImGui::SetCursorPos({at.x, at.y + 3 * (size.y + gap)});
    ImGui::Dummy({0, 0});
    ImGui::PopID();
}

}  // namespace

void begin_light_rename(LightsPanel& panel, const Settings& settings, int light) {
    panel.rename = LightRename{light, settings.lights[std::size_t(light)].name};
}

void draw_lights(LightsPanel& panel, Settings& s, Log& log, const FrameResult* result) {
    const float em = ImGui::GetFontSize();
    list_buttons(s);  // above the list, which grows and shrinks
    // In a narrow panel the name has priority: the intensity is also among the settings below.
    const bool intensities = ImGui::GetContentRegionAvail().x >= em * 20;
    if (shown_light(s) >= 0 && ImGui::BeginTable("lights", intensities ? 5 : 4,
                                                 ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_NoSavedSettings)) {
        ImGui::TableSetupColumn("light", ImGuiTableColumnFlags_WidthStretch, 1);
        ImGui::TableSetupColumn("on", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFrameHeight());
        ImGui::TableSetupColumn("solo", ImGuiTableColumnFlags_WidthFixed, button_width("Solo"));
        ImGui::TableSetupColumn("colour", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFrameHeight());
        if (intensities) ImGui::TableSetupColumn("intensity", ImGuiTableColumnFlags_WidthFixed, em * 5.4f);
        for (int i = 0; i < std::min(s.light_count, kMaxLights); ++i) light_row(panel, s, log, i, intensities);
        ImGui::EndTable();
        panel.listed = ImGui::IsItemVisible();
    }
    if (result) cube_cross(s, *result);
}

}  // namespace si
