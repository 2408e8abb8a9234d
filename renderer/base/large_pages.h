// Large pages of memory. The program's operator new and posix_memalign() ask the system for them where an allocation is
// large: a small page may take longer to be handed out than to be filled. Arrays of scenes and pictures come from
// operator new. Textures of llvmpipe come from posix_memalign().
#pragma once

#include <string_view>

namespace si {

/// Returns the size of the memory pages that the system gives to large allocations of this program: "large" (huge
/// pages) or "small".
std::string_view memory_pages();

}  // namespace si
