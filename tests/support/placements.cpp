#include "tests/support/placements.h"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/scene/main_part.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/param.h"
#include "tests/support/combinations.h"

namespace si::test {
namespace {

// Offsets off any grid: no sums of few powers of two.
constexpr Distance kDistances[] = {{"home"},
                                   {"100 m", {70.3, -13.7, 70.1}},
                                   {"10 km", {-7071.3, 130.7, 7071.1}},
                                   {"1000 km", {707106.3, -1300.7, -707108.1}},
                                   {"10000 km", {-7071067.3, 13000.7, -7071063.9}},
                                   {"1024 m", {1024, -2048, 512}, true},
                                   {"1048576 m", {1048576, 524288, -1048576}, true},
                                   {"8388608 m", {-8388608, 4194304, 8388608}, true}};
constexpr Scale kScales[] = {{"as it is"},          {"x 0.001", 1e-3},  {"x 0.1", 0.1},
                             {"x 1000", 1e3},       {"x 1000000", 1e6}, {"x 1/1024", 1.0 / 1024, true},
                             {"x 1024", 1024, true}};
constexpr LightDirection kLights[] = {{"its own light", {}, false},
                                      {"from above", LightAngles{0, 90}, true},
                                      {"from above, turned", LightAngles{-270, 90}, false},
                                      {"from +z", LightAngles{0, 0}, true},
                                      {"from -z", LightAngles{180, 0}, true},
                                      {"from +x", LightAngles{90, 0}, false},
                                      {"from -x", LightAngles{-90, 0}, false},
                                      {"from +x, 45 up", LightAngles{90, 45}, false},
                                      {"from -z, 45 up", LightAngles{-180, 45}, true},
                                      {"from below", LightAngles{0, -90}, false}};

bool may_stand(const Placement& p) {
    return !p.mirrored || light_directions()[p.light].mirrors;
}

}  // namespace

std::span<const Distance> distances() {
    return kDistances;
}
std::span<const Scale> scales() {
    return kScales;
}
std::span<const LightDirection> light_directions() {
    return kLights;
}

std::string Placement::name() const {
    return fmt::format("{}, {}, {}{}", kDistances[distance].name, kScales[scale].name, kLights[light].name,
                       mirrored ? ", mirrored" : "");
}

bool Placement::exact() const {
    if (mirrored || (distance > 0 && !kDistances[distance].exact) || (scale > 0 && !kScales[scale].exact)) return false;
    // Shaders count from a grid whose spacing is up to 32 sizes of these scenes.
    const glm::dvec3 steps = kDistances[distance].offset / (32 * kScales[scale].factor);
    return steps == glm::round(steps);
}

glm::dmat4 Placement::matrix() const {
    const double f = kScales[scale].factor;
    const glm::dvec3& at = kDistances[distance].offset;
    return moved(at.x, at.y, at.z) * scaled(mirrored ? -f : f, f, f);
}

std::vector<Placement> single_factor_placements() {
    std::vector<Placement> out;
    for (std::size_t i = 1; i < std::size(kDistances); ++i) out.push_back({.distance = i});
    for (std::size_t i = 1; i < std::size(kScales); ++i) out.push_back({.scale = i});
    for (std::size_t i = 1; i < std::size(kLights); ++i) out.push_back({.distance = 5, .light = i});
    out.push_back({.light = 8, .mirrored = true});
    return out;
}

std::vector<Placement> exact_placements() {
    std::vector<Placement> out;
    for (const Placement& p : all_placements())
        if (p.light == 0 && p.exact()) out.push_back(p);
    return out;
}

std::vector<Placement> all_placements() {
    std::vector<Placement> out;
    for (std::size_t d = 0; d < std::size(kDistances); ++d)
        for (std::size_t s = 0; s < std::size(kScales); ++s)
            for (std::size_t l = 0; l < std::size(kLights); ++l)
                for (const bool mirrored : {false, true})
                    if (const Placement p{d, s, l, mirrored}; may_stand(p) && !p.is_unmoved()) out.push_back(p);
    return out;
}

void place_scene(Scene& scene, const glm::dmat4& placed) {
    for (Node& node : scene.nodes)
        if (node.parent < 0) node.local = placed * node.local;
    for (SceneCamera& camera : scene.cameras) camera.world = placed * camera.world;
    finalise(scene);
    set_main_part(scene);
}

bool place_settings(Settings& settings, const Placement& placement) {
    LightSettings& light = settings.lights[0];
    if (const auto& angles = kLights[placement.light].angles) {
        light.azimuth = angles->azimuth;
        light.elevation = angles->elevation;
    }
    const double factor = kScales[placement.scale].factor;
    if (placement.mirrored) light.target_x = -light.target_x;
    bool within = true;
    for (const SettingRef& ref : changed_settings(settings)) {
        const Value value = get_value(settings, ref);
        const double* number = std::get_if<double>(&value);
        const std::string_view unit = shown_unit(settings, ref);
        if (!number || (unit != "m" && unit != "metres") || factor == 1) continue;
        const double scaled_by = *number * factor;
        within = within && (scaled_by == 0 || (std::abs(scaled_by) <= ref.param->max && scaled_by >= ref.param->min));
        set_value(settings, ref, scaled_by);
    }
    return within;
}

std::vector<PlacedCase> pairwise_placements(std::size_t cases, std::uint32_t seed) {
    // Factors: case, distance, scale, light, mirrored.
    const auto placement = [](const Combination& row) { return Placement{row[1], row[2], row[3], row[4] == 1}; };
    const auto pair_allowed = [](std::size_t a, std::size_t i, std::size_t b, std::size_t j) {
        return a != 3 || b != 4 || j != 1 || kLights[i].mirrors;
    };
    std::vector<PlacedCase> out;
    for (const Combination& row :
         pairwise_table({cases, std::size(kDistances), std::size(kScales), std::size(kLights), 2}, seed, pair_allowed,
                        [&](const Combination& candidate) { return may_stand(placement(candidate)); }))
        if (!placement(row).is_unmoved()) out.push_back({row[0], placement(row)});
    return out;
}

}  // namespace si::test
