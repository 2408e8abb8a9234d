// A jointed figure in the manner of a wooden lay figure.
#pragma once

#include <string>

#include "renderer/scene/scene.h"

namespace si {

/// Angles in degrees; positive bends forward (hip, shoulder), backward (knee) or upward (elbow).
struct Pose {
    double lean = 0, twist = 0, head_turn = 0, head_nod = 0;
    double hip[2] = {0, 0}, knee[2] = {0, 0}, leg_out[2] = {4, 4};          ///< left, right
    double shoulder[2] = {0, 0}, elbow[2] = {12, 12}, arm_out[2] = {9, 9};  ///< left, right
};

/// Meshes that all figures of a scene share.
struct FigureMeshes {
    int pelvis, belly, chest, neck, head, joint, upper_arm, forearm, hand, thigh, shin, foot;
};
FigureMeshes add_figure_meshes(Scene& scene, int wood, int joints);

/// A figure 1.75 m tall that faces +z of `place`, with its lowest point exactly at the height of `place`.
/// Returns its topmost node.
int add_figure(Scene& scene, const FigureMeshes& meshes, std::string name, int parent, const glm::dmat4& place,
               const Pose& pose);

}  // namespace si
