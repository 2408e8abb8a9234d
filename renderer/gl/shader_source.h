// GLSL sources: embedded in the binary, or read from the source tree and watched (development builds).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace si::gl {

/// Map from a name in `#include NAME` to the included file, e.g. FILTER_FILE -> "filters/pcf.glsl".
using IncludeNames = std::map<std::string, std::string, std::less<>>;

/// Registers a GLSL text under a path below shaders/, for shadow techniques that are not built in. Every ShaderSource
/// created afterwards finds the text.
/// @param path path below shaders/, by which #include refers to the text
void add_shader_text(std::string path, std::string text);

/// Loader of the GLSL files below shaders/. Expands includes and, in development builds, notices saved files.
class ShaderSource {
public:
    /// Loads the GLSL files.
    /// @param tree source tree whose shaders/ folder is read and watched for saved files; empty: only the texts
    /// embedded in the program
    explicit ShaderSource(std::filesystem::path tree = default_tree());
    /// Returns the text of a GLSL file below shaders/ with its includes expanded, each file once and with #line marks.
    /// @param names file for each name in `#include NAME`
    /// @param files receives the paths in the order of their #line numbers
    /// @throws Error naming file, line and the missing include.
    std::string expand(std::string_view path, const IncludeNames& names, std::vector<std::string>& files) const;
    /// Returns a counter that grows whenever poll() finds a saved shader file. Constant when no folder is watched.
    std::uint64_t generation() const { return generation_; }
    /// Reads again the GLSL files that were saved since the last call (development builds). Returns true if any was
    /// read.
    bool poll();

    /// Returns the source tree whose shader files development builds watch; empty in other builds.
    static std::filesystem::path default_tree();

private:
    std::filesystem::path tree_;
    std::map<std::string, std::string, std::less<>> texts_;
    std::map<std::string, std::int64_t, std::less<>> times_;
    std::uint64_t generation_ = 1;
    /// Reads the GLSL files of the source tree whose modification times changed since the last call.
    void read_tree();
};

/// Returns true when a GLSL text contains `identifier` as a whole word. Used to leave out defines that a shader does
/// not use.
bool mentions(std::string_view text, std::string_view identifier);

}  // namespace si::gl
