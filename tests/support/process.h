// Runs the program as a person would, and looks at what it says.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace si {

struct ProcessResult {
    int code = -1;  ///< exit code; 128 + signal when killed
    std::string out, err;
};

/// Runs shadow-inspector without a display. `folder` is its working directory.
ProcessResult run_program(const std::vector<std::string>& arguments,
                          const std::filesystem::path& folder = std::filesystem::current_path());

/// Runs a script of /bin/sh, in which $SI is the program, for what stands around it: redirections, limits.
ProcessResult run_shell(const std::string& script,
                        const std::filesystem::path& folder = std::filesystem::current_path());

/// An empty folder of the running test's own, below the build folder.
std::filesystem::path fresh_test_folder();

std::string file_bytes(const std::filesystem::path& path);

}  // namespace si
