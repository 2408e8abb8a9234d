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
    /// Returns the indices in Scene::meshes of the meshes made from the primitives of a glTF mesh. Builds them on first
    /// use. Points, lines and unusable primitives are skipped. @param mesh index in the file
    const std::vector<int>& of_mesh(int mesh);

    /// Converts a glTF primitive to a new mesh that no other primitive shares, as deformed meshes need. Returns
    /// nullopt, with a warning, when the primitive has no triangles.
    /// @param place position in the JSON, for errors @param name name of the mesh
    /// @param pick receives the file's vertex index of each vertex of the mesh; empty: all vertices in the file's order
    std::optional<Mesh> make(const tinygltf::Primitive& primitive, const Place& place, const std::string& name,
                             std::vector<std::uint32_t>& pick);

private:
    /// Returns the index in Scene::meshes of the mesh made from a glTF primitive; -1 when there is nothing to draw.
    /// Equal primitives share one mesh.
    int share(const tinygltf::Primitive& primitive, const Place& place, const std::string& name);
    /// Reads the vertex attributes of a glTF primitive into `mesh`.
    /// @param place position in the JSON, for errors @param pick indices of the vertices to read; empty: all
    void read_attributes(const tinygltf::Primitive& primitive, const Place& place, std::span<const std::uint32_t> pick,
                         Mesh& mesh);
    /// Reads the texture coordinates of a glTF primitive for one texture, with the texture's transform applied. Empty,
    /// with a warning, when the primitive lacks them.
    /// @param source attribute and transform @param pick indices of the vertices to read; empty: all
    std::vector<glm::vec2> coordinates(const tinygltf::Primitive& primitive, const Place& place, const UvSource& source,
                                       std::span<const std::uint32_t> pick);
    /// Renumbers vertex indices without gaps, in the order of first use, to drop unused vertices. Returns the old index
    /// of each used vertex.
    /// @param vertex_count number of vertices before renumbering
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

/// Returns the number of morph targets of a glTF mesh; 0 for a `mesh` of -1.
std::size_t target_count(const tinygltf::Model& model, int mesh);

}  // namespace si::gltf
