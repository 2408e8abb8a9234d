// Comparison of an imported shadow map with the map that this program draws with the same view.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/bundle/imported_maps.h"
#include "renderer/reference/reference_scene.h"
#include "renderer/render/renderer.h"

namespace si {

/// Distribution of the depth differences between an imported shadow map and the map drawn in its place, in one unit.
/// Signed differences are above 0 where the imported map lies farther from the light.
struct DepthDifferences {
    double median = 0;         ///< median of the absolute differences
    double most_of_99 = 0;     ///< 99th percentile of the absolute differences
    double max = 0;            ///< largest absolute difference
    double signed_median = 0;  ///< median of the signed differences
};

/// Class of one texel in the comparison of an imported shadow map with this program's own map: which of the two holds a
/// caster there.
enum class TexelMatch : std::uint8_t {
    Empty,   ///< neither map holds a caster
    Both,    ///< both maps hold a caster
    Missed,  ///< the imported map alone holds a caster
    Extra,   ///< the drawn map alone holds a caster
    Masked,  ///< not compared, as a caster with an alpha mask may cover the texel
};

/// Limits of the gate, the test whether scene, view and raster state reproduce an imported shadow map. They bound the
/// shares of missed and extra texels, and the depth differences.
struct MapGateLimits {
    double missed_share = 1e-3;  ///< largest ratio of missed texels to texels covered by the imported map
    double extra_share = 1e-4;   ///< largest ratio of extra texels to texels covered by the imported map
    double median_steps = 1;     ///< largest median depth difference, steps of the map's format
    double most_steps = 4;       ///< largest 99th percentile of depth differences, steps of the map's format
};

/// Limits of the gate (the test whether an imported map is reproduced) for a map whose casters the engine's shader
/// moves. They are wider, as the shader rounds the moved positions to single precision in a space that no bundle
/// states.
inline constexpr MapGateLimits kMovedCasterLimits{.median_steps = 4, .most_steps = 16};

/// Result of the gate, which tests whether an imported shadow map and the map that this program draws agree within
/// MapGateLimits.
struct MapGate {
    bool missed = false, extra = false, median = false, most = false;  ///< true: within the limit of MapGateLimits
    bool passed() const { return missed && extra && median && most; }
    std::string text;  ///< a sentence: passed, or each limit that is exceeded
    std::string hint;  ///< another convention of the imported map that would fit; empty: none found
};

/// Rectangle of shadow-map texels from `from` to `to`, without `to`, counted from the top left. Empty where `to` is
/// `from`.
struct TexelBox {
    glm::ivec2 from{0}, to{0};
    bool is_empty() const { return to.x <= from.x || to.y <= from.y; }
};

/// Options for the comparison of an imported shadow map with the map that this program draws. When the engine's shader
/// moves casters, compare_imported_maps() itself sets the permitted depth difference (`room_m`). It then also sets the
/// limits within which the two maps count as equal (`limits`).
struct MapCompareOptions {
    /// Width of a border around the texels that the imported map covers. An extra texel in the border does not count. 1
    /// for maps of moments, which are blurred.
    int border_texels = 0;
    bool leaves_out_masked = false;  ///< true: texels that casters with an alpha mask may cover are not compared
    /// Metres along the axis by which both depths of one surface may differ, besides rounding and slope. Needed for
    /// casters that the engine moves by normals which the scene does not hold.
    double room_m = 0;
    MapGateLimits limits;  ///< limits within which both maps count as equal
};

/// Comparison of one imported shadow map with this program's own map of the same view: counts of texels, depth
/// differences, and the result of the gate (MapGateLimits).
struct MapComparison {
    int light = 0, view = 0;
    std::string name;  ///< name of the view, such as "cascade 2 of 4"; empty for a light's only view
    MapSize size;
    std::size_t covered = 0;       ///< texels that hold a caster in the imported map, without TexelMatch::Masked
    std::size_t drawn = 0;         ///< texels that hold a caster in the drawn map, without TexelMatch::Masked
    std::size_t both = 0;          ///< texels that hold a caster in both maps
    std::size_t missed = 0;        ///< TexelMatch::Missed
    std::size_t extra = 0;         ///< TexelMatch::Extra, without those in the border
    std::size_t extra_border = 0;  ///< TexelMatch::Extra in the border (MapCompareOptions::border_texels)
    std::size_t masked = 0;        ///< TexelMatch::Masked
    std::size_t invalid = 0;       ///< texels of the imported map that are NaN or outside [0, 1]; they count as empty
    /// Number of texels with a caster in both maps where the imported map is nearer to the light than the drawn map at
    /// this texel and all around it, by more than bias explains.
    std::size_t nearer = 0;
    /// Number of texels with a caster in both maps where the imported map is farther from the light than the drawn map
    /// at this texel and all around it, by more than bias explains.
    std::size_t farther = 0;
    TexelBox unexplained;  ///< bounding box of missed and nearer texels, which no caster of the scene explains
    TexelBox lacking;      ///< bounding box of extra and farther texels, where the imported map lacks a caster
    double room_m = 0;     ///< MapCompareOptions::room_m
    double step = 0;       ///< median step of the depth format, depth-buffer units
    /// Differences over the texels with a caster in both maps: in steps of the format, in depth-buffer units, in metres
    /// along the ray, and in texel widths along the axis.
    DepthDifferences steps, depth, metres, texels;
    MapGate gate;
    std::vector<TexelMatch> match;    ///< by texel, top row first
    std::vector<float> difference_m;  ///< by texel, metres along the ray; above 0: imported map farther; 0 unless Both
    double missed_share() const { return covered > 0 ? double(missed) / double(covered) : missed > 0 ? 1 : 0; }
    double extra_share() const { return covered > 0 ? double(extra) / double(covered) : extra > 0 ? 1 : 0; }
};

/// Compares the depths of an imported shadow map with those of this program's own map of the same view and size. A
/// texel holds a caster where its depth is not that of the far plane.
/// @param imported,drawn depths in [0, 1], top row first
/// @param format depth format, whose steps are the unit of MapComparison::steps
/// @param masked true for texels to leave out, by texel; empty: none
/// @throws Error when sizes differ
MapComparison compare_maps(const FloatImage& imported, const FloatImage& drawn, const LightView& view, MapFormat format,
                           const std::vector<bool>& masked = {}, const MapCompareOptions& options = {});

/// Object of the scene that casts into this program's own shadow map but is missing, wholly or in part, from an
/// imported map.
struct LackingCaster {
    std::size_t object = 0;   ///< index in Scene::objects
    std::string path;         ///< path of its node
    std::size_t texels = 0;   ///< texels in which the caster is nearest to the light; estimated if not all were traced
    std::size_t empty = 0;    ///< number of these `texels` that the imported map leaves empty
    std::size_t farther = 0;  ///< number of these `texels` where the imported map is farther from the light
    bool drawn = true;        ///< false: the bundle says that the caster was not drawn into this map
    double lacking_share() const { return texels > 0 ? double(empty + farther) / double(texels) : 0; }
    /// Returns true when the imported map lacks at least half of the caster's texels, which counts as the whole caster.
    bool is_whole() const { return lacking_share() >= 0.5; }
};

/// Finds the casters of a scene that an imported map lacks, by rays from the light through the texels that casters
/// cover in this program's own map. Leaves out casters of which less than a twentieth of the texels is lacking.
/// @param offset_factor slope factor of the imported map's polygon offset, by which the tolerance grows
/// @return the caster with most lacking texels first
/// @throws Cancelled
std::vector<LackingCaster> lacking_casters(const FloatImage& imported, const FloatImage& drawn, const LightView& view,
                                           const MapComparison& comparison, const ReferenceScene& scene,
                                           const std::vector<ObjectTraits>& traits, double offset_factor = 0,
                                           const Workers& workers = {});

/// Comparison of one imported shadow map with the map that this program draws, with both images and the objects missing
/// from the imported map.
struct ComparedMap {
    MapComparison numbers;
    LightView view;
    FloatImage imported, drawn;
    std::vector<LackingCaster> lacking;
};

/// Draws the maps of a light with the views and raster state of its imported maps, and compares each with its imported
/// map. If the bundle lists the casters drawn into a map, ComparedMap::numbers covers only these casters, but
/// ComparedMap::lacking covers all casters.
/// @param settings settings of the frame; map.format gives the format
/// @param maps by light, as FrameRequest::imported; `light` has images and views
/// @throws Error where the light has no imported maps; Cancelled
std::vector<ComparedMap> compare_imported_maps(Renderer& renderer, const Scene& scene, const Settings& settings,
                                               const std::vector<std::shared_ptr<const ImportedMaps>>& maps, int light,
                                               const MapCompareOptions& options = {}, const Workers& workers = {});

/// Returns a sentence on an object that is missing from an imported shadow map: its path, the number of texels, and
/// whether the map is empty or holds a farther surface there.
std::string lacking_caster_text(const LackingCaster& caster);

/// Colours, sRGB, of texels without a depth difference in the difference picture of an imported and a drawn shadow map.
struct MapDifferenceColours {
    std::array<std::uint8_t, 3> empty{24, 24, 24}, missed{255, 214, 10}, extra{232, 62, 200}, masked{90, 90, 90};
};

/// Returns the depth difference in metres that gets the darkest colour in the difference picture of two shadow maps. It
/// is the 99th percentile of the differences, rounded up to one digit, and at least one step of the depth format; 0.001
/// for maps without a difference.
double difference_scale_m(const MapComparison& comparison);

/// Returns the sRGB colour of a depth difference between an imported and a drawn shadow map. It is white at 0, blue
/// where the imported map lies nearer to the light, and red where it lies farther.
/// @param metres the difference, above 0 where the imported map lies farther @param scale_m difference of the darkest
/// colour
std::array<std::uint8_t, 3> difference_colour(double metres, double scale_m);

/// Draws one of two compared shadow maps in greys that are linear in distance, one pixel for each texel. Both maps
/// share one scale: black is the nearest depth in either map, white is a texel without caster.
/// @param image ComparedMap::imported or ComparedMap::drawn
ByteImage linear_picture(const ComparedMap& map, const FloatImage& image);

/// Draws the depth differences between an imported and a drawn shadow map in colours, one pixel for each texel.
/// @param scale_m difference of the darkest colour, metres: difference_scale_m()
ByteImage difference_picture(const MapComparison& comparison, double scale_m);

}  // namespace si
