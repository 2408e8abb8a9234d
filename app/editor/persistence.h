// State that the editor keeps on disk: the workspace (layout, recent files) and the autosave.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/session/autosave.h"
#include "app/session/workspace.h"

namespace si {

/// Reader and writer of the editor's files in the state folder: the workspace (layout, recent files) and the autosave.
class EditorPersistence {
public:
    /// Reads the workspace and looks for autosaves. @param folder state folder of the program; empty: nothing is kept
    explicit EditorPersistence(const std::filesystem::path& folder) : workspace_(folder), autosave_(folder) {}

    const WorkspaceData& workspace() const { return workspace_.data(); }
    /// Adds a scene file to the recent files of the workspace, which a menu lists. Does nothing for a built-in scene.
    void note_scene(const std::string& path);
    /// Adds a preset file to the recent files of the workspace, which a menu lists.
    void note_preset(const std::string& path);
    /// Records in the workspace file that the welcome window was shown, so that it is shown only once.
    void note_welcome();
    /// Records in the workspace file that the user was warned that opening a capture runs its shaders. The warning is
    /// then not shown again.
    void note_capture_warning();
    /// Removes a scene or preset from the workspace's recent files. Call when the file no longer exists.
    void drop_recent(const std::string& path);
    /// Records in the workspace file whether the window is maximised and, if not, its size. Call at the editor's end.
    /// @param width, height pixels divided by the monitor's content scale
    void note_window(int width, int height, bool maximised);

    /// Writes changed settings to the autosave file at most every 2 s, and a changed window layout to the workspace
    /// file after 1 s. Call once a frame, and regularly while the editor sleeps. Errors go to the log. @param now_s
    /// time of a steady clock, seconds
    void write_when_due(EditorState& state, double now_s);
    /// Writes the recent files, and the session that a crash has left, into `frame`, the data that panels show.
    /// Pointers in `frame` stay valid until the next non-const call.
    void fill(EditorFrame& frame) const;
    /// Returns the session that a crash has left; null: none.
    const Autosave::Lost* lost() const { return autosave_.lost(); }
    /// Deletes the session that a crash has left.
    void forget_lost() { autosave_.forget_lost(); }
    /// Turns the session that a crash has left into unsaved work of this editor, after the user has restored it. Its
    /// file is deleted once autosave has written the session again.
    void adopt_lost() { autosave_.adopt_lost(); }
    /// Writes the workspace file and ends autosave, at the editor's end.
    /// @param unsaved true: keeps the autosave file, for the next start to offer, because no saved preset has the
    /// settings; false: deletes the file
    void end(const EditorState& state, bool unsaved);

private:
    Workspace workspace_;
    Autosave autosave_;
    double layout_due_s_ = 0;  ///< time at which a changed layout is written; 0: it has not changed
    std::optional<EditorLayout> seen_layout_;
};

/// Formats an age in words: "less than a minute ago", "3 minutes ago". @param seconds age
std::string age_text(double seconds);

}  // namespace si
