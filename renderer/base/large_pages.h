// Large pages of memory. The program's operator new asks the system for them where an allocation is large, so that the
// arrays of scenes and pictures are written sooner: a small page may take longer to be handed out than to be filled.
#pragma once

#include <string_view>

namespace si {

/// Returns the size of the memory pages that the system gives to large allocations of this program: "large" (huge
/// pages) or "small".
std::string_view memory_pages();

}  // namespace si
