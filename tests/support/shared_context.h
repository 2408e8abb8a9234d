// One OpenGL context for the drawing tests of a process, and the programs that they compile in it: making these for
// each test takes as long as what the tests draw.
#pragma once

#include <memory>

#include "app/context/headless_context.h"
#include "renderer/gl/program_cache.h"

namespace si::test {

/// Makes the shared context current on this thread; the first call creates it.
HeadlessContext& shared_context();

/// Returns the program cache of the shared context, for renderers made in it.
std::shared_ptr<gl::ProgramCache> shared_programs();

}  // namespace si::test
