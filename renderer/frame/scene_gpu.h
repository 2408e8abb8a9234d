// Scene on the GPU: geometry uploaded once, instance transforms relative to an origin, draws in batches.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "renderer/base/key.h"
#include "renderer/gl/handle.h"
#include "renderer/scene/part_identity.h"
#include "renderer/scene/scene.h"
#include "renderer/scene/watertight.h"
#include "renderer/settings/settings.h"

namespace si {

/// Consecutive instances of one mesh that a single draw call draws, with their common state: textures, alpha mode,
/// culling and casting.
struct Batch {
    GLsizei index_count = 0;
    std::size_t first_index = 0;
    GLint base_vertex = 0;
    GLuint first_instance = 0;
    GLsizei instances = 0;
    GLuint texture = 0;         ///< base colour texture; 0: none
    GLuint finest_texture = 0;  ///< texture view of the base colour texture's finest mip level
    GLuint normal_texture = 0;  ///< 0: none
    bool tangents = false;      ///< mesh has tangents
    bool mirrored = false, masked = false, blend = false, double_sided = false, cast = true;
    bool closed = false;  ///< mesh is watertight, see check_watertight()
    bool ground = false;  ///< Object::ground
    ObjectCull cull = ObjectCull::Inherit;
    glm::dvec3 centre_ws{0};  ///< centre of the first instance, for sorting blended batches
    /// Returns the number of triangles of all instances together.
    std::uint64_t triangles() const { return std::uint64_t(index_count) / 3 * std::uint64_t(instances); }
};

/// Geometry, textures and instance batches of one scene on the GPU.
class SceneGpu {
public:
    /// Uploads a scene's meshes and textures to the GPU.
    /// @param anisotropy true: textures get anisotropic filtering
    /// @param before the previous scene, of which equal textures and watertightness checks are reused; other data is
    /// freed before the upload. Null: none
    explicit SceneGpu(const Scene& scene, bool anisotropy, std::unique_ptr<SceneGpu> before = {});
    /// Returns Scene::id of the uploaded scene.
    std::uint64_t scene_id() const { return scene_id_; }
    /// Replaces the scene on the GPU by `scene` without an upload, if both have equal meshes and textures. Nodes and
    /// objects may differ. Returns false otherwise: the caller then creates a new SceneGpu.
    bool adopt_if_compatible(const Scene& scene);

    /// Sorts the scene's objects into batches (instances of a mesh in one draw call) by material and object settings.
    /// Batches of large meshes come after those of small ones. Cheap when nothing changed.
    void update_batches(const Scene& scene, const Settings& settings);
    /// Returns the batches (instances of a mesh in one draw call) of all objects, as lights draw them.
    const std::vector<Batch>& batches() const { return batches_; }
    /// Binds the scene's vertex positions and the indices of its triangles as storage buffers. Shaders that read the
    /// corners of their own triangle need them (shaders/lib/triangle_corners.glsl).
    void bind_triangles() const;
    /// Sets the instances that the camera draws, and their order. Used for frustum culling and front-to-back order.
    /// @param instances indices of the instances, in the order of instance_objects()
    void set_camera_instances(std::span<const std::uint32_t> instances);
    /// Returns the batches (instances of a mesh in one draw call) that the camera draws, see set_camera_instances().
    const std::vector<Batch>& seen_batches() const { return seen_batches_; }
    /// Returns true when some mesh of the scene has vertex colours (define VERTEX_COLOURS).
    bool coloured() const { return bool(colours_); }
    /// Returns the cache key of the batches (instances of a mesh in one draw call): scene, and the settings of
    /// textures, casting, culling and receiving.
    const Key& key() const { return arrangement_; }

    /// User of the instance transforms; each has an origin of its own. Seen: the camera, with seen_batches() and
    /// per-triangle normals. Casters, Volumes: lights and shadow volumes, with all batches.
    enum class Drawn { Seen, Casters, Volumes };
    /// Binds the scene's vertex array for draw_batch(), with instance transforms relative to `origin`.
    /// @param origin world, metres
    /// @param drawn user of the transforms: camera, maps or shadow volumes
    void bind_vertices(const Scene& scene, const Settings& settings, const glm::dvec3& origin, Drawn drawn);
    /// Draws all instances of one batch of the scene in one draw call. Call bind_vertices() before.
    void draw_batch(const Batch& batch) const;
    /// Returns the index in Scene::objects of each instance, in the order of batches().
    const std::vector<std::uint32_t>& instance_objects() const { return order_; }
    /// Returns for each instance the index of its batch in batches().
    const std::vector<std::uint32_t>& instance_batches() const { return batch_of_; }
    /// Attaches the instance transforms of the last bind_vertices() to another vertex array, such as that of shadow
    /// volumes. Matrix rows are attributes 4 to 6.
    /// @param binding vertex buffer binding index in `vao`
    /// @param drawn user whose transforms are attached
    void bind_transforms(const gl::VertexArray& vao, GLuint binding, Drawn drawn) const;

private:
    std::uint64_t scene_id_ = 0;
    std::vector<MeshIdentity> meshes_as_uploaded_;
    std::vector<TextureIdentity> textures_as_uploaded_;
    gl::VertexArray vao_;
    gl::Buffer positions_, attributes_, faces_, colours_, normal_map_;
    gl::Buffer indices_, faced_indices_;  ///< for lights, and for the camera: see face_normals.h
    /// Texture of the scene on the GPU, with a texture view of its finest mip level.
    struct SceneTexture {
        gl::Texture whole;
        gl::Texture finest;  ///< view of the finest mip level; empty if it has only one
        GLuint finest_id() const { return finest ? finest.id() : whole.id(); }
    };
    std::vector<SceneTexture> textures_;
    /// Range of one mesh in the vertex and index buffers that all meshes of the scene share.
    struct MeshRange {
        std::size_t first_index = 0;
        GLsizei index_count = 0;
        GLint base_vertex = 0;
        std::vector<std::uint32_t> copies;  ///< repeated vertices after the mesh's own: see face_normals.h
        /// Returns the index of the mesh vertex that vertex `i` of the mesh's range repeats; `i` itself if less than
        /// `own`.
        /// @param own number of vertices of the mesh
        std::size_t source(std::size_t own, std::size_t i) const { return i < own ? i : copies[i - own]; }
    };
    std::vector<MeshRange> ranges_;
    std::vector<WatertightCheck> bodies_;  // by mesh
    std::vector<std::uint32_t> order_;     // objects in instance order
    std::vector<std::uint32_t> batch_of_;  // by instance
    std::vector<Batch> batches_;
    std::vector<std::uint32_t> seen_order_;  // objects as the camera draws them
    std::vector<Batch> seen_batches_;
    Key arrangement_, seen_arrangement_;
    /// GPU buffer of instance transforms, with the cache key of its contents.
    struct Slot {
        gl::Buffer buffer;
        std::uint64_t key = 0;
    };
    std::array<Slot, 3> slots_;  // by Drawn

    /// Returns true when the textures on the GPU are those of `scene`, so that they need no upload.
    bool has_textures_of(const Scene& scene) const;
    /// Checks which meshes of the scene are watertight. Back faces of such casters can be skipped in shadow maps.
    /// @param before previous scene, whose results are reused for equal meshes; may be null
    void find_watertight_meshes(const Scene& scene, SceneGpu* before);
    /// Uploads the vertices and indices of all meshes of the scene to the GPU.
    void upload_geometry(const Scene& scene);
    /// Uploads tangents and texture coordinates for normal maps, for meshes whose material has one.
    /// @param vertex_count number of vertices of all meshes together
    void upload_normal_map_attributes(const Scene& scene, std::size_t vertex_count);
    /// Uploads the scene's textures with mip levels.
    /// @param anisotropy true: textures get anisotropic filtering
    /// @throws Error when the driver is out of memory
    void upload_textures(const Scene& scene, bool anisotropy);
};

}  // namespace si
