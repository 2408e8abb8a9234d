// What memory this process has, and who holds it: images and buffers of OpenGL, scenes, hierarchies of rays, truths.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace si {

/// Some bytes that somebody holds, told of as long as this lives; a copy holds as much again. Any thread.
class HeldMemory {
public:
    HeldMemory() = default;
    /// @param holder in the plural, as people are told: "shadow maps"
    HeldMemory(std::string_view holder, std::uint64_t bytes);
    ~HeldMemory() { drop(); }
    HeldMemory(const HeldMemory& other);
    HeldMemory(HeldMemory&& other) noexcept;
    HeldMemory& operator=(const HeldMemory& other);
    HeldMemory& operator=(HeldMemory&& other) noexcept;

    /// Holds so many more, or, below 0, fewer. Of nobody nothing is told.
    void add(std::int64_t bytes);
    std::uint64_t bytes() const { return bytes_; }
    void drop();

private:
    friend struct HeldLedger;
    struct HeldRow* row_ = nullptr;
    std::uint64_t bytes_ = 0;
};

/// Of one holder.
struct HeldBytes {
    std::string holder;
    std::uint64_t bytes = 0, most = 0;  ///< now, and at most so far
    std::size_t count = 0;              ///< of things
};

/// Of the whole process, bytes. 0: not known on this system.
struct ProcessMemory {
    std::uint64_t resident = 0, peak = 0;
    std::uint64_t heap = 0, heap_free = 0;  ///< that malloc() has handed out, and keeps for what comes
};

struct MemoryFacts {
    ProcessMemory process;
    std::vector<HeldBytes> holders;  ///< that ever held something, the largest first
    /// Bytes of all holders.
    std::uint64_t held() const;
};

MemoryFacts memory_facts();
ProcessMemory process_memory();
/// Gives the system the pages back that malloc() keeps of what was freed: of a large scene that was closed, of a sweep
/// that ended. Takes some ten milliseconds. Nothing where the C library knows no such thing.
void give_back_free_pages();
/// Bytes in words, "12.5 MiB".
std::string bytes_text(std::uint64_t bytes);

/// Bytes of an array's elements.
template <typename T>
std::uint64_t array_bytes(const T& array) {
    return array.size() * sizeof(typename T::value_type);
}

}  // namespace si
