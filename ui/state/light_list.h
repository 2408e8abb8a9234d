// The light that panels show, and lights added, copied, reordered and deleted in the settings.
#pragma once

#include "renderer/settings/settings.h"

namespace si {

struct FittedLight;
struct FrameResult;

/// Returns the index of the light whose map and overlays are shown (view.light), clamped to the existing lights; -1
/// without lights.
int shown_light(const Settings& settings);
/// Returns the shown light (shown_light()) with the shadow-map views that a frame fitted to it. Returns null without
/// lights, or if the light was added after the frame.
const FittedLight* shown_fitted_light(const Settings& settings, const FrameResult& result);
/// Returns the index of the shown light's view (cube face, cascade) that the map viewer shows: view.face, clamped to
/// the light's views. Returns 0 without a light.
int shown_face(const Settings& settings, const FrameResult& result);

/// Returns true if the settings have room for another light (kMaxLights).
bool can_add_light(const Settings& settings);
/// Adds a light with default settings and shows it. Its azimuth is at least 30 degrees from all other lights, if
/// possible. Does nothing if there are kMaxLights lights.
void add_light(Settings& settings);
/// Inserts a copy of a light after the original, without its name, and shows the copy. Does nothing if there is no such
/// light, or there are kMaxLights lights. @param light the index of the light
void copy_light(Settings& settings, int light);
/// Deletes a light from the settings; does nothing if there is no such light. @param light the index of the light
void delete_light(Settings& settings, int light);
/// Returns true if a light is on and all others are off. @param light the index of the light
bool is_solo(const Settings& settings, int light);
/// Switches a light on and all others off. If it is the only light that is on, switches all on. Used by the button
/// Solo.
/// @param light the index of the light
void solo_light(Settings& settings, int light);
/// Moves a light within the list of lights and shows it. @param light the index of the light @param places the number
/// of places to move by; negative: towards the beginning; clamped to the list
void move_light(Settings& settings, int light, int places);

}  // namespace si
