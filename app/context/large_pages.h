// Memory in large pages.
#pragma once

namespace si {

/// Starts the program anew with GLIBC_TUNABLES saying glibc.malloc.hugetlb=1, by which the C library (glibc 2.35 and
/// later) asks for large pages: scenes, and what drivers and rays make of them, are many megabytes, and small pages
/// may take longer to be handed out than to be filled. Returns where that variable says something of it already, where
/// the system hands out large pages anyway or never, or where there is no such library: all is well but slower.
void restart_with_large_pages(char** arguments);

/// "large": all that is allocated asks for large pages; else "small".
const char* memory_pages();

}  // namespace si
