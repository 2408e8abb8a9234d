// Reader of glTF accessors: floats and indices from any component type, normalised, interleaved or sparse.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

#include "renderer/gltf/buffers.h"
#include "renderer/gltf/tinygltf_model.h"

namespace si::gltf {

/// Reader of the accessors (typed arrays) of one glTF file. Returns their elements as floats, matrices or indices.
class Accessors {
public:
    Accessors(Context& context, const tinygltf::Model& model, Buffers& buffers);

    /// Returns the number of elements of a glTF accessor. @param accessor index in the file
    std::size_t count(int accessor) const;
    /// Returns the number of components of an element of a glTF accessor, such as 3 for VEC3.
    int width(int accessor) const;
    /// Loads the buffer of a glTF accessor, if it has one. count() is then known to be at most the number of elements
    /// that the buffer's bytes hold. Call before memory for count() elements is allocated. @throws Error when the
    /// buffer cannot be loaded or is shorter than the file states
    void load_data(int accessor);

    /// Reads a glTF accessor as elements of N floats. Normalised integers are mapped to [0,1] or [-1,1], others keep
    /// their value.
    /// @param pick the elements to read, in this order, each below count(); empty: all
    /// @throws Error when the elements do not have N components
    template <int N>
    std::vector<glm::vec<N, float>> floats(int accessor, const Place& place, std::span<const std::uint32_t> pick = {});

    /// Reads all elements of a glTF accessor as floats, one element after the other.
    /// @param place position in the JSON, for errors @param width expected number of components per element
    /// @throws Error when the elements have another number of components
    std::vector<float> numbers(int accessor, const Place& place, int width);
    /// Reads a glTF accessor of 4 x 4 matrices, such as inverse bind matrices. @param place position in the JSON, for
    /// errors
    /// @throws Error unless the accessor is of type MAT4 with floats
    std::vector<glm::mat4> matrices(int accessor, const Place& place);
    /// Reads a glTF accessor of unsigned integers, such as the vertex indices of a primitive. The largest value of the
    /// integer type, which glTF forbids, is read as an index with a warning.
    /// @param place position in the JSON, for errors @param limit number of vertices
    /// @throws Error naming the largest index unless it is below `limit`
    std::vector<std::uint32_t> indices(int accessor, const Place& place, std::size_t limit);

private:
    /// Converts elements of a glTF accessor to floats and writes them to `out`, `width` floats per element.
    /// @param place position in the JSON, for errors @param pick indices of the elements to convert, in this order;
    /// empty: all
    void read(int accessor, const Place& place, int width, std::span<const std::uint32_t> pick, float* out);
    /// Replaces elements in `out` by the sparse values of a glTF accessor.
    /// @param place position in the JSON, for errors @param width floats per element @param out all elements of the
    /// accessor
    void overlay_sparse(int accessor, const Place& place, int width, float* out);
    /// Returns the indices of the elements that a sparse glTF accessor overwrites, in ascending order.
    /// @param place position in the JSON, for errors
    std::vector<std::uint32_t> sparse_positions(int accessor, const Place& place);
    /// Adds `bytes` to the decoded size of the file's accessors and reports progress. The limit of this size refuses a
    /// small file that refers to the same data a million times.
    /// @param place position in the JSON, for errors @throws Error above the limit
    void spend(int accessor, std::size_t bytes, const Place& place);
    /// Throws Error unless the elements of a glTF accessor have `width` components.
    void expect_width(int accessor, int width, const Place& place) const;

    Context& context_;
    const tinygltf::Model& model_;
    Buffers& buffers_;
    std::size_t decoded_bytes_ = 0;
};

}  // namespace si::gltf
