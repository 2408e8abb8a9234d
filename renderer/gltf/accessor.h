// Accessor data as floats and indices, whatever the file stores: any component type, normalised, interleaved, sparse.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

#include "renderer/gltf/buffers.h"
#include "renderer/gltf/tinygltf_model.h"

namespace si::gltf {

class Accessors {
public:
    Accessors(Context& context, const tinygltf::Model& model, Buffers& buffers);

    std::size_t count(int accessor) const;
    /// VEC4, VEC3, ... the number of components.
    int width(int accessor) const;

    /// `accessor` as N floats an element, normalised integers mapped to [0,1] or [-1,1] and others kept as they are.
    /// With `pick`, only these elements, in that order; each must be below count().
    /// @throws Error when the element type has another width.
    template <int N>
    std::vector<glm::vec<N, float>> floats(int accessor, const Place& place, std::span<const std::uint32_t> pick = {});

    std::vector<float> scalars(int accessor, const Place& place);
    std::vector<glm::mat4> matrices(int accessor, const Place& place);
    /// Unsigned integers, each below `limit`. @throws Error naming the first that is not.
    std::vector<std::uint32_t> indices(int accessor, const Place& place, std::size_t limit);

private:
    void read(int accessor, const Place& place, int width, std::span<const std::uint32_t> pick, float* out);
    void overlay_sparse(int accessor, const Place& place, int width, float* out);
    std::vector<std::uint32_t> sparse_positions(int accessor, const Place& place);
    /// Counts decoded bytes, so that a small file that shows the same data a million times is refused.
    void spend(int accessor, std::size_t bytes, const Place& place);
    void expect_width(int accessor, int width, const Place& place) const;

    Context& context_;
    const tinygltf::Model& model_;
    Buffers& buffers_;
    std::size_t decoded_bytes_ = 0;
};

}  // namespace si::gltf
