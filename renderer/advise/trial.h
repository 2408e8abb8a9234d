// Trials: candidate settings that are drawn, compared with the reference and timed. Fixes, advice, the autopilot, the
// search for the least bias and the search for waste are rules that choose among trials.
//
//     TrialMeter meter = renderer_trial_meter({renderer, scene, 1280, 720, cache});
//     const MeasuredSettings now = meter.measure(settings, settings.view.light);
//     const CostChange more = meter.time(settings, candidate.settings);
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "renderer/measure/measure.h"
#include "renderer/profiles/engine_profile.h"

namespace si {

/// Receives the share of a search that is done, 0..1, and its present step. May throw Cancelled.
using TrialReport = std::function<void(double share, const std::string& step)>;

/// Renderer, scene, picture size, caches and progress callback of a search over settings. Use on the renderer's thread
/// only.
struct SearchTools {
    Renderer& renderer;
    const Scene& scene;
    int width, height;  ///< pixels of the picture
    ReferenceCache& cache;
    Workers workers = {};                   ///< threads of the reference, with the stop token of the search
    TrialReport report = {};                ///< receives progress; empty: no reports
    const EngineProfile* engine = nullptr;  ///< engine that will draw the result, which limits the changes; null: none
    /// Returns a copy of these tools for one step of a search: the step's progress 0..1 is reported as lo..hi. The
    /// `report` of the copy is never empty, and throws Cancelled once a stop was requested.
    SearchTools part(double lo = 0, double hi = 1) const;
};

/// Setting changes: keys and new values for set_setting().
using SettingChanges = std::vector<std::pair<std::string, std::string>>;
/// Lists the setting changes that turn `base` into `with`: keys, with their values in `with`.
SettingChanges setting_changes(const Settings& base, const Settings& with);

/// Measured frame time, or difference of two frame times, in milliseconds with its noise.
struct CostChange {
    double value = 0;  ///< milliseconds; a change below 0 is faster
    double noise = 0;  ///< half the confidence interval, milliseconds
    /// Returns true when the change of the frame time exceeds its noise.
    bool is_significant() const { return std::abs(value) > noise; }
};
/// Formats a change of the frame time: "+1.2 ms", "< noise", or "-" when not timed.
std::string time_text(const std::optional<CostChange>& ms);
/// Formats a change of the shadow maps' memory: "+12 MiB", or "same".
/// @param bytes bytes that are added; negative: saved
std::string map_bytes_text(long long bytes);

/// Measured error and work (WorkCost: texels, bytes, draw calls) of one frame under given settings.
struct MeasuredSettings {
    double error = 0;  ///< distance_from_best() of the metric
    double noise = 0;  ///< noise of the reference's pixels; NaN: unknown
    WorkCost work;     ///< without TrialOptions::work only the memory of the maps
    Camera camera;
    std::shared_ptr<const MeasuredError> frame = nullptr;  ///< classified pixels; null in tests without a renderer
};

/// Returns true when an engine has drawn the maps of a light; false without MeasuredSettings::frame.
/// @param light index of light.*
bool has_imported_maps(const MeasuredSettings& measured, int light);

/// Returns the number of wrong pixels of a measured frame, of all causes of error together.
std::size_t wrong_pixels(const ErrorMetrics& error);

struct Candidate;

/// Functions by which searches draw, measure and time settings. renderer_trial_meter() makes them from a renderer;
/// tests use a model instead.
struct TrialMeter {
    /// Draws a frame and measures the error of one light, given by its index in the settings light.*.
    std::function<MeasuredSettings(const Settings&, int light)> measure;
    /// Measures as `measure` does, but finds causes of errors only if the last argument, called with the compared
    /// pixels, returns true (measure_error()). Null: `measure` is used.
    std::function<MeasuredSettings(const Settings&, int light, const NeedsCauses&)> measure_in_steps = nullptr;
    /// Times frames of two settings in alternating rounds. Returns the milliseconds per frame that `with` adds to
    /// `before`.
    std::function<CostChange(const Settings& before, const Settings& with)> time;
    /// Times as `time` does, and ends as soon as the change is surely below or above a limit. Null: `time` is used.
    std::function<CostChange(const Settings& before, const Settings& with, double limit_ms)> time_to_limit = nullptr;
    /// Returns the bytes of the maps under some settings, without a trial. Null: unknown before a trial.
    std::function<std::uint64_t(const Settings&)> map_bytes = nullptr;
    /// Times frames under one set of settings. Returns the milliseconds per frame.
    std::function<CostChange(const Settings&)> ms = nullptr;
    /// Draws one frame of a candidate (setting change to try), without a reference. @throws Cancelled
    std::function<FrameResult(const Candidate&, FrameRequest)> draw = nullptr;
    std::function<double()> now_s = nullptr;  ///< present time in seconds, by any clock
    /// Times frames of two settings in as few rounds as possible, for a rough result. Uses `time` if time_to_limit is
    /// null.
    CostChange time_in_few_rounds(const Settings& before, const Settings& with) const {
        constexpr double kNoLimit = std::numeric_limits<double>::infinity();
        return time_to_limit ? time_to_limit(before, with, kNoLimit) : time(before, with);
    }
};

/// Options of renderer_trial_meter(): error metric, kind of timed frames, and options of the reference.
struct TrialOptions {
    const Metric* error = &metrics().front();        ///< metric of MeasuredSettings::error; not Better::Neither
    CostCase cost = kDefaultCost;                    ///< kind of frames that are timed
    bool work = true;                                ///< true: draws each frame once more to count its work
    std::optional<ReferenceOptions> reference = {};  ///< none: reference_options() of the settings
};

/// Makes a trial meter that draws and times frames with a renderer. The renderer, scene and cache of the tools must
/// outlive the meter.
TrialMeter renderer_trial_meter(const SearchTools& tools, const TrialOptions& options = {});

/// Result of time_alternately(), which draws frames of two kinds alternately: mean time of the first kind, and the time
/// that the second kind takes more.
struct AlternatingTimes {
    double before_ms = 0;  ///< mean of the first kind
    CostChange more;       ///< milliseconds that the second kind takes more
};
/// Times two kinds of frames in alternating rounds, so that drift of the machine's speed affects both alike. Ends when
/// the difference is known precisely enough, after a second or after 8 rounds.
/// @param before function that draws a round of frames of the first kind, whose shader programs are compiled, and
/// returns the milliseconds of one frame
/// @param with as `before`, for the second kind
/// @param limit_ms ends also once the difference is surely below or above this limit
/// @throws Cancelled
AlternatingTimes time_alternately(const std::function<double()>& before, const std::function<double()>& with,
                                  const std::stop_token& stop, std::optional<double> limit_ms = {});

/// Benefit that an advice rule claims for a setting change. The measurement confirms or rejects the claim.
enum class Claim {
    Same,   ///< same error in less time, or with fewer bytes
    Right,  ///< fewer wrong pixels
    Trade,  ///< less time for a little more error
};

/// Setting change that a search may draw and measure, with the reason for it.
struct Candidate {
    std::string name;            ///< the change, or the reason for it with its numbers
    Settings settings;           ///< settings with the whole change
    std::string untried = {};    ///< reason why the candidate is not drawn; empty: it is
    std::string label = {};      ///< name for people; empty: `name`
    std::string_view rule = {};  ///< AdviceRule::key; empty: a fix
    Claim claim = Claim::Right;
    int light = 0;                                 ///< light whose error is measured: index in the settings light.*
    std::shared_ptr<const Scene> scene = nullptr;  ///< changed scene, read by TrialMeter::draw; null: the frame's own
    std::optional<MapOfLight> emptied = {};        ///< map that TrialMeter::draw leaves empty
    /// Returns the name of the setting change for people.
    const std::string& shown_name() const { return label.empty() ? name : label; }
};

/// Visibility of one pixel in a trial (frame drawn with a setting change), beside that of the reference. The pixel is
/// the watched one, which a search for fixes is to put right.
struct PixelTrial {
    float visibility = 1, reference = 1;
    bool right = true;  ///< the pixel is not wrong
};

/// Returns the visibility of one pixel in a measured frame, beside that of the reference. Also returns whether the
/// pixel is right.
/// @param with the frame, drawn with a setting change @param pixel index of the pixel, top row first
PixelTrial pixel_trial(const MeasuredError& with, std::size_t pixel);

/// Result of trying a setting change, beside the present settings: error, work, frame time, and numbers of cured (now
/// right) and broken (now wrong) pixels.
struct Trial {
    Candidate candidate;
    SettingChanges changes;
    MeasuredSettings before, after;                  ///< MeasuredSettings::frame is null in both
    std::optional<CostChange> ms;                    ///< change of the frame time; none: not timed
    std::size_t cured = 0;                           ///< number of wrong pixels that become right
    std::size_t broken = 0;                          ///< number of right pixels that become wrong
    std::array<std::size_t, kArtefacts> cured_of{};  ///< cured pixels by cause
    ErrorMetrics metrics;             ///< metrics of the frame with the change; without causes if none were needed
    std::optional<PixelTrial> pixel;  ///< watched pixel; none: no pixel is watched
    std::string why_not;              ///< reason why the rule rejects the trial; empty: accepted
    /// True: the trial was drawn on the program's own maps in place of imported ones. Then `before` and `after` belong
    /// to own maps, too (OwnMap).
    bool on_own_map = false;
    /// Returns true when the setting change was drawn.
    bool is_drawn() const { return candidate.untried.empty(); }
    /// Returns the error that the change adds; below 0: the error falls.
    double added_error() const { return after.error - before.error; }
    /// Returns the largest rise of the error at which a tried change still counts as leaving the error unchanged. It is
    /// kSameErrorShare of the error before, at least kSameError and at least a tenth of the reference's noise.
    double tolerance() const;
    /// Returns the fall of the error that a tried change must exceed to count as an improvement: kSameError, or twice
    /// the noise of the mean error if that is larger.
    double least_gain() const;
    /// Returns the bytes of maps and look-ups that the change adds; below 0: it saves bytes.
    long long more_bytes() const { return (long long)after.work.bytes_touched - (long long)before.work.bytes_touched; }
    /// Returns the bytes of maps that the change adds; below 0: it saves bytes.
    long long map_bytes() const { return (long long)after.work.map_bytes - (long long)before.work.map_bytes; }
    /// Returns true when the tried change was drawn and helps. It helps if its rule accepts it (`why_not` is empty), or
    /// if it lowers the error and the watched pixel is right. Without a watched pixel, a lower error is enough.
    bool helps() const;
    /// Returns the number of cured minus broken pixels.
    long long gain() const { return (long long)cured - (long long)broken; }
};

/// Calls `attempt` for each candidate (setting change to try) in turn, after a report of the candidate's name. Returns
/// false when the report or `attempt` throws Cancelled.
/// @tparam C Candidate, or a type derived from it
/// @param attempt receives a candidate, which it may move; returns false when no further candidate is needed
template <class C>
bool try_each(std::vector<C> list, const TrialReport& report,
              const std::type_identity_t<std::function<bool(C&)>>& attempt) {
    try {
        for (std::size_t i = 0; i < list.size(); ++i) {
            if (report && list[i].untried.empty()) report(double(i) / double(list.size()), list[i].shown_name());
            if (!attempt(list[i])) break;
        }
        return true;
    } catch (const Cancelled&) {
        return false;
    }
}

/// Removes the candidate setting changes that an engine cannot draw. Returns the number of removed candidates.
/// @param engine engine that is to draw the found settings; null: nothing is removed
/// @param base present settings
std::size_t remove_refused(std::vector<Candidate>& list, const EngineProfile* engine, const Settings& base);

/// Largest rise of the error that counts as no rise: as a share of the error before the change, and absolute.
inline constexpr double kSameErrorShare = 0.02, kSameError = 5e-5;

/// Draws a frame with a candidate (setting change to try) and compares it with the present settings. A candidate that
/// cannot be compared, such as one that moves the camera, gets a reason in Candidate::untried.
/// @param base present settings @param before measurement under `base`, with its frame
/// @param pixel index of a pixel to watch, top row first
/// @param needs_causes decides whether Trial::metrics need causes; empty: they do
Trial try_candidate(const Settings& base, const MeasuredSettings& before, Candidate candidate, const TrialMeter& meter,
                    std::optional<std::size_t> pixel = {}, const NeedsCauses& needs_causes = {});

}  // namespace si
