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

/// Options of the command `edit`, which opens the editor.
struct EditorOptions {
    SessionOptions session;              ///< the first scene and its settings
    std::filesystem::path preset;        ///< file that saving writes; may be empty
    std::filesystem::path state_folder;  ///< folder of layout, recent files and autosaves; empty: none is kept
    bool headless = false;               ///< draw through EGL and write `screenshot`; needs no display
    std::filesystem::path screenshot;
    int width = 1600, height = 900;  ///< size of the window, or of the screenshot in pixels
    bool size_given = false;         ///< true: `width` and `height` give the window's size; false: the last session's
    double scale = 0;  ///< scale of text and widgets; 0: from the monitor, or from the screenshot's height
    int probe_x = -1, probe_y = -1;  ///< pixel of the scene picture probed at the start; negative: none
    std::string tab;                 ///< page in front at the start; empty: settings
    std::string theme;               ///< dark or light; empty: as kept, or dark
    std::filesystem::path sweep;     ///< folder of a sweep to show; may be empty
    bool welcome = false;            ///< show the welcome at the first start
    bool check_numeric = false;      ///< search every picture of the scene; run_editor() throws at the end
    std::filesystem::path report;    ///< see SessionReport; empty: none is written
    /// Time that a headless editor waits for each frame of a drawing thread (FrameThread::patience); nothing: it draws
    /// on its own thread.
    std::optional<std::chrono::milliseconds> frame_patience;
};

/// Returns the page of the editor's tabs that the option --tab names ("pixel"); the page Settings for an empty name.
/// @throws UsageError that lists the names
Page page_named(const std::string& name);

/// Runs the editor until its window is closed. With EditorOptions::headless, writes a screenshot and returns instead.
/// Returns remarks about the first scene.
/// @throws Error without a display or OpenGL 4.5, if the screenshot's scene or an output file fails, or if a number is
/// invalid (EditorOptions::check_numeric)
std::vector<std::string> run_editor(const EditorOptions& options);

}  // namespace si
