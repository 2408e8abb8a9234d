// Watch over the files of the shown scene, which other programs save again.
#pragma once

#include <optional>
#include <vector>

#include "renderer/base/file_stamp.h"

namespace si {

/// Watch over the files of the shown scene, which notices that another program has saved them. Compares sizes and times
/// of the files at most once a second, and opens none of them.
class SceneWatch {
public:
    static constexpr double kSeconds = 1;  ///< shortest time between two checks of the files

    /// Starts to watch these files, in place of earlier ones.
    /// @param files paths, each with its size and time (FileStamp) when it was read; empty: watches nothing
    void watch_files(std::vector<StampedFile> files);
    /// Checks the watched files, at most once a second. Returns true if changed() now returns another value than
    /// before.
    /// @param now_s time of a steady clock, seconds
    bool update(double now_s);
    /// Returns true if a watched file was saved again since it was read, all files exist, and none has changed between
    /// the last two checks. A file that is still being written therefore counts later.
    bool changed() const { return changed_; }
    /// Accepts the watched files as they are now: changed() returns false until they are saved once more. Call if the
    /// user keeps the shown scene.
    void accept();

private:
    std::vector<StampedFile> read_;               ///< watched files, with size and time when they were read
    std::vector<std::optional<FileStamp>> seen_;  ///< stamps at the last check; empty: not checked yet
    double due_s_ = 0;
    bool changed_ = false;
};

/// Returns true if a file has changed since it was read, by its size and time (FileStamp).
bool differs_now(const StampedFile& file);

}  // namespace si
