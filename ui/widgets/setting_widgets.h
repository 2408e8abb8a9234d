// Widgets made from a setting's row: slider, drag, combo or checkbox with unit, tooltip, reset and mark of change.
#pragma once

#include <string>

#include "renderer/render/renderer.h"
#include "renderer/settings/param.h"
#include "renderer/settings/search.h"
#include "ui/state/scene_choices.h"

namespace si {

/// The driver by which the widgets drawn from now on judge what has an effect; null: as if it could everything. The
/// pointer has to last until the next call.
void use_driver(const DriverInfo* driver);

/// Likewise the scene, of which only is kept whether it has animations; null: as if it had.
void use_scene(const Scene* scene);

/// Likewise the frame, whose light and camera say what automatic values came to; null: not known.
void use_result(const FrameResult* result);

/// Why turning the setting changes nothing: for what that driver or scene lacks, or under the other settings. Empty
/// when it acts.
std::string_view without_effect(const Settings& settings, const SettingRef& ref);

/// What belongs to the widget that was drawn last and edits this setting: tooltip, and a menu on a right click. Returns
/// whether the value changed.
bool setting_menu(Settings& settings, const SettingRef& ref);

/// The widget alone, `width` pixels wide (0: what is left). Returns whether the value changed.
/// @param names what to choose from in place of a bare number; empty: nothing
bool setting_widget(Settings& settings, const SettingRef& ref, float width = 0, const NamedValues& names = {});
/// By dotted key; asserts that the key exists.
bool setting_widget(Settings& settings, std::string_view key, float width = 0);

/// Label and widget in the two columns of the present table row.
bool setting_row(Settings& settings, const SettingRef& ref, const NamedValues& names = {});

/// What a group of settings is called, by the first part of its keys; the prefix itself where it has no name.
std::string_view setting_group_label(std::string_view prefix);

/// Whether the setting differs from its default.
bool setting_changed(const Settings& settings, const SettingRef& ref);

/// Goes on in the line when `width` more pixels fit, else starts the next one.
void flow(float width);

/// A button that opens a popup below itself; BeginPopup(`popup`) has to follow. `width` is what the popup needs.
void menu_button(const char* label, const char* popup, const char* hint, float width);

}  // namespace si
