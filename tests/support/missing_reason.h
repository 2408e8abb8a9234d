// Begins the reason of a test that is skipped for want of something outside the repository, which is then named:
// GTEST_SKIP() << test::kMissingReason << "chromium". The main program of the tests writes these down, and test.sh
// counts them.
#pragma once

namespace si::test {

inline constexpr const char* kMissingReason = "lacks ";

}  // namespace si::test
