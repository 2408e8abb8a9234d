// Entry point of the command line.
#pragma once

namespace si {

/// Parses the command line, runs the command that it names, and returns the program's exit code (ExitCode). For every
/// code but 0 it prints one line to stderr.
int run_cli(int argc, const char* const* argv);

}  // namespace si
