// Reader of glTF accessors: floats and indices from any component type, normalised, interleaved or sparse.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

#include "renderer/gltf/buffers.h"
#include "renderer/gltf/tinygltf_model.h"

namespace si::gltf {

/// Reader of the accessors of one glTF file.
class Accessors {
public:
    Accessors(Context& context, const tinygltf::Model& model, Buffers& buffers);

    /// Returns the number of elements of a glTF accessor (an index of the file).
    std::size_t count(int accessor) const;
    /// Returns the number of components of a glTF accessor's elements: 3 for VEC3.
    int width(int accessor) const;

    /// Reads a glTF accessor as elements of N floats. Normalised integers are mapped to [0,1] or [-1,1], others keep
    /// their value.
    /// @param pick the elements to read, in this order, each below count(); empty: all
    /// @throws Error when the element type has another width
    template <int N>
    std::vector<glm::vec<N, float>> floats(int accessor, const Place& place, std::span<const std::uint32_t> pick = {});

    /// Reads a glTF accessor as floats, `width` for each element. @param place position in the JSON, for errors
    /// @throws Error when the element type has another width
    std::vector<float> numbers(int accessor, const Place& place, int width);
    /// Reads a glTF accessor of 4 x 4 matrices. @param place position in the JSON, for errors
    std::vector<glm::mat4> matrices(int accessor, const Place& place);
    /// Reads a glTF accessor of unsigned integers below `limit`. The largest value of the type, which glTF forbids, is
    /// an index with a warning. @throws Error naming the largest number when it is not below
    std::vector<std::uint32_t> indices(int accessor, const Place& place, std::size_t limit);

private:
    /// Converts elements of a glTF accessor to floats, `width` per element, into `out`.
    /// @param pick indices of the elements, in this order; empty: all @param place position in the JSON, for errors
    void read(int accessor, const Place& place, int width, std::span<const std::uint32_t> pick, float* out);
    /// Overwrites elements in `out` by the sparse values of a glTF accessor.
    void overlay_sparse(int accessor, const Place& place, int width, float* out);
    /// Returns the indices of the elements that a sparse glTF accessor overwrites.
    std::vector<std::uint32_t> sparse_positions(int accessor, const Place& place);
    /// Adds to the count of decoded bytes, for the limit on a file's decoded size. @throws Error above the limit, so
    /// that a small file that refers to the same data a million times is refused
    void spend(int accessor, std::size_t bytes, const Place& place);
    /// Throws Error when the elements of a glTF accessor do not have `width` components.
    void expect_width(int accessor, int width, const Place& place) const;

    Context& context_;
    const tinygltf::Model& model_;
    Buffers& buffers_;
    std::size_t decoded_bytes_ = 0;
};

}  // namespace si::gltf
