#include "app/sweep/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <string_view>

#include "app/base/json_text.h"
#include "app/base/output.h"
#include "renderer/base/atomic_file.h"
#include "renderer/base/error.h"
#include "renderer/base/printable.h"
#include "renderer/base/regular_file.h"

namespace si {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxBadLines = 5;  ///< number of bad lines that notes name one by one
constexpr std::size_t kMaxJournalBytes = std::size_t{4} << 30;

/// Returns the journal's text up to its last line break; a rest without one was cut off.
std::string whole_lines(const fs::path& file) {
    const ReadResult read = read_regular_file(file, kMaxJournalBytes);
    if (!read.error.empty()) throw Error(fmt::format("{}: {}; choose another folder", file.string(), read.error));
    std::string text(read.bytes.text());
    const auto last = text.rfind('\n');
    text.resize(last == std::string::npos ? 0 : last + 1);
    return text;
}

/// Returns the number of cases in the plan.
std::size_t case_count(const SweepState& state) {
    const SweepSpec spec = spec_from_json(state.spec);
    return plan_sweep(spec.base, spec.axes).cases.size();
}

/// Reads one line of a journal. @throws Error, in this program's words
void apply_line(SweepState& state, std::string_view text, bool& begins) {
    Json line;
    try {
        line = parse_json_text(text, {});
    } catch (const Error&) {
        throw Error("it is cut short or damaged");
    }
    begins = line.contains("format");
    if (!begins && state.spec.is_null()) throw Error("it stands before the line that says what is swept");
    try {
        state.apply(line);
    } catch (const Json::exception&) {
        throw Error("a number or a text is missing or of another kind");
    }
}

SweepState state_of(std::string_view text, const fs::path& file) {
    SweepState state;
    const auto refuse = [&](int number, const std::string& why) {
        throw Error(fmt::format("{}: line {}: {}; choose another folder, or --fresh to start again", file.string(),
                                number, why));
    };
    int number = 0, unread = 0;
    while (!text.empty()) {
        const auto end = text.find('\n');
        ++number;
        bool begins = false;
        try {
            apply_line(state, text.substr(0, end), begins);
            if (begins) state.case_count = case_count(state);
        } catch (const OtherMeaning& e) {
            refuse(number, e.what());
        } catch (const std::exception& e) {
            if (begins) refuse(number, printable(e.what()));
            // The line's case counts as not measured.
            if (++unread <= kMaxBadLines)
                state.notes.push_back(
                    fmt::format("{}: line {} is left out: {}", file.string(), number, printable(e.what())));
        }
        text.remove_prefix(end + 1);
    }
    if (number > 0 && state.spec.is_null())
        throw Error(
            fmt::format("{}: no line says what is swept: it is damaged or no journal of a sweep; choose "
                        "another folder, or --fresh to start again",
                        file.string()));
    if (unread > kMaxBadLines)
        state.notes.push_back(fmt::format("{}: {} more lines are left out", file.string(), unread - kMaxBadLines));
    return state;
}

void write_all(int descriptor, std::string_view bytes, const fs::path& file) {
    while (!bytes.empty()) {
        const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) throw Error(fmt::format("{}: cannot be written: {}", file.string(), errno_text()));
        bytes.remove_prefix(std::size_t(n));
    }
}

/// Flushes the file to disk. A file system that cannot flush is no failure.
void flush_to_disk(int descriptor, const fs::path& file) {
    if (::fdatasync(descriptor) != 0 && errno != EINVAL && errno != EROFS)
        throw Error(fmt::format("{}: cannot be written: {}", file.string(), errno_text()));
}

}  // namespace

bool has_journal(const fs::path& folder) {
    std::error_code error;
    return fs::exists(folder / kJournalFile, error);
}

bool has_own_journal(const fs::path& folder) {
    std::error_code error;
    const fs::path file = folder / kJournalFile;
    if (!fs::is_regular_file(fs::symlink_status(file, error))) return false;
    std::ifstream in(file, std::ios::binary);
    std::string begin(1 << 16, '\0');
    in.read(begin.data(), std::streamsize(begin.size()));
    begin.resize(std::size_t(in.gcount()));
    const std::string header = fmt::format("{{\"format\":\"{}\"", kJournalFormat);
    constexpr std::string_view kRun = "{\"run\":{\"id\":\"";
    // A process killed during its first write may leave a journal cut anywhere.
    if (begin.size() < header.size() && header.starts_with(begin)) return true;
    for (std::string_view rest = begin; !rest.empty();) {
        if (rest.starts_with(header) || rest.starts_with(kRun)) return true;  // later lines may be damaged
        rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
    }
    return false;
}

SweepState read_journal(const fs::path& folder) {
    const fs::path file = folder / kJournalFile;
    if (!has_journal(folder)) throw Error(fmt::format("{}: holds no sweep (no {})", folder.string(), kJournalFile));
    SweepState state = state_of(whole_lines(file), file);
    if (state.spec.is_null()) throw Error(fmt::format("{}: holds nothing", file.string()));
    return state;
}

Journal::Journal(const fs::path& folder, const Json& spec, const std::string& plan) : file_(folder / kJournalFile) {
    make_folders(folder);
    require_writable(file_);
    descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0644);
    if (descriptor_ < 0) throw Error(fmt::format("{}: cannot be written: {}", file_.string(), errno_text()));
    try {
        struct stat status {};
        if (::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode))
            throw Error(fmt::format("{}: is not a regular file; choose another folder", file_.string()));
        if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
            throw Error(fmt::format("{}: another process is at this sweep; wait for it, or choose another folder",
                                    folder.string()));
        const std::string text = whole_lines(file_);
        state_ = state_of(text, file_);
        if (::ftruncate(descriptor_, off_t(text.size())) != 0)
            throw Error(fmt::format("{}: cannot be written: {}", file_.string(), errno_text()));
        if (state_.spec.is_null()) {
            add(header_line(spec, plan));
        } else if (const std::string difference = spec_difference(state_.spec, spec); !difference.empty()) {
            throw Error(fmt::format("{}: holds another sweep ({}); choose another folder, or --fresh to start again",
                                    folder.string(), difference));
        } else if (state_.plan != plan) {
            throw Error(
                fmt::format("{}: holds a sweep of a version of the program that ordered its cases differently; "
                            "choose another folder, or --fresh to start again",
                            folder.string()));
        }
    } catch (...) {
        ::close(descriptor_);
        throw;
    }
}

Journal::~Journal() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void Journal::add(const std::vector<Json>& lines) {
    std::string text;
    bool matters = false;
    for (const Json& line : lines) {
        text += line.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
        matters = matters || line.contains("facts") || line.contains("failed");
    }
    write_all(descriptor_, text, file_);
    if (matters) flush_to_disk(descriptor_, file_);
    for (const Json& line : lines) state_.apply(line);
}

}  // namespace si
