// Journal of a sweep: each result is appended to a file at once, so that nothing finished is lost if the program ends.
#pragma once

#include <filesystem>

#include "app/sweep/state.h"

namespace si {

inline constexpr const char* kJournalFile = "journal.jsonl";

/// Reads the journal of a sweep: the file to which each result is appended at once. Unreadable lines are skipped and
/// named in SweepState::notes. A last line that was cut off is skipped silently.
/// @throws Error when there is no journal of a sweep, or its error metrics have another definition than this program's
SweepState read_journal(const std::filesystem::path& folder);

/// Open journal of a sweep, to which each result is appended at once, so that an interrupted sweep can continue. The
/// file is locked against other processes.
class Journal {
public:
    /// Opens or creates the journal in `folder` (made if missing) and locks it. @param spec JSON of spec_json()
    /// @param plan hash of plan_key()
    /// @throws Error when the journal belongs to another sweep (naming the difference), or another process writes into
    /// it
    Journal(const std::filesystem::path& folder, const nlohmann::ordered_json& spec, const std::string& plan);
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// Returns the state of the sweep, as all lines of its journal record it.
    const SweepState& state() const { return state_; }
    /// Appends a line to the journal of the sweep, and applies it to state(). @throws Error when writing fails
    void add(const nlohmann::ordered_json& line) { add(std::vector<nlohmann::ordered_json>{line}); }
    /// Appends several lines to the journal of the sweep, and applies them to state(). Flushes the file to disk if a
    /// line records error and cost of a case, or a failure. @throws Error when writing fails
    void add(const std::vector<nlohmann::ordered_json>& lines);

private:
    std::filesystem::path file_;
    SweepState state_;
    int descriptor_ = -1;
};

/// Returns true if a folder contains a file with the name of a sweep's journal (kJournalFile).
bool has_journal(const std::filesystem::path& folder);

/// Returns true if the journal in a folder was written by a sweep of this program, so that the sweep's files there may
/// be replaced. Damage in later lines is ignored.
bool has_own_journal(const std::filesystem::path& folder);

}  // namespace si
