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

/// Largest number of shadow maps of one light in a bundle (an engine's frame as files).
inline constexpr std::size_t kMaxBundleMaps = 16;
/// Largest width and height of a shadow map's image in a bundle (an engine's frame as files), texels.
inline constexpr int kMaxBundleImageSide = 16384;

/// Axes, unit and origin of the engine's world: `world` of frame.json.
struct BundleWorld {
    UpAxis up = UpAxis::Y;  ///< never UpAxis::File
    bool left_handed = false;
    double metres_per_unit = 1;  ///< above 0
    glm::dvec3 origin{0};        ///< added to the engine's positions, in its units, if they are relative to the camera
    bool operator==(const BundleWorld&) const = default;
};

/// Matrix from the engine's world to clip space: one matrix, or a view and a projection. Exactly one of
/// `clip_from_world`, `view` and `world_from_view` is set. With `view` or `world_from_view`, `projection` is set too.
struct BundleMatrix {
    std::optional<glm::dmat4> clip_from_world;
    std::optional<glm::dmat4> view;             ///< view space from the engine's world
    std::optional<glm::dmat4> world_from_view;  ///< inverse of `view`, stored unrounded: axes and place of the camera
    std::optional<glm::dmat4> projection;       ///< clip space from view space
    /// Returns the matrix from the engine's world to clip space; the identity if no member is set.
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

/// Edge of a shadow map that the first stored row of its image holds. Bottom is clip y = -1, Top is clip y = +1.
enum class FirstRow { Bottom, Top };

/// Number type of the texels of a raw image, little-endian. U24 takes four bytes, with the value in the low 24 bits.
enum class RawFormat { F32, F16, U16, U24, U32 };

/// Image file that holds a shadow map, and its layout: `image` of a map in frame.json.
struct BundleImage {
    std::string file;                   ///< path in the bundle
    std::optional<FirstRow> first_row;  ///< edge of the map in the first stored row; not set: see first_row_of()
    int width = 0, height = 0;          ///< texels; needed for raw images; 0: the file states the size
    std::optional<RawFormat> format;    ///< set for raw images
    int channels = 1, channel = 0;      ///< channels per texel of a raw image; index of the channel that is read
    bool operator==(const BundleImage&) const = default;
};

/// Rectangle of an atlas that holds one shadow map, in texels from the image's first stored row and its left side.
struct BundleRegion {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(const BundleRegion&) const = default;
};

/// Quantity that the texels of an engine's shadow map store. Depth: depth-buffer value. Linear: 0 to 1 from near to far
/// plane along the light's axis. AxisMetres: metres along the axis. DistanceMetres: metres from the eye. DistanceShare:
/// metres from the eye, divided by BundleDepth::range_m. Exponential: exp(BundleDepth::exponent times Linear). Moments:
/// first moment, read as Linear.
enum class BundleStored { Depth, Linear, AxisMetres, DistanceMetres, DistanceShare, Exponential, Moments };

/// Format in which the engine stores the depths of its shadow map. It gives the step between depths.
enum class BundleDepthFormat { D16, D24, D32F, R16F, R32F };

/// Meaning of the values in a shadow map's texels: `depth` of a map in frame.json.
struct BundleDepth {
    DepthConvention convention;
    BundleStored stored = BundleStored::Depth;
    BundleDepthFormat format = BundleDepthFormat::D32F;
    std::optional<double> range_m;   ///< distance that is stored as 1, metres; set for BundleStored::DistanceShare
    std::optional<double> exponent;  ///< factor of the depth inside exp(); set for BundleStored::Exponential
    std::optional<double> clear;     ///< stored value of texels without a caster; not set: that of the far plane
    /// Distances of the near and far plane along the light's axis, metres; not set: they follow from the matrix.
    std::optional<std::array<double, 2>> planes_m;
    std::optional<DepthWarp> warp;  ///< depth ranges of the rows of a warped map (LiSPSM); not set: from the matrix
    bool operator==(const BundleDepth&) const = default;
};

/// Winding of front faces while an engine draws casters into a shadow map, as glFrontFace() takes it.
enum class BundleFront { Ccw, Cw };

/// Raster state with which an engine drew casters into a map, in terms of OpenGL: `raster` of a map in frame.json.
/// Members that are not set are unknown.
struct BundleRaster {
    std::optional<double> offset_factor, offset_units, offset_clamp;
    std::optional<Cull> cull;
    std::optional<BundleFront> front;
    std::optional<bool> depth_clamp;
    /// Distances by which the casters' shader moves them along the light's axis, away from the light, metres. `shift_m`
    /// counts at any angle; `grazing_shift_m` is multiplied by 1 − |n·l|, with the vertex's normal n and the axis l.
    std::optional<double> shift_m, grazing_shift_m;
    bool operator==(const BundleRaster&) const = default;
};

/// One shadow map of an engine: a member of `maps` of a light in frame.json.
struct BundleMap {
    BundleImage image;
    std::optional<BundleRegion> region;  ///< part of the image that is this map (atlas); not set: the whole image
    BundleMatrix clip;
    BundleDepth depth;
    BundleRaster raster;
    /// Camera depths between which a point reads this map, metres along the viewing direction. Two maps are blended
    /// where their intervals overlap.
    std::optional<std::array<double, 2>> interval;
    /// Distances from the map's middle at which the blend into the next map begins, and at which this map ends. They
    /// are values of max(|u|, |v|): 0.5 is the map's side. Used with ViewChoice::Map.
    std::optional<std::array<double, 2>> edge;
    std::optional<std::vector<std::string>> drawn;  ///< node paths drawn into this map; not set: unknown
    bool operator==(const BundleMap&) const = default;
};

/// Bias with which an engine's shader reads a shadow map. An amount that is not set is unknown, and its unit is
/// ignored.
struct BundleBias {
    std::optional<double> constant, slope, normal;
    std::array<BiasUnit, 3> units = {BiasUnit::Depth, BiasUnit::Depth, BiasUnit::Metres};  ///< constant, slope, normal
    OffsetBy normal_by = OffsetBy::Length;  ///< dependence of `normal` on the light's angle
    bool operator==(const BundleBias&) const = default;
};

/// Comparison that makes a receiver lit. Less: the receiver is lit if its own depth is less than the stored depth.
enum class BundleCompare { Less, LessEqual, Greater, GreaterEqual };
/// Filter of the sampler that reads an engine's shadow map.
enum class BundleFilter { Nearest, Linear };
/// Wrap mode of the sampler that reads an engine's shadow map, for look-ups outside the map.
enum class BundleWrap { Border, Clamp, Repeat };

/// Shadow look-up of the engine's shader (bias, kernel, sampler): `lookup` of a light in frame.json. Members that are
/// not set are unknown.
struct BundleLookup {
    BundleBias bias;
    std::optional<std::string> kernel;  ///< value of the setting filter.kernel, such as "pcf3"
    std::optional<BundleCompare> compare;
    std::optional<BundleFilter> filter;
    std::optional<BundleWrap> wrap;
    std::string shader;  ///< path of the look-up's source text in the bundle; empty: unknown
    bool operator==(const BundleLookup&) const = default;
};

/// Light of an engine with its shadow maps: a member of `lights` in frame.json.
struct BundleLight {
    std::string name;
    LightType type = LightType::Directional;
    std::optional<glm::dvec3> direction;  ///< direction in which the light shines, of any length, in the engine's world
    std::optional<glm::dvec3> position;   ///< in the engine's world
    std::optional<double> cone_deg;       ///< full outer angle of a spot light
    /// Rule by which a point chooses the map that it reads: One, Map, Interval or Face; not set: see choice_of().
    std::optional<ViewChoice> choice;
    bool closed = false;          ///< true: no surface within the light's range and cone is in shadow outside the maps
    std::vector<BundleMap> maps;  ///< in the order of the choice; faces: +x, -x, +y, -y, +z, -z
    BundleLookup lookup;
    bool operator==(const BundleLight&) const = default;
};

/// One frame of an engine, exported for inspection: the content of frame.json. Lengths in the engine's world are in the
/// engine's unit, which BundleWorld::metres_per_unit converts. Members whose names end in `_m` are metres.
struct Bundle {
    std::string made_by;
    std::string scene;  ///< path in the bundle of the scene's glTF file; empty: none
    BundleWorld world;
    std::optional<BundleCamera> camera;
    std::string picture;  ///< path in the bundle of the engine's own picture, a PNG; empty: none
    std::vector<BundleLight> lights;
    std::vector<std::string> notes;
    /// Settings of this program that apply when the bundle is opened: value as --set takes it, by key. They override
    /// what follows from the other members.
    std::map<std::string, std::string> settings;
    bool operator==(const Bundle&) const = default;
};

/// Returns which edge of a shadow map the first stored row of its image holds. If the image does not state the edge, it
/// is Bottom for .raw and .pfm files, and Top for others.
FirstRow first_row_of(const BundleImage& image);

/// Returns the rule by which a surface point chooses one of a light's maps. If the light does not state a rule, it is
/// One for a single map, Face for six maps of a point light, Interval if all maps have intervals, and otherwise Map.
ViewChoice choice_of(const BundleLight& light);

}  // namespace si
