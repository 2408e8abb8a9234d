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
    std::filesystem::path preset;        ///< file that saving writes, until a preset file is opened; empty: preset.json
    std::filesystem::path state_folder;  ///< folder of layout, recent files and autosaves; empty: none is kept
    bool headless = false;               ///< draw through EGL and write `screenshot`; needs no display
    std::filesystem::path screenshot;
    int width = 1600, height = 900;  ///< size of the window, or of the screenshot in pixels
    bool size_given = false;         ///< true: the window has `width` x `height`; false: the size of the last session
    double scale = 0;  ///< scale of text and widgets; 0: from the monitor, or from the screenshot's height
    int probe_x = -1, probe_y = -1;  ///< pixel of the scene picture probed at the start; negative: none
    std::string tab;                 ///< key of the page in front at the start; empty: settings
    std::string theme;               ///< colour theme, dark or light; empty: that of the last session, else dark
    std::filesystem::path sweep;     ///< folder of a sweep (measurement of many settings) to show; empty: none
    bool welcome = false;            ///< show the welcome window at the first start of the program
    bool check_numeric = false;      ///< search all frames for invalid numbers; run_editor() throws if there are any
    std::filesystem::path report;    ///< JSON file for the session report (SessionReport); empty: none is written
    /// Longest wait of a headless editor for a frame of its drawing thread (FrameThread::patience). Nothing: there is
    /// no drawing thread, and frames are drawn on the calling thread.
    std::optional<std::chrono::milliseconds> frame_patience;
};

/// Returns the editor's page (content of a tab) with this key, which the option --tab takes ("pixel"). An empty name
/// means the page Settings.
/// @throws UsageError that lists the keys
Page page_named(const std::string& name);

/// Runs the editor until its window is closed. With EditorOptions::headless, writes a screenshot and returns instead.
/// Returns remarks about the scene that it loaded first.
/// @throws Error without a display or OpenGL 4.5; if the screenshot's scene cannot be loaded, or an output file cannot
/// be written; if a number is invalid (EditorOptions::check_numeric)
std::vector<std::string> run_editor(const EditorOptions& options);

}  // namespace si
