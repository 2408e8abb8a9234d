// Martin Newell's teapot (The Utilization of Procedure Models in Digital Image Synthesis, dissertation, University of
// Utah, 1975), with the bottom and the flattened proportions of the data that Crow printed (The Origins of the Teapot,
// IEEE Computer Graphics and Applications 7(1), 1987). The 306 published points are mostly symmetry: 24 of the 32
// patches are quarters turned about the axis, the other 8 halves of handle and spout. So an outline per ring is all
// that is stored.
#include "renderer/scenes/teapot.h"

#include <array>
#include <cmath>

namespace si {
namespace {

using Patch = std::array<std::array<glm::dvec3, 4>, 4>;  ///< z up, as published

/// A control point of an outline: distance from the axis, height, and the inner points of the quarter circle,
/// which are 0.56 of the radius everywhere but at the knob.
struct Ring {
    double radius, z, tangent;
    Ring(double r, double height) : Ring(r, height, 0.56 * r) {}
    Ring(double r, double height, double t) : radius(r), z(height), tangent(t) {}
};
// Each from the top outwards and down, so that the outside lies on the same side of all.
const Ring kOutlines[6][4] = {
    {{0, 3.15}, {0.8, 3.15, 0.45}, {0, 2.85}, {0.2, 2.7}},           // knob
    {{0.2, 2.7}, {0.4, 2.55}, {1.3, 2.55}, {1.3, 2.4}},              // lid
    {{1.4, 2.4}, {1.3375, 2.53125}, {1.4375, 2.53125}, {1.5, 2.4}},  // rim
    {{1.5, 2.4}, {1.75, 1.875}, {2, 1.35}, {2, 0.9}},                // body
    {{2, 0.9}, {2, 0.45}, {1.5, 0.225}, {1.5, 0.15}},                // foot
    {{1.5, 0.15}, {1.5, 0.075}, {1.425, 0}, {0, 0}},                 // bottom
};

/// A control section of handle or spout: inner and outer point in the plane y = 0, and the half width.
struct PotSection {
    double inner_x, inner_z, outer_x, outer_z, half_width;
};
const PotSection kTubes[4][4] = {
    {{-1.6, 2.025, -1.5, 2.25, 0.3},
     {-2.3, 2.025, -2.5, 2.25, 0.3},
     {-2.7, 2.025, -3, 2.25, 0.3},
     {-2.7, 1.8, -3, 1.8, 0.3}},
    {{-2.7, 1.8, -3, 1.8, 0.3},
     {-2.7, 1.575, -3, 1.35, 0.3},
     {-2.5, 1.125, -2.65, 0.9375, 0.3},
     {-2, 0.9, -1.9, 0.6, 0.3}},
    {{1.7, 1.425, 1.7, 0.6, 0.66},
     {2.6, 1.425, 3.1, 0.825, 0.66},
     {2.3, 2.1, 2.4, 2.025, 0.25},
     {2.7, 2.4, 3.3, 2.4, 0.25}},
    {{2.7, 2.4, 3.3, 2.4, 0.25},
     {2.8, 2.475, 3.525, 2.49375, 0.25},
     {2.9, 2.475, 3.45, 2.5125, 0.15},
     {2.8, 2.4, 3.2, 2.4, 0.15}},
};

Patch quarter(const Ring (&outline)[4], int turns) {
    Patch patch;
    for (int i = 0; i < 4; ++i) {
        const Ring& r = outline[i];
        const glm::dvec2 arc[4] = {{r.radius, 0}, {r.radius, r.tangent}, {r.tangent, r.radius}, {0, r.radius}};
        for (int j = 0; j < 4; ++j) {
            glm::dvec2 p = arc[j];
            for (int k = 0; k < turns; ++k) p = {-p.y, p.x};
            patch[i][j] = {p, r.z};
        }
    }
    return patch;
}

Patch half(const PotSection (&tube)[4], bool far_side) {
    Patch patch;
    for (int i = 0; i < 4; ++i) {
        const PotSection& s = tube[i];
        const double y = far_side ? s.half_width : -s.half_width;
        patch[i] = {glm::dvec3(s.inner_x, 0, s.inner_z),
                    {s.inner_x, y, s.inner_z},
                    {s.outer_x, y, s.outer_z},
                    {s.outer_x, 0, s.outer_z}};
        if (!far_side) {
            std::swap(patch[i][0], patch[i][3]);
            std::swap(patch[i][1], patch[i][2]);
        }
    }
    return patch;
}

/// Bernstein weights of degree 3 and their first derivatives.
void weights(double t, std::array<double, 4>& w, std::array<double, 4>& d) {
    const double s = 1 - t;
    w = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
    d = {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t};
}

struct Surface {
    glm::dvec3 point{0}, du{0}, dv{0}, duv{0};
};
Surface evaluate(const Patch& patch, double u, double v) {
    std::array<double, 4> wu, wv, du, dv;
    weights(u, wu, du);
    weights(v, wv, dv);
    Surface s;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            const glm::dvec3& p = patch[i][j];
            s.point += wu[i] * wv[j] * p;
            s.du += du[i] * wv[j] * p;
            s.dv += wu[i] * dv[j] * p;
            s.duv += du[i] * dv[j] * p;
        }
    return s;
}

/// The unit normal. Where a side of the patch shrinks to a point, d/dv is zero there and grows with the mixed
/// derivative away from it, in +u from the side u = 0 and in -u from the side u = 1.
glm::dvec3 normal(const Surface& s, double u) {
    const glm::dvec3 dv = glm::length(s.dv) > 1e-9 ? s.dv : (u < 0.5 ? s.duv : -s.duv);
    return glm::normalize(glm::cross(s.du, dv));
}

void add_patch(Mesh& mesh, const Patch& patch, int cells) {
    for (int i = 0; i <= cells; ++i)
        for (int j = 0; j <= cells; ++j) {
            const double u = double(i) / cells, v = double(j) / cells;
            const Surface s = evaluate(patch, u, v);
            const glm::dvec3 n = normal(s, u);
            mesh.positions.emplace_back(s.point.x, s.point.z, -s.point.y);
            mesh.normals.emplace_back(n.x, n.z, -n.y);
            mesh.uv.emplace_back(v, u);
            if (i == 0 || j == 0) continue;
            const auto d = std::uint32_t(mesh.positions.size() - 1), c = d - 1, b = d - std::uint32_t(cells) - 1,
                       a = b - 1;
            const auto& p = mesh.positions;
            if (p[a] != p[b]) mesh.indices.append({a, d, b});
            if (p[c] != p[d]) mesh.indices.append({a, c, d});
        }
}

}  // namespace

Mesh make_teapot(int cells) {
    Mesh mesh;
    mesh.name = "teapot";
    for (const auto& outline : kOutlines)
        for (int turns = 0; turns < 4; ++turns) add_patch(mesh, quarter(outline, turns), cells);
    for (const auto& tube : kTubes)
        for (bool far_side : {false, true}) add_patch(mesh, half(tube, far_side), cells);
    return mesh;
}

}  // namespace si
