// An array that its copies share until one of them is changed: copies of a scene, and the triangles that rays meet,
// hold geometry and pictures once.
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

/// Reads like a const std::vector; whatever changes it has a name of its own. Copies may be read and changed by
/// different threads, one of them by one thread at a time.
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
    /// Whether both are one in memory.
    bool shares(const SharedArray& other) const { return block_ == other.block_; }

    /// To be changed, apart from all copies. Ends with the next copy of this array.
    std::vector<T>& edit() {
        if (block_.use_count() > 1) block_ = std::make_shared<Block>(all());
        std::atomic_thread_fence(std::memory_order_acquire);  // what those that let go of it had read
        return block_->elements;
    }
    void push_back(const T& element) { edit().push_back(element); }
    template <typename... Arguments>
    T& emplace_back(Arguments&&... arguments) {
        return edit().emplace_back(std::forward<Arguments>(arguments)...);
    }
    /// At the end.
    template <typename Range>
    void append(const Range& range) {
        std::vector<T>& to = edit();
        to.insert(to.end(), std::begin(range), std::end(range));
    }
    void append(std::initializer_list<T> elements) { append<std::initializer_list<T>>(elements); }
    void assign(std::size_t count, const T& element) { *this = std::vector<T>(count, element); }
    /// In the room that is there where nobody shares it.
    void assign(const std::vector<T>& elements) {
        if (block_.use_count() > 1)
            *this = std::vector<T>(elements);
        else
            edit() = elements;
    }
    void resize(std::size_t count) { edit().resize(count); }
    void reserve(std::size_t count) { edit().reserve(count); }
    void clear() { *this = SharedArray(); }

    /// From now on its bytes are told of once, however many share it. @param holder see HeldMemory
    void tell(std::string_view holder) {
        static std::mutex telling;  // others may tell of the same one
        const std::lock_guard lock(telling);
        if (block_->held.bytes() != array_bytes(*this)) block_->held = HeldMemory(holder, array_bytes(*this));
    }

private:
    struct Block {
        explicit Block(std::vector<T> of) : elements(std::move(of)) {}
        std::vector<T> elements;
        HeldMemory held;
    };
    static const std::shared_ptr<Block>& none() {
        static const std::shared_ptr<Block> block = std::make_shared<Block>(std::vector<T>());
        return block;
    }
    std::shared_ptr<Block> block_ = none();
};

}  // namespace si
