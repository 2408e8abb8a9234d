// Entry point of the command line.
#pragma once

namespace si {

/// Parses the command line and runs the command. Returns the exit code (ExitCode). All but 0 print one line on
/// stderr.
int run_cli(int argc, const char* const* argv);

}  // namespace si
