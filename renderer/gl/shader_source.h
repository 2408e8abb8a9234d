// GLSL sources: embedded in the binary, or read from the source tree and watched (development builds).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace si::gl {

/// Files by name in `#include NAME`, e.g. FILTER_FILE -> "filters/pcf.glsl".
using IncludeNames = std::map<std::string, std::string, std::less<>>;

/// Registers a GLSL text under `path` below shaders/, for techniques that are not built in. Every ShaderSource made
/// afterwards knows it.
void add_shader_text(std::string path, std::string text);

/// GLSL files below shaders/, with include expansion and, in development builds, detection of saved files.
class ShaderSource {
public:
    /// Loads the GLSL files. @param tree a source tree whose shaders/ is read and watched; empty: the embedded texts
    /// alone
    explicit ShaderSource(std::filesystem::path tree = default_tree());
    /// Returns the text of a file below shaders/ with its includes expanded, each file once and with #line marks.
    /// @param names files behind names in `#include NAME`
    /// @param files receives the paths in the order of their #line numbers
    /// @throws Error naming file, line and the missing include.
    std::string expand(std::string_view path, const IncludeNames& names, std::vector<std::string>& files) const;
    /// Returns a counter that grows whenever poll() finds a saved file. Constant when nothing is watched.
    std::uint64_t generation() const { return generation_; }
    /// Reads watched GLSL files that were saved since the last call. Returns true when there were any.
    bool poll();

    /// Returns the source tree that development builds watch; empty in other builds.
    static std::filesystem::path default_tree();

private:
    std::filesystem::path tree_;
    std::map<std::string, std::string, std::less<>> texts_;
    std::map<std::string, std::int64_t, std::less<>> times_;
    std::uint64_t generation_ = 1;
    /// Reads all GLSL files of the source tree, with their times of change.
    void read_tree();
};

/// Returns true when `text` contains `identifier` as a whole word.
bool mentions(std::string_view text, std::string_view identifier);

}  // namespace si::gl
