#include "ui/panels/engine_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "renderer/base/error.h"
#include "renderer/render/renderer.h"
#include "renderer/settings/param.h"
#include "renderer/view/fits/engine_facts.h"
#include "ui/widgets/combo.h"
#include "ui/widgets/quantity_text.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

/// Returns the facts of the shown light's map.
MapFacts shown_facts(const EnginePanel& panel, const Settings& settings, const FrameResult* result) {
    const auto light = std::size_t(std::max(settings.view.light, 0));
    const bool known = result && light < result->lights.size();
    MapFacts facts = map_facts(known ? &result->lights[light] : nullptr, settings,
                               known ? result->map_size : MapSize(settings.map.resolution));
    facts.angle_deg = panel.angle_deg;
    return facts;
}

/// Takes the engine's numbers from the settings, unless these are the ones that the numbers gave.
void follow_settings(EnginePanel& panel, const Settings& settings, const MapFacts& facts) {
    const bool same = panel.applied.bias == settings.bias && panel.applied.filter == settings.filter &&
                      panel.applied.map == settings.map && panel.applied.caster == settings.caster &&
                      panel.applied.lights == settings.lights;
    if (same && !panel.values.empty()) return;
    panel.values = write_engine_values(*panel.profile, settings, facts).values();
    panel.applied = settings;
}

/// Changes our settings by the engine's numbers. @param changed the parameter that the user has changed
void apply_values(EnginePanel& panel, const EngineParameter& changed, const MapFacts& facts, Settings& settings) {
    EngineValues values;
    for (const auto& [key, value] : panel.values) {
        const EngineParameter& parameter = engine_parameter(*panel.profile, key);
        if (parameter.is_bias || &parameter == &changed || parameter.setting == "filter.kernel") values[key] = value;
    }
    const bool reads_bias = changed.is_bias || changed.setting == "filter.kernel" || changed.setting.empty();
    for (const ConvertedSetting& setting : read_engine_values(*panel.profile, values, facts)) {
        const bool is_bias = setting.key.starts_with("bias.");
        const bool is_own = setting.key == changed.setting || !changed.choices.empty();
        if (is_bias ? reads_bias : is_own) set_setting(settings, setting.key, setting.value);
    }
    apply_forced_settings(*panel.profile, settings);
    panel.applied = settings;
}

void choose_engine(EnginePanel& panel, Settings& settings) {
    ImGui::SetNextItemWidth(-1);
    if (!begin_combo("##engine", panel.profile ? std::string(panel.profile->title) : "none")) {
        plain_tooltip("Type the bias in another engine's parameters. Its hidden bias is then drawn too.");
        return;
    }
    if (ImGui::Selectable("none", !panel.profile)) panel.profile = nullptr;
    for (const EngineProfile& profile : engine_profiles()) {
        if (!profile.read_bias) continue;
        if (ImGui::Selectable(std::string(profile.title).c_str(), panel.profile == &profile)) {
            panel.profile = &profile;
            panel.values.clear();
            apply_forced_settings(profile, settings);
        }
        if (!profile.unverified.empty()) plain_tooltip("Not verified: " + std::string(profile.unverified));
    }
    ImGui::EndCombo();
}

/// Draws the widget of one parameter. Returns true if its number has changed.
bool parameter_widget(const EngineParameter& parameter, double& value) {
    ImGui::SetNextItemWidth(-1);
    const std::string id = "##" + std::string(parameter.key);
    if (!parameter.choices.empty()) {
        bool changed = false;
        if (!begin_combo(id.c_str(), engine_value_text(parameter, value))) return false;
        for (std::size_t i = 0; i < parameter.choices.size(); ++i)
            if (ImGui::Selectable(std::string(parameter.choices[i].key).c_str(), int(value) == int(i))) {
                value = double(i);
                changed = true;
            }
        ImGui::EndCombo();
        return changed;
    }
    double typed = value;
    // A half-typed number changes nothing.
    if (!ImGui::InputDouble(id.c_str(), &typed, 0, 0, "%.6g", ImGuiInputTextFlags_EnterReturnsTrue)) return false;
    if (!std::isfinite(typed)) return false;
    value = std::clamp(typed, parameter.min, parameter.max);
    return true;
}

/// Draws the row of the reference angle. Another angle gives other numbers for the present settings.
void draw_angle(EnginePanel& panel) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("reference angle");
    wrapped_tooltip(
        "Angle between surface and light, in degrees, for which numbers are converted that are not exact at every "
        "angle. From 0 to 89, default 45.");
    ImGui::TableNextColumn();
    ImGui::SetNextItemWidth(-1);
    double typed = panel.angle_deg;
    if (!ImGui::InputDouble("##reference angle", &typed, 0, 0, "%.6g°", ImGuiInputTextFlags_EnterReturnsTrue)) return;
    if (!std::isfinite(typed)) return;
    constexpr double kMaxAngle = 89;
    panel.angle_deg = std::clamp(typed, 0.0, kMaxAngle);
    panel.values.clear();
}

void draw_parameters(EnginePanel& panel, const MapFacts& facts, Settings& settings) {
    if (!ImGui::BeginTable("parameters", 2, ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_NoSavedSettings))
        return;
    for (const EngineParameter& parameter : panel.profile->parameters) {
        if (!parameter.is_bias && parameter.setting.empty()) continue;
        double value = engine_value(*panel.profile, panel.values, parameter.key);
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(std::string(parameter.key).c_str());
        wrapped_tooltip(fmt::format("{}{}{}. From {} to {}, default {}.", parameter.meaning,
                                    parameter.unit.empty() ? "" : " Unit: ", parameter.unit,
                                    quantity_text(parameter.min), quantity_text(parameter.max),
                                    engine_value_text(parameter, parameter.standard)));
        ImGui::TableNextColumn();
        if (!parameter_widget(parameter, value)) continue;
        panel.values[std::string(parameter.key)] = value;
        apply_values(panel, parameter, facts, settings);
    }
    draw_angle(panel);
    ImGui::EndTable();
}

}  // namespace

EngineWording engine_wording(const EnginePanel& panel, const Settings& settings, const FrameResult* result) {
    if (!panel.profile) return {};
    return {panel.profile, shown_facts(panel, settings, result), settings};
}

void draw_engine_panel(EnginePanel& panel, Settings& settings, const FrameResult* result) {
    choose_engine(panel, settings);
    if (!panel.profile) return;
    try {
        const MapFacts facts = shown_facts(panel, settings, result);
        follow_settings(panel, settings, facts);
        draw_parameters(panel, facts, settings);
        ImGui::TextDisabled("%s", fmt::format("W {}, N {}, D {}, {}", quantity_text(facts.width_m, "m"), facts.texels,
                                              quantity_text(facts.depth_m, "m"), quantity_text(facts.angle_deg, "deg"))
                                      .c_str());
    } catch (const Error& e) {
        coloured_wrapped(e.what(), theme::warning());
    }
    if (!panel.profile->unverified.empty())
        coloured_wrapped("Not verified: " + std::string(panel.profile->unverified), theme::warning());
}

}  // namespace si
