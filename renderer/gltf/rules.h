// Validation of a whole glTF 2.0 document before anything reads it: every index, range, type and reference.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/gltf/json_guard.h"

namespace si::gltf {

/// Reader of the fields of one JSON object of a glTF file. Every getter throws Error, naming the field, when the value
/// has the wrong type.
class Fields {
public:
    Fields(const Context& context, const Json& object, const Place& place);
    /// Returns a JSON field as a whole number of 0..most; nullopt when absent. @throws Error for any other value
    std::optional<std::uint64_t> whole(const char* key, std::uint64_t most) const;
    /// Returns a JSON field as a whole number of 0..most. @throws Error, also when absent
    std::uint64_t whole_required(const char* key, std::uint64_t most) const { return required(key, whole(key, most)); }
    /// Returns a JSON field as an index below `size`; nullopt when absent. @throws Error for any other value
    std::optional<std::size_t> index(const char* key, std::size_t size) const;
    /// Returns a JSON field as an index below `size`. @throws Error, also when absent
    std::size_t index_required(const char* key, std::size_t size) const { return required(key, index(key, size)); }
    /// Returns a JSON field as a string; nullopt when absent. @throws Error for any other value
    std::optional<std::string> string(const char* key) const;
    /// Returns a JSON field as an array of `n` finite numbers; nullopt when absent. @throws Error for any other value
    std::optional<std::vector<double>> numbers(const char* key, std::size_t n) const;
    /// Returns a JSON field as an array of indices below `size`; empty when absent. @throws Error for any other value
    std::vector<std::size_t> indices(const char* key, std::size_t size) const;
    /// Returns a JSON field that must be an object. @throws Error when the field is absent or not an object
    const Json& object(const char* key) const;
    /// Returns the position of this object in the glTF file.
    const Place& place() const { return place_; }

private:
    /// Throws Error for a missing field.
    [[noreturn]] void fail_missing(const char* key) const;
    /// Returns the value of a field. @throws Error when it is missing
    template <typename T>
    T required(const char* key, const std::optional<T>& value) const {
        if (!value) fail_missing(key);
        return *value;
    }

    const Context& context_;
    const Json& object_;
    const Place& place_;
};

/// Returns a JSON value of a glTF file as an index below `size`. @param place position in the JSON, which the error
/// names
/// @throws Error when the value is not such an index
std::size_t checked_index(const Context& context, const Json& value, const Place& place, std::size_t size);

/// Number of elements of each top-level array of a glTF file.
struct Sizes {
    std::size_t buffers = 0, views = 0, accessors = 0, meshes = 0, nodes = 0, scenes = 0, materials = 0, textures = 0,
                samplers = 0, images = 0, cameras = 0, skins = 0, animations = 0;
};

/// Counts the elements of all top-level arrays of a glTF file.
/// @throws Error when such a member of the JSON root is not an array of objects, or when all elements together would
/// need more than 512 MiB
Sizes check_arrays(const Context& context, const Json& root);

/// Validates the lengths and URIs that a glTF file states for its buffers, without loading them. Returns the lengths in
/// bytes. @throws Error
std::vector<std::uint64_t> check_buffers(const Context& context, const Json& root);

/// Validates the byte ranges of all buffers, buffer views and accessors of a glTF file, also of sparse accessors. A
/// faulty buffer view that no accessor reads becomes an empty one in `root`, with a warning. @throws Error
void check_data(Context& context, Json& root, const Sizes& sizes);

/// Validates the references between the objects of a glTF file, and its node graph. The graph must be a forest: at most
/// one parent per node, no cycle, at most 512 levels. @throws Error
void check_graph(Context& context, const Json& root, const Sizes& sizes);

/// Validates materials, textures and samplers of a glTF file. Erases wrong values and references from `root` with a
/// warning, since they change only the look of surfaces.
void check_look(Context& context, Json& root, const Sizes& sizes);

/// Returns the size in bytes of a glTF component type, such as 4 for 5126 (float); 0 for an unknown type.
std::size_t component_bytes(std::uint64_t component_type);
/// Returns the size in bytes of one element of a glTF accessor, with the column padding of matrices (glTF 2.0, section
/// 3.6.2.4). 0 for an unknown type. @param type of the accessor, such as "VEC3"
std::size_t element_bytes(std::string_view type, std::uint64_t component_type);

}  // namespace si::gltf
