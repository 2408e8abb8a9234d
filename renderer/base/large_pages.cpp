#include "renderer/base/large_pages.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <new>
#include <string>

#if defined(__linux__)
#include <sys/mman.h>
#endif

// Sanitizers bring their own operator new.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SI_OWN_NEW 0
#endif
#endif
#if !defined(SI_OWN_NEW)
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__linux__)
#define SI_OWN_NEW 0
#else
#define SI_OWN_NEW 1
#endif
#endif

namespace si {

std::string_view memory_pages() {
    std::ifstream file("/sys/kernel/mm/transparent_hugepage/enabled");
    for (std::string mode; file >> mode;)
        if (mode == "[always]" || (mode == "[madvise]" && SI_OWN_NEW)) return "large";
    return "small";
}

}  // namespace si

#if SI_OWN_NEW

namespace {

constexpr std::size_t kLargePage = std::size_t{2} << 20;

/// Allocates at least one large page, and asks the system for large pages. Returns null if memory lacks.
/// @param alignment bytes, a power of two
void* allocate_large(std::size_t alignment, std::size_t bytes) {
    void* block = std::aligned_alloc(std::max(alignment, kLargePage), bytes);
    // A request: without large pages all is well but slower.
    if (block) ::madvise(block, bytes, MADV_HUGEPAGE);
    return block;
}

void* allocate_block(std::size_t bytes) {
    if (bytes < kLargePage) return std::malloc(bytes == 0 ? 1 : bytes);
    return allocate_large(kLargePage, bytes);
}

}  // namespace

void* operator new(std::size_t bytes) {
    for (;;) {
        if (void* block = allocate_block(bytes)) return block;
        const std::new_handler handler = std::get_new_handler();
        if (!handler) throw std::bad_alloc();
        handler();
    }
}

// llvmpipe allocates textures by this function and clears them, which touches every page.
extern "C" int posix_memalign(void** block, std::size_t alignment, std::size_t bytes) noexcept {
    if (alignment % sizeof(void*) != 0 || !std::has_single_bit(alignment)) return EINVAL;
    void* made = bytes < kLargePage ? std::aligned_alloc(alignment, bytes) : allocate_large(alignment, bytes);
    if (!made) return ENOMEM;
    *block = made;
    return 0;
}

void operator delete(void* block) noexcept {
    std::free(block);
}

void operator delete(void* block, std::size_t) noexcept {
    std::free(block);
}

#endif
