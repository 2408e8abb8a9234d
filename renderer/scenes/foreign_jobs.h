// Table of the parsers that run in child processes of this program.
#pragma once

#include <span>

#include "renderer/foreign/child.h"

namespace si {

/// Returns every job that a child process of this program may run, for foreign_child_main().
std::span<const ForeignJob> foreign_jobs();

}  // namespace si
