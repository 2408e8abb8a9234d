// Parts of a GLB while an importer collects them: JSON and binary chunk.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

namespace si {

/// Builder of a GLB file in memory. An importer adds buffer views and accessors, and fills the JSON `root` with
/// everything that refers to them.
class GlbWriter {
public:
    nlohmann::json root = {{"asset", {{"version", "2.0"}}}};  ///< JSON of the file

    /// Appends bytes to the GLB as a buffer view. Returns its index. @throws Error beyond 4 GiB
    int add_view(std::span<const std::uint8_t> bytes);
    /// Appends vectors of 32-bit floats to the GLB as an accessor. Returns its index. Used to convert models that
    /// Assimp reads.
    /// @param width numbers per vector, 2 to 4
    /// @param with_bounds true: also writes the least and greatest component values, as positions need them
    int add_floats(std::span<const float> values, int width, bool with_bounds = false);
    /// Appends the indices of a triangle list to the GLB as an accessor. Returns its index.
    int add_indices(std::span<const std::uint32_t> indices);
    /// Appends an object to a top-level array of the GLB's JSON. Returns its index.
    /// @param list name of the array: "nodes", "meshes", ...
    int append(const char* list, nlohmann::json object);
    /// Returns the whole GLB file. Invalid UTF-8 in its texts is replaced. @throws Error beyond 4 GiB
    std::vector<std::uint8_t> bytes();

private:
    std::vector<std::uint8_t> binary_;
};

}  // namespace si
