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
    double median = 0;         ///< of the absolute differences
    double most_of_99 = 0;     ///< 99th percentile of the absolute differences
    double max = 0;            ///< largest absolute difference
    double signed_median = 0;  ///< median with its sign
};

/// Class of one texel in the comparison of an imported shadow map with the drawn one: which of them holds a caster
/// there.
enum class TexelMatch : std::uint8_t {
    Empty,   ///< both maps hold no caster
    Both,    ///< both hold a caster
    Missed,  ///< the imported map alone holds a caster
    Extra,   ///< the drawn map alone holds a caster
    Masked,  ///< left out of both, as a masked caster may lie here
};

/// Limits of the gate. The gate tests whether scene, view and raster state reproduce an imported shadow map.
struct MapGateLimits {
    double missed_share = 1e-3;  ///< of the texels that the imported map covers
    double extra_share = 1e-4;   ///< of the texels that the imported map covers
    double median_steps = 1;     ///< steps of the map's format
    double most_steps = 4;       ///< steps within which 99 % of the texels lie
};

/// Limits for a map whose casters the engine's shader moves: single precision rounds the moved positions in the
/// engine's own space, which no bundle knows.
inline constexpr MapGateLimits kMovedCasterLimits{.median_steps = 4, .most_steps = 16};

/// Result of the gate, which tests whether an imported shadow map and the drawn one agree within MapGateLimits.
struct MapGate {
    bool missed = false, extra = false, median = false, most = false;  ///< true: within the limit
    bool passed() const { return missed && extra && median && most; }
    std::string text;  ///< a sentence: passed, or each limit that is exceeded
    std::string hint;  ///< another convention that would fit; empty: none was found
};

/// Rectangle of shadow-map texels, counted from the top left. `to` lies outside; the rectangle is empty where `to` is
/// `from`.
struct TexelBox {
    glm::ivec2 from{0}, to{0};
    bool is_empty() const { return to.x <= from.x || to.y <= from.y; }
};

/// Options for the comparison of an imported shadow map with the drawn one. When the
/// engine's shader moves casters, compare_imported_maps() itself sets the permitted difference of depth (`room_m`) and
/// the limits within which maps count as alike (`limits`).
struct MapCompareOptions {
    /// Texels next to texels that the imported map covers, within which an extra texel does not count. 1 for maps of
    /// moments, which are blurred.
    int border_texels = 0;
    bool leaves_out_masked = false;  ///< true: texels that masked casters may cover count in neither map
    /// Metres along the axis by which both depths of one surface may differ, besides rounding and slope. For casters
    /// that the engine moves by normals which the scene does not hold.
    double room_m = 0;
    MapGateLimits limits;  ///< limits within which both maps count as alike
};

/// Comparison of one imported shadow map with the map drawn from the same view: counts of texels, depth differences,
/// and whether the maps are alike enough by MapGateLimits.
struct MapComparison {
    int light = 0, view = 0;
    std::string name;  ///< name of the view, such as "cascade 2 of 4"; empty for a light's only view
    MapSize size;
    std::size_t covered = 0;       ///< texels that hold a caster in the imported map, without those left out
    std::size_t drawn = 0;         ///< the same in the drawn map
    std::size_t both = 0;          ///< texels that hold a caster in both
    std::size_t missed = 0;        ///< TexelMatch::Missed
    std::size_t extra = 0;         ///< TexelMatch::Extra that counts
    std::size_t extra_border = 0;  ///< TexelMatch::Extra within MapCompareOptions::border_texels, which does not count
    std::size_t masked = 0;        ///< TexelMatch::Masked
    std::size_t invalid = 0;       ///< texels of the imported map that are NaN or outside [0, 1]; they count as empty
    std::size_t nearer = 0;  ///< texels in both where the imported map lies before all drawn texels around, beyond bias
    std::size_t farther = 0;  ///< texels in both where it lies behind all drawn texels around, beyond bias
    TexelBox unexplained;     ///< around all missed and nearer texels: something that no caster of the scene explains
    TexelBox lacking;         ///< around all extra and farther texels: something that the imported map lacks
    double room_m = 0;        ///< MapCompareOptions::room_m
    double step = 0;          ///< median step of the format, depth-buffer units
    DepthDifferences steps, depth, metres,
        texels;  ///< over texels in both; metres along the ray, texels along the axis
    MapGate gate;
    std::vector<TexelMatch> match;    ///< by texel, top row first
    std::vector<float> difference_m;  ///< by texel, metres along the ray, above 0: farther; 0 unless TexelMatch::Both
    double missed_share() const { return covered > 0 ? double(missed) / double(covered) : missed > 0 ? 1 : 0; }
    double extra_share() const { return covered > 0 ? double(extra) / double(covered) : extra > 0 ? 1 : 0; }
};

/// Compares the depths of an imported map with those of a drawn one of the same view and size. A texel holds a caster
/// where its depth is not that of the far plane.
/// @param format format whose steps count; both images hold depths in [0, 1], top row first
/// @param masked texels to leave out, by texel; empty: none
MapComparison compare_maps(const FloatImage& imported, const FloatImage& drawn, const LightView& view, MapFormat format,
                           const std::vector<bool>& masked = {}, const MapCompareOptions& options = {});

/// Object of the scene that casts into the drawn shadow map but is missing, wholly or in part, from an imported map.
struct LackingCaster {
    std::size_t object = 0;   ///< index in Scene::objects
    std::string path;         ///< of its node
    std::size_t texels = 0;   ///< texels in which it is the first caster; estimated where not all were traced
    std::size_t empty = 0;    ///< of these, texels that the imported map leaves empty
    std::size_t farther = 0;  ///< of these, texels in which the imported map lies farther from the light, beyond bias
    bool drawn = true;        ///< false: the bundle says that it was not drawn into this map
    double lacking_share() const { return texels > 0 ? double(empty + farther) / double(texels) : 0; }
    /// Returns true when the map lacks the whole caster rather than a part.
    bool is_whole() const { return lacking_share() >= 0.5; }
};

/// Finds the casters of a scene that an imported map lacks, by rays from the light through the texels that the drawn
/// map covers. Casters that lack less than a twentieth of their texels are left out.
/// @param offset_factor slope factor of the polygon offset of the imported map, for the tolerance
/// @return the caster that lacks most texels first
/// @throws Cancelled
std::vector<LackingCaster> lacking_casters(const FloatImage& imported, const FloatImage& drawn, const LightView& view,
                                           const MapComparison& comparison, const ReferenceScene& scene,
                                           const std::vector<ObjectTraits>& traits, double offset_factor = 0,
                                           const Workers& workers = {});

/// Comparison of one imported shadow map with the drawn map, with both images and the objects missing from the imported
/// map.
struct ComparedMap {
    MapComparison numbers;
    LightView view;
    FloatImage imported, drawn;
    std::vector<LackingCaster> lacking;
};

/// Draws the maps of a light with the views and raster state of its imported maps, and compares each. Where the bundle
/// says which casters were drawn into a map, the numbers are of these alone. Casters that it lacks are among all.
/// @param settings settings of the frame; map.format gives the format
/// @param maps by light, as FrameRequest::imported; `light` has images and views
/// @throws Error where the light has no imported maps; Cancelled
std::vector<ComparedMap> compare_imported_maps(Renderer& renderer, const Scene& scene, const Settings& settings,
                                               const std::vector<std::shared_ptr<const ImportedMaps>>& maps, int light,
                                               const MapCompareOptions& options = {}, const Workers& workers = {});

/// Returns a sentence on an object that is missing from an imported shadow map: its path, the number of texels, and
/// whether the map is empty there.
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
/// @param scale_m difference_scale_m()
ByteImage difference_picture(const MapComparison& comparison, double scale_m);

}  // namespace si
