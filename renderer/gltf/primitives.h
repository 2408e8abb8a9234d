// Conversion of glTF primitives to the scene's triangle meshes: one mesh per primitive, shared by all nodes with it.
#pragma once

#include <map>

#include "renderer/gltf/accessor.h"
#include "renderer/gltf/materials.h"

namespace si::gltf {

/// Converter of the primitives of one glTF file to meshes of a scene.
class Primitives {
public:
    Primitives(Context& context, const tinygltf::Model& model, Accessors& accessors, Materials& materials,
               Scene& scene);
    /// Returns the scene's mesh indices for glTF mesh `mesh`; builds the meshes on first use. Points, lines and
    /// unusable primitives are skipped.
    const std::vector<int>& of_mesh(int mesh);

    /// Converts a glTF primitive to a mesh that shares nothing. Returns nothing, with a warning, when it has no
    /// triangles.
    /// @param pick receives the file's vertices that the mesh uses, in its order; empty: all, in the file's order
    std::optional<Mesh> make(const tinygltf::Primitive& primitive, const Place& place, const std::string& name,
                             std::vector<std::uint32_t>& pick);

private:
    /// Returns the scene's mesh index of a glTF primitive, or -1 when there is nothing to draw. Equal primitives share
    /// one mesh.
    int share(const tinygltf::Primitive& primitive, const Place& place, const std::string& name);
    /// Reads the vertex attributes of a glTF primitive into `mesh`. @param pick the vertices to read; empty: all
    void read_attributes(const tinygltf::Primitive& primitive, const Place& place, std::span<const std::uint32_t> pick,
                         Mesh& mesh);
    /// Reads the texture coordinates that a texture of the primitive's material uses, with its transform applied.
    std::vector<glm::vec2> coordinates(const tinygltf::Primitive& primitive, const Place& place, const UvSource& source,
                                       std::span<const std::uint32_t> pick);
    /// Renumbers `indices` without unused vertices. Returns the used vertices, in the order of first use.
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

/// Returns the number of morph targets of glTF mesh `mesh`.
std::size_t target_count(const tinygltf::Model& model, int mesh);

}  // namespace si::gltf
