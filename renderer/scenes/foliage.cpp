#include "renderer/scenes/foliage.h"

#include <algorithm>
#include <cmath>

#include "renderer/scenes/shapes.h"

namespace si {
namespace {

struct Leaf {
    glm::dvec2 base, tip;  ///< v upwards, 0..1
    double width;          ///< half width as a share of the length
    glm::dvec3 srgb;
};

/// Returns a position relative to a leaf: x along it from base (0) to tip (1), y across, in units of its length.
glm::dvec2 leaf_space(const Leaf& leaf, const glm::dvec2& p) {
    const glm::dvec2 axis = leaf.tip - leaf.base, d = p - leaf.base;
    const double length2 = glm::dot(axis, axis);
    return {glm::dot(d, axis) / length2, (axis.x * d.y - axis.y * d.x) / length2};
}

bool inside(const Leaf& leaf, const glm::dvec2& q) {
    if (q.x <= 0 || q.x >= 1) return false;
    // A lens that is widest before its middle.
    return std::abs(q.y) < leaf.width * 2.6 * std::sqrt(q.x) * (1 - q.x) * (0.62 + 0.38 * (1 - q.x));
}

std::vector<Leaf> sprig() {
    std::vector<Leaf> leaves;
    Random random(7);
    const auto tone = [&] {
        const double t = random.in(0, 1);
        return glm::mix(glm::dvec3(84, 112, 44), glm::dvec3(138, 152, 66), t);
    };
    for (int pair = 0; pair < 4; ++pair) {
        const glm::dvec2 base(0.5 + 0.015 * pair, 0.08 + 0.19 * pair);
        const double reach = 0.46 - 0.055 * pair;
        for (double side : {-1.0, 1.0}) {
            const double angle = glm::radians(34.0 + 6 * pair + random.in(-7, 7));
            leaves.push_back({base, base + reach * glm::dvec2(side * std::cos(angle), std::sin(angle)), 0.19, tone()});
        }
    }
    leaves.push_back({{0.56, 0.66}, {0.60, 0.985}, 0.21, tone()});
    leaves.push_back({{0.49, 0.0}, {0.58, 0.72}, 0.011, {104, 92, 52}});  // the stem
    return leaves;
}

}  // namespace

Texture make_sprig_texture(int size) {
    constexpr int kSub = 4;
    const std::vector<Leaf> leaves = sprig();
    Texture texture;
    texture.name = "Sprig";
    texture.width = texture.height = size;
    texture.wrap_s = texture.wrap_t = TextureWrap::Clamp;
    std::vector<std::uint8_t> rgba(std::size_t(size) * std::size_t(size) * 4);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            glm::dvec3 sum(0);
            int hits = 0;
            for (int s = 0; s < kSub * kSub; ++s) {
                const glm::dvec2 p((x + (s % kSub + 0.5) / kSub) / size, 1 - (y + (s / kSub + 0.5) / kSub) / size);
                for (auto leaf = leaves.rbegin(); leaf != leaves.rend(); ++leaf) {
                    const glm::dvec2 q = leaf_space(*leaf, p);
                    if (!inside(*leaf, q)) continue;
                    const bool rib = std::abs(q.y) < 0.012;
                    sum += leaf->srgb * (rib ? 1.22 : (q.y > 0 ? 1.0 : 0.90));
                    ++hits;
                    break;
                }
            }
            // Transparent texels get the leaves' mean colour, as filtering blends it into the edges.
            const glm::dvec3 colour = hits ? sum / double(hits) : glm::dvec3(108, 130, 55);
            std::uint8_t* out = &rgba[(std::size_t(y) * std::size_t(size) + std::size_t(x)) * 4];
            for (int c = 0; c < 3; ++c) out[c] = std::uint8_t(std::min(255.0, colour[c] + 0.5));
            out[3] = std::uint8_t(hits * 255 / (kSub * kSub));
        }
    texture.rgba = std::move(rgba);
    return texture;
}

Mesh make_leaf_cluster(double radius, double card_size, int cards, std::uint32_t seed) {
    Mesh mesh;
    Random random(seed);
    for (int i = 0; i < cards; ++i) {
        const glm::dvec3 outwards = random.direction();
        const glm::dvec3 centre = outwards * radius * std::cbrt(random.in(0.12, 1.0)) * glm::dvec3(1, 0.8, 1);
        // Cards face roughly outwards and upwards, as leaves turn to the light.
        const glm::dvec3 n = glm::normalize(outwards + 0.7 * random.direction() + glm::dvec3(0, 0.5, 0));
        const glm::dvec3 t = glm::normalize(glm::cross(n, random.direction())), b = glm::cross(n, t);
        const double half = 0.5 * card_size * random.in(0.8, 1.2);
        const auto first = std::uint32_t(mesh.positions.size());
        for (int k = 0; k < 4; ++k) {
            const double u = (k == 1 || k == 2), v = k >= 2;
            mesh.positions.emplace_back(centre + half * ((2 * u - 1) * t + (2 * v - 1) * b));
            mesh.normals.emplace_back(n);
            mesh.uv.emplace_back(u, 1 - v);
        }
        mesh.indices.append({first, first + 1, first + 2, first, first + 2, first + 3});
    }
    return mesh;
}

}  // namespace si
