// Errors, warnings, progress and cancellation, shared by all steps of loading one glTF file.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/gltf/gltf.h"

namespace si::gltf {

/// Position in the JSON of a glTF file, such as "meshes[3].primitives[0].attributes", for errors and warnings. Holds a
/// pointer to the position of the parent, so that only text() allocates memory.
struct Place {
    const Place* up = nullptr;
    std::string_view name;
    std::int64_t index = -1;

    Place(std::string_view name_) : name(name_) {}
    Place(std::string_view name_, std::integral auto index_) : name(name_), index(std::int64_t(index_)) {}
    Place(const Place& up_, std::string_view name_) : up(&up_), name(name_) {}
    Place(const Place& up_, std::string_view name_, std::integral auto index_)
        : up(&up_), name(name_), index(std::int64_t(index_)) {}
    /// Formats this position in a glTF file as text: "meshes[3].primitives[0]".
    std::string text() const;
};

/// Default advice of errors, for a file that violates the glTF format.
inline constexpr std::string_view kRepairHint = "repair the file or export it again";

/// State that all steps of loading one glTF file share: path, options, errors, warnings, progress, and the files read.
class Context {
public:
    Context(const std::filesystem::path& path, const GltfOptions& options, std::vector<std::string>& warnings);

    /// Throws Error "FILE: place: what; fix", one printable line.
    /// @param what the problem @param fix advice for the user
    [[noreturn]] void fail(const Place& place, std::string_view what, std::string_view fix = kRepairHint) const;
    /// Throws Error "FILE: what; fix" for a problem of the whole glTF file.
    [[noreturn]] void fail(std::string_view what, std::string_view fix) const;
    /// Records a warning about a position in the glTF file. After the first hundred, warnings are only counted.
    void warn(const Place& place, std::string_view what);
    /// Records a warning about the whole glTF file. After the first hundred, warnings are only counted.
    void warn(std::string_view what);
    /// Appends a last warning that states how many warnings were counted but not listed. Call once, after loading.
    void close_warnings();

    /// Reports loading progress, 0 to 1, to the caller's callback (GltfOptions::progress). The reported value never
    /// decreases.
    /// @throws Error "cancelled" when the callback returns false
    void progress(double fraction);

    /// Records a file that the scene is loaded from, with its time stamp, so that later changes of the file are
    /// noticed. Call before reading the file, even if it is missing.
    void note_file(const std::filesystem::path& path);
    /// Returns the files recorded by note_file(), and clears the record. Call once, after loading.
    std::vector<StampedFile> take_files() { return std::move(files_); }

    /// Returns the path of the glTF file.
    const std::filesystem::path& path() const { return path_; }
    /// Returns the options of load_gltf().
    const GltfOptions& options() const { return options_; }

private:
    std::filesystem::path path_;
    const GltfOptions& options_;
    std::vector<std::string>& warnings_;
    std::vector<StampedFile> files_;
    std::size_t not_kept_ = 0;
    double shown_ = 0;
};

}  // namespace si::gltf
