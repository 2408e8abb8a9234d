// Data of a bundle's frame.json: one frame of an engine, as docs/bundle.md describes it. An optional member that is not
// set is unknown, and never 0.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/projection/depth_curve.h"
#include "renderer/projection/view_choice.h"
#include "renderer/settings/settings.h"

namespace si {

/// Largest number of maps of one light of a bundle.
inline constexpr std::size_t kMaxBundleMaps = 16;
/// Largest number of texels along one side of a bundle's image.
inline constexpr int kMaxBundleImageSide = 16384;

/// Axes, unit and origin of the engine's world: `world` of frame.json.
struct BundleWorld {
    UpAxis up = UpAxis::Y;  ///< never UpAxis::File
    bool left_handed = false;
    double metres_per_unit = 1;  ///< above 0
    glm::dvec3 origin{0};        ///< place of the world's origin, in units of the engine
    bool operator==(const BundleWorld&) const = default;
};

/// Matrix from the engine's world to clip space: one matrix, or a view and a projection. Exactly one of
/// `clip_from_world`, `view` and `world_from_view` is set; `projection` is set beside the latter two.
struct BundleMatrix {
    std::optional<glm::dmat4> clip_from_world;
    std::optional<glm::dmat4> view;             ///< view space from world
    std::optional<glm::dmat4> world_from_view;  ///< axes and place of the camera: inverse of `view`, without rounding
    std::optional<glm::dmat4> projection;       ///< clip space from view space
    /// Returns clip space from the engine's world; the identity where nothing is set.
    glm::dmat4 matrix() const {
        if (clip_from_world) return *clip_from_world;
        const glm::dmat4 p = projection.value_or(glm::dmat4(1));
        if (view) return p * *view;
        return world_from_view ? p * glm::inverse(*world_from_view) : p;
    }
    bool operator==(const BundleMatrix&) const = default;
};

/// Camera of the engine's picture: `camera` of frame.json.
struct BundleCamera {
    BundleMatrix clip;
    int width = 0, height = 0;  ///< pixels of the picture
    DepthConvention depth;
    bool operator==(const BundleCamera&) const = default;
};

/// End of a map that an image's first stored row shows: Bottom is clip y = -1, Top is clip y = +1.
enum class FirstRow { Bottom, Top };

/// Number type of the texels of a raw image, little-endian. U24 takes four bytes, the value in the low 24 bits.
enum class RawFormat { F32, F16, U16, U24, U32 };

/// Image file that holds a shadow map, and its layout: `image` of a map in frame.json.
struct BundleImage {
    std::string file;                   ///< path in the bundle
    std::optional<FirstRow> first_row;  ///< not set: see first_row_of()
    int width = 0, height = 0;          ///< texels, for raw images; 0: the file says it
    std::optional<RawFormat> format;    ///< set for raw images
    int channels = 1, channel = 0;      ///< channels of a texel (raw), and the one that is read
    bool operator==(const BundleImage&) const = default;
};

/// Rectangle of an atlas that holds one shadow map, in texels from the image's first stored row and its left side.
struct BundleRegion {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(const BundleRegion&) const = default;
};

/// Meaning of a stored texel: depth-buffer value; 0 to 1 from near to far plane along the axis; metres along the axis;
/// metres from the eye; metres from the eye over BundleDepth::range_m; exp of BundleDepth::exponent times Linear; first
/// moment, which is Linear.
enum class BundleStored { Depth, Linear, AxisMetres, DistanceMetres, DistanceShare, Exponential, Moments };

/// Storage of depth in the engine, for the step of depth.
enum class BundleDepthFormat { D16, D24, D32F, R16F, R32F };

/// Meaning of the values in a shadow map's texels: `depth` of a map in frame.json.
struct BundleDepth {
    DepthConvention convention;
    BundleStored stored = BundleStored::Depth;
    BundleDepthFormat format = BundleDepthFormat::D32F;
    std::optional<double> range_m;   ///< set for BundleStored::DistanceShare, metres
    std::optional<double> exponent;  ///< set for BundleStored::Exponential
    std::optional<double> clear;     ///< stored value of texels without a caster; not set: the far plane
    /// Distances of near and far plane along the axis, metres; not set: from the matrix.
    std::optional<std::array<double, 2>> planes_m;
    std::optional<DepthWarp> warp;  ///< ranges of the rows of a warped map (LiSPSM); not set: from the matrix
    bool operator==(const BundleDepth&) const = default;
};

/// Winding of front faces in the map's image.
enum class BundleFront { Ccw, Cw };

/// Raster state with which an engine drew casters into a map, in terms of OpenGL: `raster` of a map in frame.json.
/// Members that are not set are unknown.
struct BundleRaster {
    std::optional<double> offset_factor, offset_units, offset_clamp;
    std::optional<Cull> cull;
    std::optional<BundleFront> front;
    std::optional<bool> depth_clamp;
    /// Metres by which the casters' shader moves them along the map's axis, away from the light: everywhere, and times
    /// 1 − |n·l| with the vertex's normal and the axis.
    std::optional<double> shift_m, grazing_shift_m;
    bool operator==(const BundleRaster&) const = default;
};

/// One shadow map of an engine: a member of `maps` of a light in frame.json.
struct BundleMap {
    BundleImage image;
    std::optional<BundleRegion> region;  ///< not set: the whole image
    BundleMatrix clip;
    BundleDepth depth;
    BundleRaster raster;
    /// Camera depths between which a point reads this map, metres along the view. Two maps are blended where their
    /// intervals overlap.
    std::optional<std::array<double, 2>> interval;
    /// Largest distances from the map's middle at which a point reads this map: start of the blend into the next map
    /// and end, as max(|u|, |v|), so that 0.5 is the map's side. For the choice `map`.
    std::optional<std::array<double, 2>> edge;
    std::optional<std::vector<std::string>> drawn;  ///< node paths of the scene that were drawn into this map
    bool operator==(const BundleMap&) const = default;
};

/// Bias with which an engine's shader reads a shadow map. An amount that is not set is unknown, and its unit is
/// ignored.
struct BundleBias {
    std::optional<double> constant, slope, normal;
    std::array<BiasUnit, 3> units = {BiasUnit::Depth, BiasUnit::Depth, BiasUnit::Metres};  ///< in the order above
    OffsetBy normal_by = OffsetBy::Length;  ///< dependence of `normal` on the light's angle
    bool operator==(const BundleBias&) const = default;
};

/// Comparison of own depth with the stored one, for lit.
enum class BundleCompare { Less, LessEqual, Greater, GreaterEqual };
/// Filter of the sampler that reads the map.
enum class BundleFilter { Nearest, Linear };
/// Wrapping of the sampler that reads the map.
enum class BundleWrap { Border, Clamp, Repeat };

/// Shadow look-up of the engine's shader (bias, kernel, sampler): `lookup` of a light in frame.json. Members that are
/// not set are unknown.
struct BundleLookup {
    BundleBias bias;
    std::optional<std::string> kernel;  ///< value of filter.kernel, such as "pcf3"
    std::optional<BundleCompare> compare;
    std::optional<BundleFilter> filter;
    std::optional<BundleWrap> wrap;
    std::string shader;  ///< path in the bundle of the source text of the look-up; empty: unknown
    bool operator==(const BundleLookup&) const = default;
};

/// Light of an engine with its shadow maps: a member of `lights` in frame.json.
struct BundleLight {
    std::string name;
    LightType type = LightType::Directional;
    std::optional<glm::dvec3> direction;  ///< in which the light shines, of any length, in the engine's world
    std::optional<glm::dvec3> position;   ///< in the engine's world
    std::optional<double> cone_deg;       ///< full outer angle of a spot light
    /// Choice of the map that a point reads: One, Map, Interval or Face; not set: see choice_of().
    std::optional<ViewChoice> choice;
    bool closed = false;          ///< no surface that the light reaches lies in shadow outside the maps
    std::vector<BundleMap> maps;  ///< in the order of the choice; faces: +x, -x, +y, -y, +z, -z
    BundleLookup lookup;
    bool operator==(const BundleLight&) const = default;
};

/// One frame of an engine, exported for inspection: the content of frame.json. Lengths in the engine's world have its
/// own unit; BundleWorld::metres_per_unit converts them. Members with `_m` are metres.
struct Bundle {
    std::string made_by;
    std::string scene;  ///< path in the bundle of the scene's glTF file; empty: none
    BundleWorld world;
    std::optional<BundleCamera> camera;
    std::string picture;  ///< path in the bundle of the engine's own picture, a PNG; empty: none
    std::vector<BundleLight> lights;
    std::vector<std::string> notes;
    /// Settings of this program with which the bundle opens, as texts of --set by key. They replace what the other
    /// members say.
    std::map<std::string, std::string> settings;
    bool operator==(const Bundle&) const = default;
};

/// Returns which edge of a shadow map the first stored row of its image holds. An image that does not state it has the
/// Bottom row first in .raw and .pfm files, and the Top row in others.
FirstRow first_row_of(const BundleImage& image);

/// Returns the rule by which a surface point chooses one of a light's maps. A light that does not state it has One for
/// a single map, Face for six maps of a point light, Interval if all maps have intervals, and otherwise Map.
ViewChoice choice_of(const BundleLight& light);

}  // namespace si
