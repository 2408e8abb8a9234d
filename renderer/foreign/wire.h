// Messages that a child process of run_foreign_job() sends to its parent through a socket.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace si::foreign {

/// Kinds of messages that a child process sends to its parent.
enum class Message : std::uint8_t {
    Progress = 'p',  ///< one double, 0..1
    Answer = 'a',    ///< the last message: bytes of the answer
    Failure = 'e'    ///< the last message: an error sentence
};

/// Header of a message from a child process to its parent: kind of the message, and number of bytes that follow.
struct MessageHeader {
    Message kind = Message::Failure;
    std::uint64_t bytes = 0;
};
using PackedHeader = std::array<std::uint8_t, 1 + sizeof(std::uint64_t)>;  ///< bytes of a MessageHeader as sent

/// Converts a message header to the bytes that are sent.
inline PackedHeader pack(const MessageHeader& header) {
    PackedHeader out{std::uint8_t(header.kind)};
    std::memcpy(out.data() + 1, &header.bytes, sizeof header.bytes);
    return out;
}

/// Converts the bytes of a message header, as pack() returns them, back to the header.
inline MessageHeader unpack(const PackedHeader& packed) {
    MessageHeader out{Message(packed[0])};
    std::memcpy(&out.bytes, packed.data() + 1, sizeof out.bytes);
    return out;
}

inline constexpr std::size_t kMaxFailureBytes = 2000;
inline constexpr const char* kChildOption = "--foreign-job";  ///< hidden first argument of a child process

/// File descriptors of a child process: kSocket brings the request and takes the messages to the parent; kFolder is the
/// folder that stays readable.
inline constexpr int kSocket = 0, kFolder = 3;

/// Restricts the calling process for good, before it parses an untrusted file: its descriptors, memory, processor time,
/// system calls and files. Returns false where the kernel offers no filter of system calls (seccomp).
/// @param memory_bytes address space in addition to that in use
/// @param processor_s limit of processor time, seconds
/// @param folder true: the descriptor kFolder is a folder that stays readable
bool confine(std::size_t memory_bytes, int processor_s, bool folder);

}  // namespace si::foreign
