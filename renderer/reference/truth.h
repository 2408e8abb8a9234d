// The ray-traced truth about one light's shadows: what each pixel's surface sees of the light.
//
//     auto geometry = std::make_shared<ReferenceGeometry>(scene, settings);           // a copy; any thread from here
//     on ReferenceScene casters(geometry);                                               // the hierarchy Receivers
//     receivers = place_receivers(*geometry, frame.camera, renderer.read_surface_ids(frame.surface_ids), {}); Truth
//     truth = trace_visibility(casters, receivers, reference_query(scene, settings, frame.lights, 0), {});
//     truth.visibility.at(x, y);                                                  // 1 lit ... 0 in shadow
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/reference/emitter.h"
#include "renderer/reference/receivers.h"
#include "renderer/reference/truth_scene.h"

namespace si {

/// Whether a pixel counts in comparisons, and if not, why.
enum class PixelState : std::uint8_t {
    Counted,       ///< faces the light and lies in its cone and range
    Background,    ///< shows no surface
    FacesAway,     ///< not faces_light(N_g.L): no light whatever stands between
    OutsideCone,   ///< of a spot light
    NotReceiving,  ///< object.PATH.receive is off
    BeyondRange,   ///< of a spot or point light, in its cone
};
inline constexpr std::size_t kPixelStates = 6;
/// Whether the truth of the surface is traced, counted or not.
constexpr bool is_traced(PixelState s) {
    return s == PixelState::Counted || s == PixelState::OutsideCone || s == PixelState::BeyondRange;
}

struct ReferenceOptions {
    bool area = false;           ///< the light has its size; else it is a point or a direction
    bool as_rasterised = false;  ///< faces that culling leaves out of the shadow map cast nothing here either
    int samples = 1024;          ///< area: most rays a pixel. 64 everywhere, then four times as many, as noise demands
    double noise = 0.005;        ///< area: wanted standard error of a pixel's visibility
    bool nearest = true;         ///< find Truth::nearest_m and blocker_m
    int step = 1;                ///< every that many pixels of the picture, across and down, are one of the truth's
    bool operator==(const ReferenceOptions&) const = default;
};

/// As truth.* of the settings say.
ReferenceOptions reference_options(const Settings& settings);

struct ReferenceQuery {
    Emitter emitter;
    std::vector<ObjectTraits> traits;  ///< by object
    std::vector<LightView> views;      ///< whose near planes bound what a map stores; may be empty
    ViewChooser chooser;               ///< of them
    ReferenceOptions options;
};

/// The query for a light of a frame. @throws Error when there is no such light
ReferenceQuery reference_query(const Scene& scene, const Settings& settings, const std::vector<FittedLight>& lights,
                               int light, const ReferenceOptions& options = {});

/// How many points of the light the estimates of counted pixels rest on, above the surface's horizon or below.
struct SamplesUsed {
    int least = 0, most = 0;  ///< of a pixel; 0: no light of size was sampled
    double mean = 0;
};

struct Reference {
    int width = 0, height = 0;
    int step = 1;                   ///< pixels of the picture, across and down, per pixel here (ReferenceOptions::step)
    std::vector<PixelState> state;  ///< top row first, as all images here
    /// 1 lit to 0 in shadow. Where a pixel does not count: 1 (Background, NotReceiving), 0 (FacesAway), or what is true
    /// of the surface (OutsideCone, BeyondRange), as the shadow mapped visibility has it.
    FloatImage visibility;
    FloatImage point_visibility;  ///< area: the same for a light without size; see hard()
    /// Area: estimated standard error of `visibility`, 0 where it is no estimate. NaN where it is unknown: no two
    /// samples that are neighbours on the light. Else empty.
    FloatImage standard_error;
    /// Metres along the pixel's light ray from its surface to the surface nearest the light, which is what a shadow map
    /// stores: under the culling of casters and beyond the map's near plane. NaN where none stands before the pixel's.
    /// Empty without ReferenceOptions::nearest.
    FloatImage nearest_m;
    /// The same over all casters from both sides, whatever is culled and wherever the near plane stands: what a map
    /// would store that loses no caster. NaN where the surface is lit. Empty without ReferenceOptions::nearest.
    FloatImage blocker_m;
    std::array<std::size_t, kPixelStates> pixels{};  ///< per state
    std::size_t on_ground = 0;                       ///< counted pixels of the ground under a model
    std::uint64_t rays = 0;                          ///< to the light
    /// Area: root mean square of the counted pixels' standard errors that are known; NaN when none is.
    double noise = 0;
    std::size_t noise_unknown = 0;  ///< area: counted pixels whose standard error is unknown
    SamplesUsed samples;
    std::size_t partial = 0;  ///< area: counted pixels that see a part of the light

    HeldMemory held = {};  ///< what it takes

    /// Visibility of a light without size: 0 or 1.
    const FloatImage& hard() const { return point_visibility.data.empty() ? visibility : point_visibility; }
    std::size_t counted() const { return pixels[std::size_t(PixelState::Counted)]; }
    /// Whether the light had its size.
    bool is_area() const { return !standard_error.data.empty(); }
};

/// How sure the truth is, in words: "noise 0.0031, 64 to 1024 samples a pixel (112 on average)". Empty without a size.
std::string noise_text(const Reference& reference);

/// Traces every pixel. Equal for any number of threads. @throws Cancelled
Reference trace_visibility(const ReferenceScene& scene, const Receivers& receivers, const ReferenceQuery& query,
                           const Workers& workers);

}  // namespace si
