// Widgets made from a setting's row: slider, drag, combo or checkbox with unit, tooltip, reset and mark of change.
#pragma once

#include <string>

#include "renderer/render/renderer.h"
#include "renderer/settings/param.h"
#include "renderer/settings/search.h"
#include "ui/state/scene_choices.h"

namespace si {

/// Sets the driver by which widgets decide which settings have an effect; null: a driver that can do everything. The
/// pointer has to be valid until the next call.
void use_driver(const DriverInfo* driver);

/// Sets the scene, of which only the presence of animations is kept; null: it has some.
void use_scene(const Scene* scene);

/// Sets the frame whose light and camera give the numbers of automatic values; null: not known. The pointer has to be
/// valid until the next call.
void use_result(const FrameResult* result);

/// Returns the reason why a setting has no effect with this driver, scene or other settings; empty: it has one.
std::string_view without_effect(const Settings& settings, const SettingRef& ref);

/// Adds tooltip and context menu of a setting to the last widget. Returns true if the value has changed.
bool setting_menu(Settings& settings, const SettingRef& ref);

/// Draws the widget of a setting without its label. Returns true if the value has changed.
/// @param width pixels; 0: the free width @param names choices in place of a plain number; empty: a number
bool setting_widget(Settings& settings, const SettingRef& ref, float width = 0, const NamedValues& names = {});
/// Draws the widget of the setting with this dotted key, which has to exist.
bool setting_widget(Settings& settings, std::string_view key, float width = 0);

/// Draws label and widget of a setting in two table columns. Returns true if the value has changed.
bool setting_row(Settings& settings, const SettingRef& ref, const NamedValues& names = {});

/// Returns the label of a group of settings, given by the first part of its keys; without a label that prefix.
std::string_view setting_group_label(std::string_view prefix);

/// Returns true if the setting differs from its default.
bool setting_changed(const Settings& settings, const SettingRef& ref);

/// Continues the line if `width` more pixels fit, else starts the next one.
void flow(float width);

/// Draws a button that opens a popup below itself; ImGui::BeginPopup(popup) has to follow. @param width of the popup,
/// pixels
void menu_button(const char* label, const char* popup, const char* hint, float width);

}  // namespace si
