// Specification of a sweep: scene, settings, axes and picture size. Equal specifications give equal errors and costs,
// so that a sweep can be continued, split into shards and merged.
#pragma once

#include <string>
#include <string_view>

#include "app/base/json_text.h"
#include "app/session/session.h"
#include "renderer/measure/axes.h"
#include "renderer/measure/frame_costs.h"
#include "renderer/measure/shadow_time.h"
#include "renderer/settings/earlier.h"

namespace si {

/// Shard: one of `count` parts of a sweep, for several machines. Case n belongs to part n mod count.
struct Shard {
    int index = 1, count = 1;  ///< index from 1
    /// Returns true if the case belongs to this shard of the sweep.
    bool contains(std::size_t case_number) const { return int(case_number % std::size_t(count)) == index - 1; }
    bool operator==(const Shard&) const = default;
};

/// Parses the value of --shard: "2/8" is the second part of eight. @throws UsageError
Shard parse_shard(std::string_view text);

/// Timing options of a sweep. Rounds go on until every case's time has settled (time_sampler.h), up to a limit.
struct SweepTiming {
    bool on = true;
    CostCase cost = kFrontierCost;  ///< kind of frames to time
    int rounds = 10;                ///< largest number of rounds
    int frames = 3;                 ///< timed frames per case and round, after one warm-up frame
    int min_frames = 5;             ///< smallest number of frames of a case before its time can count as settled
};

/// Specification of a sweep: scene, settings, axes and picture size.
struct SweepSpec {
    std::string scene;                ///< name or path as given
    std::uint64_t scene_content = 0;  ///< scene_content_key()
    std::size_t triangles = 0;
    Settings base;  ///< measured_settings()
    std::vector<SweepAxis> axes;
    int width = 640, height = 360;  ///< size of the picture
    bool area = false;              ///< truth.area, which all cases share
    Shard shard;
};

/// Computes a hash of a scene's drawable content. A file read twice, or from another place, gives the same hash.
std::uint64_t scene_content_key(const Scene& scene);

/// Makes the specification of a sweep.
SweepSpec sweep_spec(const std::string& scene_name, const Scene& scene, const Settings& settings,
                     std::vector<SweepAxis> axes, int width, int height);

/// Converts the specification of a sweep to JSON.
nlohmann::ordered_json spec_json(const SweepSpec& spec);
/// Reads the specification of a sweep from the JSON that spec_json() writes. @param settings_version version of the
/// settings in the file (earlier.h) @throws Error
SweepSpec spec_from_json(const nlohmann::ordered_json& json, int settings_version = kSettingsVersion);

/// Computes a hash of a sweep's cases and their order, which follow from the specification and the settings table.
std::string plan_key(const SweepPlan& plan);

/// Describes the first difference of two sweeps' specifications ("map.format: d16 there, d24 here"); empty if equal.
/// @param there, here JSON of spec_json() @param with_shard also compares the shards
std::string spec_difference(const nlohmann::ordered_json& there, const nlohmann::ordered_json& here,
                            bool with_shard = true);

}  // namespace si
