// Tests of large allocations, which ask the system for large pages.
#include "renderer/base/large_pages.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace si {
namespace {

/// Returns true if the system was asked for large pages at an address: the flag "hg" of /proc/self/smaps.
bool asked_for_large_pages(const void* address) {
    const auto at = reinterpret_cast<std::uintptr_t>(address);
    std::ifstream maps("/proc/self/smaps");
    bool here = false;
    for (std::string line; std::getline(maps, line);) {
        std::istringstream words(line);
        std::uintptr_t first = 0, last = 0;
        char dash = 0;
        if (words >> std::hex >> first >> dash >> last && dash == '-') here = first <= at && at < last;
        if (here && line.starts_with("VmFlags:")) return line.find(" hg") != std::string::npos;
    }
    return false;
}

TEST(LargePages, AreAskedForByNewAndByTheDriversTextures) {
    if (memory_pages() != "large") GTEST_SKIP() << "the system has no large pages";
    std::ifstream mode_file("/sys/kernel/mm/transparent_hugepage/enabled");
    std::string modes;
    std::getline(mode_file, modes);
    if (modes.find("[madvise]") == std::string::npos) GTEST_SKIP() << "large pages are given without being asked for";
    const std::unique_ptr<char[]> array(new char[5 << 20]);
    EXPECT_TRUE(asked_for_large_pages(array.get() + (3 << 20)));
    void* block = nullptr;
    ASSERT_EQ(::posix_memalign(&block, 64, 5 << 20), 0);
    EXPECT_TRUE(asked_for_large_pages(static_cast<char*>(block) + (3 << 20)));
    std::free(block);
}

TEST(LargePages, BlocksHaveTheirAlignmentAndBadAlignmentsAreRefused) {
    for (const std::size_t alignment : {std::size_t(8), std::size_t(64), std::size_t(4096), std::size_t(8) << 20})
        for (const std::size_t bytes : {std::size_t(0), std::size_t(1), std::size_t(100), std::size_t(3) << 20}) {
            void* block = nullptr;
            ASSERT_EQ(::posix_memalign(&block, alignment, bytes), 0) << alignment << " " << bytes;
            EXPECT_EQ(reinterpret_cast<std::uintptr_t>(block) % alignment, 0u) << bytes;
            std::free(block);
        }
    // Not known to the compiler, which would warn.
    for (volatile std::size_t alignment : {std::size_t(0), std::size_t(4), std::size_t(24)}) {
        void* block = nullptr;
        EXPECT_EQ(::posix_memalign(&block, alignment, 100), EINVAL) << alignment;
    }
}

}  // namespace
}  // namespace si
