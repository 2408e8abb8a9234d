// glTF primitives to the scene's triangle meshes: one mesh for each primitive, shared by all nodes that show it.
#pragma once

#include <map>

#include "renderer/gltf/accessor.h"
#include "renderer/gltf/materials.h"

namespace si::gltf {

class Primitives {
public:
    Primitives(Context& context, const tinygltf::Model& model, Accessors& accessors, Materials& materials,
               Scene& scene);
    /// The scene's meshes for glTF mesh `mesh`, built on first use; points, lines and unusable primitives left out.
    const std::vector<int>& of_mesh(int mesh);

    /// A primitive as a mesh of its own; `pick` gets the vertices of the file that it took, empty: all, in order.
    /// Nothing, with a warning, when there is nothing to draw.
    std::optional<Mesh> make(const tinygltf::Primitive& primitive, const Place& place, const std::string& name,
                             std::vector<std::uint32_t>& pick);

private:
    int build(const tinygltf::Primitive& primitive, const Place& place, const std::string& name);
    /// The scene mesh of a primitive, -1 when there is nothing to draw; equal primitives share one.
    int share(const tinygltf::Primitive& primitive, const Place& place, const std::string& name);
    void read_attributes(const tinygltf::Primitive& primitive, const Place& place, std::span<const std::uint32_t> pick,
                         Mesh& mesh);
    std::vector<glm::vec2> coordinates(const tinygltf::Primitive& primitive, const Place& place, const UvSource& source,
                                       std::span<const std::uint32_t> pick);
    /// Renumbers `indices` to the vertices in use and returns these, ascending by first use.
    std::vector<std::uint32_t> compact(std::vector<std::uint32_t>& indices, std::size_t vertex_count);

    Context& context_;
    const tinygltf::Model& model_;
    Accessors& accessors_;
    Materials& materials_;
    Scene& scene_;
    std::map<int, std::vector<int>> of_mesh_;
    std::map<std::vector<int>, int> shared_;
    std::vector<std::uint32_t> scratch_;
};

/// How many morph targets mesh `mesh` has.
std::size_t target_count(const tinygltf::Model& model, int mesh);

}  // namespace si::gltf
