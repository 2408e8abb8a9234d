// Table of the parsers that run in child processes of this program.
#pragma once

#include <span>

#include "renderer/foreign/child.h"

namespace si {

/// Returns the parsers of foreign file formats that this program may run in a child process. Every main() passes them
/// to foreign_child_main().
std::span<const ForeignJob> foreign_jobs();

}  // namespace si
