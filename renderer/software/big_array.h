// Arrays of many megabytes that are written whole right after they are made.
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

/// Asks the system for large pages, which are there 512 times as soon, and leaves elements that resize() adds as the
/// memory is: whoever adds them writes all of them, on the threads that do.
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
        madvise(p, bytes, MADV_HUGEPAGE);  // a wish: small pages do as well
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

template <typename T>
using BigArray = std::vector<T, BigArrayAllocator<T>>;

}  // namespace si
