// The light and the map that panels show.
#pragma once

namespace si {

struct FrameResult;
struct Settings;

/// Returns the index of the light whose map and overlays are shown, clamped to the existing lights; -1 without lights.
int shown_light(const Settings& settings);

/// Returns the index of the shown light's view (cube face, cascade) that is shown, clamped to its views.
int shown_face(const Settings& settings, const FrameResult& result);

}  // namespace si
