// Scene for the renderer, the light fit and the ray-traced reference: flat lists of meshes, materials, textures and
// placed objects. Positions in metres, y up, right-handed; transforms in double.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "renderer/base/file_stamp.h"
#include "renderer/base/held_memory.h"
#include "renderer/base/shared_array.h"
#include "renderer/settings/settings.h"

namespace si {

/// Eight corners of a box, in any orientation.
using Box = std::array<glm::dvec3, 8>;

/// Axis-aligned rectangle in 2D; empty by default.
struct Bounds2 {
    glm::dvec2 lo{std::numeric_limits<double>::infinity()};
    glm::dvec2 hi{-std::numeric_limits<double>::infinity()};
    /// Returns true when the rectangle contains no point.
    bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y); }
    /// Returns true when another rectangle lies inside this one, or is empty.
    bool contains(const Bounds2& r) const {
        return r.empty() || (lo.x <= r.lo.x && lo.y <= r.lo.y && hi.x >= r.hi.x && hi.y >= r.hi.y);
    }
    /// Grows the rectangle to contain another one.
    void add(const Bounds2& r) {
        lo = glm::min(lo, r.lo);
        hi = glm::max(hi, r.hi);
    }
    /// Grows the rectangle to contain a point.
    void add(const glm::dvec2& p) {
        lo = glm::min(lo, p);
        hi = glm::max(hi, p);
    }
    /// Returns the intersection of two rectangles; empty if they do not overlap.
    Bounds2 intersection(const Bounds2& r) const { return {glm::max(lo, r.lo), glm::min(hi, r.hi)}; }
};

/// Axis-aligned bounding box; empty by default.
struct Bounds {
    glm::dvec3 lo{std::numeric_limits<double>::infinity()};
    glm::dvec3 hi{-std::numeric_limits<double>::infinity()};
    bool operator==(const Bounds&) const = default;
    /// Returns true when the box contains no point.
    bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
    /// Returns the centre of the box; the origin when empty.
    glm::dvec3 centre() const { return empty() ? glm::dvec3(0) : 0.5 * lo + 0.5 * hi; }
    /// Returns half the diagonal of the box; 0 when empty.
    double radius() const { return empty() ? 0 : 0.5 * glm::length(hi - lo); }
    /// Grows the box to contain a point.
    void add(const glm::dvec3& p) {
        lo = glm::min(lo, p);
        hi = glm::max(hi, p);
    }
    /// Grows the box to contain another box.
    void add(const Bounds& b) {
        lo = glm::min(lo, b.lo);
        hi = glm::max(hi, b.hi);
    }
    /// Returns the eight corners of this bounding box, transformed by `m`. Bits 0, 1, 2 of a corner's index are set for
    /// the upper x, y, z of the box.
    Box corners(const glm::dmat4& m = glm::dmat4(1.0)) const;
    /// Returns the axis-aligned box around this box's eight corners, transformed by `m`; empty for an empty box.
    Bounds transformed(const glm::dmat4& m) const;
};

/// Wrapping of texture coordinates outside [0,1].
enum class TextureWrap { Repeat, Clamp, Mirror };

/// Image with four 8-bit channels, and how it is sampled.
struct Texture {
    std::string name;
    int width = 0, height = 0;
    SharedArray<std::uint8_t> rgba;  ///< width*height*4, row 0 is v = 0 (glTF: the top of the image)
    bool srgb = true;
    TextureWrap wrap_s = TextureWrap::Repeat, wrap_t = TextureWrap::Repeat;
    bool nearest_mag = false, nearest_min = false, mipmaps = true;
};

/// Use of a material's alpha channel (glTF 2.0): ignored, alpha test, or blending.
enum class AlphaMode { Opaque, Mask, Blend };

/// Material of a mesh: colour, textures and alpha mode.
struct Material {
    std::string name;
    glm::vec4 base_colour{0.8f, 0.8f, 0.8f, 1.0f};  ///< linear
    int base_colour_texture = -1;                   ///< index into Scene::textures; -1: none
    int normal_texture = -1;                        ///< index into Scene::textures; -1: none
    float normal_scale = 1;
    AlphaMode alpha = AlphaMode::Opaque;
    float alpha_cutoff = 0.5f;
    bool double_sided = false;
    bool unlit = false;
    bool operator==(const Material&) const = default;
};

// Defined in renderer/scene/animation.h.
struct Deformer;
struct Rig;

/// Triangle mesh with one material. All attribute arrays are empty or as long as `positions`.
struct Mesh {
    std::string name;
    SharedArray<glm::vec3> positions;
    SharedArray<glm::vec3> normals;            ///< empty before finalise(): flat normals are made
    SharedArray<glm::vec2> uv;                 ///< for the base colour texture, transforms applied
    SharedArray<glm::vec2> uv_normal;          ///< for the normal texture; empty: uv
    SharedArray<glm::vec4> tangents;           ///< xyz and handedness
    SharedArray<glm::vec4> colours;            ///< linear, multiplies the base colour
    SharedArray<std::uint32_t> indices;        ///< triangle list
    int material = -1;                         ///< -1: the default material
    Bounds bounds;                             ///< local; set by finalise()
    std::shared_ptr<const Deformer> deformer;  ///< morph targets and skin; null: rigid
};

/// Calls `work` with the pointer to each member of Mesh that holds one attribute of all vertices, positions first.
template <typename Work>
void for_each_attribute(Work&& work) {
    work(&Mesh::positions);
    work(&Mesh::normals);
    work(&Mesh::uv);
    work(&Mesh::uv_normal);
    work(&Mesh::tangents);
    work(&Mesh::colours);
}

/// Gives each triangle of a mesh three vertices of its own, for flat normals. The new vertex i is a copy of the vertex
/// that the i-th index named.
void split_vertices(Mesh& mesh);

/// Node of the scene's transform hierarchy.
struct Node {
    std::string name;
    std::string path;  ///< unique, "Parent/Child"; set by finalise()
    int parent = -1;   ///< always smaller than the node's own index; -1: root node
    glm::dmat4 local{1.0};
    glm::dmat4 world{1.0};  ///< set by finalise()
};

/// Instance of a mesh, placed in the scene by a node. Several objects may share node and mesh (primitives, instancing).
struct Object {
    int node = 0;
    int mesh = 0;
    glm::dmat4 instance{1.0};  ///< applied before the node's world transform
    glm::dmat4 world{1.0};     ///< set by finalise()
    bool ground = false;       ///< ground disc of add_ground(): receives, never casts, and is no part of Scene::bounds
    /// Bounds over a whole animation, before Scene::placement; empty: the object stays where `world` places it. See
    /// measure_animation_bounds().
    Bounds animation_bounds;
};

/// Object that hide_objects() moved out of Scene::objects, with its position in the list.
struct HiddenObject {
    std::size_t place = 0;  ///< index among all objects, shown and hidden
    Object object;
};

/// Camera that a scene's file contains.
struct SceneCamera {
    std::string name;
    glm::dmat4 world{1.0};  ///< looks along -z
    glm::dmat4 home{1.0};   ///< `world` before Scene::placement; set by finalise()
    bool orthographic = false;
    double fov_y_deg = 45;
    double height = 10;        ///< height of an orthographic view, metres before Scene::placement
    double near = 0, far = 0;  ///< metres before Scene::placement; 0: automatic
};

/// Light that a scene's file contains.
struct SceneLight {
    std::string name;
    LightType type = LightType::Directional;
    glm::dmat4 world{1.0};  ///< shines along -z
    glm::dmat4 home{1.0};   ///< `world` before Scene::placement; set by finalise()
    glm::dvec3 colour{1};
    double intensity = 1;
    double range = 0;  ///< metres before Scene::placement; 0: unlimited
    double inner_cone_rad = 0, outer_cone_rad = 0.785398163397448;
};

/// Scene to draw: meshes, materials, textures, placed objects, cameras and lights, with derived bounds and an id for
/// cache keys. Fill the lists, then call finalise().
struct Scene {
    std::string name;                      ///< key of the built-in scene, or the file's path
    std::string about;                     ///< description in a sentence
    std::vector<std::string> file_scenes;  ///< names (or "") of all scenes in the scene's file
    int file_scene = 0;                    ///< index of this scene in `file_scenes`
    UpAxis file_up = UpAxis::Y;            ///< axis of the file that its loader has turned upwards
    double file_unit_m = 1;                ///< metres per unit of the file, which its loader has applied
    std::vector<StampedFile> files;  ///< the scene's file, and the buffers and images that it names; empty: built in
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Node> nodes;
    glm::dmat4 placement{1.0};  ///< applied to root nodes, cameras and lights: see place()
    std::vector<Object> objects;
    std::vector<HiddenObject> hidden;  ///< see hide_objects(), ascending by place
    std::vector<SceneCamera> cameras;
    std::vector<SceneLight> lights;
    /// Suggested settings (key, value), used where the user set nothing.
    std::vector<std::pair<std::string, std::string>> suggested;
    std::vector<std::string> warnings;  ///< data of the file that was dropped or approximated, and the reason
    /// Parts of the file that an export of the scene lacks, one sentence each.
    std::vector<std::string> not_written;
    std::string far_objects;  ///< far_objects_text() of a file's scene; empty: no object is far from the rest
    bool looks_z_up = false;  ///< looks_z_up() of a file's scene: its z axis probably points up
    Bounds bounds;            ///< world, with hidden objects, without the ground; set by finalise()
    Bounds main_part;      ///< without far-off parts, before `placement`; empty: none is far off. See set_main_part()
    Bounds ground_bounds;  ///< world, of the ground disc; empty: no disc. Set by finalise()
    Bounds bounds_without_floor;        ///< world, of objects_without_floor(); set by finalise()
    bool has_floor = false;             ///< the file has its own floor and needs no ground disc: see add_ground()
    std::vector<glm::dvec3> framed;     ///< extreme_points() of a file's scene in its first pose; empty: not computed
    Bounds framed_bounds;               ///< main_bounds() in the pose of `framed`, before `placement`
    Bounds animation_bounds;            ///< `bounds` over a whole animation, before `placement`; empty: not computed
    int animation_bounds_of = -1;       ///< animation of `animation_bounds`; -1: none. See measure_animation_bounds()
    std::uint64_t id = 0;               ///< unique per finalise() in this process; part of cache keys
    std::size_t dropped_triangles = 0;  ///< degenerate triangles that finalise() removed
    std::shared_ptr<const Rig> rig;     ///< animations; null: none
    TrackedMemory held;                 ///< memory of nodes and objects, for the memory report; set by finalise()

    /// Returns the number of visible (not hidden) objects in the scene, without the ground disc.
    std::size_t object_count() const;
    /// Returns the number of triangles of all visible (not hidden) objects in the scene. Counts each instance; leaves
    /// out the ground disc.
    std::size_t triangle_count() const;
};

/// Validates and completes a scene whose lists a loader has filled: the last step of every loader. Drops non-finite
/// meshes and degenerate triangles, with warnings. Computes missing normals, world transforms, unique node paths and
/// bounds.
/// @throws Error when an index, material, node or mesh reference is out of range
void finalise(Scene& scene);

/// Updates world transforms, bounds and id of a scene after Node::local or the vertices of deformed meshes have
/// changed. Drops degenerate triangles of deformed meshes, without warnings.
void refresh(Scene& scene);

/// Hides the objects of the nodes with these paths, and shows all others. Hidden objects are not drawn and cast no
/// shadow. They still count in Scene::bounds, so that cameras that frame the scene do not move. Gives the scene a new
/// id if anything changes.
void hide_objects(Scene& scene, const std::set<std::string>& paths);

/// Returns the settings of an object (object.PATH.*), such as whether it casts and receives shadows; the defaults where
/// `settings` do not name the object.
const ObjectSettings& object_settings(const Scene& scene, const Settings& settings, const Object& object);

/// Returns true when the condition number of a transform is small, so that normals and rays can be transformed in
/// single precision.
bool is_well_conditioned(const glm::dmat3& m);

/// Returns all objects of a scene, shown and hidden, in the order of its file.
std::vector<const Object*> all_objects(const Scene& scene);

/// Returns the objects of a scene without its ground disc and floors, which are thin, low objects nearly as wide as
/// main_bounds(). Includes hidden objects. If the scene has only floors, returns all objects but the ground disc.
std::vector<const Object*> objects_without_floor(const Scene& scene);

/// Places a scene in the world: transforms its objects, cameras and lights from the coordinates of its file by
/// `placement`, which replaces the previous placement. Calls refresh(). The suggested settings do not change.
void place(Scene& scene, const glm::dmat4& placement);

/// Returns the factor by which Scene::placement scales lengths.
double placement_scale(const Scene& scene);

/// Returns the world-space bounds of a scene without objects and vertices far from the rest (Scene::main_part).
/// Scene::bounds where nothing lies far off.
Bounds main_bounds(const Scene& scene);

/// Returns the world-space bounds of a scene for fitting shadow maps: those over the whole animation
/// (Scene::animation_bounds) where known, else Scene::bounds.
Bounds light_fit_bounds(const Scene& scene);

}  // namespace si
