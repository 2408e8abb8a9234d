// A copy-on-write array: copies of a scene, and the ray-traced reference, share geometry and pictures.
#pragma once

#include <atomic>
#include <initializer_list>
#include <memory>
#include <mutex>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/base/held_memory.h"

namespace si {

/// Array with copy-on-write storage: copies share memory until edit() changes one. It reads like a const std::vector.
/// Different threads may use different copies; one copy is used by one thread at a time.
template <typename T>
class SharedArray {
public:
    using value_type = T;

    SharedArray() = default;
    SharedArray(std::vector<T> elements) : block_(std::make_shared<Block>(std::move(elements))) {}
    SharedArray(std::initializer_list<T> elements) : SharedArray(std::vector<T>(elements)) {}
    SharedArray(const SharedArray&) = default;
    SharedArray(SharedArray&& other) noexcept : block_(std::exchange(other.block_, none())) {}
    SharedArray& operator=(const SharedArray&) = default;
    SharedArray& operator=(SharedArray&& other) noexcept {
        if (this != &other) block_ = std::exchange(other.block_, none());
        return *this;
    }
    ~SharedArray() = default;

    /// Returns the elements as a std::vector.
    const std::vector<T>& all() const { return block_->elements; }
    operator const std::vector<T>&() const { return all(); }
    std::size_t size() const { return all().size(); }
    bool empty() const { return all().empty(); }
    const T* data() const { return all().data(); }
    const T& operator[](std::size_t i) const { return all()[i]; }
    const T& front() const { return all().front(); }
    const T& back() const { return all().back(); }
    auto begin() const { return all().begin(); }
    auto end() const { return all().end(); }
    bool operator==(const SharedArray& other) const { return block_ == other.block_ || all() == other.all(); }
    /// Returns true when both arrays share one block of memory; equal contents alone do not count.
    bool shares_storage_with(const SharedArray& other) const { return block_ == other.block_; }

    /// Returns the elements for writing; storage shared with copies is cloned first. The reference is valid until this
    /// array is copied.
    std::vector<T>& edit() {
        if (block_.use_count() > 1) block_ = std::make_shared<Block>(all());
        std::atomic_thread_fence(std::memory_order_acquire);  // orders this write after reads of copies that are gone
        return block_->elements;
    }
    void push_back(const T& element) { edit().push_back(element); }
    template <typename... Arguments>
    T& emplace_back(Arguments&&... arguments) {
        return edit().emplace_back(std::forward<Arguments>(arguments)...);
    }
    /// Appends the elements of `range`.
    template <typename Range>
    void append(const Range& range) {
        std::vector<T>& to = edit();
        to.insert(to.end(), std::begin(range), std::end(range));
    }
    void append(std::initializer_list<T> elements) { append<std::initializer_list<T>>(elements); }
    void assign(std::size_t count, const T& element) { *this = std::vector<T>(count, element); }
    /// Replaces all elements; reuses the memory where no copy shares it.
    void assign(const std::vector<T>& elements) {
        if (block_.use_count() > 1)
            *this = std::vector<T>(elements);
        else
            edit() = elements;
    }
    void resize(std::size_t count) { edit().resize(count); }
    void reserve(std::size_t count) { edit().reserve(count); }
    void clear() { *this = SharedArray(); }

    /// Counts the bytes of this array in the memory report from now on. Copies that share the memory are counted once.
    /// @param holder name in the memory report, a plural: "textures"
    void track_memory(std::string_view holder) {
        static std::mutex mutex;  // copies that share the block may be on other threads
        const std::lock_guard lock(mutex);
        if (block_->held.bytes() != array_bytes(*this)) block_->held = TrackedMemory(holder, array_bytes(*this));
    }

private:
    /// Storage shared by the copies of one array: the elements, and their entry in the memory report.
    struct Block {
        explicit Block(std::vector<T> of) : elements(std::move(of)) {}
        std::vector<T> elements;
        TrackedMemory held;
    };
    /// Returns the memory block that all empty arrays share.
    static const std::shared_ptr<Block>& none() {
        static const std::shared_ptr<Block> block = std::make_shared<Block>(std::vector<T>());
        return block;
    }
    std::shared_ptr<Block> block_ = none();
};

}  // namespace si
