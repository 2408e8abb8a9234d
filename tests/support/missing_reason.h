// Defines the start of skip messages for tests that need something outside the repository.
#pragma once

namespace si::test {

/// Start of the message of a test that is skipped because something outside the repository is missing:
/// GTEST_SKIP() << test::kMissingReason << "chromium". main.cpp collects these messages and test.sh counts them.
inline constexpr const char* kMissingReason = "lacks ";

}  // namespace si::test
