// What every step of loading one glTF file shares: how to refuse, warn, report progress and be cancelled.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/gltf/gltf.h"

namespace si::gltf {

/// A position in the JSON, "meshes[3].primitives[0].attributes"; costs nothing until text() is asked for.
struct Place {
    const Place* up = nullptr;
    std::string_view name;
    std::int64_t index = -1;

    Place(std::string_view name_, std::int64_t index_ = -1) : name(name_), index(index_) {}
    Place(const Place& up_, std::string_view name_, std::int64_t index_ = -1) : up(&up_), name(name_), index(index_) {}
    std::string text() const;
};

/// The remedy where a file breaks the format.
inline constexpr std::string_view kRepair = "repair the file or export it again";

class Context {
public:
    Context(const std::filesystem::path& path, const GltfOptions& options, std::vector<std::string>& warnings);

    /// @throws Error "FILE: place: what; remedy", one line, made printable.
    [[noreturn]] void fail(const Place& place, std::string_view what, std::string_view fix) const;
    [[noreturn]] void fail(std::string_view what, std::string_view fix) const;
    /// Keeps the first hundred warnings and counts the others.
    void warn(const Place& place, std::string_view what);
    void warn(std::string_view what);
    /// Appends the count of warnings not kept; once, at the end.
    void close_warnings();

    /// Never falls, whatever order the steps report in. @throws Error "cancelled" when the callback returns false.
    void progress(double fraction);

    const std::filesystem::path& path() const { return path_; }
    const GltfOptions& options() const { return options_; }

private:
    std::filesystem::path path_;
    const GltfOptions& options_;
    std::vector<std::string>& warnings_;
    std::size_t not_kept_ = 0;
    double shown_ = 0;
};

}  // namespace si::gltf
