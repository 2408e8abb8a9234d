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

/// Returns true when an engine's numbers are the same for two maps, to the digits that are shown.
bool is_same_map(const MapFacts& a, const MapFacts& b) {
    constexpr double kShownDigits = 1e-6;
    const auto equal = [](double x, double y) { return std::abs(x - y) <= kShownDigits * std::abs(y); };
    return a.texels == b.texels && a.cascades == b.cascades && equal(a.width_m, b.width_m) &&
           equal(a.depth_m, b.depth_m);
}

/// Returns the bias of the settings after the engine's numbers have replaced what they give.
BiasSettings bias_of_values(const EnginePanel& panel, const MapFacts& facts, Settings settings) {
    for (const ConvertedSetting& setting : read_engine_values(*panel.profile, panel.values, facts))
        if (setting.key.starts_with("bias.")) set_setting(settings, setting.key, setting.value);
    return settings.bias;
}

/// Takes the bias of the settings from the engine's numbers.
void read_bias(EnginePanel& panel, const MapFacts& facts, Settings& settings) {
    settings.bias = bias_of_values(panel, facts, settings);
    apply_forced_settings(*panel.profile, settings);
    panel.applied = settings;
    panel.facts = facts;
    panel.gives_bias = true;
}

/// Takes the engine's numbers from the settings. @param kept numbers that stay as they are
void write_values(EnginePanel& panel, const MapFacts& facts, const Settings& settings, const EngineValues& kept = {}) {
    panel.values = write_engine_values(*panel.profile, settings, facts, kept).values();
    panel.applied = settings;
    panel.facts = facts;
    panel.gives_bias = false;
}

/// Takes the engine's numbers from the settings, if these are not the ones that the numbers gave. Under another map a
/// bias that was typed stays the same in the engine's units, and any other bias stays the same in the settings.
void follow_settings(EnginePanel& panel, const MapFacts& facts, Settings& settings) {
    const bool same = panel.applied.bias == settings.bias && panel.applied.filter == settings.filter &&
                      panel.applied.map == settings.map && panel.applied.caster == settings.caster &&
                      panel.applied.lights == settings.lights && panel.applied.view.light == settings.view.light;
    if (!same || panel.values.empty()) return write_values(panel, facts, settings);
    if (is_same_map(panel.facts, facts)) return;
    // The bias widens the map's margin by whole steps, so that bias and map may change each other without end.
    constexpr int kMostRounds = 8;
    panel.rounds = panel.applied == settings ? panel.rounds + 1 : 0;
    if (!panel.gives_bias || panel.rounds > kMostRounds) return write_values(panel, facts, settings);
    read_bias(panel, facts, settings);
    for (const auto& [key, value] : write_engine_values(*panel.profile, settings, facts).values())
        if (!engine_parameter(*panel.profile, key).is_bias) panel.values[key] = value;
}

/// Changes one of the engine's numbers, and our settings by it. @param changed the parameter that the user has changed
void apply_value(EnginePanel& panel, const EngineParameter& changed, double value, Settings& settings) {
    const MapFacts facts = panel.facts;
    const std::string key(changed.key);
    panel.rounds = 0;
    const BiasSettings before = bias_of_values(panel, facts, settings);
    panel.values[key] = value;
    for (const ConvertedSetting& setting : read_engine_values(*panel.profile, {{key, value}}, facts))
        if (!setting.key.starts_with("bias.")) set_setting(settings, setting.key, setting.value);
    if (panel.gives_bias || changed.is_bias || bias_of_values(panel, facts, settings) != before)
        return read_bias(panel, facts, settings);
    EngineValues kept = panel.values;
    std::erase_if(kept, [&](const auto& entry) { return engine_parameter(*panel.profile, entry.first).is_bias; });
    apply_forced_settings(*panel.profile, settings);
    write_values(panel, facts, settings, kept);
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

void draw_parameters(EnginePanel& panel, Settings& settings) {
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
        if (parameter_widget(parameter, value)) apply_value(panel, parameter, value, settings);
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
        follow_settings(panel, facts, settings);
        draw_parameters(panel, settings);
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
