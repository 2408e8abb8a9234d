// Cache keys: 64-bit hashes of everything that a result depends on.
#pragma once

#include <atomic>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <vector>

namespace si {

/// Returns a number that no earlier call in this process returned, above 0. Usable from any thread.
inline std::uint64_t next_version() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

/// Hashes 64 bits by the finaliser of splitmix64 (Steele, Lea, Flood, OOPSLA 2014).
constexpr std::uint64_t splitmix64(std::uint64_t z) {
    z += 0x9e3779b97f4a7c15ull;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
}

/// Running 64-bit hash that serves as a cache key: add() all inputs of a result, then read value(). The value is never
/// 0, which stands for "undefined contents".
class Key {
public:
    template <typename T>
    requires std::is_arithmetic_v<T> || std::is_enum_v<T>
        /// Hashes a number or enumerator.
        Key& add(T value) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &value, sizeof value);
        mix(bits);
        return *this;
    }
    /// Hashes a text and its length.
    Key& add(std::string_view text) {
        add(text.size());
        return bytes(text.data(), text.size());
    }
    /// Hashes the value of another key.
    Key& add(const Key& other) { return add(other.value()); }
    /// Hashes `size` raw bytes.
    Key& bytes(const void* data, std::size_t size) {
        const auto* p = static_cast<const unsigned char*>(data);
        while (size) {
            std::uint64_t bits = 0;
            const std::size_t n = size < 8 ? size : 8;
            std::memcpy(&bits, p, n);
            mix(bits);
            p += n;
            size -= n;
        }
        return *this;
    }
    /// Hashes a trivially copyable object without padding, such as a glm vector or matrix.
    template <typename T>
    requires(!std::is_arithmetic_v<T> && !std::is_enum_v<T> && std::is_trivially_copyable_v<T> &&
             !std::is_convertible_v<T, std::string_view>) Key& add(const T& value) {
        static_assert(sizeof(T) % 4 == 0);
        return bytes(&value, sizeof value);
    }
    /// Returns the hash of everything added so far; never 0.
    std::uint64_t value() const { return hash_ ? hash_ : 1; }

private:
    /// Mixes 64 bits into the running hash.
    void mix(std::uint64_t bits) { hash_ = splitmix64(hash_ ^ bits); }
    std::uint64_t hash_ = 0x243f6a8885a308d3ull;
};

}  // namespace si
