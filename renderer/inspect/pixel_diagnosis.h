// Why a probed pixel is lit or dark, whether that is true, and what would put it right.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/inspect/fragment_reference.h"
#include "renderer/render/renderer.h"

namespace si {

/// Rounded up to three digits, so that what was just enough stays so; 0 for what is not above 0.
double round_up_3_digits(double v);

/// Settings that put the pixel right, by what is known of its plane.
struct SuggestedFix {
    std::vector<std::pair<std::string, std::string>> settings;  ///< key and value, as set_setting() takes them
    std::string text;                                           ///< "set bias.slope to 1.8 texels"
    double equivalent_bias_texels =
        0;  ///< depth bias that the pixel has with it, where a bias is what it sets; 0: not known
};

/// What it sets by the names that are on the screen: "Slope bias 1.8 texels".
std::string fix_text(const SuggestedFix& fix, const Settings& settings);
/// " (worth 1.2 texels of depth bias here)"; empty where that is not known.
std::string equivalent_bias_text(const SuggestedFix& fix);

/// A light's verdict about the pixel. The window of depth biases that are right for it is [least, occluder): less, and
/// its surface shadows itself; as much or more, and the surface that keeps the light from it is lost.
struct PixelDiagnosis {
    int light = 0;
    FragmentReference reference;
    DepthShift least;   ///< bias that the surface needs
    DepthShift has;     ///< what all bias is worth against acne
    DepthShift lifted;  ///< how far the bias moves the compared depth towards the light
    /// To the surface nearest the light, along the light's axis; infinite where none stands before the pixel's.
    DepthShift occluder{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                        std::numeric_limits<double>::infinity()};
    /// Whether some depth bias is right: always where nothing stands between surface and light.
    bool window_open() const { return least.depth < occluder.depth; }
    Cause cause() const { return reference.cause; }
    /// Least power of two of map.resolution at which the window opens; 0 when it is open, infinite when none does it as
    /// the format's steps alone are too coarse.
    double opening_resolution = 0;
    bool right = true;    ///< visibility and truth are on the same side of one half
    std::string verdict;  ///< a sentence
    std::optional<SuggestedFix> fix;
};

/// @param settings that were probed
PixelDiagnosis explain(const Probe& probe, const Probe::PerLight& light, const FragmentReference& reference,
                       const Settings& settings, const DriverInfo& driver);

}  // namespace si
