// Arrays of many megabytes whose elements are all written right after allocation.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace si {

/// Allocator for BigArray that leaves elements added by resize() uninitialised. The caller writes every new element, on
/// the threads that use it.
template <typename T>
struct BigArrayAllocator {
    using value_type = T;
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

    /// Makes an allocator; allocators have no state.
    BigArrayAllocator() = default;
    /// Makes an allocator from one of another element type.
    template <typename U>
    BigArrayAllocator(const BigArrayAllocator<U>&) {}

    /// Returns memory for n elements, uninitialised.
    T* allocate(std::size_t n) { return std::allocator<T>().allocate(n); }
    /// Frees memory from allocate().
    void deallocate(T* p, std::size_t n) { std::allocator<T>().deallocate(p, n); }
    /// Leaves an element uninitialised where std::vector would value-initialise it.
    void construct(T*) {}
    template <typename... A>
    requires(sizeof...(A) > 0) void construct(T* p, A&&... a) {
        ::new (static_cast<void*>(p)) T(std::forward<A>(a)...);
    }
    bool operator==(const BigArrayAllocator&) const = default;
};

/// A std::vector for large plain data; resize() does not initialise the new elements.
template <typename T>
using BigArray = std::vector<T, BigArrayAllocator<T>>;

}  // namespace si
