#include "app/session/autosave.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "renderer/base/atomic_file.h"
#include "renderer/base/error.h"
#include "renderer/scenes/builtin.h"

namespace si {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSessionExtension = ".json";

fs::path lock_of(fs::path file) {
    return file.replace_extension(".lock");
}

void remove_session(const fs::path& file) {
    std::error_code ignored;
    fs::remove(file, ignored);
    fs::remove(lock_of(file), ignored);
}

/// Returns the scene's name as an absolute path, valid from any working directory.
std::string absolute_name(const std::string& scene) {
    if (is_builtin_scene(scene)) return scene;
    std::error_code error;
    const fs::path absolute = fs::absolute(scene, error);
    return error ? scene : absolute.string();
}

}  // namespace

Autosave::Autosave(const fs::path& folder) : folder_(folder.empty() ? fs::path() : folder / "sessions") {
    find_lost();
}

void Autosave::find_lost() {
    std::vector<std::pair<fs::file_time_type, fs::path>> files;
    std::error_code error;
    if (folder_.empty() || !fs::is_directory(folder_, error)) return;
    for (const auto& entry : fs::directory_iterator(folder_, error))
        if (entry.path().extension() == kSessionExtension && entry.is_regular_file(error))
            files.emplace_back(entry.last_write_time(error), entry.path());
    std::sort(files.rbegin(), files.rend());
    for (const auto& [time, file] : files) {
        if (file == file_ || std::find(settled_.begin(), settled_.end(), file) != settled_.end()) continue;
        LockFile lock(lock_of(file), false);
        if (!lock || !fs::exists(file, error)) continue;  // its editor still runs, or another editor has handled it
        try {
            Lost lost{load_preset(file.string()), 0, file, std::move(lock)};
            lost.age_s = std::chrono::duration<double>(fs::file_time_type::clock::now() - time).count();
            lost_ = std::move(lost);
            return;
        } catch (const std::exception& e) {
            remarks_.push_back(fmt::format("a lost session cannot be restored: {}", e.what()));
            fs::path aside = file;
            fs::rename(file, aside.replace_extension(".unreadable"), error);
            fs::remove(lock_of(file), error);
        }
    }
}

void Autosave::forget_lost() {
    if (!lost_) return;
    remove_session(lost_->file);
    settled_.push_back(lost_->file);
    lost_.reset();
    find_lost();
}

void Autosave::adopt_lost() {
    if (!lost_) return;
    settled_.push_back(lost_->file);
    adopted_.emplace(std::move(*lost_));
    lost_.reset();
    // A state without a scene: the restored session differs from it, so that it is unsaved and the next write is due.
    first_.emplace();
    known_ = first_;
    next_write_s_ = 0;
    find_lost();
}

bool Autosave::claim_file() {
    if (lock_) return true;
    make_folders(folder_);
    for (int n = 0; n < 100 && !lock_; ++n) {
        file_ = folder_ / fmt::format("{}-{}{}", ::getpid(), n, kSessionExtension);
        std::error_code error;
        if (fs::exists(file_, error)) continue;  // left by an earlier process with the same id
        lock_ = LockFile(lock_of(file_), false);
    }
    return bool(lock_);
}

bool Autosave::write(const std::string& scene, const Settings& settings) {
    try {
        if (!claim_file()) throw Error(fmt::format("{}: files cannot be locked there", folder_.string()));
        save_preset({.scene = absolute_name(scene), .settings = settings}, file_);
    } catch (const std::exception& e) {
        if (!std::exchange(failed_, true))
            remarks_.push_back(fmt::format("a crash would lose the present settings: {}", e.what()));
        return false;
    }
    failed_ = false;
    if (adopted_) remove_session(adopted_->file);
    adopted_.reset();
    return true;
}

void Autosave::update(const std::string& scene, const Settings& settings, double now_s) {
    // A killed editor may still hold its lock while the next one starts.
    if (!look_again_s_) look_again_s_ = now_s + kSeconds;
    if (!lost_ && now_s >= *look_again_s_) {
        look_again_s_ = std::numeric_limits<double>::infinity();
        find_lost();
    }
    if (folder_.empty() || now_s < next_write_s_) return;
    if (!known_) {
        first_.emplace(scene, settings);
        known_ = first_;
    }
    if (known_->first == scene && known_->second == settings) return;
    if (write(scene, settings)) known_.emplace(scene, settings);
    next_write_s_ = now_s + kSeconds;
}

void Autosave::end(const std::string& scene, const Settings& settings, bool unsaved) {
    if (folder_.empty()) return;
    Settings work = settings;
    if (first_) {
        work.camera = first_->second.camera;
        work.view = first_->second.view;
    }
    // Moves of the camera are not saved work.
    const bool keep = unsaved && first_ && (first_->first != scene || first_->second != work);
    if (keep) {
        write(scene, settings);  // on an error the files written before stay
    } else {
        if (lock_) remove_session(file_);
        if (adopted_) remove_session(adopted_->file);
    }
    adopted_.reset();
    lock_.release();
    folder_.clear();
}

}  // namespace si
