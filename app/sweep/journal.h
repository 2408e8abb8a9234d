// Journal of a sweep: each result is appended to a file at once, so that nothing finished is lost if the program ends.
#pragma once

#include <filesystem>

#include "app/sweep/state.h"

namespace si {

inline constexpr const char* kJournalFile = "journal.jsonl";

/// Reads the journal of a sweep: the file to which each result is appended at once. Unreadable lines are skipped and
/// named in the state's notes. A last line that was cut off is skipped silently.
/// @throws Error when there is no journal of a sweep, or its error metrics have another definition
SweepState read_journal(const std::filesystem::path& folder);

/// Open journal of a sweep, to which each result is appended at once, so that an interrupted sweep can continue. This
/// process holds a lock on it.
class Journal {
public:
    /// Opens or begins the journal in `folder` (made if missing) and locks it. @throws Error when it belongs to another
    /// sweep (naming the difference), or another process writes into it
    Journal(const std::filesystem::path& folder, const nlohmann::ordered_json& spec, const std::string& plan);
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// Returns the state that all lines of the journal add up to.
    const SweepState& state() const { return state_; }
    /// Appends a line to the journal, and flushes results of cases to disk. @throws Error when writing fails
    void add(const nlohmann::ordered_json& line) { add(std::vector<nlohmann::ordered_json>{line}); }
    /// Appends several lines to the journal of the sweep, and applies them to state(). @throws Error when writing fails
    void add(const std::vector<nlohmann::ordered_json>& lines);

private:
    std::filesystem::path file_;
    SweepState state_;
    int descriptor_ = -1;
};

/// Returns true if a folder holds a file with the name of a sweep's journal (file of results).
bool has_journal(const std::filesystem::path& folder);

/// Returns true if a sweep of this program wrote the journal (file of results) in a folder, so that its files there may
/// be replaced. Damage in later lines is ignored.
bool has_own_journal(const std::filesystem::path& folder);

}  // namespace si
