// Fixes: setting changes that may cure wrong pixels, each drawn and measured before it is offered.
//
//     FixTable table = find_fixes(renderer, scene, settings, 1280, 720, {.pixel = glm::ivec2(640, 360)}, cache);
//     table.rows.front().cured                       // number of pixels that the first fix makes right
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "renderer/advise/bias_needs.h"
#include "renderer/inspect/pixel_diagnosis.h"

namespace si {

/// Setting change that may cure wrong pixels, not yet measured.
struct FixCandidate {
    std::string name;        ///< "least bias, constant alone"
    Settings settings;       ///< settings with the change
    std::string untried;     ///< reason why the fix is not drawn and measured; empty: it is
    std::string label = {};  ///< name for people; empty: `name`
};

/// Measurements of a frame from which fixes are proposed.
struct FixFacts {
    BiasNeeds needs;
    std::vector<FittedLight> lights;
    int light = 0;           ///< index of light.*
    int map_resolution = 0;  ///< texels per side, as drawn
    int max_resolution = 0;  ///< limit of the driver, texels per side
    /// Value of map.resolution at which 95 % of the undersampled pixels would have narrow enough texels; 0: no pixel is
    /// undersampled.
    double sampling_resolution = 0;
    /// Least bias of each row of the bias table that no bias family uses.
    std::vector<std::pair<const Bias*, BiasSettings>> least_of_rows;
};
/// Collects the measurements of a frame from which fixes are proposed. @param settings settings of the measured frame
FixFacts fix_facts(const MeasuredError& measured, const Settings& settings, const DriverInfo& driver);

/// Returns the least bias of a family for a frame by theory, rounded up by 0.1 % and to three digits.
BiasSettings least_bias_of(const BiasNeeds& needs, BiasFamily family);
/// Returns the kernels that blur shadow edges over the next smaller and the next larger width, of all square kernels at
/// their own sizes. Empty: none.
std::pair<std::string_view, std::string_view> adjacent_kernels(const Settings& settings);
/// Lists the settings that differ between two sets, as keys and values for set_setting().
/// @param with the settings whose values are returned
std::vector<std::pair<std::string, std::string>> setting_changes(const Settings& base, const Settings& with);

/// Converts the fix suggested by a pixel diagnosis to a candidate for measuring.
FixCandidate suggested_candidate(const SuggestedFix& fix, const Settings& settings);

/// Proposes setting changes that may cure wrong pixels: bias, culling, kernel, resolution, fit. Leaves out changes
/// without effect. Draws nothing.
std::vector<FixCandidate> fix_candidates(const Settings& settings, const FixFacts& facts);

/// Measured change of a frame time with its noise.
struct CostChange {
    double value = 0;  ///< milliseconds; negative: faster
    double noise = 0;  ///< half the confidence interval, milliseconds
    /// Returns true when the change of the frame time exceeds its noise.
    bool is_significant() const { return std::abs(value) > noise; }
};

/// Formats a change of the frame time: "+1.2 ms", "< noise", or "-" when not timed.
std::string time_text(const std::optional<CostChange>& ms);
/// Formats a change of the maps' memory: "+12 MiB", or "same".
std::string map_bytes_text(long long bytes);

/// Setting change with the measured numbers of pixels that it cures and breaks.
struct MeasuredFix {
    std::string name;  ///< name in files
    std::vector<std::pair<std::string, std::string>>
        settings;                                    ///< changed settings: keys and new values for set_setting()
    std::string untried;                             ///< reason why nothing was measured; empty: measured
    std::size_t cured = 0;                           ///< number of wrong pixels that become right
    std::size_t broken = 0;                          ///< number of right pixels that become wrong
    std::array<std::size_t, kArtefacts> cured_of{};  ///< cured pixels by cause
    std::optional<bool> pixel_right;                 ///< FixOptions::pixel becomes right
    std::optional<CostChange> ms;  ///< change of the time of passes that the fix affects; none: not timed
    long long map_bytes = 0;       ///< change of the maps' memory, bytes
    std::string label = {};        ///< name for people; empty: `name`
    /// Returns the name of the fix for people.
    const std::string& shown_name() const { return label.empty() ? name : label; }
    /// Returns the number of cured minus broken pixels.
    long long gain() const { return (long long)cured - (long long)broken; }
};

/// Table of measured fixes for the wrong pixels of a frame.
struct FixTable {
    /// Fixes by gain(), then by time. Fixes that make FixOptions::pixel right come first, unmeasured ones last.
    std::vector<MeasuredFix> rows;
    std::size_t wrong = 0;                           ///< number of wrong pixels before
    std::array<std::size_t, kArtefacts> wrong_of{};  ///< wrong pixels by cause
};

/// Options of find_fixes(): pixel to cure, timing, reference, and further candidates.
struct FixOptions {
    std::optional<glm::ivec2> pixel;  ///< pixel to cure, from the top left
    bool time = false;                ///< times each fix, too
    int frames = 7;                   ///< timed frames with and without a fix; slow frames: at least two
    ReferenceOptions reference;
    std::vector<FixCandidate> more;  ///< further candidates
};

/// Searches for fixes of the wrong pixels in a frame: proposes setting changes, draws each, counts cured and broken
/// pixels, and times them on request. Call on the renderer's thread.
/// @param width, height of the picture in pixels
/// @param report receives the share done, 0..1, and the present fix
/// @throws Cancelled, Error
FixTable find_fixes(Renderer& renderer, const Scene& scene, const Settings& settings, int width, int height,
                    const FixOptions& options, ReferenceCache& cache, const Workers& workers = {},
                    const std::function<void(double, const std::string&)>& report = {});

}  // namespace si
