// Messages that a child process of run_foreign_job() sends to its parent through a socket.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace si::foreign {

/// Kinds of messages from a child.
enum class Message : std::uint8_t {
    Progress = 'p',  ///< one double, 0..1
    Answer = 'a',    ///< the last message: bytes of the answer
    Failure = 'e'    ///< the last message: an error sentence
};

/// Header of a message: its kind, and the bytes that follow.
struct MessageHeader {
    std::uint64_t bytes = 0;
    Message kind = Message::Failure;
};

inline constexpr std::size_t kMaxFailureBytes = 2000;
inline constexpr const char* kChildOption = "--foreign-job";  ///< hidden first argument of a child

/// Descriptors of a child: the socket, through which the request comes and messages go, and the readable folder.
inline constexpr int kSocket = 0, kFolder = 3;

/// Restricts the calling process for good: descriptors, memory, processor time, system calls, files.
/// @param folder true where the descriptor kFolder is a folder that stays readable
/// Returns false where the kernel offers no filter of system calls.
bool confine(std::size_t memory_bytes, int processor_s, bool folder);

}  // namespace si::foreign
