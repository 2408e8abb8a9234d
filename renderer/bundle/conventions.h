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

/// Returns the step of depths stored in a format, depth-buffer units; of floats that of the values from 0.5 to 1.
double depth_step(BundleDepthFormat format);

/// Order of the 16 numbers of a matrix that multiplies columns.
enum class MatrixOrder { Columns, Rows };

/// Order of the product of the matrices called view and projection.
enum class ProductOrder { ProjectionView, ViewProjection };

/// Axis of the light's file that points the other way in the scene's world.
enum class MirroredAxis { None, X, Y, Z };

/// Axes, hand and unit of the light's file (the JSON file that `import-map` reads), compared with those of the scene's
/// world.
struct LightAxes {
    UpAxis up = UpAxis::Y;  ///< axis of the light's file, after mirroring, that becomes the scene's y; never File
    MirroredAxis mirrored = MirroredAxis::None;
    double unit = 1;  ///< lengths of the scene's world in one length of the light's file; above 0
    /// Returns the matrix from the world space of the light's file to that of the scene.
    glm::dmat4 scene_from_light() const;
    bool operator==(const LightAxes&) const = default;
};

/// Reading of a map and its matrix: one combination of conventions that the file may follow.
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

/// Parts of a Convention that are known.
struct KnownConvention {
    std::optional<bool> zero_to_one, reversed;
    std::optional<FirstRow> first_row;
    std::optional<MatrixOrder> matrix;
    std::optional<ProductOrder> product;
    std::optional<BundleStored> stored;
    std::optional<UpAxis> up;
    std::optional<MirroredAxis> mirrored;
    std::optional<double> unit;
    /// Returns the axes of the scene's world with the known parts in their place.
    LightAxes own_axes() const;
    /// Returns true for a reading that contradicts no known part.
    bool allows(const Convention& convention) const;
};

/// Ray of a light from the near to the far plane of a map, world space, metres.
struct MapRay {
    glm::dvec3 from_ws{0}, to_ws{0};
};

/// Function that returns the distance from the start of each ray to the first caster, metres; NaN without one.
using FirstCasters = std::function<std::vector<double>(std::span<const MapRay>)>;

/// Fit of one reading (Convention) to the scene.
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

/// Fits of all readings, the best first. Readings with the same effect are listed once.
struct ConventionFits {
    std::vector<ConventionFit> fits;
    /// Number of known readings at the start of `fits` that fit the map equally well; 0: none fits.
    std::size_t equal = 0;
    /// Number of further readings that fit no better and no worse than the first, in other axes or units than the
    /// scene's: the scene is symmetric.
    std::size_t other_axes = 0;
    bool over_scene = false;  ///< compared with surfaces, not only with the map's own range
};

/// Tries every reading of the maps of a light, and compares some 4,000 texels a map with the casters of a scene.
/// Without a scene only range and consistency can tell readings apart: readings that put texels outside the depth
/// range, or the sky on the near plane, do not fit. Over a scene other axes, hands and units of the light's file are
/// tried too: with few texels first, and all texels for the readings that may fit.
/// @param light stated conventions are those of `known`; its maps read one image
/// @param type_known false: BundleLight::type is not stated
/// @param world from the engine's world to metres, y up, right-handed
/// @param casters empty: no scene
ConventionFits fit_conventions(const BundleLight& light, bool type_known, const glm::dmat4& world,
                               const FloatImage& image, const KnownConvention& known, const FirstCasters& casters);

/// Returns a light whose maps are read as a convention says, in the form that frame.json has.
BundleLight with_convention(const BundleLight& light, const Convention& convention);

/// Returns the sentence that a fit amounts to: "the scene lies behind the map at 93 % of its texels".
std::string fit_sentence(const ConventionFit& fit, bool over_scene);

}  // namespace si
