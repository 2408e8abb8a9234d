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
    FacesAway,         ///< visible side faces away from the light (faces_light()): dark without any occluder
    OutsideCone,       ///< outside a spot light's cone
    NotReceiving,      ///< object.PATH.receive is off
    BeyondRange,       ///< beyond the range of a spot or point light, in its cone
    ShadowTerminator,  ///< as FacesAway, but the smooth normal (of the vertices) faces the light: no bias cures it
};
inline constexpr std::size_t kPixelStates = 7;
/// Returns true when the reference traces rays for pixels of a state. Comparisons leave out some of these pixels.
constexpr bool is_traced(PixelState s) {
    return s == PixelState::Counted || s == PixelState::OutsideCone || s == PixelState::BeyondRange;
}

/// Options for tracing a reference: kind of light, culling, number of rays and resolution.
struct ReferenceOptions {
    bool area = false;           ///< true: area light of the light's size; false: point or parallel light
    bool as_rasterised = false;  ///< faces that culling removes from the shadow map cast no shadow here either
    int samples = 1024;          ///< area light: most rays per pixel; penumbrae take 64, and more while noisy
    int first_samples = 8;       ///< area light: first rays per pixel; more where they or a neighbour's disagree
    double noise = 0.005;        ///< area light: target standard error of a pixel's visibility
    bool nearest = true;         ///< compute Reference::nearest_m and blocker_m
    int step = 1;                ///< pixels of the picture per pixel of the reference, across and down
    bool operator==(const ReferenceOptions&) const = default;
};

/// Returns the reference options that the settings truth.* select.
ReferenceOptions reference_options(const Settings& settings);

/// Input of trace_visibility(): the light, shadow settings of objects, views of the map, and options.
struct ReferenceQuery {
    Emitter emitter;
    std::vector<ObjectTraits> traits;  ///< one per object of the scene
    std::vector<LightView> views;      ///< views of the light's map, whose near planes limit nearest_m; may be empty
    ViewChooser chooser;               ///< selects the view of a point
    ReferenceOptions options;
};

/// Collects the input of trace_visibility() for one light of a frame. @throws Error when there is no such light
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
    std::vector<ObjectTraits> traits;  ///< by object of the traced scene
    std::vector<PixelState> state;     ///< top row first, as all images here
    /// Visibility, 1 lit to 0 in shadow. Pixels that are not counted: 1 (Background, NotReceiving), 0 (FacesAway,
    /// ShadowTerminator), or the traced value (OutsideCone, BeyondRange), as in the shadow-mapped visibility.
    FloatImage visibility;
    FloatImage point_visibility;  ///< area light: visibility of a light without size, see hard(); else empty
    /// Area light: estimated standard error of `visibility`; 0 where all samples agree, NaN where there are too few.
    /// Empty for other lights.
    FloatImage standard_error;
    /// Distance in metres from the pixel's surface, towards the light's centre, to the occluder that the shadow map
    /// stores: the one nearest the light. Culled faces, and casters in front of the map's near plane, do not count. NaN
    /// without an occluder. Empty without ReferenceOptions::nearest.
    FloatImage nearest_m;
    /// Distance like nearest_m, but over all casters from both sides, without culling and near plane: the content of a
    /// map that loses no caster. NaN where a light without size is visible. Empty without ReferenceOptions::nearest.
    FloatImage blocker_m;
    std::array<std::size_t, kPixelStates> pixels{};  ///< number of pixels per state
    std::size_t on_ground = 0;                       ///< counted pixels on the ground disc under a model
    std::uint64_t rays = 0;                          ///< number of rays to the light
    /// Area light: root mean square of the known standard errors of counted pixels; NaN when none is known.
    double noise = 0;
    std::size_t noise_unknown = 0;  ///< area light: counted pixels whose standard error is unknown
    SamplesUsed samples;
    std::size_t partial = 0;  ///< area light: counted pixels in penumbra

    TrackedMemory held = {};  ///< bytes of all images

    /// Returns the visibility of each pixel under the same light without size: 0 or 1.
    const FloatImage& hard() const { return point_visibility.data.empty() ? visibility : point_visibility; }
    /// Returns the number of pixels that comparisons count (PixelState::Counted).
    std::size_t counted() const { return pixels[std::size_t(PixelState::Counted)]; }
    /// Returns true when the reference was traced for an area light.
    bool is_area() const { return !standard_error.data.empty(); }
};

/// Caster that shadows a receiver, but that is missing from the shadow map.
struct MissingCaster {
    std::uint32_t object = 0;  ///< index in ReferenceGeometry::objects
    bool culled = false;       ///< true: face culling left the caster out; false: the near plane did
};
/// Finds a caster that shadows a receiver, but that face culling or the near plane kept out of the shadow map. Returns
/// the one nearest the light if there are several; nullopt without any.
/// @param query light, culling and views of the map
std::optional<MissingCaster> missing_caster(const ReferenceScene& scene, const Receiver& receiver,
                                            const ReferenceQuery& query);

/// Formats noise and sample counts of a reference: "noise 0.0031, 64 to 1024 samples a pixel (112 on average)". Empty
/// for a light without size.
std::string noise_text(const Reference& reference);

/// Callback after each traced tile (square of pixels) of a reference, called on the tracing threads.
/// @param so_far unfinished reference, in which the tile's pixels are set
/// @param first the tile's upper left pixel
/// @param end the pixel after the tile's lower right one
using TileDone = std::function<void(const Reference& so_far, glm::ivec2 first, glm::ivec2 end)>;

/// Traces the reference: the visible share of one light at every receiver (surface point of a pixel). The result does
/// not depend on the number of threads.
/// @param tile_done called after each tile; empty: no callback
/// @throws Cancelled; Error when `query` and `scene` have different numbers of objects
Reference trace_visibility(const ReferenceScene& scene, const Receivers& receivers, const ReferenceQuery& query,
                           const Workers& workers, const TileDone& tile_done = {});

}  // namespace si
