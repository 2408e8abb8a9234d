// The command line: which command, with which options.
#pragma once

namespace si {

/// Runs the program. Returns its exit code: 0 done, 1 failed (one line on stderr), 2 the command line is wrong.
int run_cli(int argc, const char* const* argv);

}  // namespace si
