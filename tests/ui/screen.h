// How large the screen is that the editor's tests draw on.
#pragma once

namespace si::test {

inline constexpr int kWidth = 1280, kHeight = 720;

}  // namespace si::test
