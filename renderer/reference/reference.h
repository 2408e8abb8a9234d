// Ray-traced reference of one light's shadows: the visible share of the light at each pixel's surface.
//
//     auto geometry = std::make_shared<ReferenceGeometry>(scene, settings);  // a copy; any thread from here on
//     ReferenceScene casters(geometry);                                      // the hierarchy
//     SurfaceIds ids = renderer.read_surface_ids(frame.surface_ids);
//     Receivers receivers = reconstruct_receivers(*geometry, frame.camera, ids, {});
//     ReferenceQuery query = reference_query(scene, settings, frame.lights, 0);
//     Reference reference = trace_visibility(casters, receivers, query, {});
//     reference.visibility.at(x, y);  // 1 lit ... 0 in shadow
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/reference/emitter.h"
#include "renderer/reference/receivers.h"
#include "renderer/reference/reference_scene.h"

namespace si {

/// State of a pixel in comparisons with the reference: counted, or the reason why the pixel is not counted.
enum class PixelState : std::uint8_t {
    Counted,           ///< faces the light and lies in its cone and range
    Background,        ///< shows no surface
    FacesAway,         ///< faces_light(N_g.L) is false: dark without any occluder
    OutsideCone,       ///< outside a spot light's cone
    NotReceiving,      ///< object.PATH.receive is off
    BeyondRange,       ///< beyond the range of a spot or point light, in its cone
    ShadowTerminator,  ///< as FacesAway, but the smooth normal (of the vertices) faces the light: no bias cures it
};
inline constexpr std::size_t kPixelStates = 7;
/// Returns true when the reference traces rays for pixels of a state, counted or not.
constexpr bool is_traced(PixelState s) {
    return s == PixelState::Counted || s == PixelState::OutsideCone || s == PixelState::BeyondRange;
}

/// Options for tracing a reference: kind of light, culling, number of rays and resolution.
struct ReferenceOptions {
    bool area = false;           ///< area light of the light's size; else a point or a direction
    bool as_rasterised = false;  ///< faces that culling removes from the shadow map cast no shadow here either
    int samples = 1024;          ///< area: most rays per pixel; in penumbrae 64, and more while noisy
    int first_samples = 8;       ///< area: rays of every pixel; more follow where these or a neighbour's disagree
    double noise = 0.005;        ///< area: wanted standard error of a pixel's visibility
    bool nearest = true;         ///< compute Reference::nearest_m and blocker_m
    int step = 1;                ///< pixels of the picture per pixel of the reference, across and down
    bool operator==(const ReferenceOptions&) const = default;
};

/// Returns the reference options that the settings truth.* select.
ReferenceOptions reference_options(const Settings& settings);

/// Light, shadow settings of objects, and options for tracing a reference.
struct ReferenceQuery {
    Emitter emitter;
    std::vector<ObjectTraits> traits;  ///< one per object of the scene
    std::vector<LightView> views;      ///< views of the light's map, whose near planes limit nearest_m; may be empty
    ViewChooser chooser;               ///< selects the view of a point
    ReferenceOptions options;
};

/// Makes the query for the reference of one light of a frame. @throws Error when there is no such light
ReferenceQuery reference_query(const Scene& scene, const Settings& settings, const std::vector<FittedLight>& lights,
                               int light, const ReferenceOptions& options = {});

/// Light samples per pixel that the reference of an area light took: least, most and mean over all counted pixels
/// (PixelState::Counted).
struct SamplesUsed {
    int least = 0, most = 0;  ///< per pixel; 0: no area light was sampled
    double mean = 0;
};

/// Ray-traced reference of one light: per pixel its visibility, noise, and distances to occluders.
struct Reference {
    int width = 0, height = 0;
    int step = 1;  ///< pixels of the picture, across and down, per pixel here (ReferenceOptions::step)
    std::vector<ObjectTraits> traits;  ///< of the traced scene's objects
    std::vector<PixelState> state;     ///< top row first, as all images here
    /// Visibility, 1 lit to 0 in shadow. Pixels that do not count: 1 (Background, NotReceiving), 0 (FacesAway,
    /// ShadowTerminator), or the
    /// traced value (OutsideCone, BeyondRange), as in the shadow-mapped visibility.
    FloatImage visibility;
    FloatImage point_visibility;  ///< area: visibility of a light without size; see hard()
    /// Area: estimated standard error of `visibility`; 0 where that is exact, NaN where unknown (no two neighbouring
    /// samples on the light). Otherwise empty.
    FloatImage standard_error;
    /// Distance in metres along the pixel's light ray from its surface to the occluder nearest the light, which a
    /// shadow map stores: with the culling of casters, beyond the map's near plane. NaN without an occluder. Empty
    /// without ReferenceOptions::nearest.
    FloatImage nearest_m;
    /// Distance as nearest_m, but over all casters from both sides, without culling and near plane: the content of a
    /// map that loses no caster. NaN where the surface is lit. Empty without ReferenceOptions::nearest.
    FloatImage blocker_m;
    std::array<std::size_t, kPixelStates> pixels{};  ///< per state
    std::size_t on_ground = 0;                       ///< counted pixels of the ground disc under a model
    std::uint64_t rays = 0;                          ///< number of rays to the light
    /// Area: root mean square of the known standard errors of counted pixels; NaN when none is known.
    double noise = 0;
    std::size_t noise_unknown = 0;  ///< area: counted pixels whose standard error is unknown
    SamplesUsed samples;
    std::size_t partial = 0;  ///< area: counted pixels in penumbra

    TrackedMemory held = {};  ///< bytes of all images

    /// Returns the visibility of a light without size: 0 or 1.
    const FloatImage& hard() const { return point_visibility.data.empty() ? visibility : point_visibility; }
    /// Returns the number of counted pixels.
    std::size_t counted() const { return pixels[std::size_t(PixelState::Counted)]; }
    /// Returns true when the reference was traced for an area light.
    bool is_area() const { return !standard_error.data.empty(); }
};

/// Caster that shadows a receiver, but that the shadow map does not hold.
struct MissingCaster {
    std::uint32_t object = 0;  ///< index in ReferenceGeometry::objects
    bool culled = false;       ///< face culling left it out; else the near plane
};
/// Finds a caster that shadows a receiver, but that face culling or the near plane kept out of the shadow map. Of
/// several it is the one nearest the light; nullopt: none.
/// @param query light, culling and views of the map
std::optional<MissingCaster> missing_caster(const ReferenceScene& scene, const Receiver& receiver,
                                            const ReferenceQuery& query);

/// Formats noise and sample counts of a reference: "noise 0.0031, 64 to 1024 samples a pixel (112 on average)". Empty
/// for a light without size.
std::string noise_text(const Reference& reference);

/// Function that receives each tile as it is traced, on the tracing threads. @param so_far reference in work, of which
/// the tile is finished @param first the tile's upper left pixel @param end the pixel after its lower right one
using TileDone = std::function<void(const Reference& so_far, glm::ivec2 first, glm::ivec2 end)>;

/// Traces the reference for every receiver. The result does not depend on the number of threads.
/// @param tile_done called after each tile; empty: nobody watches @throws Cancelled
Reference trace_visibility(const ReferenceScene& scene, const Receivers& receivers, const ReferenceQuery& query,
                           const Workers& workers, const TileDone& tile_done = {});

}  // namespace si
