// Pixel diagnosis: why a probed pixel is lit or in shadow, whether that is right, and a setting change that fixes it.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/inspect/fragment_reference.h"
#include "renderer/inspect/probe.h"
#include "renderer/render/renderer.h"

namespace si {

/// Rounds a number up to three significant digits. Used for suggested biases: a value that is just large enough remains
/// large enough. Returns 0 for numbers that are not positive.
double round_up_3_digits(double v);

/// Change of settings that makes one pixel's shadow test right, computed from the plane of the pixel's surface.
struct SuggestedFix {
    std::vector<std::pair<std::string, std::string>> settings;  ///< setting keys and values for set_setting()
    std::string text;                                           ///< "set bias.slope to 1.8 texels"
    double equivalent_bias_texels = 0;  ///< equivalent depth bias of the pixel with the fix; 0: unknown, or no bias fix
};

/// Formats the settings of a suggested fix with the labels that the editor shows: "Slope bias 1.8 texels".
std::string fix_text(const SuggestedFix& fix, const Settings& settings);
/// Formats the depth bias that acts against acne as much as a suggested fix does: " (equivalent depth bias 1.2
/// texels)". Empty where this bias is unknown.
std::string equivalent_bias_text(const SuggestedFix& fix);

/// Diagnosis of one light's shadow test at a pixel. Depth biases from `least` up to, but without, `occluder` are right
/// for the pixel. With less bias the surface shadows itself (acne). With more, the occluder's shadow is lost
/// (peter-panning).
struct PixelDiagnosis {
    int light = 0;  ///< index of the light in the settings light.*
    FragmentReference reference;
    DepthShift least;  ///< depth bias that the surface needs
    DepthShift has;    ///< equivalent depth bias of all bias settings
    DepthShift shift;  ///< actual shift of the compared depth towards the light by bias
    /// Distance from the surface to the occluder nearest the light, as a depth shift; infinite without an occluder.
    DepthShift occluder{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                        std::numeric_limits<double>::infinity()};
    /// Returns true when some depth bias is right; always where nothing occludes the light.
    bool window_open() const { return least.depth < occluder.depth; }
    /// Returns the cause of the pixel's shadow error.
    Cause cause() const { return reference.cause; }
    /// Returns true when a fix is wanted: the pixel is wrong, or right with faint acne or faint light.
    bool wants_fix() const { return cause().artefact != Artefact::None || cause().faint || reference.any_leak; }
    /// Smallest power of two for map.resolution at which some depth bias is right. 0: the present resolution is enough.
    /// Infinite: no resolution is, since the steps of the depth format alone are too coarse.
    double opening_resolution = 0;
    bool right = true;  ///< visibility and reference are both at least 0.5, or both below
    /// Knowledge of the engine's bias. Unknown or changed: the verdict is about this program's look-up of the engine's
    /// map, not about the engine's pixel.
    EngineBias engine_bias = EngineBias::Own;
    std::string verdict;                     ///< a sentence
    std::optional<SuggestedFix> fix;         ///< none when no fix is needed or known
    std::optional<SuggestedFix> fix_of_map;  ///< fix that needs another map from the engine; none on drawn maps
};

/// Diagnoses one light's shadow test at a probed pixel: verdict in words, range of right biases, suggested fix.
/// @param probe probe of the pixel @param light the probe's result for the light
/// @param reference ray-traced visibility of the pixel @param settings settings of the probed frame
PixelDiagnosis diagnose_pixel(const Probe& probe, const Probe::PerLight& light, const FragmentReference& reference,
                              const Settings& settings, const DriverInfo& driver);

}  // namespace si
