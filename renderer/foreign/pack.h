// Packing of numbers and bytes into requests and answers of child processes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/base/error.h"

namespace si {

/// Writer of a message between parent and child process: whole numbers and byte blocks, each block at a multiple of
/// four bytes.
class PackWriter {
public:
    /// Appends a number to the message, in eight bytes.
    void number(std::uint64_t value) {
        const auto* at = reinterpret_cast<const std::uint8_t*>(&value);
        bytes_.insert(bytes_.end(), at, at + sizeof value);
    }
    /// Appends a block of bytes to the message: its size, then its bytes.
    void block(std::span<const std::uint8_t> bytes) {
        number(bytes.size());
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
    }
    void block(std::string_view text) { block({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}); }
    /// Returns the bytes of the message written so far. The caller may move them away once the message is complete.
    std::vector<std::uint8_t>& bytes() { return bytes_; }

private:
    std::vector<std::uint8_t> bytes_;
};

/// Reader of messages from an untrusted child process, as PackWriter writes them. Every call throws Error if the bytes
/// end early.
class PackReader {
public:
    explicit PackReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
    /// Returns the next number of the message.
    std::uint64_t number() {
        std::uint64_t value = 0;
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    }
    /// Returns the next block of bytes of the message, as a view into the message.
    std::span<const std::uint8_t> block() {
        const std::uint64_t size = number();
        if (size > bytes_.size() - at_) fail();
        const auto out = take(std::size_t(size));
        at_ = std::min(bytes_.size(), (at_ + 3) / 4 * 4);
        return out;
    }
    /// Returns the next block of the message as text, as a view into the message.
    std::string_view text() {
        const auto bytes = block();
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
    /// Returns true if all bytes of the message were read.
    bool at_end() const { return at_ == bytes_.size(); }

private:
    [[noreturn]] static void fail() { throw Error("the answer of a decoder is cut"); }
    std::span<const std::uint8_t> take(std::size_t size) {
        if (size > bytes_.size() - at_) fail();
        at_ += size;
        return bytes_.subspan(at_ - size, size);
    }

    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
};

}  // namespace si
