// Rays through the scene of a bundle by the matrices of its maps, to check maps without the program's own renderer.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "renderer/scene/scene.h"

namespace si::test {

/// One map of a bundle: depths of its region, row 0 at clip y = -1.
struct GivenMap {
    nlohmann::json json;  ///< its member of frame.json
    int width = 0, height = 0;
    std::vector<double> depth;
    glm::dmat4 clip_from_world{1};
    double near_value = 0, far_value = 1;  ///< stored values of the near and far plane
    double step = 0;                       ///< smallest difference of stored values
    double ndc_near = -1, ndc_far = 1;
};

/// Reads a map of a bundle in a folder: PFM, or 16-bit raw texels. Expects the bottom row first.
/// @param json member of `maps` of frame.json
GivenMap read_given_map(const std::filesystem::path& bundle, const nlohmann::json& json);

/// Comparison of a given map with rays, over a part of its texels.
struct MapAgreement {
    std::size_t covered = 0;    ///< texels with a caster in the given map
    std::size_t missed = 0;     ///< those of them that no ray finds covered
    std::size_t extra = 0;      ///< texels that only rays find covered
    std::vector<double> steps;  ///< differences of depth in steps of the format, ascending
    /// Returns the difference below which a share of the texels lies.
    double steps_of(double share) const {
        return steps.empty() ? 0 : steps[std::size_t(share * double(steps.size() - 1))];
    }
};

/// Compares a map with rays to the nearest caster of the scene, with the recorded culling and polygon offset.
/// @param every distance of compared rows and columns, texels
/// @param snap_texels distance by which the engine's rasteriser may move vertices: one over two to the power of
/// GL_SUBPIXEL_BITS. Coverage at edges and depth along a slope may differ by it.
MapAgreement compare_with_rays(const GivenMap& map, const Scene& scene, int every, double snap_texels = 0);

}  // namespace si::test
