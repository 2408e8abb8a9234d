// The editor: a window, or the same picture drawn headless into a PNG.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/session/session.h"
#include "ui/state/editor_ui.h"

namespace si {

struct EditorOptions {
    SessionOptions session;              ///< the first scene and its settings
    std::filesystem::path preset;        ///< where Ctrl+S saves; may be empty
    std::filesystem::path state_folder;  ///< where layout, recent files and autosaves are kept; empty: nowhere
    bool headless = false;               ///< draw through EGL and write `screenshot`; needs no display
    std::filesystem::path screenshot;
    int width = 1600, height = 900;  ///< of the window, or of the screenshot in pixels
    bool size_given = false;         ///< a window has this size whatever was kept
    double scale = 0;                ///< of text and widgets; 0: from the monitor, or from the screenshot's height
    int probe_x = -1, probe_y = -1;  ///< pixel of the scene picture probed at the start; negative: none
    std::string tab;                 ///< of the strip below, in front at the start; empty: effects
    std::string theme;               ///< dark or light; empty: as kept, or dark
    std::filesystem::path sweep;     ///< folder of a sweep to show; may be empty
    bool welcome = false;            ///< nothing was asked for: a person who is new here is welcomed
    bool check_numeric = false;      ///< search every picture of the scene; run_editor() throws at the end
    std::filesystem::path report;    ///< see SessionReport; empty: none is written
    /// A headless editor draws its frames on a thread of their own, as a window does, and waits so long for each
    /// (FrameThread); nothing: it draws them itself.
    std::optional<std::chrono::milliseconds> frame_patience;
};

/// @throws UsageError naming the tabs there are
BottomTab tab_named(const std::string& name);

/// Runs until the window is closed, or until the screenshot is written. Returns remarks about the first scene.
/// @throws Error when there is no display, no OpenGL 4.5, the screenshot's scene cannot be read, or a file cannot be
/// written.
std::vector<std::string> run_editor(const EditorOptions& options);

}  // namespace si
