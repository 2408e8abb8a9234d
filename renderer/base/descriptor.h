// Owner of a POSIX file descriptor.
#pragma once

#include <unistd.h>

#include <utility>

namespace si {

/// Owner of a POSIX file descriptor, which the destructor closes. `fd` is -1 when there is no descriptor.
struct Descriptor {
    int fd = -1;
    Descriptor() = default;
    explicit Descriptor(int fd_) : fd(fd_) {}
    Descriptor(Descriptor&& other) noexcept : fd(std::exchange(other.fd, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(fd, other.fd);
        return *this;
    }
    ~Descriptor() { close(); }
    /// Closes the descriptor now.
    void close() {
        if (fd >= 0) ::close(fd);
        fd = -1;
    }
};

}  // namespace si
