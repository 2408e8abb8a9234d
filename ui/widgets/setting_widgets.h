// Widgets made from a setting's row: slider, drag, combo or checkbox with unit, tooltip, reset and mark of change.
#pragma once

#include <span>
#include <string>
#include <utility>

#include "renderer/render/renderer.h"
#include "renderer/settings/param.h"
#include "renderer/settings/search.h"
#include "ui/state/scene_choices.h"

namespace si {

struct EngineWording;
struct FileDialog;

/// Data for the widgets of settings. Driver, scene and engine decide whether a setting has an effect; the last frame
/// gives the numbers that automatic settings stand for.
struct SettingFacts {
    const DriverInfo* driver = nullptr;     ///< null: a driver that can do everything
    const Scene* scene = nullptr;           ///< null: a scene with animations
    const FrameResult* result = nullptr;    ///< frame whose light and camera give automatic values; null: not known
    FileDialog* files = nullptr;            ///< dialog that chooses the file of a setting; null: paths are typed
    const EngineWording* engine = nullptr;  ///< engine whose limits apply, and in which texts speak; null: none
    std::string_view searched = {};         ///< text of the settings search: engines' names in it are explained
};
/// Sets the data for the widgets of settings in the current ImGui context. For instance, the widgets decide by these
/// data whether a setting has an effect. The pointer has to stay valid until the next call. @param facts null: nothing
/// is known
void use_setting_facts(const SettingFacts* facts);

/// Formats changes of settings as parameters of the engine that the user chose: "in three.js: set normalBias to
/// 0.0098". Returns an empty text if no engine is chosen, none of its parameters changes, or it cannot express the
/// change.
/// @param changes pairs of setting key and value
std::string engine_changes_text(std::span<const std::pair<std::string, std::string>> changes);

/// Returns the reason why a setting has no effect with the present driver, scene or other settings; empty: it has an
/// effect.
std::string_view without_effect(const Settings& settings, const SettingRef& ref);

/// Adds the tooltip and the context menu (reset, copy) of a setting to the last ImGui item. Returns true if the menu
/// has changed the value.
bool setting_menu(Settings& settings, const SettingRef& ref);

/// Draws the widget (slider, combo or checkbox) of a setting without its label. Returns true if the value has changed.
/// @param width pixels; 0: the free width @param names choices in place of a plain number; empty: a number
bool setting_widget(Settings& settings, const SettingRef& ref, float width = 0, const NamedValues& names = {});
/// Draws the widget (slider, combo or checkbox) of a setting without its label. Returns true if the value has changed.
/// @param key dotted key of a setting that exists @param width pixels; 0: the free width
bool setting_widget(Settings& settings, std::string_view key, float width = 0);

/// Draws label and widget of a setting in two table columns. Returns true if the value has changed.
bool setting_row(Settings& settings, const SettingRef& ref, const NamedValues& names = {});

/// Returns the label of a group of settings: "Bias" for "bias". Returns the prefix itself if the group has no label.
/// @param prefix first part of the settings' keys
std::string_view setting_group_label(std::string_view prefix);

/// Returns true if the setting differs from its default.
bool setting_changed(const Settings& settings, const SettingRef& ref);

/// Places the next ImGui widget on the same line if `width` pixels fit there, else on the next line.
void same_line_if_fits(float width);

/// Draws a button that opens an ImGui popup below itself. ImGui::BeginPopup(popup) has to follow.
/// @param popup ImGui id of the popup @param hint tooltip of the button @param width width of the popup, pixels
void menu_button(const char* label, const char* popup, const char* hint, float width);

}  // namespace si
