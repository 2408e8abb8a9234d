// Autosave of the scene and settings while the editor runs, so that a crash loses nothing. Each running editor has its
// own file and holds a lock file next to it. A file whose lock is free was left by an editor that crashed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/session/presets.h"
#include "app/session/workspace.h"

namespace si {

/// Autosave of the scene and settings of one running editor. It also finds the files that crashed editors left, so that
/// their work can be restored.
class Autosave {
public:
    static constexpr double kSeconds = 2;  ///< shortest time between two writes

    /// Prepares autosave and looks for the work of editors that crashed. @param folder state folder of the program;
    /// empty: autosave is off
    explicit Autosave(const std::filesystem::path& folder);

    /// Scene and settings that an editor left when it crashed. The lock keeps other running editors from offering them
    /// too.
    struct Lost {
        Preset preset;
        double age_s = 0;  ///< seconds since the session's file was written last
        std::filesystem::path file;
        LockFile lock;
    };
    /// Returns the work of a crashed editor that the user may restore; null: none.
    const Lost* lost() const { return lost_ ? &*lost_ : nullptr; }
    /// Removes the autosave file of a crashed editor (lost()) after the user has declined it. Then looks for the next
    /// such file.
    void forget_lost();
    /// Turns the work of a crashed editor (lost()) into unsaved work of this editor, after the user has restored it.
    /// The next update() writes it, and only then removes the crashed editor's file. Looks for the next such file.
    void adopt_lost();

    /// Writes scene and settings to the autosave file if they differ from those of the last write. Before the first
    /// write they are compared with those of the first call, when the editor opened. Writes at most every kSeconds.
    /// Call every frame. Never throws: errors go to take_remarks().
    /// @param now_s time of a steady clock, seconds
    void update(const std::string& scene, const Settings& settings, double now_s);
    /// Ends autosave when the editor closes.
    /// @param unsaved true: keeps the file if scene or settings (without camera and view) differ from those at the
    /// start of the editor; the next start then offers them, as after a crash. false: removes the file
    void end(const std::string& scene, const Settings& settings, bool unsaved);
    /// Returns the errors of autosave and of reading sessions of crashed editors since the last call, one line each,
    /// and clears them.
    std::vector<std::string> take_remarks() { return std::exchange(remarks_, {}); }

private:
    /// Looks for the newest autosave file that a crashed editor left; lost() then returns its contents.
    void find_lost();
    /// Makes and locks the autosave file of this editor. Returns false if no file can be locked.
    bool claim_file();
    /// Writes scene and settings to the autosave file of this editor, and then removes the file of a restored session.
    /// Returns false after an error; the first of several in a row goes to the remarks.
    bool write(const std::string& scene, const Settings& settings);

    std::filesystem::path folder_;  ///< empty: off
    std::filesystem::path file_;
    LockFile lock_;
    std::optional<Lost> lost_;
    std::optional<Lost> adopted_;                            ///< restored session that this editor has not written yet
    std::vector<std::filesystem::path> settled_;             ///< lost sessions that were restored or declined
    std::optional<std::pair<std::string, Settings>> known_;  ///< state at the last write, or at the start
    std::optional<std::pair<std::string, Settings>> first_;  ///< state at the start; without a scene after adopt_lost()
    bool failed_ = false;                                    ///< the last write failed; the next one tries again
    double next_write_s_ = 0;
    std::optional<double> look_again_s_;  ///< time of the next search for lost sessions; infinite: never
    std::vector<std::string> remarks_;
};

}  // namespace si
