// GLSL sources: embedded in the binary, or read from the tree and watched (development builds).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace si::gl {

/// Names that stand for a file in `#include NAME`, e.g. FILTER_FILE -> "filters/pcf.glsl".
using IncludeNames = std::map<std::string, std::string, std::less<>>;

/// Adds a text that every ShaderSource made from then on knows as `path` below shaders/, for what is not built in.
void add_shader_text(std::string path, std::string text);

class ShaderSource {
public:
    /// @param tree a source tree whose shaders/ is read and watched; empty: the embedded texts alone. Development
    /// builds watch their own tree.
    explicit ShaderSource(std::filesystem::path tree = default_tree());
    /// The text of a file below shaders/ with its includes expanded (each file once, with #line marks).
    /// `files` receives the paths in the order of their #line numbers.
    /// @throws Error naming file, line and the missing include.
    std::string expand(std::string_view path, const IncludeNames& names, std::vector<std::string>& files) const;
    /// Rises whenever a watched file was saved. Constant when nothing is watched.
    std::uint64_t generation() const { return generation_; }
    /// Looks at the watched files; true when the generation rose.
    bool poll();

    static std::filesystem::path default_tree();

private:
    std::filesystem::path tree_;
    std::map<std::string, std::string, std::less<>> texts_;
    std::map<std::string, std::int64_t, std::less<>> times_;
    std::uint64_t generation_ = 1;
    void read_tree();
};

/// True when `text` mentions `identifier` as a whole word.
bool mentions(std::string_view text, std::string_view identifier);

}  // namespace si::gl
