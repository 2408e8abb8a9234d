// Fixes: setting changes that put wrong pixels right. Each is drawn and measured before it is offered.
//
//     FixTable table = find_fixes({renderer, scene, 1280, 720, cache}, settings, {.pixel = glm::ivec2(640, 360)});
//     if (const Trial* fix = table.fix()) apply(fix->changes);
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "renderer/advise/least_bias.h"
#include "renderer/advise/own_map.h"
#include "renderer/inspect/pixel_diagnosis.h"

namespace si {

/// Measurements of a frame from which fix_candidates() proposes setting changes for its wrong pixels.
struct FixFacts {
    std::vector<BiasStart> starts;  ///< rows of the bias table; empty when no pixel needs bias
    std::vector<FittedLight> lights;
    int light = 0;           ///< index of the light in the settings light.*
    int map_resolution = 0;  ///< texels per side, as drawn
    int max_resolution = 0;  ///< limit of the driver, texels per side
    /// Value of map.resolution at which 95 % of the undersampled pixels would have narrow enough texels; 0: no pixel is
    /// undersampled.
    double sampling_resolution = 0;
};
/// Collects the measurements of a frame from which fix_candidates() proposes setting changes for its wrong pixels.
/// @param settings settings of the measured frame
FixFacts fix_facts(const MeasuredError& measured, const Settings& settings, const DriverInfo& driver);

/// Returns the keys of two filter kernels: the one that blurs shadow edges over the next smaller width than the present
/// kernel, and the one over the next larger width. Considers only the square kernels in the list of sweep_kernels(). A
/// key is empty if there is no such kernel.
std::pair<std::string_view, std::string_view> adjacent_kernels(const Settings& settings);

/// Converts the fix that a pixel diagnosis suggests into a candidate, which search_fixes() draws and measures.
/// @param settings present settings, to which the fix is applied
Candidate suggested_candidate(const SuggestedFix& fix, const Settings& settings);

/// Choice of a short or a whole list of setting changes for fix_candidates().
enum class FixList {
    Short,  ///< changes that help most often
    Whole,  ///< also all kernels, and more strengths of each bias
};

/// Proposes setting changes that may put wrong pixels right, the most promising first. The changes concern bias,
/// culling, near and far planes, kernel, map resolution, fit and map format. Leaves out changes without effect.
/// Candidates whose bias would reach the limit of a setting are listed as untried (Candidate::untried). Draws nothing.
std::vector<Candidate> fix_candidates(const Settings& settings, const FixFacts& facts, FixList list);

/// Result of a search for fixes: all tried setting changes for the wrong pixels of a frame, the best first.
struct FixTable {
    /// Trials: fixes, then other drawn trials, then undrawn ones. Each group is sorted by mean error, wrong pixels and
    /// frame time; fixes on the program's own map (Trial::on_own_map) come after other fixes. Trial::why_not is empty
    /// for a fix. A fix puts the watched pixel right within kRightVisibilityError; without a watched pixel, it lowers
    /// the mean error. It raises neither wrong pixels, mean error, any acne nor any leak. It keeps light.source, the
    /// camera and the reference, and at most doubles the shadow's time and the bytes of the maps.
    std::vector<Trial> rows;
    std::size_t wrong = 0;                           ///< number of wrong pixels under the present settings
    std::array<std::size_t, kArtefacts> wrong_of{};  ///< these wrong pixels by cause
    std::size_t candidates = 0;                      ///< number of candidates, drawn or not
    std::size_t refused = 0;                         ///< number of further changes, which the engine lacks; not tried
    bool stopped = false;                            ///< stopped before all candidates were tried
    /// Returns the best fix of this search; null: no tried setting change is a fix.
    const Trial* fix() const;
    /// Returns the best trial whose unknown frame time alone may keep it from being a fix; null: none. A search that is
    /// stopped before it times one has no fix().
    const Trial* untimed_fix() const;
    /// Returns the trial that puts most wrong pixels of one cause right; null: no trial does. Considers fixes, and
    /// trials that were not timed but meet all other conditions of a fix.
    const Trial* fix_of(Artefact cause) const;
    /// Returns the number of candidate setting changes whose picture the search has drawn so far.
    std::size_t drawn() const;
};

/// Largest difference between a pixel's visibility and the reference at which a fix counts as putting the pixel right.
inline constexpr float kRightVisibilityError = 0.25f;

/// Options of find_fixes(), which searches setting changes that put wrong pixels right: watched pixel, timing, and
/// further candidates.
struct FixOptions {
    /// Pixel to put right, from the top left, compared with a light without size as in a pixel diagnosis; none: all
    /// wrong pixels of the picture.
    std::optional<glm::ivec2> pixel;
    bool time = false;   ///< true: times every trial; false: only trials that may be the best fix
    bool first = false;  ///< true: tries the whole list only if the short list has no fix
    FixList list = FixList::Short;
    std::vector<Candidate> more = {};  ///< further candidates
};

/// Tries candidates as fixes of a frame's wrong pixels, and rates them. Draws and times by means of `meter`.
/// @param before the present settings, with their frame
/// @param shown receives the table so far, after each trial; the first fix is then timed at once, in few rounds
/// @param enough number of candidates after which a fix ends the search
/// @param own returns the program's own maps, for changes that need another map than the imported one; called at the
/// first such change. Empty: such changes are not tried
/// @returns the table so far when the meter or the report throws Cancelled
FixTable search_fixes(const Settings& base, const MeasuredSettings& before, std::vector<Candidate> candidates,
                      const TrialMeter& meter, const FixOptions& options, const TrialReport& report = {},
                      const std::function<void(const FixTable&)>& shown = {},
                      std::size_t enough = std::numeric_limits<std::size_t>::max(),
                      const std::function<OwnMap()>& own = {});

/// Searches for fixes of the wrong pixels in a frame: proposes setting changes, draws each, counts cured and broken
/// pixels, and times the changes that may be the best fix.
/// @param shown receives the table so far, after each trial
/// @throws Error; Cancelled before the first trial. Later the table so far is returned
FixTable find_fixes(const SearchTools& tools, const Settings& settings, const FixOptions& options,
                    const std::function<void(const FixTable&)>& shown = {});

}  // namespace si
