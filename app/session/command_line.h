// Conversion of the editor's state into a command line that draws the same picture without a window.
#pragma once

#include <string>

#include "app/session/session.h"

namespace si {

/// Returns a plan that opens the scene with these settings: base_settings() and --set for everything that differs.
SessionPlan session_plan(const std::string& scene_name, const Scene& scene, const Settings& settings);

/// Formats the command that renders a scene with these settings, with --set for everything that differs from
/// base_settings(). @param scene_name the key of a built-in scene, or a path
std::string command_line(const std::string& scene_name, const Scene& scene, const Settings& settings, int width,
                         int height);

}  // namespace si
