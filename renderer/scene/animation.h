// Moving scenes: node animation, morph targets and skins. A scene is posed on the CPU, once, so that every pass and the
// ray-traced truth see the same triangles.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace si {

enum class Interpolation { Step, Linear, Cubic };
enum class AnimatedProperty { Translation, Rotation, Scale, Weights };

/// Keyframes of one property of one node (glTF 2.0, section 3.11).
struct AnimationChannel {
    int node = 0;  ///< of the scene
    AnimatedProperty property = AnimatedProperty::Translation;
    Interpolation interpolation = Interpolation::Linear;
    std::size_t width = 3;       ///< numbers a key: 3, 4 (x y z w), or the count of morph targets
    std::vector<float> times_s;  ///< ascending
    std::vector<float> values;   ///< width numbers a key; Cubic: in-tangent, value, out-tangent
};

struct Animation {
    std::string name;
    double duration_s = 0;
    std::vector<AnimationChannel> channels;
};

/// What a node is when nothing animates it.
struct NodeRestPose {
    bool has_trs = true;  ///< false: Node::local is a matrix that no channel may change
    glm::dvec3 translation{0}, scale{1};
    glm::dquat rotation{1, 0, 0, 0};
    std::vector<float> weights;  ///< of the morph targets of its mesh
};

/// Everything that moves in a scene. Nodes, cameras and lights are numbered as in the scene.
struct Rig {
    std::vector<Animation> animations;
    std::vector<NodeRestPose> rest;  ///< for each node
    std::vector<int> camera_nodes, light_nodes;
};

struct Skin {
    std::vector<int> joints;  ///< nodes of the scene
    std::vector<glm::dmat4> inverse_bind;
};

/// A mesh as it was before any morph or skin; vertices as in the Mesh that it deforms. Shared by its copies.
struct DeformSource {
    struct Target {
        std::vector<glm::vec3> positions, normals, tangents;  ///< offsets; empty or one a vertex
    };
    struct Influence {
        std::array<std::uint16_t, 4> joints{};
        glm::vec4 weights{0};
    };
    std::vector<glm::vec3> positions, normals;  ///< normals empty: flat ones are made anew for each pose
    std::vector<glm::vec4> tangents;
    SharedArray<std::uint32_t> indices;
    std::vector<Target> targets;
    std::vector<Influence> influences;  ///< influence_sets a vertex, together; weights sum to 1
    std::size_t influence_sets = 0;
};

/// How one Mesh of a scene follows its nodes.
struct Deformer {
    std::shared_ptr<const DeformSource> source;
    std::shared_ptr<const Skin> skin;  ///< null: only morphed
    int node = 0;                      ///< whose weights count
    int placement = -1;  ///< with a skin: the root node, moved along with the first joint, that the object stands on
};

/// Poses the scene by animation `animation` (-1: at rest) at `time_s`, held before the first and after the last key:
/// node transforms, deformed vertices, bounds, cameras, lights and what they suggest; the scene gets a new id, and is
/// placed nowhere (Scene::placement).
/// Does nothing to a scene without a rig. @throws Error when there is no such animation.
void pose(Scene& scene, int animation, double time_s);

/// The same without bounds and id, for a loader that ends with finalise().
void apply_pose(Scene& scene, int animation, double time_s);

/// Finds for each object that animation `animation` moves or deforms the box that holds it at all times
/// (Object::travel), and the scene's (Scene::travel), by which fits go that shall not follow the pose. Posed at all
/// keys and at steps between them, with room for how far it bends outwards from step to step. Once for a scene and an
/// animation: what is known is kept. A copy is posed; this scene's pose stays. -1 forgets what was found.
void measure_animation_bounds(Scene& scene, int animation);

/// Whether time moves anything: an animation is chosen (scene.animation) and lasts.
bool moves(const Scene& scene, int animation);

/// The value of a channel at `time_s`; rotations normalised, x y z w.
std::vector<float> sample(const AnimationChannel& channel, double time_s);

}  // namespace si
