// Animated scenes: node animation, morph targets and skins. A scene is posed once, on the CPU, so that every pass and
// the ray-traced reference see the same triangles.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace si {

/// Interpolation between keyframes (glTF 2.0).
enum class Interpolation { Step, Linear, Cubic };
/// Property of a node that an animation channel changes; Weights are those of morph targets.
enum class AnimatedProperty { Translation, Rotation, Scale, Weights };

/// Keyframes of one property of one node (glTF 2.0, section 3.11).
struct AnimationChannel {
    int node = 0;  ///< index into Scene::nodes
    AnimatedProperty property = AnimatedProperty::Translation;
    Interpolation interpolation = Interpolation::Linear;
    std::size_t width = 3;       ///< numbers per key: 3, 4 (x y z w), or the count of morph targets
    std::vector<float> times_s;  ///< ascending
    std::vector<float> values;   ///< width numbers per key; Cubic: in-tangent, value, out-tangent
};

/// Named animation of a scene: keyframe channels that play together.
struct Animation {
    std::string name;
    double duration_s = 0;
    std::vector<AnimationChannel> channels;
};

/// Rest pose of a node: its transform and morph weights when no animation plays.
struct NodeRestPose {
    bool has_trs = true;  ///< false: Node::local is a matrix that no channel may change
    glm::dvec3 translation{0}, scale{1};
    glm::dquat rotation{1, 0, 0, 0};
    std::vector<float> weights;  ///< weights of the morph targets of the node's mesh
};

/// Animations of a scene and the rest pose of its nodes. Nodes, cameras and lights are indexed as in Scene.
struct Rig {
    std::vector<Animation> animations;
    std::vector<NodeRestPose> rest;              ///< rest pose of each node
    std::vector<int> camera_nodes, light_nodes;  ///< node that carries each camera and light
};

/// Joints of a skinned mesh and their inverse bind matrices (glTF 2.0).
struct Skin {
    std::vector<int> joints;  ///< nodes of the scene
    std::vector<glm::dmat4> inverse_bind;
};

/// Undeformed vertices of a mesh with its morph targets and skin weights, from which each pose is computed. The
/// vertices have the order of the deformed Mesh. Copies of a scene share this source.
struct DeformSource {
    /// Offsets of one morph target, added to the vertices of a mesh.
    struct Target {
        std::vector<glm::vec3> positions, normals, tangents;  ///< empty, or one offset per vertex
    };
    /// Up to four joints of a skin that move one vertex, and their weights.
    struct Influence {
        std::array<std::uint16_t, 4> joints{};
        glm::vec4 weights{0};
    };
    std::vector<glm::vec3> positions, normals;  ///< normals empty: flat normals are computed for each pose
    std::vector<glm::vec4> tangents;
    SharedArray<std::uint32_t> indices;
    std::vector<Target> targets;
    std::vector<Influence> influences;  ///< influence_sets per vertex, contiguous; weights sum to 1
    std::size_t influence_sets = 0;
};

/// Link from one Mesh of a scene to the data that deforms it: undeformed vertices, skin, and the nodes that drive the
/// pose.
struct Deformer {
    std::shared_ptr<const DeformSource> source;
    std::shared_ptr<const Skin> skin;  ///< null: only morphed
    int node = 0;                      ///< node of the file's mesh: its morph weights and its mirroring apply
    /// Node of a skinned object: a root that follows the first joint, mirrored where `node` is; -1: no skin.
    int placement = -1;
};

/// Poses a scene at a time of one of its animations. Updates node transforms, deformed vertices, bounds, cameras,
/// lights, and the suggested settings that follow from these. Resets Scene::placement and gives the scene a new id.
/// Does nothing for a scene without a rig (animations and rest pose).
/// @param animation index; -1: the rest pose @param time_s seconds; clamped to the first and last key
/// @throws Error when there is no such animation
void pose(Scene& scene, int animation, double time_s);

/// Poses nodes, deformed vertices, cameras and lights of a scene, but does not update its bounds and id. For loaders,
/// which call finalise() afterwards. @param animation index; -1: the rest pose @throws Error when there is no such
/// animation
void apply_pose(Scene& scene, int animation, double time_s);

/// Computes the bounds of a scene over a whole animation, for fitting shadow maps whose area must not change with the
/// pose. Sets Scene::animation_bounds, and Object::animation_bounds of every object that moves or deforms. Poses a copy
/// of the scene at all keys and at steps between them, and pads by the curvature of the motion. Does nothing when the
/// bounds of this animation are known already.
/// @param animation index; -1 clears the bounds
void measure_animation_bounds(Scene& scene, int animation);

/// Returns true when the scene has this animation and the animation lasts longer than 0 s. Casters can then move, and
/// caching the static casters may save time. @param animation index; -1: none
bool is_animated(const Scene& scene, int animation);

/// Interpolates an animation channel at a time in seconds, clamped to the first and last key. Returns
/// AnimationChannel::width numbers; a rotation is a normalised quaternion, x y z w.
std::vector<float> sample_channel(const AnimationChannel& channel, double time_s);

}  // namespace si
