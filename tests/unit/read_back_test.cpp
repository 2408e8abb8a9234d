// Tests of the size of read-backs: OpenGL takes a signed number of 32 bits.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "renderer/gl/target.h"
#include "tests/support/error_text.h"

namespace si {
namespace {

TEST(ReadBack, RefusesAnImageWhoseSizeOpenGlCannotTake) {
    constexpr std::size_t kTwoGiB = std::size_t(1) << 31;
    EXPECT_EQ(gl::read_back_size(0), 0);
    EXPECT_EQ(gl::read_back_size(kTwoGiB - 1), 2147483647);
    for (const std::size_t bytes : {kTwoGiB, 2 * kTwoGiB, 2 * kTwoGiB + 4})
        EXPECT_TRUE(test::fails_with([&] { gl::read_back_size(bytes); },
                                     {std::to_string(bytes), "draw a smaller picture (--size)", "map.resolution"}));
}

}  // namespace
}  // namespace si
