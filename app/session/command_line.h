// Conversion of the editor's state into a command line that draws the same picture without a window.
#pragma once

#include <string>

#include "app/session/session.h"

namespace si {

/// Returns a session plan that opens a scene with the given settings, to draw the editor's picture again. Settings that
/// differ from those with which the scene opens at this scale (base_settings(), carry_settings()) become assignments of
/// --set.
SessionPlan session_plan(const std::string& scene_name, const Scene& scene, const Settings& settings);

/// Formats a command line that renders a scene with the given settings, for the user to copy. Settings that differ from
/// those with which the scene opens (base_settings()) become options --set.
/// @param scene_name the key of a built-in scene, or a path @param width, height size of the picture, pixels
std::string command_line(const std::string& scene_name, const Scene& scene, const Settings& settings, int width,
                         int height);

}  // namespace si
