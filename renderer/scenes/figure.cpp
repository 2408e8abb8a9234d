#include "renderer/scenes/figure.h"

#include <algorithm>
#include <limits>

#include "renderer/scenes/shapes.h"

namespace si {
namespace {

// Lengths between joints, metres.
constexpr double kThigh = 0.42, kShin = 0.41, kUpperArm = 0.29, kForearm = 0.25, kHipHalf = 0.10, kShoulderHalf = 0.20;

Mesh ellipsoid(double x, double y, double z) {
    return transformed(make_sphere(1, 24, 12), scaled(x, y, z));
}

/// Makes a limb that hangs down from its joint at the origin, thinner at the lower end.
Mesh limb(double length, double top, double bottom) {
    Mesh mesh = transformed(make_cylinder(bottom, length, 16, top), moved(0, -length, 0));
    append(mesh, make_sphere(top, 16, 8));
    append(mesh, transformed(make_sphere(bottom, 16, 8), moved(0, -length, 0)));
    return mesh;
}

/// Returns the lowest y of the objects below node `first`, in the space of that node's parent.
double lowest(const Scene& scene, std::size_t first) {
    std::vector<glm::dmat4> world(scene.nodes.size(), glm::dmat4(1));
    for (std::size_t i = first; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        world[i] = std::size_t(std::max(node.parent, 0)) >= first ? world[node.parent] * node.local : node.local;
    }
    double y = std::numeric_limits<double>::infinity();
    for (const Object& o : scene.objects) {
        if (std::size_t(o.node) < first) continue;
        for (const glm::vec3& p : scene.meshes[o.mesh].positions) y = std::min(y, (world[o.node] * glm::dvec4(p, 1)).y);
    }
    return y;
}

}  // namespace

FigureMeshes add_figure_meshes(Scene& scene, int wood, int joints) {
    FigureMeshes m{};
    m.pelvis = add_mesh(scene, "Pelvis", ellipsoid(0.155, 0.105, 0.110), wood);
    m.belly = add_mesh(scene, "Belly", ellipsoid(0.120, 0.130, 0.095), joints);
    m.chest = add_mesh(scene, "Chest", ellipsoid(0.175, 0.205, 0.118), wood);
    m.neck = add_mesh(scene, "Neck", transformed(make_capsule(0.048, 0.10, 20), moved(0, -0.02, 0)), joints);
    m.head = add_mesh(scene, "Head", ellipsoid(0.090, 0.125, 0.105), wood);
    m.joint = add_mesh(scene, "Joint", make_sphere(0.058, 16, 8), joints);
    m.upper_arm = add_mesh(scene, "Upper arm", limb(kUpperArm, 0.048, 0.036), wood);
    m.forearm = add_mesh(scene, "Forearm", limb(kForearm, 0.038, 0.026), wood);
    m.hand = add_mesh(scene, "Hand", transformed(ellipsoid(0.022, 0.085, 0.042), moved(0, -0.07, 0)), wood);
    m.thigh = add_mesh(scene, "Thigh", limb(kThigh, 0.080, 0.052), wood);
    m.shin = add_mesh(scene, "Shin", limb(kShin, 0.054, 0.034), wood);
    m.foot = add_mesh(scene, "Foot", transformed(ellipsoid(0.046, 0.040, 0.125), moved(0, -0.035, 0.070)), wood);
    return m;
}

int add_figure(Scene& scene, const FigureMeshes& m, std::string name, int parent, const glm::dmat4& place,
               const Pose& pose) {
    const glm::dvec3 x_axis(1, 0, 0), z_axis(0, 0, 1);
    const int root = add_node(scene, std::move(name), parent, place);
    const int hips = add_object(scene, "Pelvis", root, m.pelvis);
    const int belly = add_object(scene, "Belly", hips, m.belly,
                                 moved(0, 0.10, 0) * turned(pose.lean / 2, x_axis) * turned(pose.twist / 2));
    const int chest = add_object(scene, "Chest", belly, m.chest,
                                 turned(pose.lean / 2, x_axis) * turned(pose.twist / 2) * moved(0, 0.235, 0));
    const int neck = add_object(scene, "Neck", chest, m.neck, moved(0, 0.19, 0));
    add_object(scene, "Head", neck, m.head,
               moved(0, 0.10, 0) * turned(pose.head_turn) * turned(pose.head_nod, x_axis) * moved(0, 0.11, 0.012));
    for (int side = 0; side < 2; ++side) {
        const double sign = side == 0 ? 1 : -1;  // the figure's left is +x when it faces +z
        const std::string which = side == 0 ? "Left " : "Right ";
        const int shoulder =
            add_object(scene, which + "shoulder", chest, m.joint,
                       moved(sign * kShoulderHalf, 0.105, 0) * turned(sign * pose.arm_out[side], z_axis) *
                           turned(-pose.shoulder[side], x_axis));
        add_object(scene, which + "upper arm", shoulder, m.upper_arm);
        const int elbow = add_object(scene, which + "forearm", shoulder, m.forearm,
                                     moved(0, -kUpperArm, 0) * turned(-pose.elbow[side], x_axis));
        add_object(scene, which + "hand", elbow, m.hand, moved(0, -kForearm, 0));
        const int hip = add_object(scene, which + "hip", hips, m.joint,
                                   moved(sign * kHipHalf, -0.05, 0) * turned(sign * pose.leg_out[side], z_axis) *
                                       turned(-pose.hip[side], x_axis));
        add_object(scene, which + "thigh", hip, m.thigh);
        const int knee =
            add_object(scene, which + "shin", hip, m.shin, moved(0, -kThigh, 0) * turned(pose.knee[side], x_axis));
        // The ankle keeps the sole level.
        add_object(scene, which + "foot", knee, m.foot,
                   moved(0, -kShin, 0) * turned(pose.hip[side] - pose.knee[side], x_axis) *
                       turned(-sign * pose.leg_out[side], z_axis));
    }
    scene.nodes[hips].local = moved(0, -lowest(scene, std::size_t(hips)), 0);
    return root;
}

}  // namespace si
