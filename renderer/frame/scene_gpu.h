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

/// Run of instances that one draw call covers, with the state that they share.
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
    bool closed = false;  ///< see check_watertight()
    bool ground = false;  ///< Object::ground
    ObjectCull cull = ObjectCull::Inherit;
    glm::dvec3 centre_ws{0};  ///< centre of the first instance, for sorting blended batches
    /// Returns the triangles of all instances.
    std::uint64_t triangles() const { return std::uint64_t(index_count) / 3 * std::uint64_t(instances); }
};

/// Geometry, textures and instance batches of one scene on the GPU.
class SceneGpu {
public:
    /// Uploads a scene's meshes and textures to the GPU.
    /// @param anisotropy true: textures get anisotropic filtering
    /// @param before the previous scene, of which equal textures and watertightness checks are reused; the remainder is
    /// freed first
    explicit SceneGpu(const Scene& scene, bool anisotropy, std::unique_ptr<SceneGpu> before = {});
    /// Returns Scene::id of the uploaded scene.
    std::uint64_t scene_id() const { return scene_id_; }
    /// Switches to another scene without an upload. Returns false when meshes or textures differ, and a new SceneGpu is
    /// needed; only nodes and objects may differ.
    bool adopt_if_compatible(const Scene& scene);

    /// Sorts the scene's objects into batches by material and object settings, large meshes after small ones. Cheap
    /// when nothing changed.
    void update_batches(const Scene& scene, const Settings& settings);
    /// Returns the batches of all objects, as lights draw them.
    const std::vector<Batch>& batches() const { return batches_; }
    /// Binds positions and indices of all triangles, as the camera draws them, for shaders/lib/triangle_corners.glsl.
    void bind_triangles() const;
    /// Sets the instances that the camera draws, and their order. Used for frustum culling and front-to-back order.
    /// @param instances the indices of the instances, in the order of instance_objects()
    void set_camera_instances(std::span<const std::uint32_t> instances);
    /// Returns the batches that the camera draws, see set_camera_instances().
    const std::vector<Batch>& seen_batches() const { return seen_batches_; }
    /// Returns true when vertices have colours (define VERTEX_COLOURS); else each object has one.
    bool coloured() const { return bool(colours_); }
    /// Returns the key of the batches: scene, and the settings of casting, culling and receiving.
    const Key& key() const { return arrangement_; }

    /// User of instance transforms. Seen: the camera, with seen_batches() and per-triangle normals. Casters, Volumes:
    /// lights and shadow volumes, with all batches and an origin each.
    enum class Drawn { Seen, Casters, Volumes };
    /// Binds the vertex array for drawing batches, with instance transforms relative to `origin`, world metres.
    void bind_vertices(const Scene& scene, const Settings& settings, const glm::dvec3& origin, Drawn drawn);
    /// Draws one batch. Call bind_vertices() before.
    void draw_batch(const Batch& batch) const;
    /// Returns the index in Scene::objects of each instance, in batch order.
    const std::vector<std::uint32_t>& instance_objects() const { return order_; }
    /// Returns the batch number of each instance.
    const std::vector<std::uint32_t>& instance_batches() const { return batch_of_; }
    /// Lets another vertex array read the instance transforms of the last bind_vertices(): matrix rows at locations 4
    /// to 6.
    /// @param binding vertex buffer binding index in `vao`
    void bind_transforms(const gl::VertexArray& vao, GLuint binding, Drawn drawn) const;

private:
    std::uint64_t scene_id_ = 0;
    std::vector<MeshIdentity> meshes_as_uploaded_;
    std::vector<TextureIdentity> textures_as_uploaded_;
    gl::VertexArray vao_;
    gl::Buffer positions_, attributes_, faces_, colours_, normal_map_;
    gl::Buffer indices_, faced_indices_;  ///< for lights, and for the camera: see face_normals.h
    /// Texture of the scene as uploaded, with a view of its finest mip level.
    struct SceneTexture {
        gl::Texture whole;
        gl::Texture finest;  ///< view of the finest mip level; empty if it has only one
        GLuint finest_id() const { return finest ? finest.id() : whole.id(); }
    };
    std::vector<SceneTexture> textures_;
    /// Place of a mesh in the shared vertex and index buffers.
    struct MeshRange {
        std::size_t first_index = 0;
        GLsizei index_count = 0;
        GLint base_vertex = 0;
        std::vector<std::uint32_t> copies;  ///< repeated vertices after the mesh's own: see face_normals.h
        /// Returns the mesh vertex that vertex `i` of the range is or repeats.
        /// @param own the vertices of the mesh
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
    /// Buffer of instance transforms, with the key of its contents.
    struct Slot {
        gl::Buffer buffer;
        std::uint64_t key = 0;
    };
    std::array<Slot, 3> slots_;  // by Drawn

    /// Returns true when the uploaded textures are those of a scene.
    bool has_textures_of(const Scene& scene) const;
    /// Checks which meshes are watertight.
    /// @param before the previous scene, whose results are reused for equal meshes; may be null
    void find_watertight_meshes(const Scene& scene, SceneGpu* before);
    /// Uploads the vertices and indices of all meshes.
    void upload_geometry(const Scene& scene);
    /// Uploads tangents and texture coordinates for normal maps, for meshes whose material has one.
    void upload_normal_map_attributes(const Scene& scene, std::size_t vertex_count);
    /// Uploads the scene's textures with mip levels.
    /// @throws Error when the driver is out of memory
    void upload_textures(const Scene& scene, bool anisotropy);
};

}  // namespace si
