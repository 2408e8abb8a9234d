// A scene as the renderer, the light fit and the ray-traced truth see it: flat lists of triangles, materials,
// textures and placed objects. Positions in metres, y up, right-handed; transforms in double.
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

#include "renderer/base/held.h"
#include "renderer/base/shared_array.h"

namespace si {

/// Eight corners of a box.
using Box = std::array<glm::dvec3, 8>;

struct Bounds {
    glm::dvec3 lo{std::numeric_limits<double>::infinity()};
    glm::dvec3 hi{-std::numeric_limits<double>::infinity()};
    bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
    glm::dvec3 centre() const { return empty() ? glm::dvec3(0) : 0.5 * lo + 0.5 * hi; }
    /// Half the diagonal; 0 when empty.
    double radius() const { return empty() ? 0 : 0.5 * glm::length(hi - lo); }
    void add(const glm::dvec3& p) {
        lo = glm::min(lo, p);
        hi = glm::max(hi, p);
    }
    void add(const Bounds& b) {
        lo = glm::min(lo, b.lo);
        hi = glm::max(hi, b.hi);
    }
    /// The eight corners moved by `m`; corner i has hi instead of lo of x, y, z where bit 0, 1, 2 of i is set.
    Box corners(const glm::dmat4& m = glm::dmat4(1.0)) const;
    /// The box around this box's eight corners moved by `m`; empty stays empty.
    Bounds transformed(const glm::dmat4& m) const;
};

enum class TextureWrap { Repeat, Clamp, Mirror };

struct Texture {
    std::string name;
    int width = 0, height = 0;
    SharedArray<std::uint8_t> rgba;  ///< width*height*4, row 0 is v = 0 (glTF: the top of the image)
    bool srgb = true;
    TextureWrap wrap_s = TextureWrap::Repeat, wrap_t = TextureWrap::Repeat;
    bool nearest_mag = false, nearest_min = false, mipmaps = true;
};

enum class AlphaMode { Opaque, Mask, Blend };

struct Material {
    std::string name;
    glm::vec4 base_colour{0.8f, 0.8f, 0.8f, 1.0f};  ///< linear
    int base_colour_texture = -1;
    int normal_texture = -1;
    float normal_scale = 1;
    AlphaMode alpha = AlphaMode::Opaque;
    float alpha_cutoff = 0.5f;
    bool double_sided = false;
    bool unlit = false;
    bool operator==(const Material&) const = default;
};

struct Deformer;  // renderer/scene/animation.h
struct Rig;

/// Triangles of one material. All attribute arrays are empty or as long as `positions`.
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

struct Node {
    std::string name;
    std::string path;  ///< unique, "Parent/Child"; set by finalise()
    int parent = -1;   ///< always smaller than the node's own index
    glm::dmat4 local{1.0};
    glm::dmat4 world{1.0};  ///< set by finalise()
};

/// One mesh placed once. Several objects may share node and mesh (primitives, instancing).
struct Object {
    int node = 0;
    int mesh = 0;
    glm::dmat4 instance{1.0};  ///< applied before the node's world transform
    glm::dmat4 world{1.0};     ///< set by finalise()
    bool ground = false;       ///< see add_ground(): receives, never casts, and is no part of Scene::bounds
    Bounds travel;             ///< see measure_travel(): before Scene::placement; empty: it stands where `world` says
};

/// One that is left out of Scene::objects for now.
struct HiddenObject {
    std::size_t place = 0;  ///< its index among all
    Object object;
};

struct SceneCamera {
    std::string name;
    glm::dmat4 world{1.0};  ///< looks along -z
    glm::dmat4 home{1.0};   ///< `world` before Scene::placement; set by finalise()
    bool orthographic = false;
    double fov_y_deg = 45;
    double height = 10;
    double near = 0, far = 0;  ///< 0: automatic
};

struct SceneLight {
    std::string name;
    int type = 0;           ///< LightType
    glm::dmat4 world{1.0};  ///< shines along -z
    glm::dmat4 home{1.0};   ///< `world` before Scene::placement; set by finalise()
    glm::dvec3 colour{1};
    double intensity = 1;
    double range = 0;  ///< 0: unlimited
    double inner_cone_rad = 0, outer_cone_rad = 0.785398163397448;
};

struct Scene {
    std::string name;                      ///< built-in key, or the file's path
    std::string about;                     ///< a sentence
    std::vector<std::string> file_scenes;  ///< names (or "") of the scenes in the file that this one is from
    int file_scene = 0;                    ///< which of them this is
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Node> nodes;
    glm::dmat4 placement{1.0};  ///< of all nodes without a parent, cameras and lights: see place()
    std::vector<Object> objects;
    std::vector<HiddenObject> hidden;  ///< see hide_objects(), ascending by place
    std::vector<SceneCamera> cameras;
    std::vector<SceneLight> lights;
    /// Settings that suit this scene (key, value), used where the user set nothing.
    std::vector<std::pair<std::string, std::string>> suggested;
    std::vector<std::string> warnings;  ///< what was dropped or approximated, and why
    Bounds bounds;                      ///< world, with what is hidden, without the ground; set by finalise()
    Bounds ground_bounds;               ///< world, of the ground put under it; empty: there is none. Likewise
    Bounds standing;  ///< `bounds` without the file's own floor, or all of it where nothing else is there. Likewise
    bool has_floor = false;  ///< the file brings what shadows fall on, so that it needs no ground: see add_ground()
    std::vector<glm::dvec3> framed;     ///< outermost_points() as a file's scene is first posed; none: not asked for
    Bounds framed_bounds;               ///< `bounds` then, before `placement`
    Bounds travel;                      ///< `bounds` over all of an animation, before `placement`; empty: not asked for
    int travel_of = -1;                 ///< which animation; -1: none. See measure_travel()
    std::uint64_t id = 0;               ///< unique per finalise() in this process; part of cache keys
    std::size_t dropped_triangles = 0;  ///< degenerate, set by finalise()
    std::shared_ptr<const Rig> rig;     ///< animations; null: nothing moves
    HeldMemory held;                    ///< nodes and objects, which copies do not share; set by finalise()

    std::size_t object_count() const;    ///< without the ground
    std::size_t triangle_count() const;  ///< over objects, instances counted, without the ground
};

/// Drops non-finite meshes and degenerate triangles (with warnings), makes missing normals flat, computes
/// world transforms, unique node paths and bounds. Loaders and built-in scenes end with it.
/// @throws Error when an index, material, node or mesh reference is out of range.
void finalise(Scene& scene);

/// After Node::local or vertices of deformed meshes changed: world transforms and bounds again, degenerate triangles of
/// deformed meshes dropped, and a new id. Nothing else changes; no warnings are added.
void refresh(Scene& scene);

/// Leaves what the nodes with these paths place out of Scene::objects, and brings back all else: what is hidden is not
/// drawn, casts and receives nothing, but keeps its share of Scene::bounds, so that views of the scene stay. A new id
/// where that changes anything.
void hide_objects(Scene& scene, const std::set<std::string>& paths);

/// Shown and hidden, in the order of the scene's file.
std::vector<const Object*> all_objects(const Scene& scene);

/// Those that Scene::standing bounds.
std::vector<const Object*> standing_objects(const Scene& scene);

/// Moves, turns and scales all of the scene from where its nodes have it, whatever placed it before: refresh(), and
/// cameras and lights with it. What the scene suggests stays as it was.
void place(Scene& scene, const glm::dmat4& placement);

}  // namespace si
