// Large pages of memory. The program's operator new asks the system for them where an allocation is large, so that the
// arrays of scenes and pictures are written sooner: a small page may take longer to be handed out than to be filled.
#pragma once

#include <string_view>

namespace si {

/// Returns "large" where large allocations of this program get large memory pages from the system, else "small".
std::string_view memory_pages();

}  // namespace si
