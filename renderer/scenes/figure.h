// Jointed wooden figure (a lay figure) for built-in scenes.
#pragma once

#include <string>

#include "renderer/scene/scene.h"

namespace si {

/// Joint angles of a wooden figure in degrees. Positive angles bend forward (hip, shoulder), backward (knee) or upward
/// (elbow).
struct Pose {
    double lean = 0, twist = 0, head_turn = 0, head_nod = 0;
    double hip[2] = {0, 0}, knee[2] = {0, 0}, leg_out[2] = {4, 4};          ///< left, right
    double shoulder[2] = {0, 0}, elbow[2] = {12, 12}, arm_out[2] = {9, 9};  ///< left, right
};

/// Mesh indices of a wooden figure's parts, shared by all figures of a scene.
struct FigureMeshes {
    int pelvis, belly, chest, neck, head, joint, upper_arm, forearm, hand, thigh, shin, foot;
};
/// Adds the meshes of a wooden figure's parts to a scene, to be shared by all its figures. Call once before
/// add_figure().
/// @param wood, joints indices of the materials of limbs and of joints
FigureMeshes add_figure_meshes(Scene& scene, int wood, int joints);

/// Adds a wooden figure, 1.75 m tall, to a scene. Returns the index of its topmost node.
/// @param meshes from add_figure_meshes() @param parent index of the parent node; -1: none
/// @param place transform of the figure: it faces +z, and its lowest point is at y = 0 @param pose joint angles
int add_figure(Scene& scene, const FigureMeshes& meshes, std::string name, int parent, const glm::dmat4& place,
               const Pose& pose);

}  // namespace si
