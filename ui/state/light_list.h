// The light that panels show, and lights added, copied, reordered and deleted in the settings.
#pragma once

#include "renderer/settings/settings.h"

namespace si {

struct FittedLight;
struct FrameResult;

/// Returns the index of the light whose map and overlays are shown, clamped to the existing lights; -1 without lights.
int shown_light(const Settings& settings);
/// Returns the shown light in a frame; null: there is none, or the light was added after the frame.
const FittedLight* shown_fitted_light(const Settings& settings, const FrameResult& result);
/// Returns the index of the shown light's view (cube face, cascade) that is shown, clamped to its views.
int shown_face(const Settings& settings, const FrameResult& result);

/// Returns true if the settings have room for another light (kMaxLights).
bool can_add_light(const Settings& settings);
/// Adds a light with default settings from a direction that no other light has, and shows it. Does nothing at
/// kMaxLights.
void add_light(Settings& settings);
/// Inserts a copy of a light after it, without its name, and shows it. Does nothing without that light or at
/// kMaxLights.
void copy_light(Settings& settings, int light);
/// Deletes a light from the settings; does nothing if there is no such light. @param light the index of the light
void delete_light(Settings& settings, int light);
/// Returns true if `light` (an index) is the only light that is on.
bool is_solo(const Settings& settings, int light);
/// Switches all lights except `light` (an index) off; switches all on if the others are off already.
void solo_light(Settings& settings, int light);
/// Moves a light within the list of lights and shows it. @param light the index of the light @param places the number
/// of places to move by; negative: towards the beginning; clamped to the list
void move_light(Settings& settings, int light, int places);

}  // namespace si
