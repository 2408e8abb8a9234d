// The editor: a window, or the same picture drawn headless into a PNG.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/settings.h"

namespace si {

struct EditorOptions {
    std::string scene;             ///< built-in key or path; empty: the default scene
    Settings settings;             ///< already composed of scene suggestions, preset and --set
    bool use_suggested = true;     ///< `settings` began with the scene's suggestions; false: with a preset, whose
                                   ///< values all count as chosen when another scene is opened
    std::filesystem::path preset;  ///< where Ctrl+S saves; may be empty
    bool headless = false;         ///< draw through EGL and write `screenshot`; needs no display
    std::filesystem::path screenshot;
    int width = 1600, height = 900;  ///< of the window, or of the screenshot in pixels
    double scale = 0;                ///< of text and widgets; 0: from the monitor, or from the screenshot's height
    int probe_x = -1, probe_y = -1;  ///< pixel of the scene picture probed at the start; negative: none
    std::string tab;                 ///< passes, probe, objects or log in front at the start; empty: passes
};

/// Runs until the window is closed, or until the screenshot is written. Returns the exit code.
/// @throws Error when there is no display, no OpenGL 4.5, or a file cannot be read or written.
int run_editor(const EditorOptions& options);

}  // namespace si
