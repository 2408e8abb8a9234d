// Cache of the pixels in the umbra, which are in full shadow out to a kernel's reach (umbra_of()).
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

namespace si {

/// Cache of the pixels of a reference that lie in the umbra: the pixel and the surface around it, out to the kernel's
/// reach, are in full shadow. Holds the last few pairs of reach and map. Any thread may use it.
class UmbraCache {
public:
    /// State of one pixel: outside or inside the umbra, or not yet known.
    enum class State : std::uint8_t { Unknown, Outside, Inside };
    /// Returns the state of each pixel: inside or outside the umbra (full shadow out to the kernel's reach), or Unknown
    /// where no ray was traced yet.
    /// @param key hash of the kernel's reach and of the map
    /// @param pixels number of pixels of the reference
    std::vector<State> find(std::uint64_t key, std::size_t pixels) const;
    /// Stores the state of each pixel, inside or outside the umbra (full shadow out to the kernel's reach), for find().
    /// @param key as for find()
    void store(std::uint64_t key, std::vector<State> states);

private:
    static constexpr std::size_t kMaxReaches = 4;
    /// Cached umbra states of all pixels for one kernel reach and one map. A pixel is inside the umbra if the pixel and
    /// 8 points at the kernel's reach around it are in full shadow (umbra_of()).
    struct Known {
        std::uint64_t key = 0;
        std::vector<State> states;
    };
    mutable std::mutex lock_;
    std::vector<Known> known_;  ///< most recently stored last
};

}  // namespace si
