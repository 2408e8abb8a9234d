// Memory of the pixels in full shadow at a kernel's reach (umbra_of()).
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

namespace si {

/// Umbra of one reference, as far as it is traced, for the last few reaches and maps. Any thread may use it.
class UmbraCache {
public:
    /// Pixel of the umbra's image.
    enum class State : std::uint8_t { Unknown, Outside, Inside };
    /// Returns the known states of all pixels under `key`, Unknown where not traced.
    std::vector<State> find(std::uint64_t key, std::size_t pixels) const;
    /// Stores the umbra states (lit, umbra, penumbra) of all pixels under `key`.
    void store(std::uint64_t key, std::vector<State> states);

private:
    static constexpr std::size_t kMaxReaches = 4;
    /// Umbra states (lit, umbra, penumbra) of all pixels, computed for one kernel reach and one map.
    struct Known {
        std::uint64_t key = 0;
        std::vector<State> states;
    };
    mutable std::mutex lock_;
    std::vector<Known> known_;  ///< latest last
};

}  // namespace si
