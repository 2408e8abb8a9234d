// Entry point of the command line.
#pragma once

namespace si {

/// Parses the command line and runs the command. Returns the exit code: 0 done, 1 failed (one line on stderr), 2 wrong
/// usage.
int run_cli(int argc, const char* const* argv);

}  // namespace si
