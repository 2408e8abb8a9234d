// Jobs of child processes that misbehave in every way that a parser of foreign files may.
#pragma once

#include <vector>

#include "renderer/foreign/child.h"

namespace si::test {

/// Returns the jobs of the program and those of the tests, for foreign_child_main() of test programs.
const std::vector<ForeignJob>& all_foreign_jobs();

/// Returns a job by its name. The tests have: echo (returns the request), refuse (throws Error "REQUEST"), crash
/// (SIGSEGV), abort, quit (ends without an answer), loop (computes for ever), memory (allocates
/// for ever), zeros (returns as many zeros as the request's decimal number), forbidden (tries what a
/// parser must not do and returns the names of what succeeded), read (returns the bytes of the file that the request
/// names, below the folder).
const ForeignJob& foreign_job(const char* name);

}  // namespace si::test
