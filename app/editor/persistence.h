// State that the editor keeps on disk: the workspace (layout, recent files) and the autosave.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/session/autosave.h"
#include "app/session/workspace.h"

namespace si {

/// Reader and writer of the workspace and the autosave of one editor.
class EditorPersistence {
public:
    /// Reads the workspace and looks for autosaves. @param folder state folder of the program; empty: nothing is kept
    explicit EditorPersistence(const std::filesystem::path& folder) : workspace_(folder), autosave_(folder) {}

    const WorkspaceData& workspace() const { return workspace_.data(); }
    /// Adds a scene to the workspace's recent files.
    void note_scene(const std::string& path);
    /// Adds a preset to the workspace's recent files.
    void note_preset(const std::string& path);
    /// Records in the workspace that the welcome was shown.
    void note_welcome();
    /// Records in the workspace that the user was told what opening a capture does.
    void note_capture_warning();
    /// Removes a file that no longer exists from the workspace's recent files.
    void drop_recent(const std::string& path);
    /// Records at the editor's end whether the window is maximised and, if not, its size (screen coordinates at scale
    /// 1).
    void note_window(int width, int height, bool maximised);

    /// Writes workspace and autosave if they have changed and the shortest time between two writes has passed. Call
    /// once a frame, and regularly while the editor sleeps. Remarks go to the log. @param now_s time of a steady clock,
    /// seconds
    void write_when_due(EditorState& state, double now_s);
    /// Writes recent files and the session that a crash has left into `frame`. Pointers in it stay valid until the next
    /// non-const call.
    void fill(EditorFrame& frame) const;
    /// Returns the session that a crash has left; null: none.
    const Autosave::Lost* lost() const { return autosave_.lost(); }
    /// Deletes the session that a crash has left.
    void forget_lost() { autosave_.forget_lost(); }
    /// Writes the workspace at the editor's end, and ends autosave: with `unsaved` the autosave file is kept, for the
    /// next start to offer; otherwise it is deleted. @param unsaved true: the settings differ from every saved preset
    void end(const EditorState& state, bool unsaved);

private:
    Workspace workspace_;
    Autosave autosave_;
    double layout_due_s_ = 0;  ///< time at which a changed layout is written; 0: it has not changed
    std::optional<EditorLayout> seen_layout_;
};

/// Returns a path as absolute and without "." and "..".
std::string whole_path(const std::filesystem::path& path);
/// Formats the age of a file in words: "3 minutes ago". @param seconds age
std::string age_text(double seconds);

}  // namespace si
