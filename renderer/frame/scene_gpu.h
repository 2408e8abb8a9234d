// A scene on the GPU: geometry once, instance transforms relative to an origin, draws in batches.
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

/// Instances that one draw call covers.
struct Batch {
    GLsizei index_count = 0;
    std::size_t first_index = 0;
    GLint base_vertex = 0;
    GLuint first_instance = 0;
    GLsizei instances = 0;
    GLuint texture = 0;         ///< base colour; 0: none
    GLuint finest_texture = 0;  ///< its finest mip level alone
    GLuint normal_texture = 0;  ///< 0: none
    bool tangents = false;      ///< the mesh brings its tangents
    bool mirrored = false, masked = false, blend = false, double_sided = false, cast = true;
    bool closed = false;  ///< see check_watertight()
    bool ground = false;  ///< Object::ground
    ObjectCull cull = ObjectCull::Inherit;
    glm::dvec3 centre_ws{0};  ///< of the first instance, to order blended batches
    std::uint64_t triangles() const { return std::uint64_t(index_count) / 3 * std::uint64_t(instances); }
};

class SceneGpu {
public:
    /// @param before what was there; it hands on its textures where they are the same, and which meshes are closed of
    ///     those that are, all else is freed first
    explicit SceneGpu(const Scene& scene, bool anisotropy, std::unique_ptr<SceneGpu> before = {});
    std::uint64_t scene_id() const { return scene_id_; }
    /// Takes this for the scene from now on, where all that was handed to the driver is as it was: nodes and objects
    /// alone have changed. False: it needs another.
    bool adopt_if_compatible(const Scene& scene);

    /// Sorts the objects into batches under the object settings, large meshes after small ones; cheap when nothing
    /// changed.
    void update_batches(const Scene& scene, const Settings& settings);
    const std::vector<Batch>& batches() const { return batches_; }
    /// Has the camera draw some of the arranged instances, in another order. @param instances their numbers
    void set_camera_instances(std::span<const std::uint32_t> instances);
    const std::vector<Batch>& seen_batches() const { return seen_batches_; }
    /// Whether vertices bring colours (define VERTEX_COLOURS); else each object has one.
    bool coloured() const { return bool(colours_); }
    /// Key of the arrangement: scene, casts, culls, receives.
    const Key& key() const { return arrangement_; }

    /// Whose instances and transforms: the camera's are those of seen_batches(), and its triangles bring their normals;
    /// lights and shadow volumes have all that are arranged, each from an origin of its own.
    enum class Drawn { Seen, Casters, Volumes };
    /// Binds the vertex array with instance transforms relative to `origin`.
    void bind_vertices(const Scene& scene, const Settings& settings, const glm::dvec3& origin, Drawn drawn);
    void draw_batch(const Batch& batch) const;
    /// The number in Scene::objects of each arranged instance.
    const std::vector<std::uint32_t>& instance_objects() const { return order_; }
    /// Of each arranged instance the number of its batch.
    const std::vector<std::uint32_t>& instance_batches() const { return batch_of_; }
    /// Has another vertex array read transforms as bind_vertices() laid them out last: rows at locations 4 to 6.
    void bind_transforms(GLuint vao, GLuint binding, Drawn drawn) const;

private:
    std::uint64_t scene_id_ = 0;
    std::vector<MeshIdentity> meshes_as_uploaded_;
    std::vector<TextureIdentity> textures_as_uploaded_;
    gl::VertexArray vao_;
    gl::Buffer positions_, attributes_, faces_, colours_, normal_map_;
    gl::Buffer indices_, faced_indices_;  ///< as the lights draw, and as the camera does: see face_normals.h
    struct SceneTexture {
        gl::Texture whole;
        gl::Texture finest;  ///< a view of its finest mip level; none where that is all
        GLuint finest_id() const { return finest ? finest.id() : whole.id(); }
    };
    std::vector<SceneTexture> textures_;
    struct MeshRange {
        std::size_t first_index = 0;
        GLsizei index_count = 0;
        GLint base_vertex = 0;
        std::vector<std::uint32_t> copies;  ///< of vertices, after the mesh's own: see face_normals.h
        /// The mesh's vertex that vertex i of the range is or repeats. @param own how many the mesh has
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
    struct Slot {
        gl::Buffer buffer;
        std::uint64_t key = 0;
    };
    std::array<Slot, 3> slots_;  // by Drawn

    bool has_textures_of(const Scene& scene) const;
    void find_watertight_meshes(const Scene& scene, SceneGpu* before);
    void upload_geometry(const Scene& scene);
    void upload_normal_map_attributes(const Scene& scene, std::size_t vertex_count);
    void upload_textures(const Scene& scene, bool anisotropy);
};

}  // namespace si
