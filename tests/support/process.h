// Runs the program and shell scripts as child processes and returns their output.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/caller.h"

namespace si {

/// Words of a command line. A text converts to words: spaces separate them. A word with a space needs the form of a
/// list.
class Words : public std::vector<std::string> {
public:
    using std::vector<std::string>::vector;
    Words(const std::string& line);
    Words(const char* line) : Words(std::string(line)) {}

    /// Returns words followed by more words.
    friend Words operator+(Words words, const Words& more) {
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
};

/// Exit code and output of a finished child process.
struct ProcessResult {
    int code = -1;    ///< exit code; 128 + signal of a killed process
    std::string out;  ///< standard output
    std::string err;  ///< standard error
};

/// Runs shadow-inspector without a display and waits for its end.
/// @param arguments command line after the program's name
/// @param folder working directory of the process
ProcessResult run_program(const Words& arguments,
                          const std::filesystem::path& folder = std::filesystem::current_path());

/// Runs shadow-inspector with --json and expects exit code 0. Returns the parsed output, which is discarded if the
/// output is not JSON. A failure names the command and its caller.
nlohmann::json program_json(const Words& arguments,
                            const std::filesystem::path& folder = std::filesystem::current_path(),
                            Caller caller = Caller::here());

/// Returns the words of --set for a JSON object of settings with their values as texts.
Words set_words(const nlohmann::json& settings);

/// Runs shadow-inspector and expects an exit code and a text within standard error. A failure names the command and its
/// caller.
ProcessResult expect_error(const Words& arguments, int code, std::string_view text,
                           const std::filesystem::path& folder = std::filesystem::current_path(),
                           Caller caller = Caller::here());

/// Runs a script of /bin/sh in which $SI is the path of shadow-inspector, for tests of redirections and limits.
/// @param folder working directory of the shell
ProcessResult run_shell(const std::string& script,
                        const std::filesystem::path& folder = std::filesystem::current_path());

/// Returns a part of a script of /bin/sh for run_shell(): waits at most 30 s for a condition, sends one signal to the
/// last process in the background, waits for its end and prints "code N".
/// @param condition shell command that succeeds when the signal may be sent @param signal name such as INT
std::string signal_once(std::string_view condition, std::string_view signal);

/// Creates an empty folder for the running test, below the build folder. Returns its path.
std::filesystem::path fresh_test_folder();

/// Returns the bytes of a file. @throws std::runtime_error if the file cannot be read
std::string file_bytes(const std::filesystem::path& path);

}  // namespace si
