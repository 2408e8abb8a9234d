// Cache keys: a 64-bit hash of everything a result depends on.
#pragma once

#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <vector>

namespace si {

/// Accumulates values into a key. Never 0, which stands for "undefined contents".
class Key {
public:
    template <typename T>
    requires std::is_arithmetic_v<T> || std::is_enum_v<T> Key& add(T value) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &value, sizeof value);
        mix(bits);
        return *this;
    }
    Key& add(std::string_view text) {
        add(text.size());
        return bytes(text.data(), text.size());
    }
    Key& add(const Key& other) { return add(other.value()); }
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
    /// glm vectors and matrices, and vectors of plain values.
    template <typename T>
    requires(!std::is_arithmetic_v<T> && !std::is_enum_v<T> && std::is_trivially_copyable_v<T> &&
             !std::is_convertible_v<T, std::string_view>) Key& add(const T& value) {
        static_assert(sizeof(T) % 4 == 0);
        return bytes(&value, sizeof value);
    }
    std::uint64_t value() const { return hash_ ? hash_ : 1; }

private:
    /// The finaliser of splitmix64 (Steele, Lea, Flood, OOPSLA 2014) over a running value.
    void mix(std::uint64_t bits) {
        std::uint64_t z = (hash_ ^ bits) + 0x9e3779b97f4a7c15ull;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        hash_ = z ^ (z >> 31);
    }
    std::uint64_t hash_ = 0x243f6a8885a308d3ull;
};

}  // namespace si
