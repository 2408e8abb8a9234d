// What the editor remembers from one run to the next: layout, window, recent files. A file that people may delete at
// any time; whatever is wrong with it never hinders the editor.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "ui/state/editor_ui.h"

namespace si {

struct WorkspaceData {
    EditorLayout layout;
    int window_width = 0, window_height = 0;  ///< screen coordinates at scale 1; 0: never kept
    bool maximised = false;
    bool welcomed = false;                                   ///< the welcome was shown
    std::vector<std::string> recent_scenes, recent_presets;  ///< absolute paths, the newest first
    bool operator==(const WorkspaceData&) const = default;
};

/// $XDG_STATE_HOME/shadow-inspector, or ~/.local/state/shadow-inspector where that is not set (XDG base directories);
/// empty when neither is known.
std::filesystem::path state_folder();

/// $XDG_CACHE_HOME/shadow-inspector, or ~/.cache/shadow-inspector where that is not set; empty when neither is known.
std::filesystem::path cache_folder();

/// Opened and locked by this process alone (flock), until closed. Invalid when another process holds it or the file
/// system cannot lock.
class LockFile {
public:
    LockFile() = default;
    /// @param wait for another holder to let go
    LockFile(const std::filesystem::path& path, bool wait);
    ~LockFile() { release(); }
    LockFile(LockFile&& other) noexcept;
    LockFile& operator=(LockFile&& other) noexcept;
    explicit operator bool() const { return fd_ >= 0; }
    void release();

private:
    int fd_ = -1;
};

class Workspace {
public:
    /// @param folder made when first written to; empty: nothing is remembered
    explicit Workspace(std::filesystem::path folder);

    const WorkspaceData& data() const { return data_; }
    /// Changes the data here and in the file, on top of what other instances wrote meanwhile. Never throws.
    void change(const std::function<void(WorkspaceData&)>& edit);
    /// What went wrong since the last call, one line each.
    std::vector<std::string> take_remarks();

private:
    bool read(WorkspaceData& data);

    std::filesystem::path folder_;
    WorkspaceData data_;
    bool foreign_ = false;  ///< the file is not ours to write
    std::vector<std::string> remarks_;
};

/// Puts a path to the front of a list of recent files, once.
void put_first(std::vector<std::string>& recent, const std::string& path);

}  // namespace si
