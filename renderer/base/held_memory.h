// Memory accounting: bytes of the process, and of its large owners (OpenGL images and buffers, scenes, ray hierarchies,
// references).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace si {

/// Entry in the process-wide accounting of memory, which memory_report() lists. An owner of much memory keeps an entry
/// as a member and states its bytes there. The entry itself allocates nothing. A copy of an entry counts the bytes
/// again. Usable from any thread.
class TrackedMemory {
public:
    TrackedMemory() = default;
    /// Counts `bytes` in the memory report under `holder`, until this object is destroyed.
    /// @param holder name in the memory report, a plural: "shadow maps"
    TrackedMemory(std::string_view holder, std::uint64_t bytes);
    ~TrackedMemory() { drop(); }
    TrackedMemory(const TrackedMemory& other);
    TrackedMemory(TrackedMemory&& other) noexcept;
    TrackedMemory& operator=(TrackedMemory other) noexcept;

    /// Adds bytes to this entry of the memory accounting, when its owner allocates more. An empty entry (made without
    /// arguments, or dropped) ignores the call.
    /// @param bytes below 0: subtracts
    void add(std::int64_t bytes);
    /// Returns the bytes that this entry counts at present.
    std::uint64_t bytes() const { return bytes_; }
    /// Removes this entry from the memory accounting, after its owner has freed the memory.
    void drop();

private:
    friend struct MemoryLedger;
    struct MemoryLedgerRow* row_ = nullptr;
    std::uint64_t bytes_ = 0;
};

/// Line of the memory report: bytes that all owners of one kind, such as "shadow maps", hold now and have held at most.
struct MemoryUse {
    std::string holder;
    std::uint64_t bytes = 0, most = 0;  ///< now, and the peak so far
    std::size_t count = 0;              ///< number of TrackedMemory entries
};

/// Memory of the whole process in bytes, as the system reports it. 0: unknown on this system.
struct ProcessMemory {
    std::uint64_t resident = 0, peak = 0;   ///< physical memory now, and its peak
    std::uint64_t heap = 0, heap_free = 0;  ///< allocated by malloc(), and freed but kept by malloc()
};

/// Memory of the process, and of each kind of owner in the program (TrackedMemory), at one time.
struct MemoryReport {
    ProcessMemory process;
    std::vector<MemoryUse> holders;  ///< the largest first
    /// Returns the sum of the bytes that all owners in this memory report hold.
    std::uint64_t held() const;
};

/// Returns a report of the memory that the process and each kind of owner (TrackedMemory) hold now.
MemoryReport memory_report();
/// Returns resident, peak and heap bytes of this process now.
ProcessMemory process_memory();
/// Returns the bytes that this process can still get: free memory of the machine, within the limits of its control
/// group and of the process. 0: unknown on this system.
std::uint64_t available_memory();
/// Gives heap pages that are free, but kept by malloc(), back to the system (malloc_trim). Call after a large scene was
/// closed or a sweep ended: it takes some ten milliseconds. Does nothing where the C library has no such function.
void trim_heap();
/// Formats a number of bytes for people: "2.5 MiB".
std::string bytes_text(std::uint64_t bytes);

/// Returns the bytes that the elements of a container take.
template <typename T>
std::uint64_t array_bytes(const T& array) {
    return array.size() * sizeof(typename T::value_type);
}

}  // namespace si
