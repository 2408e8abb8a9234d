// SHA-256 of bytes, for content that a policy names by its hash.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace si {

/// Computes the SHA-256 of bytes (FIPS 180-4, section 6.2).
std::array<std::uint8_t, 32> sha256(std::string_view bytes);

}  // namespace si
