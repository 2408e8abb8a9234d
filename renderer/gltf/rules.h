// Validation of a whole glTF 2.0 document before anything reads it: every index, range, type and reference.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/gltf/json_guard.h"

namespace si::gltf {

/// Typed access to the fields of one JSON object of a glTF file. Every getter throws Error naming the field when its
/// value has the wrong type.
class Fields {
public:
    Fields(const Context& context, const Json& object, const Place& place);
    /// Returns a JSON field as a whole number of 0..most; nothing when absent. @throws Error
    std::optional<std::uint64_t> whole(const char* key, std::uint64_t most) const;
    /// Returns a JSON field as a whole number of 0..most. @throws Error, also when absent
    std::uint64_t whole_required(const char* key, std::uint64_t most) const { return required(key, whole(key, most)); }
    /// Returns a JSON field as an index below `size`; nothing when absent. @throws Error
    std::optional<std::size_t> index(const char* key, std::size_t size) const;
    /// Returns a JSON field as an index below `size`. @throws Error, also when absent
    std::size_t index_required(const char* key, std::size_t size) const { return required(key, index(key, size)); }
    /// Returns a JSON field as a string; nothing when absent. @throws Error
    std::optional<std::string> string(const char* key) const;
    /// Returns a JSON field as an array of `n` finite numbers; nothing when absent. @throws Error
    std::optional<std::vector<double>> numbers(const char* key, std::size_t n) const;
    /// Returns a JSON field as an array of indices below `size`; empty when absent. @throws Error
    std::vector<std::size_t> indices(const char* key, std::size_t size) const;
    /// Returns a JSON field that is an object. @throws Error, also when absent
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

/// Returns a JSON value as an index below `size`. @throws Error naming `place`.
std::size_t checked_index(const Context& context, const Json& value, const Place& place, std::size_t size);

/// Number of elements of each top-level array of a glTF file.
struct Sizes {
    std::size_t buffers = 0, views = 0, accessors = 0, meshes = 0, nodes = 0, scenes = 0, materials = 0, textures = 0,
                samplers = 0, images = 0, cameras = 0, skins = 0, animations = 0;
};

/// Counts the elements of all top-level arrays of a glTF file.
/// @throws Error when one is no array of objects, or they would need more than 512 MiB
Sizes check_arrays(const Context& context, const Json& root);

/// Validates the buffers of a glTF file. Returns their lengths in bytes. @throws Error
std::vector<std::uint64_t> check_buffers(const Context& context, const Json& root);

/// Validates the byte ranges of all buffers, views and accessors (sparse ones too) of a glTF file. A faulty view that
/// no accessor reads becomes an empty one in `root`, with a warning. @throws Error
void check_data(Context& context, Json& root, const Sizes& sizes);

/// Validates the references and the node graph of a glTF file: a forest (at most one parent, no cycle), at most 512
/// levels deep. @throws Error
void check_graph(Context& context, const Json& root, const Sizes& sizes);

/// Validates materials, textures and samplers of a glTF file. Wrong values and references are erased from `root` with a
/// warning, as they affect the look alone.
void check_look(Context& context, Json& root, const Sizes& sizes);

/// Returns the bytes of one component of a glTF componentType; 0 for an unknown type.
std::size_t component_bytes(std::uint64_t component_type);
/// Returns the bytes of one accessor element, with the column padding of matrices (glTF 2.0, section 3.6.2.4); 0 for an
/// unknown type. @param type "VEC3"
std::size_t element_bytes(std::string_view type, std::uint64_t component_type);

}  // namespace si::gltf
