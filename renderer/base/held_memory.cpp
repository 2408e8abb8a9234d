#include "renderer/base/held_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <mutex>
#include <utility>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace si {

struct HeldRow {
    std::uint64_t bytes = 0, most = 0;
    std::size_t count = 0;
};

/// Outlives all that static storage holds: never destroyed.
struct HeldLedger {
    std::mutex mutex;
    std::map<std::string, HeldRow, std::less<>> rows;

    static HeldLedger& get() {
        static auto* ledger = new HeldLedger;
        return *ledger;
    }
    void take(HeldMemory& held, HeldRow* row, std::uint64_t bytes) {
        const std::lock_guard lock(mutex);
        held.row_ = row;
        if (!row) return;
        ++row->count;
        change(held, std::int64_t(bytes));
    }
    static void change(HeldMemory& held, std::int64_t by) {
        held.bytes_ += std::uint64_t(by);
        held.row_->bytes += std::uint64_t(by);
        held.row_->most = std::max(held.row_->most, held.row_->bytes);
    }
    HeldRow* row(std::string_view holder) {
        const std::lock_guard lock(mutex);
        const auto known = rows.find(holder);
        return known != rows.end() ? &known->second : &rows[std::string(holder)];
    }
};

HeldMemory::HeldMemory(std::string_view holder, std::uint64_t bytes) {
    HeldLedger& ledger = HeldLedger::get();
    ledger.take(*this, ledger.row(holder), bytes);
}

HeldMemory::HeldMemory(const HeldMemory& other) {
    HeldLedger::get().take(*this, other.row_, other.bytes_);
}

HeldMemory::HeldMemory(HeldMemory&& other) noexcept
    : row_(std::exchange(other.row_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}

HeldMemory& HeldMemory::operator=(const HeldMemory& other) {
    if (this != &other) *this = HeldMemory(other);
    return *this;
}

HeldMemory& HeldMemory::operator=(HeldMemory&& other) noexcept {
    if (this != &other) {
        drop();
        row_ = std::exchange(other.row_, nullptr);
        bytes_ = std::exchange(other.bytes_, 0);
    }
    return *this;
}

void HeldMemory::add(std::int64_t bytes) {
    if (!row_) return;
    const std::lock_guard lock(HeldLedger::get().mutex);
    HeldLedger::change(*this, bytes);
}

void HeldMemory::drop() {
    if (!row_) return;
    const std::lock_guard lock(HeldLedger::get().mutex);
    row_->bytes -= bytes_;
    --row_->count;
    row_ = nullptr;
    bytes_ = 0;
}

std::uint64_t MemoryFacts::held() const {
    std::uint64_t sum = 0;
    for (const HeldBytes& h : holders) sum += h.bytes;
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

void give_back_free_pages() {
#if defined(__GLIBC__)
    malloc_trim(0);
#endif
}

MemoryFacts memory_facts() {
    MemoryFacts facts{.process = process_memory(), .holders = {}};
    HeldLedger& ledger = HeldLedger::get();
    {
        const std::lock_guard lock(ledger.mutex);
        for (const auto& [holder, row] : ledger.rows) facts.holders.push_back({holder, row.bytes, row.most, row.count});
    }
    std::stable_sort(facts.holders.begin(), facts.holders.end(),
                     [](const HeldBytes& a, const HeldBytes& b) { return a.bytes > b.bytes; });
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
