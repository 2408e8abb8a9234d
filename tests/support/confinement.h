// Keeps a child process from changing anything but what is below one folder.
#pragma once

#include <filesystem>
#include <optional>

namespace si::test {

/// Rules of the kernel (Landlock, Linux 5.13 and later), made before a fork and put in force after it.
class Confinement {
public:
    /// What is not below `folder` stays as it is, but for devices. Nothing where the kernel has no such rules.
    static std::optional<Confinement> to(const std::filesystem::path& folder);
    ~Confinement();
    Confinement(Confinement&& other) noexcept;
    Confinement(const Confinement&) = delete;
    Confinement& operator=(const Confinement&) = delete;
    Confinement& operator=(Confinement&& other) noexcept;

    /// In a child, before it becomes another program. Returns whether it is so from now on.
    bool apply_to_this_process() const;

private:
    explicit Confinement(int rules) : rules_(rules) {}
    int rules_ = -1;
};

}  // namespace si::test
