// Tables of offsets, scales, mirrorings and light directions. Tests compare the hard cases and the reference under
// these placements with the unmoved scene.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"

namespace si::test {

/// Direction of a light, degrees.
struct LightAngles {
    double azimuth = 0;
    double elevation = 0;
};

/// Offset of a scene from its own place: one row of distances().
struct Distance {
    const char* name;      ///< name of the row, part of test names
    glm::dvec3 offset{0};  ///< world metres
    bool exact = false;    ///< powers of two, without rounding
};
/// Scale of a scene: one row of scales().
struct Scale {
    const char* name;    ///< name of the row, part of test names
    double factor = 1;   ///< ratio of scaled to own lengths
    bool exact = false;  ///< powers of two, without rounding
};
/// Direction of a scene's light: one row of light_directions().
struct LightDirection {
    const char* name;
    std::optional<LightAngles> angles;  ///< direction; nothing: the case's own
    bool mirrors = false;               ///< symmetry: the light's map is its own mirror image in x
};

/// Returns the table of offsets. The first row has no offset.
std::span<const Distance> distances();
/// Returns the table of scales. The first row has the factor 1.
std::span<const Scale> scales();
/// Returns the table of light directions. The first row is the case's own direction.
std::span<const LightDirection> light_directions();

/// Placement of a scene: an offset, a scale, a light direction and a mirroring.
struct Placement {
    std::size_t distance = 0;  ///< index into distances()
    std::size_t scale = 0;     ///< index into scales()
    std::size_t light = 0;     ///< index into light_directions()
    bool mirrored = false;     ///< mirroring in x
    /// Returns the names of the placement's rows, joined.
    std::string name() const;
    /// Returns whether the placement rounds nothing and shifts by whole grid steps. Pictures then have the same bytes
    /// as the unmoved scene's.
    bool exact() const;
    /// Returns whether the scene keeps its own place, scale and handedness.
    bool is_unmoved() const { return distance == 0 && scale == 0 && !mirrored; }
    /// Returns the matrix from the scene's own space to world space.
    glm::dmat4 matrix() const;
};

/// Returns the placements that change one factor only.
std::vector<Placement> single_factor_placements();
/// Returns the placements that round nothing, under a case's own light.
std::vector<Placement> exact_placements();
/// Returns all placements: each combination of the tables' rows.
std::vector<Placement> all_placements();

/// Transforms the root nodes and cameras of a scene.
/// @param placed matrix of a placement, see Placement::matrix()
void place_scene(Scene& scene, const glm::dmat4& placed);
/// Scales the settings in metres and turns the light as a placement requires.
/// @returns false if a setting leaves its range
bool place_settings(Settings& settings, const Placement& placement);

/// Hard case with one of its placements: a row of pairwise_placements().
struct PlacedCase {
    std::size_t case_index = 0;  ///< index of the case, from 0
    Placement placement;
};
/// Returns a pairwise table of cases and placements, made greedily. Each allowed pair of values of two factors is in at
/// least one row; the case is a factor too.
/// @param cases number of cases
/// @param seed number that chooses among equally good rows
std::vector<PlacedCase> pairwise_placements(std::size_t cases, std::uint32_t seed);

}  // namespace si::test
