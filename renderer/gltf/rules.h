// The glTF 2.0 document checked as a whole before anything reads it: every index, range, type and reference.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/gltf/json_guard.h"

namespace si::gltf {

/// One JSON object read field by field; every getter throws Error naming the field when its value is of the wrong kind.
class Fields {
public:
    Fields(const Context& context, const Json& object, const Place& place);
    bool has(const char* key) const { return object_.contains(key); }
    /// A whole number of 0..most; absent gives nothing.
    std::optional<std::uint64_t> whole(const char* key, std::uint64_t most) const;
    std::uint64_t whole_required(const char* key, std::uint64_t most) const;
    /// An index below `size`.
    std::optional<std::size_t> index(const char* key, std::size_t size) const;
    std::size_t index_required(const char* key, std::size_t size) const;
    std::optional<std::string> string(const char* key) const;
    /// `n` finite numbers.
    std::optional<std::vector<double>> numbers(const char* key, std::size_t n) const;
    /// An array of indices below `size`.
    std::vector<std::size_t> indices(const char* key, std::size_t size) const;
    /// The object under `key`, which must be there.
    const Json& object(const char* key) const;
    const Place& place() const { return place_; }

private:
    const Context& context_;
    const Json& object_;
    const Place& place_;
};

/// The index in `value`, below `size`. @throws Error naming `place`.
std::size_t checked_index(const Context& context, const Json& value, const Place& place, std::size_t size);

/// How many elements each top-level array has.
struct Sizes {
    std::size_t buffers = 0, views = 0, accessors = 0, meshes = 0, nodes = 0, scenes = 0, materials = 0, textures = 0,
                samplers = 0, images = 0, cameras = 0, skins = 0, animations = 0;
};

/// Counts the arrays; @throws Error when one is no array of objects or they would need more than 512 MiB.
Sizes check_arrays(const Context& context, const Json& root);

/// Ranges of buffers, views and accessors, sparse ones included, in 64 bit without wrap-around.
void check_data(const Context& context, const Json& root, const Sizes& sizes);

/// References and the node graph: a forest (one parent at most, no cycle) at most 512 levels deep.
void check_graph(Context& context, const Json& root, const Sizes& sizes);

/// Materials, textures and samplers; values that only harm the look are erased from `root` with a warning.
void check_look(Context& context, Json& root, const Sizes& sizes);

/// Bytes of one component; 0 for a type that glTF 2.0 has not.
std::size_t component_bytes(std::uint64_t component_type);
/// Bytes of one element, the column padding of matrices included (glTF 2.0, section 3.6.2.4); 0 for an unknown type.
std::size_t element_bytes(std::string_view type, std::uint64_t component_type);

}  // namespace si::gltf
