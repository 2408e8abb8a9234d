// What would put wrong pixels right: changes of settings, each drawn and judged before it is offered.
//
//     FixTable table = find_fixes(renderer, scene, settings, 1280, 720, {.pixel = glm::ivec2(640, 360)}, cache);
//     table.rows.front().cured                       // apply its settings, measure: exactly so many
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "renderer/advise/bias_needs.h"
#include "renderer/inspect/pixel_diagnosis.h"

namespace si {

/// A change that may put pixels right.
struct FixCandidate {
    std::string name;        ///< "least bias, constant alone"
    Settings settings;       ///< with the change
    std::string untried;     ///< why it is not drawn; empty: it is
    std::string label = {};  ///< as people read it; empty: as it is named
};

/// What ideas depend on beside the settings.
struct FixFacts {
    BiasNeeds needs;
    std::vector<FittedLight> lights;
    int light = 0, map_resolution = 0, max_resolution = 0;
    /// Texels of map.resolution at which nineteen of twenty undersampled pixels have texels no wider than what they
    /// show; 0: none is.
    double sampling_resolution = 0;
    /// The least bias of each row of the bias table that no family of `needs` spends.
    std::vector<std::pair<const Bias*, BiasSettings>> least_of_rows;
};
FixFacts fix_facts(const MeasuredError& measured, const Settings& settings, const DriverInfo& driver);

/// The least bias of a family that clears what is seen, a little above what theory says.
BiasSettings least_bias_of(const BiasNeeds& needs, BiasFamily family);
/// Of the square kernels at their own sizes the next narrower and the next wider by how far they displace edges; empty
/// where there is none.
std::pair<std::string_view, std::string_view> adjacent_kernels(const Settings& settings);
/// Key and value of what differs, as set_setting() takes them.
std::vector<std::pair<std::string, std::string>> setting_changes(const Settings& base, const Settings& with);

/// A dossier's remedy, to be tried like the others.
FixCandidate suggested_candidate(const SuggestedFix& fix, const Settings& settings);

/// All that may help under these settings; changes that change nothing are left out. Pure.
std::vector<FixCandidate> fix_candidates(const Settings& settings, const FixFacts& facts);

struct CostChange {
    double value = 0, noise = 0;  ///< milliseconds, noise of the difference; below it there is none
    bool told() const { return std::abs(value) > noise; }
};

/// "+1.2 ms", "< noise", or "-" where nothing was timed.
std::string time_text(const std::optional<CostChange>& ms);
/// "+12 MiB", or "same".
std::string map_bytes_text(long long bytes);

struct MeasuredFix {
    std::string name;  ///< in files
    std::vector<std::pair<std::string, std::string>>
        settings;                       ///< key and value of what changes, as set_setting() takes them
    std::string untried;                ///< why nothing of the following is known; empty: it is
    std::size_t cured = 0, broken = 0;  ///< pixels: wrong before and right with it; right before and wrong with it
    std::array<std::size_t, kArtefacts> cured_of{};  ///< the cured ones by what was wrong
    std::optional<bool> pixel_right;                 ///< whether the pixel asked for is right with it
    std::optional<CostChange> ms;                    ///< of the passes that it changes; nothing unless timed
    long long map_bytes = 0;                         ///< more of them than before
    std::string label = {};                          ///< as people read it; empty: as it is named
    const std::string& shown_name() const { return label.empty() ? name : label; }
    long long gain() const { return (long long)cured - (long long)broken; }
};

struct FixTable {
    std::vector<MeasuredFix>
        rows;  ///< by cured - broken, then milliseconds; with a pixel those first that put it right; untried last
    std::size_t wrong = 0;  ///< pixels before
    std::array<std::size_t, kArtefacts> wrong_of{};
};

struct FixOptions {
    std::optional<glm::ivec2> pixel;  ///< of the picture, from the top left
    bool time = false;
    int frames = 7;  ///< timed, of each side; fewer, but two at least, of frames that take long
    ReferenceOptions reference;
    std::vector<FixCandidate> more;  ///< tried besides
};

/// Draws, judges and times every idea. On the renderer's thread. `report` hears of the share done and what is tried.
/// @throws Cancelled, Error
FixTable find_fixes(Renderer& renderer, const Scene& scene, const Settings& settings, int width, int height,
                    const FixOptions& options, ReferenceCache& cache, const Workers& workers = {},
                    const std::function<void(double, const std::string&)>& report = {});

}  // namespace si
