// The command that draws without a window what the editor shows.
#pragma once

#include <string>

#include "app/session/session.h"

namespace si {

/// Defaults with the scene's suggested settings over them. @throws Error when a suggestion has no such setting.
Settings base_settings(const Scene& scene);

/// What opens the scene and these settings: the scene's base, and --set for everything that differs from it.
SessionPlan session_plan(const std::string& scene_name, const Scene& scene, const Settings& settings);

/// The command that renders what `settings` show, with --set for everything that differs from the scene's base.
/// @param scene_name built-in key or path, as the editor was given it
std::string command_line(const std::string& scene_name, const Scene& scene, const Settings& settings, int width,
                         int height);

}  // namespace si
