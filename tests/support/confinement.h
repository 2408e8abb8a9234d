// Restricts the file access of a child process to one folder.
#pragma once

#include <filesystem>
#include <optional>

namespace si::test {

/// Set of kernel rules (Landlock, Linux 5.13 and later) that forbid writing outside one folder. A parent creates the
/// rules before fork(), and the child applies them.
class Confinement {
public:
    /// Creates rules that forbid changes to files outside `folder`, except devices.
    /// @returns nothing where the kernel lacks Landlock
    static std::optional<Confinement> for_folder(const std::filesystem::path& folder);
    ~Confinement();
    Confinement(Confinement&& other) noexcept;
    Confinement(const Confinement&) = delete;
    Confinement& operator=(const Confinement&) = delete;
    Confinement& operator=(Confinement&& other) noexcept;

    /// Applies the rules to the calling process and its children. A forked child calls it before exec().
    /// @returns false if the kernel refused
    bool apply_to_this_process() const;

private:
    explicit Confinement(int rules) : rules_(rules) {}
    int rules_ = -1;  ///< file descriptor of the rules; -1: none
};

}  // namespace si::test
