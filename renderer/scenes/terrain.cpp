#include "renderer/scenes/terrain.h"

#include <algorithm>
#include <cmath>

namespace si {
namespace {

/// Returns a hashed value in [-1, 1) for a lattice point.
double lattice(std::int32_t x, std::int32_t z, std::uint32_t seed) {
    std::uint32_t h = seed + std::uint32_t(x) * 0x9E3779B1u + std::uint32_t(z) * 0x85EBCA77u;
    h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
    h = (h ^ (h >> 12)) * 0x297A2D39u;
    return (h ^ (h >> 15)) * (2.0 / 4294967296.0) - 1;
}

double smoothstep(double lo, double hi, double x) {
    const double t = std::clamp((x - lo) / (hi - lo), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

glm::dvec3 field_colour(double x, double z) {
    // Strips of farmland, on a grid rotated against the village's.
    const double c = std::cos(0.42), s = std::sin(0.42);
    const auto i = std::int32_t(std::floor((c * x - s * z) / 62)), j = std::int32_t(std::floor((s * x + c * z) / 105));
    const double pick = lattice(i, j, 77);
    if (pick < -0.45) return {0.36, 0.31, 0.10};  // ripe corn
    if (pick < 0.0) return {0.20, 0.27, 0.07};    // meadow
    if (pick < 0.5) return {0.13, 0.20, 0.05};    // clover
    return {0.22, 0.15, 0.09};                    // ploughed
}

glm::dvec3 land_colour(double x, double z, double height, double slope) {
    const double distance = std::hypot(x, z), patch = smooth_noise(x / 45, z / 45, 5);
    const glm::dvec3 grass = glm::mix(glm::dvec3(0.15, 0.20, 0.06), glm::dvec3(0.23, 0.26, 0.09), 0.5 + 0.5 * patch);
    glm::dvec3 colour = glm::mix(field_colour(x, z), grass, smoothstep(330, 390, distance + 40 * patch));
    colour = glm::mix(grass * 0.9 + glm::dvec3(0.05, 0.03, 0.01), colour, smoothstep(90, 140, distance));
    colour = glm::mix(colour, glm::dvec3(0.30, 0.28, 0.25), smoothstep(0.45, 0.75, slope + 0.08 * patch));
    colour = glm::mix(colour, glm::dvec3(0.78, 0.79, 0.80),
                      smoothstep(205, 250, height + 18 * patch) * (1 - smoothstep(0.8, 1.1, slope)));
    return glm::mix(glm::dvec3(0.38, 0.33, 0.22), colour, smoothstep(kWaterLevel_m - 0.5, kWaterLevel_m + 2.5, height));
}

}  // namespace

double smooth_noise(double x, double z, std::uint32_t seed) {
    const double fx = std::floor(x), fz = std::floor(z), tx = x - fx, tz = z - fz;
    const auto i = std::int32_t(fx), j = std::int32_t(fz);
    const auto ease = [](double t) { return t * t * t * (t * (6 * t - 15) + 10); };
    const double u = ease(tx), v = ease(tz);
    const double a = lattice(i, j, seed), b = lattice(i + 1, j, seed), c = lattice(i, j + 1, seed),
                 d = lattice(i + 1, j + 1, seed);
    return (a + (b - a) * u) * (1 - v) + (c + (d - c) * u) * v;
}

double terrain_height(double x, double z) {
    double hills = 0, amplitude = 1, total = 0, scale = 1.0 / 420;
    for (std::uint32_t octave = 0; octave < 5; ++octave) {
        hills += amplitude * smooth_noise(x * scale + 13.7, z * scale - 4.2, 100 + octave);
        total += amplitude;
        amplitude *= 0.45;
        scale *= 2.1;
    }
    hills *= 62 / total;
    // Mountains close the valley to the north and the sides; a lake lies east of the village.
    const double distance = std::hypot(x, z);
    // The small constant rounds the crests to more than a cell.
    const double ridge = 1 - std::hypot(smooth_noise(x / 310 + 5, z / 310 + 8, 40), 0.12);
    const double rim = smoothstep(430, 980, std::hypot(0.85 * x, std::min(z, 0.45 * z)));
    double height = hills + rim * (70 + 190 * ridge * ridge);
    height -= 46 * std::exp(-(std::pow((x - 330) / 170, 2) + std::pow((z + 130) / 120, 2)));
    return height * smoothstep(0.35 * kVillageRadius_m, 2.2 * kVillageRadius_m, distance);
}

double terrain_slope(double x, double z) {
    const double d = 2;
    return std::hypot(terrain_height(x + d, z) - terrain_height(x - d, z),
                      terrain_height(x, z + d) - terrain_height(x, z - d)) /
           (2 * d);
}

Mesh make_terrain(int cells) {
    Mesh mesh;
    mesh.name = "terrain";
    const double step = kTerrainSize_m / cells;
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) {
            const double x = step * (i - 0.5 * cells), z = step * (j - 0.5 * cells), y = terrain_height(x, z);
            const double d = step;  // as wide as the facets that meet here
            const glm::dvec3 n = glm::normalize(glm::dvec3(terrain_height(x - d, z) - terrain_height(x + d, z), 2 * d,
                                                           terrain_height(x, z - d) - terrain_height(x, z + d)));
            mesh.positions.emplace_back(x, y, z);
            mesh.normals.emplace_back(n);
            mesh.colours.emplace_back(land_colour(x, z, y, terrain_slope(x, z)), 1.0);
            if (i == 0 || j == 0) continue;
            const auto v = std::uint32_t(mesh.positions.size() - 1), above = v - std::uint32_t(cells) - 1;
            mesh.indices.append({above - 1, v - 1, v, above - 1, v, above});
        }
    return mesh;
}

}  // namespace si
