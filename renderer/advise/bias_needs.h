// Depth bias that a whole frame needs, by theory: the start of every search for the least bias.
#pragma once

#include <optional>

#include "renderer/bias/account.h"
#include "renderer/measure/frontier.h"
#include "renderer/measure/measured_error.h"
#include "renderer/settings/biases.h"

namespace si {

/// Numbers of pixels of a frame that are darkened for lack of bias, and the side effects of the frame's present bias:
/// lit gaps at casters and shifted shadow edges.
struct BiasNeeds {
    std::size_t pixels = 0;  ///< number of pixels that are lit in the reference and covered by the map
    /// Number of faintly darkened pixels, half lit or more, on planes with less bias than they need.
    std::size_t faint_acne = 0;
    /// Number of faintly darkened pixels on planes with enough bias, where an adjoining surface rises within the
    /// kernel's reach, as a wall above its floor.
    std::size_t folds = 0;
    /// Width of the lit gap at casters that touch their receiver, under the present bias, metres.
    double gap_median_m = 0, gap_p95_m = 0;
    /// Shift of shadow edges along the surface by the normal offset, h tan(theta), 95th percentile, metres.
    double shift_p95_m = 0;
};

/// Counts the pixels of a frame that lack bias, and measures lit gaps at casters and shifts of shadow edges.
/// Considers only pixels that the error metrics count and that are lit in the reference and covered by the shadow map,
/// since other pixels cannot show acne. Gaps and shifts come from an even sample of these pixels.
/// @param measured errors of the frame against the reference @param settings settings of the same frame
/// @param driver traits of the rasteriser, on which polygon offset depends
BiasNeeds bias_needs(const MeasuredError& measured, const Settings& settings, const RasterTraits& driver);

/// Returns true when a frame, compared with the reference, has a pixel that can show acne. Such a pixel is counted in
/// this comparison, lit in the reference, and covered by the shadow map.
bool has_lit_receivers(const MeasuredError& measured);

/// Returns the distance of a point from the camera along the viewing axis, metres. Negative behind the camera.
double depth_along_axis_m(const Camera& camera, const glm::dvec3& position_ws);
/// Returns the world-space width of one pixel at a distance along the camera's viewing axis, metres.
/// @param depth_m distance along the axis; no effect for an orthographic camera
/// @param lines height of the picture in pixels
double pixel_m(const Camera& camera, double depth_m, int lines);

/// Computes where one pixel's surface point lies in the shadow map, and its depth there. The light is the one whose
/// errors `measured` holds. Takes a fraction of the time of MeasuredBias::breakdown(), which also computes the bias.
LightReceiver receiver_in_light(const MeasuredError& measured, const Settings& settings, const Receiver& receiver);

/// Calculator of the depth bias at pixels of a frame whose errors were measured. Keeps references to the constructor's
/// arguments, which must outlive it.
class MeasuredBias {
public:
    /// Makes the calculator. Keeps references to all arguments.
    /// @param settings settings with the bias to examine, which may differ from the bias of the frame
    MeasuredBias(const MeasuredError& measured, const Settings& settings, const RasterTraits& driver);
    /// Computes the depth bias under the settings at the surface point of one pixel, with the share of each setting.
    /// Includes the least bias that avoids acne at this point.
    BiasBreakdown breakdown(const Receiver& receiver) const;

private:
    const MeasuredError& measured_;
    const Settings& settings_;
    const RasterTraits& driver_;
    glm::dvec3 origin_ws_;  ///< origin of positions in shaders
    double kernel_reach_texels_;
};

/// Computes the least settings of one kind of bias (row of the bias table) under which 999 of 1000 pixels that can show
/// acne have enough bias. Uses an even sample of the pixels that bias_needs() considers. Amounts are in texels where
/// bias.unit applies, and end at the limits of the settings. Kinds that compute the needed bias per pixel get no
/// amounts. Normal offset and polygon offset, which act beside bias.kind, get bias.kind=constant.
/// @return none when the light draws no map, or when some pixels need bias and the kind adds bias at no pixel, whatever
/// its amount
std::optional<BiasSettings> least_bias_of_row(const Bias& row, const MeasuredError& measured, const Settings& settings,
                                              const RasterTraits& driver);

/// Returns bias settings whose amounts are all multiplied by a factor and clamped to the limits of the settings.
BiasSettings scale_bias(const BiasSettings& bias, double factor);

}  // namespace si
