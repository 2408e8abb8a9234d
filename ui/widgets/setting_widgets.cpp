#include "ui/widgets/setting_widgets.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <limits>

#include "renderer/base/command_text.h"
#include "renderer/base/error.h"
#include "renderer/base/lengths_text.h"
#include "renderer/profiles/engine_wording.h"
#include "renderer/scene/animation.h"
#include "renderer/settings/idle_reason.h"
#include "renderer/settings/splits.h"
#include "renderer/settings/starting_values.h"
#include "ui/widgets/combo.h"
#include "ui/widgets/file_dialog.h"
#include "ui/widgets/quantity_text.h"
#include "ui/widgets/slider.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr float kSettingTip = 26;    ///< width of a setting's tooltip, ems
constexpr double kSmallRange = 0.1;  ///< logarithmic sliders up to this have seven decimals
constexpr double kWide = 1e5;        ///< larger ranges get a drag field, because a slider would be too coarse

/// Returns a setting's unit as written after a number.
std::string unit_suffix(std::string_view unit) {
    return unit.empty() ? "" : unit == "deg" ? "°" : fmt::format(" {}", unit);
}

/// Returns the singular of a unit: "1 texel". @param unit unit as written after a number
std::string one_of(const std::string& unit) {
    return unit.size() > 3 && unit.ends_with('s') ? unit.substr(0, unit.size() - 1) : unit;
}

/// Returns a text escaped for a printf format.
std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) out += c == '%' ? std::string("%%") : std::string(1, c);
    return out;
}

/// Returns the facts of the current ImGui context's setting widgets.
const SettingFacts& facts_in_use() {
    static constexpr SettingFacts kNone;
    const void* const facts = ImGui::GetIO().UserData;
    return facts ? *static_cast<const SettingFacts*>(facts) : kNone;
}

/// Draws the names that engines have for a setting, with their conversion: those searched for, else those of the chosen
/// engine.
void draw_engine_names(const SettingRef& ref, float width) {
    const SettingFacts& facts = facts_in_use();
    std::vector<std::string> lines;
    if (engine_name_matches(ref, facts.searched))
        lines = engine_names_of(ref, facts.searched);
    else if (facts.engine)
        lines = engine_names_of(ref, {}, facts.engine->profile);
    for (const std::string& line : lines) ImGui::TextUnformatted(broken_at_spaces(line, width).c_str());
}

void tooltip(const Settings& settings, const SettingRef& ref) {
    const Param& p = *ref.param;
    place_tooltip();
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(kSettingTip * ImGui::GetFontSize());
    strong_text(p.label);
    const float wide = kSettingTip * ImGui::GetFontSize() - ImGui::GetStyle().WindowPadding.x - 1;
    ImGui::TextUnformatted(broken_at_spaces(p.help, wide).c_str());
    const bool slides = !p.choices && !std::holds_alternative<bool>(default_value(ref));
    coloured_text(fmt::format("{}   default {}", setting_key(ref), shown_value(settings, ref, default_value(ref))),
                  theme::muted());
    coloured_text(is_text(p) ? "Right-click its label to reset"
                  : slides   ? "Ctrl+click to type, right-click to reset"
                             : "Right-click to reset",
                  theme::muted());
    draw_engine_names(ref, wide);
    if (const auto idle = without_effect(settings, ref); !idle.empty()) {
        std::string text(idle);
        text[0] = char(std::toupper(static_cast<unsigned char>(text[0])));
        coloured_text(text + ".", theme::accent());
    }
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

/// Sets a value, with the starting values that it brings along, and moves settings that must not overlap with it.
void change(Settings& settings, const SettingRef& ref, const Value& value) {
    const Settings before = settings;
    set_value(settings, ref, value);
    set_starting_values(before, settings);
    push_splits(settings, ref);
}

bool reset_menu(Settings& settings, const SettingRef& ref) {
    bool changed = false;
    if (!ImGui::BeginPopup("row menu")) return false;
    const Value preset = default_value(ref);
    const std::string label = fmt::format("Reset to {}", shown_value(settings, ref, preset));
    if (ImGui::MenuItem(label.c_str(), nullptr, false, setting_changed(settings, ref))) {
        change(settings, ref, preset);
        changed = true;
    }
    if (ImGui::MenuItem("Copy as --set")) {
        const std::pair change{setting_key(ref), value_text(*ref.param, get_value(settings, ref))};
        ImGui::SetClipboardText(set_options_text({&change, 1}).c_str());
    }
    ImGui::EndPopup();
    return changed;
}

bool choice_combo(const Param& p, int& value) {
    std::vector<ComboItem> items;
    for (const auto& choice : p.choices()) items.push_back({int(items.size()), choice.label, choice.help});
    return item_combo("##value", items, value, fmt::format("{}", value));
}

bool named_combo(const NamedValues& names, int& value) {
    std::vector<ComboItem> items;
    for (const auto& [number, name] : names) items.push_back({number, name, {}});
    return item_combo("##value", items, value, fmt::format("{} (not there)", value));
}

bool integer(const Param& p, int& value, const std::string& unit) {
    const int lo = int(p.min), hi = int(p.max);
    ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp;
    if (p.logarithmic) flags |= ImGuiSliderFlags_Logarithmic;
    const std::string format = "%d" + (value == 1 ? one_of(unit) : unit);
    if (!slider("##value", ImGuiDataType_S32, &value, &lo, &hi, format.c_str(), flags)) return false;
    // Dragging snaps sizes to powers of two; typing accepts any size.
    if (p.logarithmic && ImGui::IsMouseDown(ImGuiMouseButton_Left) && value > 0) {
        const unsigned below = std::bit_floor(unsigned(value));
        value = std::clamp(int(double(value) * value > 2.0 * below * below ? 2 * below : below), lo, hi);
    }
    return true;
}

/// Returns the last frame's value of a setting that is 0 for automatic; NaN: not known.
double automatic_value(const SettingRef& ref) {
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    const FrameResult* const result = facts_in_use().result;
    if (!result) return kUnknown;
    const std::string_view key = ref.param->key, field = key.substr(key.rfind('.') + 1);
    if (ref.param->scope != Scope::Light) {
        const DepthCurve& curve = result->camera.curve;
        return field == "near" ? curve.near : field == "far" ? curve.far : kUnknown;
    }
    if (std::size_t(ref.light) >= result->lights.size()) return kUnknown;
    const FittedLight& light = result->lights[std::size_t(ref.light)];
    if (field == "distance") return light.distance_m;
    if (light.views.empty()) return kUnknown;
    return field == "near" ? light.views[0].curve.near : field == "far" ? light.views[0].curve.far : kUnknown;
}

/// Returns true for depths and metres that need an exponent, but have a digit within six decimals.
bool is_tiny(double value) {
    return std::abs(value) >= 5e-7 && std::abs(value) < 1e-4;
}

/// Returns true for numbers that ImGui's formats print with an exponent.
bool needs_exponent(double value) {
    return value != 0 && std::abs(value) < 1e-4;
}

/// Returns the number format for ImGui. A drag rounds to the shown digits. The number of digits must not depend on the
/// value, because ImGui derives the steps of a logarithmic slider from it.
std::string number_format(const SettingRef& ref, double value, const std::string& unit, bool of_texels) {
    const Param& p = *ref.param;
    if (p.zero_is_auto && value == 0) {
        const double taken = automatic_value(ref);
        return std::isfinite(taken) ? "auto " + escaped(digits_text(taken)) + unit : std::string("auto");
    }
    const std::string shown = value == 1 ? one_of(unit) : unit;
    const bool dragged = p.max - p.min > kWide;
    const bool bias = p.unit.starts_with("bias.") && !of_texels;
    // ImGui's formats would print an exponent. A text without a conversion is printed as it is.
    if (p.logarithmic && p.max <= kSmallRange) return "%.7f" + shown;
    if (needs_exponent(value) && (dragged || !p.logarithmic) && !(bias && is_tiny(value)))
        return escaped(stored_text(value, 3)) + unit;
    if (bias) return (is_tiny(value) ? "%.6f" : "%.6g") + shown;
    if (p.slider_max > 0) return (std::abs(value) >= 999.5 ? "%.0f" : "%.3g") + shown;
    if (dragged && std::abs(value) >= 9999.5) return "%.0f" + shown;
    return (p.max >= 9999.5 && !dragged ? "%.6g" : "%.4g") + shown;
}

/// Draws the widget of a number. @param counted_in shown_unit() @param unit empty: left out
bool real(const SettingRef& ref, double& value, const std::string& unit, std::string_view counted_in) {
    const Param& p = *ref.param;
    const bool of_texels = counted_in == "texels";
    const std::string format = number_format(ref, value, unit, of_texels);
    if (p.slider_max > 0) {
        // Useful biases are a small part of the range in depths or metres, so that the slider is logarithmic.
        const double most = counted_in == "depth" ? 1 : p.slider_max;
        const ImGuiSliderFlags flags =
            p.logarithmic || !of_texels ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None;
        if (!slider("##value", ImGuiDataType_Double, &value, &p.min, &most, format.c_str(), flags)) return false;
        value = std::clamp(value, p.min, p.max);
        // Six decimals; %.6g would show more for small numbers.
        if (!of_texels && std::abs(value) < 1 && ImGui::IsMouseDown(ImGuiMouseButton_Left))
            value = std::round(value * 1e6) / 1e6;
        return true;
    }
    if (p.max - p.min > kWide) {
        const float speed = float(std::max(std::abs(value) * 0.004, 0.004));
        return ImGui::DragScalar("##value", ImGuiDataType_Double, &value, speed, &p.min, &p.max, format.c_str(),
                                 ImGuiSliderFlags_AlwaysClamp);
    }
    ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp;
    if (p.logarithmic) flags |= ImGuiSliderFlags_Logarithmic;
    return slider("##value", ImGuiDataType_Double, &value, &p.min, &p.max, format.c_str(), flags);
}

/// Draws a text field for a text setting. Text that the row does not allow changes nothing.
bool text_input(const SettingRef& ref, std::string& value) {
    std::string typed = value;
    if (!ImGui::InputTextWithHint("##value", "none", &typed)) return false;
    try {
        value = std::get<std::string>(parse_value(ref, typed));
        return true;
    } catch (const UsageError&) {
        return false;
    }
}

/// Draws a text field for the path of a file, with a button that opens the file dialog. A typed path is taken when the
/// field is left, because its beginnings name no file.
bool file_input(const SettingRef& ref, std::string& value, float width) {
    constexpr const char* kBrowse = "Browse…";
    FileDialog* const dialog = facts_in_use().files;
    const ImGuiStyle& style = ImGui::GetStyle();
    const float button = ImGui::CalcTextSize(kBrowse).x + 2 * style.FramePadding.x;
    const float room = width > 0 ? width : ImGui::GetContentRegionAvail().x;
    const bool browses = dialog && room > 2 * button;
    ImGui::SetNextItemWidth(browses ? room - button - style.ItemInnerSpacing.x : room);
    static std::string typed;  // of the one field that is edited
    std::string shown = value;
    ImGui::InputTextWithHint("##value", "none", &shown);
    if (ImGui::IsItemActive()) typed = shown;
    bool changed = false;
    if (ImGui::IsItemDeactivatedAfterEdit() && typed != value) {
        try {
            value = std::get<std::string>(parse_value(ref, typed));
            changed = true;
        } catch (const UsageError&) {
            changed = false;
        }
    }
    if (!browses) return changed;
    ImGui::SameLine(0, style.ItemInnerSpacing.x);
    if (ImGui::Button(kBrowse)) open_bundle_dialog(*dialog, setting_key(ref), value);
    return changed;
}

/// Returns true if the setting has no effect, and changing it alone would not give it one.
bool cannot_take_effect(Settings& settings, const SettingRef& ref) {
    if (without_effect(settings, ref).empty()) return false;
    const Param& p = *ref.param;
    const Value now = get_value(settings, ref);
    if (p.choices || is_text(p)) return true;
    set_value(settings, ref,
              now.index() == 0   ? Value(!std::get<bool>(now))
              : now.index() == 1 ? Value(int(p.max))
                                 : Value(p.max));
    const bool still = !without_effect(settings, ref).empty();
    set_value(settings, ref, now);
    return still;
}

/// Draws a setting's widget and its menu inside the ID scope of its row. @param idle see cannot_take_effect()
bool widget_and_menu(Settings& settings, const SettingRef& ref, float width, const NamedValues& names, bool idle) {
    const Param& p = *ref.param;
    Value value = get_value(settings, ref);
    bool changed = false;
    const bool narrow = width > 0 && width < ImGui::GetFontSize() * 7;  // no room for the unit
    const std::string unit = narrow ? std::string() : escaped(unit_suffix(shown_unit(settings, ref)));
    if (idle) ImGui::PushStyleVar(ImGuiStyleVar_Alpha, ImGui::GetStyle().Alpha * ImGui::GetStyle().DisabledAlpha);
    ImGui::SetNextItemWidth(width > 0 ? width : -FLT_MIN);
    const EngineWording* const engine = facts_in_use().engine;
    ImGui::BeginDisabled(engine && forced_setting(*engine->profile, p.key));
    if (auto* b = std::get_if<bool>(&value))
        changed = ImGui::Checkbox("##value", b);
    else if (auto* i = std::get_if<int>(&value))
        changed = p.choices ? choice_combo(p, *i) : !names.empty() ? named_combo(names, *i) : integer(p, *i, unit);
    else if (auto* t = std::get_if<std::string>(&value))
        changed = p.file ? file_input(ref, *t, width) : text_input(ref, *t);
    else
        changed = real(ref, std::get<double>(value), unit, shown_unit(settings, ref));
    ImGui::EndDisabled();
    if (idle) ImGui::PopStyleVar();
    if (changed) change(settings, ref, value);
    return setting_menu(settings, ref) || changed;
}

}  // namespace

void use_setting_facts(const SettingFacts* facts) {
    ImGui::GetIO().UserData = const_cast<SettingFacts*>(facts);  // ImGui takes a mutable pointer and only keeps it
}

std::string engine_changes_text(std::span<const std::pair<std::string, std::string>> changes) {
    const EngineWording* const engine = facts_in_use().engine;
    try {
        return engine ? engine->text(changes) : std::string();
    } catch (const Error&) {
        return {};  // the engine takes no such number, which its panel says
    }
}

std::string_view without_effect(const Settings& settings, const SettingRef& ref) {
    const auto& [driver, scene, result, files, engine, searched] = facts_in_use();
    if (engine) {
        if (const ForcedSetting* forced = forced_setting(*engine->profile, ref.param->key)) return forced->reason;
        for (const LackingSetting& lacking : engine->profile->lacking)
            if (lacking.key == ref.param->key && lacking.value.empty()) return lacking.reason;
    }
    if (driver && ref.param->needs == DriverFeature::PolygonOffsetClamp && !driver->polygon_offset_clamp)
        return "without effect: this driver lacks GL_EXT_polygon_offset_clamp";
    const bool moves = !scene || (scene->rig && !scene->rig->animations.empty());
    if (ref.param->animation_only && !moves) return "without effect: the scene has no animation";
    return idle_reason(settings, ref);
}

bool setting_changed(const Settings& settings, const SettingRef& ref) {
    return get_value(settings, ref) != default_value(ref);
}

bool setting_menu(Settings& settings, const SettingRef& ref) {
    ImGui::OpenPopupOnItemClick("row menu", ImGuiPopupFlags_MouseButtonRight);
    if (ImGui::IsItemHovered() && !ImGui::IsItemActive() && ImGui::GetIO().MouseDownDuration[0] < 0)
        tooltip(settings, ref);
    return reset_menu(settings, ref);
}

bool setting_widget(Settings& settings, const SettingRef& ref, float width, const NamedValues& names) {
    ImGui::PushID(setting_key(ref).c_str());
    const bool changed = widget_and_menu(settings, ref, width, names, cannot_take_effect(settings, ref));
    ImGui::PopID();
    return changed;
}

bool setting_widget(Settings& settings, std::string_view key, float width) {
    const auto ref = find_setting(key);
    IM_ASSERT(ref && "a widget names a setting that has no row");
    return ref && setting_widget(settings, *ref, width);
}

bool setting_row(Settings& settings, const SettingRef& ref, const NamedValues& names) {
    const Param& p = *ref.param;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushID(setting_key(ref).c_str());
    const bool idle = cannot_take_effect(settings, ref);
    const float dot = ImGui::GetFontSize() * 0.75f;
    const ImVec2 start = ImGui::GetCursorScreenPos();
    ImGui::AlignTextToFramePadding();
    if (setting_changed(settings, ref)) {
        const ImVec2 centre(start.x + dot * 0.33f, start.y + ImGui::GetFrameHeight() * 0.5f);
        ImGui::GetWindowDrawList()->AddCircleFilled(centre, ImGui::GetFontSize() * 0.17f, theme::accent(), 12);
    }
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + dot);
    ImGui::PushStyleColor(ImGuiCol_Text, idle ? theme::faint() : theme::text());
    // The column clips the label at the end of its padding.
    const float room = ImGui::GetContentRegionAvail().x + ImGui::GetStyle().CellPadding.x;
    ImGui::TextUnformatted(beginning_that_fits(std::string(p.label), room, ImGui::GetFont()).c_str());
    ImGui::PopStyleColor();
    ImGui::OpenPopupOnItemClick("row menu", ImGuiPopupFlags_MouseButtonRight);
    if (ImGui::IsItemHovered()) tooltip(settings, ref);
    ImGui::TableNextColumn();
    const bool changed = widget_and_menu(settings, ref, 0, names, idle);
    ImGui::PopID();
    return changed;
}

void menu_button(const char* label, const char* popup, const char* hint, float width) {
    // The press that closes another menu opens this one.
    const bool pressed = ImGui::Button(label);
    const bool closed_other = press_closed_other_popup() && !ImGui::IsPopupOpen(popup);
    if (pressed || closed_other) ImGui::OpenPopup(popup);
    const ImVec2 lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
    if (ImGui::IsItemHovered() && !ImGui::IsPopupOpen(popup)) ImGui::SetTooltip("%s", hint);
    const float most = ImGui::GetIO().DisplaySize.x - width - ImGui::GetFontSize() * 0.3f;
    ImGui::SetNextWindowPos({std::max(std::min(lo.x, most), 0.0f), hi.y + ImGui::GetFontSize() * 0.2f});
}

void same_line_if_fits(float width) {
    ImGui::SameLine();
    if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}

}  // namespace si
