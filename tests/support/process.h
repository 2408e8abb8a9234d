// Runs the program and shell scripts as child processes and returns their output.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace si {

/// Exit code and output of a finished child process.
struct ProcessResult {
    int code = -1;    ///< exit code; 128 + signal of a killed process
    std::string out;  ///< standard output
    std::string err;  ///< standard error
};

/// Runs shadow-inspector without a display and waits for its end.
/// @param arguments command line after the program's name
/// @param folder working directory of the process
ProcessResult run_program(const std::vector<std::string>& arguments,
                          const std::filesystem::path& folder = std::filesystem::current_path());

/// Runs a script of /bin/sh in which $SI is the path of shadow-inspector, for tests of redirections and limits.
/// @param folder working directory of the shell
ProcessResult run_shell(const std::string& script,
                        const std::filesystem::path& folder = std::filesystem::current_path());

/// Creates an empty folder for the running test, below the build folder. Returns its path.
std::filesystem::path fresh_test_folder();

/// Returns the bytes of a file. @throws std::runtime_error if the file cannot be read
std::string file_bytes(const std::filesystem::path& path);

}  // namespace si
