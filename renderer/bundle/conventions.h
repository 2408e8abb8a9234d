// Conventions of a shadow map that its writer did not state: each is tried, and ranked by how well the map then fits
// the scene.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/base/float_image.h"
#include "renderer/bundle/bundle.h"

namespace si {

/// Returns the step between depths that a bundle's depth format can store, in depth-buffer units. For floating-point
/// formats, returns the step between values from 0.5 to 1.
double depth_step(BundleDepthFormat format);

/// Order in which a file lists the 16 numbers of a matrix: column by column or row by row. The matrix multiplies column
/// vectors.
enum class MatrixOrder { Columns, Rows };

/// Order in which the matrices named view and projection are multiplied to map from world to clip space.
enum class ProductOrder { ProjectionView, ViewProjection };

/// Axis of a light file (JSON with the light of an imported map image) that points the opposite way in the scene's
/// world.
enum class MirroredAxis { None, X, Y, Z };

/// Axes, handedness and unit of a light file (the JSON file with the light of an imported map image), relative to the
/// scene's world.
struct LightAxes {
    UpAxis up = UpAxis::Y;  ///< axis of the light file, after mirroring, that becomes the scene's y; never File
    MirroredAxis mirrored = MirroredAxis::None;
    double unit = 1;  ///< unit of the light file, in units of the scene's world; above 0
    /// Returns the matrix from the world space of the light file (JSON with the light of an imported map image) to that
    /// of the scene.
    glm::dmat4 scene_from_light() const;
    bool operator==(const LightAxes&) const = default;
};

/// One combination of conventions by which a shadow map and its matrix may be written: depth range, order of rows,
/// order of matrix elements, axes and others.
struct Convention {
    DepthConvention depth;
    FirstRow first_row = FirstRow::Bottom;
    MatrixOrder matrix = MatrixOrder::Columns;
    ProductOrder product = ProductOrder::ProjectionView;
    BundleStored stored = BundleStored::Depth;
    std::optional<double> range_m;  ///< distance that is stored as 1, metres; set for BundleStored::DistanceShare
    LightAxes axes;
    bool operator==(const Convention&) const = default;
};

/// Conventions of a shadow map (depth range, order of rows, axes and others) that its file or the user states. Members
/// that are not set are unknown: fit_conventions() tries their values.
struct KnownConvention {
    std::optional<bool> zero_to_one, reversed;
    std::optional<FirstRow> first_row;
    std::optional<MatrixOrder> matrix;
    std::optional<ProductOrder> product;
    std::optional<BundleStored> stored;
    std::optional<UpAxis> up;
    std::optional<MirroredAxis> mirrored;
    std::optional<double> unit;
    /// Returns the stated axes and length unit of the light file (JSON with the light of an imported map image). Parts
    /// that are not stated are those of the scene's world.
    LightAxes own_axes() const;
    /// Returns true when a combination of conventions contradicts none of the stated ones.
    bool allows(const Convention& convention) const;
};

/// Ray of a light through a shadow map, from the near to the far plane, in world space, metres. Used to find the
/// conventions of an imported map: the first caster on the ray is compared with the depth of the texel.
struct MapRay {
    glm::dvec3 from_ws{0}, to_ws{0};
};

/// Function that returns the distance from the start of each ray to the first caster, metres; NaN for a ray without a
/// caster.
using FirstCasters = std::function<std::vector<double>(std::span<const MapRay>)>;

/// Result of reading a shadow map by one combination of conventions: differences between its texels and the scene.
struct ConventionFit {
    Convention convention;
    bool known = true;        ///< the combination contradicts no stated convention
    std::string refusal;      ///< reason why the matrix cannot be read by these conventions; empty: it can
    std::size_t samples = 0;  ///< compared texels: with a surface in map or scene; all if there is no scene
    std::size_t off = 0;      ///< compared texels beyond the tolerance, or with a surface in only one of map and scene
    std::size_t behind = 0;   ///< texels of `off` where the scene lies behind the map's surface, or has no surface
    std::size_t before = 0;   ///< texels of `off` where the scene lies before the map's surface, or the map has none
    std::size_t outside = 0;  ///< texels whose depth lies beyond the near or far plane
    std::size_t empty = 0;    ///< texels without a caster
    std::size_t texels = 0;   ///< texels that were read
    double median_m = 0;      ///< median difference along the axis, metres; infinite if most have only one surface
    double median_texels = 0;
    /// Returns the share of compared texels that do not fit; 1 if no texel was compared.
    double share_off() const { return samples == 0 ? 1 : double(off) / double(samples); }
};

/// Results of all combinations of conventions that were tried on a shadow map, the best first. Combinations with the
/// same effect are listed once.
struct ConventionFits {
    std::vector<ConventionFit> fits;
    /// Number of combinations at the start of `fits` that fit the map equally well and contradict no stated convention;
    /// 0: none fits.
    std::size_t equal = 0;
    /// Number of further combinations that fit as well as the first, but with other axes or units than the scene's. A
    /// symmetric scene has such combinations.
    std::size_t other_axes = 0;
    bool over_scene = false;  ///< compared with surfaces of a scene; false: only with the map's own depth range
};

/// Finds the conventions by which an imported shadow map is written, where they are not stated. Reads the map by every
/// possible combination, and compares some 4,000 texels per map with the casters of a scene. Without a scene, a texel
/// counts as a misfit if its depth lies outside the depth range or on the near plane. With a scene, other axes,
/// handedness and length units of the light's world are also tried: first on few texels, then plausible ones on all.
/// @param light light whose maps are parts of `image` or the whole image; its stated conventions are those of `known`
/// @param type_known false: BundleLight::type is not stated
/// @param world matrix from the engine's world to metres, y up, right-handed
/// @param image decoded image, rows in the order of the file
/// @param casters function that traces rays through the scene; empty: there is no scene
ConventionFits fit_conventions(const BundleLight& light, bool type_known, const glm::dmat4& world,
                               const FloatImage& image, const KnownConvention& known, const FirstCasters& casters);

/// Converts a light that is written by other conventions to those of frame.json: order and axes of its matrices,
/// direction and position. Sets order of rows, depth range and stored quantity of its maps. The texels themselves do
/// not change. Used to try one way to interpret an imported map.
/// @param convention conventions by which the light is written
BundleLight with_convention(const BundleLight& light, const Convention& convention);

/// Returns a sentence for people on how well a shadow map fits under some conventions: "the scene lies behind the map
/// at 93.0 % of the texels: reversed depth?".
/// @param over_scene true: the map was compared with the scene's surfaces; false: only with its own depth range
std::string fit_sentence(const ConventionFit& fit, bool over_scene);

}  // namespace si
