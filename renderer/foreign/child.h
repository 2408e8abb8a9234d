// Child processes that run parsers of foreign files. A crash, an endless loop or a huge allocation of a parser ends its
// child alone, and a parser that a file has taken over reaches neither network nor other files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

namespace si {

/// Parser of untrusted files that runs in a child process. The child is this program itself with a hidden first
/// argument, so every main() that loads files calls foreign_child_main() first.
struct ForeignJob {
    const char* name;   ///< key of the job on the hidden command line
    const char* label;  ///< subject of error sentences: "the Draco decoder"
    /// Parses `request` and returns the answer. Runs confined: it reads no file but those below `folder`, by openat(),
    /// and starts no thread or process. An Error that it throws is thrown again by run_foreign_job().
    /// @param progress takes 0..1 @param folder descriptor of the only folder that the job may read; -1: none
    std::vector<std::uint8_t> (*work)(std::span<const std::uint8_t> request,
                                      const std::function<void(double)>& progress, int folder);
};

/// Limits of memory, processor time and answer size of a child process that parses a file. Its wall time is limited to
/// ten times its processor time.
struct ForeignLimits {
    std::size_t memory_bytes = std::size_t{2} << 30;  ///< address space in addition to that of the program at its start
    int processor_s = 60;
    std::size_t answer_bytes = std::size_t{1} << 30;
};

/// Runs a job in a child process and returns its answer, which is as untrusted as the request.
/// The child has the given limits, no descriptors but its own, and no core dump. A filter of system calls (seccomp)
/// allows the child neither network nor processes nor writing. Where the kernel has Landlock, the child reads no file
/// outside `folder`. The child is killed when the calling thread ends. Without seccomp no job runs.
/// @param folder folder that the job may read; null: none
/// @param progress called with 0..1 at least every 50 ms; returning false or throwing ends the child
/// @throws Error with one sentence, without the file's name: an Error of the job, a crash, an exceeded limit, or
/// "cancelled"
std::vector<std::uint8_t> run_foreign_job(const ForeignJob& job, std::span<const std::uint8_t> request,
                                          const ForeignLimits& limits = {},
                                          const std::filesystem::path* folder = nullptr,
                                          const std::function<bool(double)>& progress = {});

/// Runs the parser job that the command line names and then ends the process, if this process is a child of
/// run_foreign_job(). Returns at once otherwise. Every main() calls this function first.
/// @param jobs every job that this program may run
void foreign_child_main(int argc, char** argv, std::span<const ForeignJob> jobs);

}  // namespace si
