// Watch over the files of the shown scene, which other programs save again.
#pragma once

#include <optional>
#include <vector>

#include "renderer/base/file_stamp.h"

namespace si {

/// Watch over the files that a scene was read from. It looks at their sizes and times at most once a second, and opens
/// none of them.
class SceneWatch {
public:
    static constexpr double kSeconds = 1;  ///< shortest time between two looks

    /// Watches these files in place of those before.
    /// @param files with the stamps that they had when they were read; empty: watches nothing
    void watch_files(std::vector<StampedFile> files);
    /// Looks at the files, if that is due. Returns true if changed() is another one than before.
    /// @param now_s time of a steady clock, seconds
    bool update(double now_s);
    /// Returns true if files were saved again since they were read, all exist, and none has changed between the last
    /// two looks: a file that is still being written counts later.
    bool changed() const { return changed_; }
    /// Takes the present files for those that were read, so that only a further change counts.
    void accept();

private:
    std::vector<StampedFile> read_;               ///< as they were read
    std::vector<std::optional<FileStamp>> seen_;  ///< at the last look; empty: none was taken
    double due_s_ = 0;
    bool changed_ = false;
};

/// Returns true if a file has another stamp than when it was read.
bool differs_now(const StampedFile& file);

}  // namespace si
