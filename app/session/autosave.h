// The present scene and settings on disk while the editor runs, so that a crash loses nothing. Each running editor has
// a file of its own and holds a lock beside it; a file whose lock is free was left behind by an editor that did not
// end cleanly.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/session/presets.h"
#include "app/session/workspace.h"

namespace si {

class Autosave {
public:
    static constexpr double kSeconds = 2;  ///< at least so long between two writings

    /// @param folder of the program's state; empty: nothing is kept
    explicit Autosave(const std::filesystem::path& folder);
    Autosave(const Autosave&) = delete;
    Autosave& operator=(const Autosave&) = delete;

    /// A session that an earlier run left behind. No other running editor is offered the same.
    struct Lost {
        Preset preset;
        double age_s = 0;  ///< since it was last written
        std::filesystem::path file;
        LockFile lock;
    };
    const Lost* lost() const { return lost_ ? &*lost_ : nullptr; }
    /// It was restored or is not wanted: removes it and looks for the next.
    void forget_lost();

    /// Call often. Writes when scene or settings differ from what was there at first and from what is written,
    /// `now_s` grows steadily. Never throws.
    void follow(const std::string& scene, const Settings& settings, double now_s);
    /// The end. @param unsaved what is shown then is kept and offered again, as after a crash; else nothing is left
    void end(const std::string& scene, const Settings& settings, bool unsaved);
    /// What went wrong since the last call, one line each.
    std::vector<std::string> take_remarks();

private:
    void find_lost();
    bool claim();
    void write(const std::string& scene, const Settings& settings);

    std::filesystem::path folder_;  ///< empty: off
    std::filesystem::path file_;
    LockFile lock_;
    std::optional<Lost> lost_;
    std::vector<std::filesystem::path> settled_;             ///< lost sessions that were dealt with
    std::optional<std::pair<std::string, Settings>> known_;  ///< as at first, later as written
    std::optional<std::pair<std::string, Settings>> first_;  ///< as the editor began
    double next_write_s_ = 0;
    std::optional<double> look_again_s_;  ///< for lost sessions; infinite: done
    std::vector<std::string> remarks_;
};

}  // namespace si
