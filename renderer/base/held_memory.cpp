#include "renderer/base/held_memory.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <mutex>
#include <utility>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace si {

struct MemoryLedgerRow {
    std::uint64_t bytes = 0, most = 0;
    std::size_t count = 0;
};

/// Bytes by holder for the whole process. Never destroyed, as objects with static storage may still use it at exit.
struct MemoryLedger {
    std::mutex mutex;
    std::map<std::string, MemoryLedgerRow, std::less<>> rows;

    static MemoryLedger& get() {
        static auto* ledger = new MemoryLedger;
        return *ledger;
    }
    void take(TrackedMemory& held, MemoryLedgerRow* row, std::uint64_t bytes) {
        const std::lock_guard lock(mutex);
        held.row_ = row;
        if (!row) return;
        ++row->count;
        change(held, std::int64_t(bytes));
    }
    static void change(TrackedMemory& held, std::int64_t by) {
        held.bytes_ += std::uint64_t(by);
        held.row_->bytes += std::uint64_t(by);
        held.row_->most = std::max(held.row_->most, held.row_->bytes);
    }
    MemoryLedgerRow* row(std::string_view holder) {
        const std::lock_guard lock(mutex);
        const auto known = rows.find(holder);
        return known != rows.end() ? &known->second : &rows[std::string(holder)];
    }
};

TrackedMemory::TrackedMemory(std::string_view holder, std::uint64_t bytes) {
    MemoryLedger& ledger = MemoryLedger::get();
    ledger.take(*this, ledger.row(holder), bytes);
}

TrackedMemory::TrackedMemory(const TrackedMemory& other) {
    MemoryLedger::get().take(*this, other.row_, other.bytes_);
}

TrackedMemory::TrackedMemory(TrackedMemory&& other) noexcept
    : row_(std::exchange(other.row_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}

TrackedMemory& TrackedMemory::operator=(TrackedMemory other) noexcept {
    std::swap(row_, other.row_);
    std::swap(bytes_, other.bytes_);
    return *this;
}

void TrackedMemory::add(std::int64_t bytes) {
    if (!row_) return;
    const std::lock_guard lock(MemoryLedger::get().mutex);
    MemoryLedger::change(*this, bytes);
}

void TrackedMemory::drop() {
    if (!row_) return;
    const std::lock_guard lock(MemoryLedger::get().mutex);
    row_->bytes -= bytes_;
    --row_->count;
    row_ = nullptr;
    bytes_ = 0;
}

std::uint64_t MemoryReport::held() const {
    std::uint64_t sum = 0;
    for (const MemoryUse& h : holders) sum += h.bytes;
    return sum;
}

ProcessMemory process_memory() {
    ProcessMemory out;
    // proc(5): "VmRSS:    1234 kB"
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        std::uint64_t* to = line.starts_with("VmRSS:")   ? &out.resident
                            : line.starts_with("VmHWM:") ? &out.peak
                                                         : nullptr;
        if (to) *to = std::stoull(line.substr(6)) * 1024;
    }
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
    const struct mallinfo2 info = mallinfo2();
    out.heap = info.uordblks + info.hblkhd;
    out.heap_free = info.fordblks;
#endif
    return out;
}

std::uint64_t available_memory() {
    std::uint64_t least = 0;
    const auto limit = [&](std::uint64_t bytes) {
        if (bytes > 0 && (least == 0 || bytes < least)) least = bytes;
    };
    // proc(5): "MemAvailable:    1234 kB"
    std::ifstream machine("/proc/meminfo");
    for (std::string line; std::getline(machine, line);)
        if (line.starts_with("MemAvailable:")) limit(std::stoull(line.substr(13)) * 1024);
    std::uint64_t group = 0, group_used = 0;  // "max" is no number: there is no limit
    if (std::ifstream("/sys/fs/cgroup/memory.max") >> group)
        if (std::ifstream("/sys/fs/cgroup/memory.current") >> group_used)
            limit(group > group_used ? group - group_used : 1);
    rlimit space{};
    std::uint64_t pages = 0;
    if (::getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY)
        if (std::ifstream("/proc/self/statm") >> pages) {
            const std::uint64_t used = pages * std::uint64_t(::sysconf(_SC_PAGESIZE));
            limit(space.rlim_cur > used ? space.rlim_cur - used : 1);
        }
    return least;
}

void trim_heap() {
#if defined(__GLIBC__)
    malloc_trim(0);
#endif
}

MemoryReport memory_report() {
    MemoryReport facts{.process = process_memory(), .holders = {}};
    MemoryLedger& ledger = MemoryLedger::get();
    {
        const std::lock_guard lock(ledger.mutex);
        for (const auto& [holder, row] : ledger.rows) facts.holders.push_back({holder, row.bytes, row.most, row.count});
    }
    std::stable_sort(facts.holders.begin(), facts.holders.end(),
                     [](const MemoryUse& a, const MemoryUse& b) { return a.bytes > b.bytes; });
    return facts;
}

std::string bytes_text(std::uint64_t bytes) {
    const double mib = double(bytes) / (1 << 20);
    return bytes < (10u << 10)   ? fmt::format("{} bytes", bytes)
           : bytes < (1u << 20)  ? fmt::format("{:.0f} KiB", mib * 1024)
           : bytes < (10u << 20) ? fmt::format("{:.1f} MiB", mib)
                                 : fmt::format("{:.0f} MiB", mib);
}

}  // namespace si
