// Shares one OpenGL context and its compiled programs among the drawing tests of a process, because making them for
// each test takes as long as drawing.
#pragma once

#include <memory>

#include "app/context/headless_context.h"
#include "renderer/gl/program_cache.h"

namespace si::test {

/// Makes the shared headless context current on this thread and returns it. The first call creates the context.
HeadlessContext& shared_context();

/// Returns the program cache of shared_context(), for renderers made in that context.
std::shared_ptr<gl::ProgramCache> shared_programs();

}  // namespace si::test
