#include "app/editor/scene_watch.h"

#include <utility>

namespace si {

bool differs_now(const StampedFile& file) {
    return file_stamp(file.path) != file.stamp;
}

void SceneWatch::watch_files(std::vector<StampedFile> files) {
    read_ = std::move(files);
    seen_.clear();
    changed_ = false;
}

bool SceneWatch::update(double now_s) {
    if (read_.empty() || now_s < due_s_) return false;
    due_s_ = now_s + kSeconds;
    std::vector<std::optional<FileStamp>> now;
    bool differs = false, missing = false;
    for (const StampedFile& file : read_) {
        now.push_back(file_stamp(file.path));
        differs |= now.back() != file.stamp;
        missing |= !now.back() && file.stamp;
    }
    const bool steady = now == seen_;
    seen_ = std::move(now);
    return std::exchange(changed_, differs && steady && !missing) != changed_;
}

void SceneWatch::accept() {
    for (StampedFile& file : read_)
        if (const auto stamp = file_stamp(file.path)) file.stamp = stamp;
    seen_.clear();
    changed_ = false;
}

}  // namespace si
