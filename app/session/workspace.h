// Workspace file: layout, window and recent files that the editor keeps between runs. Users may delete it at any time,
// and a damaged file never stops the editor.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "ui/state/editor_ui.h"

namespace si {

/// Contents of the workspace file, which the editor keeps between runs: layout, window, theme and recent files.
struct WorkspaceData {
    EditorLayout layout;
    int window_width = 0, window_height = 0;  ///< screen coordinates at scale 1; 0: unknown
    bool maximised = false;
    bool welcomed = false;                                   ///< the welcome was shown
    bool capture_warned = false;                             ///< the user knows that opening a capture runs its shaders
    std::vector<std::string> recent_scenes, recent_presets;  ///< absolute paths, the newest first
    bool operator==(const WorkspaceData&) const = default;
};

/// Returns the folder in which the program keeps state between runs: $XDG_STATE_HOME/shadow-inspector, else
/// ~/.local/state/shadow-inspector (XDG base directories). Empty if neither variable is set.
std::filesystem::path state_folder();

/// Returns the folder for files that the program can make again: $XDG_CACHE_HOME/shadow-inspector, else
/// ~/.cache/shadow-inspector. Empty if neither variable is set.
std::filesystem::path cache_folder();

/// Lock among processes: a file that this process holds open and locked (flock). Converts to false when another process
/// holds the lock or the file system cannot lock.
class LockFile {
public:
    LockFile() = default;
    /// Opens or creates the file and locks it. @param wait true: blocks until another holder releases the lock; false:
    /// gives up at once
    LockFile(const std::filesystem::path& path, bool wait);
    ~LockFile() { release(); }
    LockFile(LockFile&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    LockFile& operator=(LockFile other) noexcept {
        std::swap(fd_, other.fd_);
        return *this;
    }
    /// Returns true if this process holds the lock.
    explicit operator bool() const { return fd_ >= 0; }
    /// Releases the lock on this file and closes it.
    void release();

private:
    int fd_ = -1;
};

/// Workspace file of the editor, which holds layout, window and recent files. All running editors share it.
class Workspace {
public:
    /// Reads the workspace file (layout, window, recent files) of a state folder. @param folder made at the first
    /// write; empty: nothing is kept
    explicit Workspace(std::filesystem::path folder);

    /// Returns the workspace as last read or written by this process.
    const WorkspaceData& data() const { return data_; }
    /// Changes the workspace (layout, window, recent files) in memory and in its file, on top of changes that other
    /// editors wrote. Never throws: errors go to take_remarks().
    /// @param edit function that makes the change; may be called twice, on different data
    void change(const std::function<void(WorkspaceData&)>& edit);
    /// Returns the errors of reading and writing the workspace file since the last call, one line each.
    std::vector<std::string> take_remarks() { return std::exchange(remarks_, {}); }

private:
    /// Reads the workspace file, if there is one. Returns false if the file must not be overwritten: it is unreadable,
    /// or of another program or version.
    bool read(WorkspaceData& data);

    std::filesystem::path folder_;
    WorkspaceData data_;
    bool foreign_ = false;  ///< the file belongs to another program or version and is not written
    std::vector<std::string> remarks_;
};

/// Puts a path at the front of a list of recent files, without duplicates. Keeps the 12 newest paths.
void put_first(std::vector<std::string>& recent, const std::string& path);

}  // namespace si
