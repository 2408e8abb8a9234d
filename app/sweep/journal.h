// The journal of a sweep: a file to which each result is added as a line when it is there, so that nothing finished is
// lost however the program ends.
#pragma once

#include <filesystem>

#include "app/sweep/state.h"

namespace si {

inline constexpr const char* kJournalFile = "journal.jsonl";

/// Reads what a folder's journal says. A last line that was cut off is left out; so are others that cannot be read, of
/// which the state's notes tell. @throws Error when it is no journal, or its errors mean something else
SweepState read_journal(const std::filesystem::path& folder);

class Journal {
public:
    /// Opens or begins the journal in `folder`, which is made if missing, and keeps others from writing into it.
    /// @throws Error when it is of another sweep (naming the difference), or another process writes into it.
    Journal(const std::filesystem::path& folder, const nlohmann::ordered_json& spec, const std::string& plan);
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    const SweepState& state() const { return state_; }
    /// Adds a line. Whatever becomes of the program, it is kept; results of cases are on the disk when this returns, so
    /// that they survive the machine's end, too. @throws Error when it cannot be written.
    void add(const nlohmann::ordered_json& line);
    /// Adds several lines at once.
    void add(const std::vector<nlohmann::ordered_json>& lines);

private:
    std::filesystem::path file_;
    SweepState state_;
    int descriptor_ = -1;
};

/// Whether there is a journal in `folder`.
bool has_journal(const std::filesystem::path& folder);

/// Whether it is one that a sweep wrote, whatever is wrong with it further on.
bool has_own_journal(const std::filesystem::path& folder);

}  // namespace si
