// Arrays of many megabytes whose elements are all written right after allocation.
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace si {

/// Allocator for BigArray: requests 2 MiB pages, which need 512 times fewer page faults, and leaves elements that
/// resize() adds uninitialised. The caller writes every new element, on the threads that use it.
template <typename T>
struct BigArrayAllocator {
    using value_type = T;
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

    BigArrayAllocator() = default;
    template <typename U>
    BigArrayAllocator(const BigArrayAllocator<U>&) {}

    T* allocate(std::size_t n) {
        const std::size_t bytes = n * sizeof(T);
        if (bytes < kLargePage) return static_cast<T*>(::operator new(bytes));
        void* p = ::operator new(bytes, std::align_val_t(kLargePage));
#if defined(__linux__)
        madvise(p, bytes, MADV_HUGEPAGE);  // only a hint: the result does not matter
#endif
        return static_cast<T*>(p);
    }
    void deallocate(T* p, std::size_t n) {
        if (n * sizeof(T) < kLargePage)
            ::operator delete(p);
        else
            ::operator delete(p, std::align_val_t(kLargePage));
    }
    void construct(T*) {}
    template <typename... A>
    requires(sizeof...(A) > 0) void construct(T* p, A&&... a) {
        ::new (static_cast<void*>(p)) T(std::forward<A>(a)...);
    }
    bool operator==(const BigArrayAllocator&) const = default;

private:
    static constexpr std::size_t kLargePage = std::size_t(2) << 20;
};

/// A std::vector for large plain data; resize() does not initialise the new elements.
template <typename T>
using BigArray = std::vector<T, BigArrayAllocator<T>>;

}  // namespace si
