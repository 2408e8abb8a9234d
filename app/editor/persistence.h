// What the editor keeps on disk while it runs and from run to run: workspace and autosave.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/session/autosave.h"
#include "app/session/workspace.h"

namespace si {

class EditorPersistence {
public:
    /// @param folder of the program's state; empty: nothing is kept
    explicit EditorPersistence(const std::filesystem::path& folder) : workspace_(folder), autosave_(folder) {}

    const WorkspaceData& workspace() const { return workspace_.data(); }
    /// A file was opened or saved.
    void note_scene(const std::string& path);
    void note_preset(const std::string& path);
    void note_welcome();
    /// A file is not there any more.
    void drop(const std::string& path);
    /// The window's size in screen coordinates at scale 1, kept while it is not maximised.
    void note_window(int width, int height, bool maximised);

    /// Call once a frame, and now and then while the editor sleeps: keeps what changed. Remarks go to the log.
    /// `now_s` grows steadily.
    void follow(EditorState& state, double now_s);
    /// What the editor is told. Valid until the next call.
    void fill(EditorFrame& frame) const;
    const Autosave::Lost* lost() const { return autosave_.lost(); }
    void forget_lost() { autosave_.forget_lost(); }
    /// The end. @param unsaved no preset holds the present settings: they are offered at the next start
    void end(const EditorState& state, bool unsaved);

private:
    Workspace workspace_;
    Autosave autosave_;
    double layout_due_s_ = 0;  ///< when a layout that changed is written
    std::optional<EditorLayout> seen_layout_;
};

/// "3 minutes ago".
std::string age_text(double seconds);

}  // namespace si
