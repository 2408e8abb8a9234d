// Parts of a GLB while an importer collects them: JSON and binary chunk.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

namespace si {

/// GLB in the making: an importer adds views and accessors, and fills `root` with all that refers to them.
class GlbWriter {
public:
    nlohmann::json root = {{"asset", {{"version", "2.0"}}}};  ///< JSON of the file

    /// Appends bytes as a buffer view. Returns its index. @throws Error beyond 4 GiB
    int add_view(std::span<const std::uint8_t> bytes);
    /// Appends vectors of 32-bit floats as an accessor. Returns its index.
    /// @param width numbers per vector, 2 to 4 @param with_bounds true: writes least and greatest vector (positions)
    int add_floats(std::span<const float> values, int width, bool with_bounds = false);
    /// Appends the indices of a triangle list as an accessor. Returns its index.
    int add_indices(std::span<const std::uint32_t> indices);
    /// Appends a JSON object to an array of the file. Returns its index. @param list "nodes", "meshes", ...
    int append(const char* list, nlohmann::json object);
    /// Returns the whole file. Text that is not UTF-8 is replaced by marks. @throws Error beyond 4 GiB
    std::vector<std::uint8_t> bytes();

private:
    std::vector<std::uint8_t> binary_;
};

}  // namespace si
