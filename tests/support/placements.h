// Where a scene stands, how large it is and which way round, and where its light comes from: one table, over which the
// hard cases and the truth are compared with how they look at home.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"

namespace si::test {

/// A light's direction in place of a case's own, degrees.
struct LightAngles {
    double azimuth = 0, elevation = 0;
};

/// One factor of a placement, with its name.
struct Distance {
    const char* name;
    glm::dvec3 offset{0};
    bool exact = false;  ///< whole powers of two: rounds nothing
};
struct Scale {
    const char* name;
    double factor = 1;
    bool exact = false;
};
struct LightDirection {
    const char* name;
    std::optional<LightAngles> angles;  ///< nothing: the case's own
    bool mirrors = false;               ///< the light's map is its own mirror image in x
};

std::span<const Distance> distances();  ///< the first: at home
std::span<const Scale> scales();        ///< the first: as it is
std::span<const LightDirection> light_directions();

/// Numbers into the tables above.
struct Placement {
    std::size_t distance = 0, scale = 0, light = 0;
    bool mirrored = false;  ///< in x
    std::string name() const;
    /// Whether nothing is rounded on the way, the shift being one of whole grid steps: the same bytes are due.
    bool exact() const;
    bool is_unmoved() const { return distance == 0 && scale == 0 && !mirrored; }
    glm::dmat4 matrix() const;
};

/// Each row of each factor with the others as they are at home.
std::vector<Placement> single_factor_placements();
/// Those that round nothing, under a case's own light.
std::vector<Placement> exact_placements();
/// All of them.
std::vector<Placement> all_placements();

/// The scene with what its nodes without a parent stand on moved, scaled and mirrored, its cameras too.
void place_scene(Scene& scene, const glm::dmat4& placed);
/// What of the settings counts in metres, scaled; and the light turned. Returns whether all of it lies in the settings'
/// ranges.
bool place_settings(Settings& settings, const Placement& placement);

/// A case's number and a placement of it. Each pair of values of two factors (the case is one) that may stand together
/// is in some row; made greedily from a seed.
struct PlacedCase {
    std::size_t of = 0;
    Placement placement;
};
std::vector<PlacedCase> pairwise_placements(std::size_t cases, std::uint32_t seed);

}  // namespace si::test
