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

/// Returns the step between depths that a bundle's depth format can store, in depth-buffer units. For floats it is the
/// step of values from 0.5 to 1.
double depth_step(BundleDepthFormat format);

/// Order of the 16 numbers of a matrix that multiplies columns.
enum class MatrixOrder { Columns, Rows };

/// Order of the product of the matrices called view and projection.
enum class ProductOrder { ProjectionView, ViewProjection };

/// Axis of the light's file that points the other way in the scene's world.
enum class MirroredAxis { None, X, Y, Z };

/// Axes, handedness and unit of a light file (the JSON file with the light of an imported map image), relative to the
/// scene's world.
struct LightAxes {
    UpAxis up = UpAxis::Y;  ///< axis of the light's file, after mirroring, that becomes the scene's y; never File
    MirroredAxis mirrored = MirroredAxis::None;
    double unit = 1;  ///< lengths of the scene's world in one length of the light's file; above 0
    /// Returns the matrix from the world space of the light file to that of the scene.
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
    std::optional<double> range_m;  ///< set for BundleStored::DistanceShare, metres
    LightAxes axes;
    bool operator==(const Convention&) const = default;
};

/// Conventions of a shadow map (depth range, order of rows, axes and others) that are stated. Those that are not set
/// are unknown and have to be tried by fit_conventions().
struct KnownConvention {
    std::optional<bool> zero_to_one, reversed;
    std::optional<FirstRow> first_row;
    std::optional<MatrixOrder> matrix;
    std::optional<ProductOrder> product;
    std::optional<BundleStored> stored;
    std::optional<UpAxis> up;
    std::optional<MirroredAxis> mirrored;
    std::optional<double> unit;
    /// Returns the stated axes and unit of the light file, with those of the scene's world where nothing is stated.
    LightAxes own_axes() const;
    /// Returns true when a combination of conventions contradicts none of the stated ones.
    bool allows(const Convention& convention) const;
};

/// Ray of a light through a shadow map, from the near to the far plane, in world space, metres.
struct MapRay {
    glm::dvec3 from_ws{0}, to_ws{0};
};

/// Function that returns the distance from the start of each ray to the first caster, metres; NaN without one.
using FirstCasters = std::function<std::vector<double>(std::span<const MapRay>)>;

/// Result of reading a shadow map by one combination of conventions: differences between its texels and the scene.
struct ConventionFit {
    Convention convention;
    bool known = true;        ///< contradicts no known part
    std::string refusal;      ///< reason why the matrix cannot be read so; empty: it can
    std::size_t samples = 0;  ///< texels that were compared: where map or scene has a surface
    std::size_t off = 0;      ///< texels that differ by more than the tolerance, or where one of both has no surface
    std::size_t behind = 0;   ///< of these: the scene's surface lies behind the map's
    std::size_t before = 0;   ///< of these: the scene's surface lies before the map's
    std::size_t outside = 0;  ///< texels beyond near or far plane
    std::size_t empty = 0;    ///< texels without a caster
    std::size_t texels = 0;   ///< texels that were read
    double median_m = 0;      ///< median difference along the axis, metres; infinite where most have no partner
    double median_texels = 0;
    /// Returns the share of compared texels that do not fit; 1 where none could be compared.
    double share_off() const { return samples == 0 ? 1 : double(off) / double(samples); }
};

/// Results of all combinations of conventions that were tried on a shadow map, the best first. Combinations with the
/// same effect are listed once.
struct ConventionFits {
    std::vector<ConventionFit> fits;
    /// Number of known readings at the start of `fits` that fit the map equally well; 0: none fits.
    std::size_t equal = 0;
    /// Number of further readings that fit no better and no worse than the first, in other axes or units than the
    /// scene's: the scene is symmetric.
    std::size_t other_axes = 0;
    bool over_scene = false;  ///< compared with surfaces, not only with the map's own range
};

/// Finds the conventions by which an imported shadow map is written, where they are not stated. Reads the map by every
/// possible combination, and compares some 4,000 texels a map with the casters of a scene. Without a scene, a
/// combination does not fit if it puts texels outside the depth range, or the sky on the near plane. With a scene,
/// other axes, handedness and units of the light file are tried too: first on few texels, then the plausible ones on
/// all.
/// @param light light whose maps all read one image; its stated conventions are those of `known`
/// @param type_known false: BundleLight::type is not stated
/// @param world matrix from the engine's world to metres, y up, right-handed
/// @param casters empty: there is no scene
ConventionFits fit_conventions(const BundleLight& light, bool type_known, const glm::dmat4& world,
                               const FloatImage& image, const KnownConvention& known, const FirstCasters& casters);

/// Converts a light that is written by other conventions to those of frame.json: order and axes of its matrices,
/// direction and position. Sets order of rows, depth range and kind of depth of its maps; their texels stay. Used to
/// try a reading of an imported map.
/// @param convention conventions by which the light is written
BundleLight with_convention(const BundleLight& light, const Convention& convention);

/// Returns a sentence for people on how well a shadow map fits under some conventions: "the scene lies behind the map
/// at 93.0 % of the texels: reversed depth?".
/// @param over_scene true: the map was compared with the scene's surfaces; false: only with its own depth range
std::string fit_sentence(const ConventionFit& fit, bool over_scene);

}  // namespace si
